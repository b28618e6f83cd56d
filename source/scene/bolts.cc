#include <nmm/base/archive.h>
#include <nmm/output/csv_series.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <scene/bolts.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// The stage that begins at the load factor 1 + i installs bolts that its parameters name.
      std::vector<Bolt>
      bolts_of(const SceneParameters      &parameters,
               const SceneBolts::Installed installed)
      {
        std::vector<Bolt>  result;
        const unsigned int n_stages =
          installed == SceneBolts::Installed::in_stages
            ? parameters.stages.size()
            : 0;
        for (const BoltParameters &one : parameters.bolts)
        {
          double installed_at = std::numeric_limits<double>::lowest();
          for (unsigned int i = 0; i < n_stages; ++i)
          {
            const auto &names = parameters.stages[i].installed;
            if (std::find(names.begin(), names.end(), one.name) != names.end())
              installed_at = 1. + i;
          }
          for (const Bolt &bolt : one.make_bolts(installed_at))
            result.push_back(bolt);
        }
        return result;
      }


      const char *
      word_for(const BoltReport::Bond bond)
      {
        switch (bond)
        {
          case BoltReport::Bond::elastic:
            return "elastic";
          case BoltReport::Bond::yielded:
            return "yielded";
          default:
            return "none";
        }
      }
    } // namespace


    std::unique_ptr<SceneBolts>
    SceneBolts::make(const Scene &scene)
    {
      return scene.parameters().bolts.empty()
               ? nullptr
               : std::make_unique<SceneBolts>(scene);
    }


    SceneBolts::SceneBolts(const Scene &scene)
      : scene(&scene)
    {
    }


    TermMaker
    SceneBolts::maker()
    {
      return [this](const Solid &solid, const ModelLayout &layout) {
        const SceneParameters &parameters = scene->parameters();
        auto                   term =
          std::make_unique<BoltTerm>(solid.covers(),
                                     layout,
                                     bolts_of(parameters,
                                              parameters.model.analysis ==
                                                  Analysis::statics
                                                ? Installed::in_stages
                                                : Installed::before),
                                     parameters.model.kinematics);
        bolts = term.get();
        return term;
      };
    }


    std::vector<TermMaker>
    SceneBolts::makers(const Scene &scene, const Installed installed)
    {
      if (scene.parameters().bolts.empty())
        return {};
      return {[&scene, installed](const Solid       &solid,
                                  const ModelLayout &layout) {
        return std::make_unique<BoltTerm>(solid.covers(),
                                          layout,
                                          bolts_of(scene.parameters(),
                                                   installed),
                                          scene.parameters().model.kinematics);
      }};
    }


    void
    SceneBolts::take_state(const ForceTerm::Vector &u)
    {
      reports = bolts->reports(u);
    }


    namespace
    {
      double
      largest_force(const std::vector<BoltReport> &reports)
      {
        double result = 0.;
        for (const BoltReport &report : reports)
          if (std::abs(report.largest_force) > std::abs(result))
            result = report.largest_force;
        return result;
      }
    } // namespace


    std::string
    SceneBolts::progress() const
    {
      std::ostringstream text;
      text.precision(4);
      text << "largest bolt force " << largest_force(reports) << ' '
           << scene->parameters().output.stress_unit << '*'
           << scene->parameters().output.length_unit << "^2";
      return text.str();
    }


    void
    SceneBolts::add_rows(const unsigned int step, const double value)
    {
      if (step == last_step && !rows.empty())
        return;
      last_step = step;
      std::ostringstream places, joints;
      places.precision(12);
      joints.precision(12);
      for (unsigned int b = 0; b < reports.size(); ++b)
      {
        if (!reports[b].is_installed)
          continue;
        const std::string name = quoted(bolts->bolts()[b].name);
        for (const BoltReport::Place &place : reports[b].places)
          places << step << ',' << value << ',' << name << ',' << place.s << ','
                 << place.x[0] << ',' << place.x[1] << ',' << place.force << ','
                 << place.slip << ',' << word_for(place.bond) << '\n';
        for (const BoltReport::Crossing &joint : reports[b].crossings)
          joints << step << ',' << value << ',' << name << ','
                 << quoted(joint.joint) << ',' << joint.s << ',' << joint.x[0]
                 << ',' << joint.x[1] << ',' << joint.opening << ','
                 << joint.slip << ',' << joint.force << ',' << joint.dowel_force
                 << ',' << joint.moment << '\n';
      }
      rows += places.str();
      joint_rows += joints.str();
    }


    void
    SceneBolts::write(const OutputDirectory &directory) const
    {
      const std::string time =
        scene->parameters().model.analysis == Analysis::statics ? "load_factor"
                                                                : "time";
      directory.write_text("bolts.csv", [&](std::ostream &out) {
        out << "step," << time << ",bolt,s,x,y,axial_force,slip,bond\n" << rows;
      });
      directory.write_text("bolt-joints.csv", [&](std::ostream &out) {
        out << "step," << time
            << ",bolt,joint,s,x,y,opening,joint_slip,axial_force,dowel_force,"
               "moment\n"
            << joint_rows;
      });
    }


    void
    SceneBolts::add_to(PictureData &picture) const
    {
      for (const BoltReport &report : reports)
        for (unsigned int i = 0;
             report.is_installed && i + 1 < report.places.size();
             ++i)
        {
          const BoltReport::Place &a = report.places[i],
                                  &b = report.places[i + 1];
          PictureData::BoltLine line;
          line.line  = {{a.x, a.u}, {b.x, b.u}};
          line.force = 0.5 * (a.force + b.force);
          picture.bolts.push_back(line);
        }
    }


    std::vector<std::string>
    SceneBolts::description() const
    {
      std::vector<std::string> result;
      const OutputParameters  &output = scene->parameters().output;
      const std::string        force =
        output.stress_unit + "*" + output.length_unit + "^2";
      for (unsigned int b = 0; b < reports.size(); ++b)
      {
        const BoltReport  &report = reports[b];
        std::ostringstream text;
        text.precision(4);
        text << "bolt '" << bolts->bolts()[b].name << "': ";
        if (!report.is_installed)
          text << "not installed";
        else
          text << "largest axial force " << report.largest_force << ' '
               << force;
        if (report.slipped_length > 0.)
          text << ", the bond has slipped on " << report.slipped_length << ' '
               << output.length_unit;
        if (report.yielded_length > 0.)
          text << ", the bar has yielded on " << report.yielded_length << ' '
               << output.length_unit;
        if (report.n_breaks > 0)
          text << ", the bar is broken in " << report.n_breaks << " place(s)";
        double shear = 0.;
        for (const BoltReport::Crossing &joint : report.crossings)
          shear = std::max(shear, std::abs(joint.dowel_force));
        if (shear > 0.)
          text << ", largest dowel force " << shear << ' ' << force;
        if (bolts->bolts()[b].spacing != 1.)
          text << "; one every " << bolts->bolts()[b].spacing << ' '
               << output.length_unit << " out of the plane";
        result.push_back(text.str());
      }
      return result;
    }


    void
    SceneBolts::add_to(Summary &summary) const
    {
      const OutputParameters &output  = scene->parameters().output;
      double                  slipped = 0., yielded = 0., dowel = 0.;
      unsigned int            n_breaks = 0;
      for (const BoltReport &report : reports)
      {
        slipped += report.slipped_length;
        yielded += report.yielded_length;
        n_breaks += report.n_breaks;
        for (const BoltReport::Crossing &joint : report.crossings)
          dowel = std::max(dowel, std::abs(joint.dowel_force));
      }
      const std::string force =
        output.stress_unit + "*" + output.length_unit + "^2";
      summary.add("bolts", reports.size());
      summary.add("largest_bolt_force", largest_force(reports), force);
      summary.add("largest_dowel_force", dowel, force);
      summary.add("bond_slipped_length", slipped, output.length_unit);
      summary.add("bolt_yielded_length", yielded, output.length_unit);
      summary.add("bolt_breaks", n_breaks);
    }
  } // namespace internal
} // namespace NMM
