#include "study.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

namespace StepNMM4
{
  using namespace dealii;

  // @sect3{Parameters}

  namespace
  {
    bool
    is_first_rank()
    {
      return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }
  } // namespace


  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory)
  {
    Parameters parameters;
    parameters.output_directory = output_directory;

    ParameterHandler       prm;
    const Patterns::Double positive(1e-300);
    prm.add_parameter("Friction angles",
                      parameters.friction_angles,
                      "One run for each [degrees].",
                      Patterns::List(Patterns::Double(0., 89.), 1));
    prm.add_parameter("Time step",
                      parameters.step,
                      "The longest [s].",
                      positive);
    prm.add_parameter("Half step",
                      parameters.is_halved,
                      "Compute what falls with half of the step, too.");
    prm.add_parameter("Perturbation",
                      parameters.perturbation,
                      "Of the friction angle, in one more run of what falls; "
                      "0: none [degrees].",
                      Patterns::Double(0.));
    prm.add_parameter("Perturbed runs",
                      parameters.n_perturbed,
                      "With 1, 2, ... times the perturbation; more than one: "
                      "also with half of the step, if that is asked for.",
                      Patterns::Integer(0, 1000));
    prm.add_parameter("End time",
                      parameters.end_time,
                      "Or at rest [s].",
                      positive);
    prm.add_parameter("Stages",
                      parameters.stages,
                      "Times of pictures besides begin and end [s].",
                      Patterns::List(Patterns::Double(0.), 0));
    prm.add_parameter("Block length",
                      parameters.block_length,
                      "Along the layers [m].",
                      Patterns::Double(0.5, 10.));
    prm.add_parameter("Layer",
                      parameters.layer,
                      "Thickness of layers [m].",
                      Patterns::Double(0.5, 5.));
    prm.add_parameter("Spring",
                      parameters.spring,
                      "Of faces, normal and along them [Pa/m].",
                      positive);
    prm.add_parameter("Dashpot",
                      parameters.dashpot,
                      "The same [Pa s/m].",
                      Patterns::Double(0.));
    prm.add_parameter("Rock damping",
                      parameters.damping,
                      "Of blocks, times their stiffness [s].",
                      Patterns::Double(0.));
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-4.prm");
    std::sort(parameters.stages.begin(), parameters.stages.end());
    return parameters;
  }


  // @sect3{Outcomes}

  void
  Outcome::finish()
  {
    released = rows.back().external_work;
    std::vector<double> penetrations, overlaps;
    for (const Row &row : rows)
    {
      account_error = std::max(account_error, std::abs(row.balance));
      penetrations.push_back(row.penetration_over_block);
      overlaps.push_back(row.overlap_over_block);
    }
    if (released != 0.)
      account_error /= std::abs(released);
    penetration_at_rest = penetrations.back();
    overlap_at_rest     = overlaps.back();
    std::sort(penetrations.begin(), penetrations.end());
    std::sort(overlaps.begin(), overlaps.end());
    largest_penetration = penetrations.back();
    largest_overlap     = overlaps.back();
    median_penetration  = penetrations[penetrations.size() / 2];
    median_overlap      = overlaps[overlaps.size() / 2];
  }


  bool
  Outcome::stands() const
  {
    constexpr double settlement = 0.05;
    return is_at_rest && rows.back().center_of_mass.distance(
                           rows.front().center_of_mass) < settlement;
  }


  // @sect3{Tables}

  Tutorial::Row
  cells(const Row &r)
  {
    return {{"time", r.time},
            {"x", r.center_of_mass[0]},
            {"y", r.center_of_mass[1]},
            {"kinetic", r.kinetic},
            {"external_work", r.external_work},
            {"dissipated", r.dissipated},
            {"balance", r.balance},
            {"stick", r.n_stick},
            {"slip", r.n_slip},
            {"penetration_over_block", r.penetration_over_block},
            {"strain", r.strain},
            {"contact", r.contact},
            {"penetration", r.penetration},
            {"overlap", r.overlap},
            {"overlap_over_block", r.overlap_over_block}};
  }


  namespace
  {
    /// Between rows, or where the run ended.
    Point<2>
    center_of_mass_at(const Outcome &outcome, const double time)
    {
      const auto after = std::lower_bound(outcome.rows.begin(),
                                          outcome.rows.end(),
                                          time,
                                          [](const Row &row, const double t) {
                                            return row.time < t;
                                          });
      if (after == outcome.rows.begin() || after == outcome.rows.end())
        return (after == outcome.rows.end() ? outcome.rows.back() : *after)
          .center_of_mass;
      const Row &row = *(after - 1);
      return row.center_of_mass +
             (time - row.time) / (after->time - row.time) *
               (after->center_of_mass - row.center_of_mass);
    }


    /// Of the centres of mass at times that the rows on the screen have.
    void
    print_difference(const Outcome &first, const Outcome &other)
    {
      Tutorial::Table table("Centre of mass of the run '" + other.name +
                            "' against '" + first.name + "'");
      const Point<2>  start = first.rows.front().center_of_mass;
      const auto      add   = [&](const double time, const double difference) {
        table.add({{"time", time},
                   {"difference_m", difference},
                   {"of_its_way_%",
                    100. * difference /
                      center_of_mass_at(first, time).distance(start)}});
      };
      double next = 0.5;
      for (const Row &at : first.rows)
      {
        if (at.time < next && &at != &first.rows.back())
          continue;
        next = std::floor(2. * at.time) / 2. + 0.5;
        add(at.time,
            center_of_mass_at(other, at.time).distance(at.center_of_mass));
      }
      // where both end
      add(first.rows.back().time,
          other.rows.back().center_of_mass.distance(
            first.rows.back().center_of_mass));
    }
  } // namespace


  void
  report_runs(const std::string &prefix, const std::vector<Outcome> &outcomes)
  {
    Tutorial::Table runs("Runs", 12);
    for (const Outcome &o : outcomes)
    {
      runs.add({{"run", o.name},
                {"stands", o.stands()},
                {"is_at_rest", o.is_at_rest},
                {"end_time", o.rows.back().time},
                {"steps", o.n_steps},
                {"cuts", o.n_cuts},
                {"iterations", o.n_iterations},
                {"account_error", o.account_error},
                {"largest_penetration", o.largest_penetration},
                {"penetration_at_rest", o.penetration_at_rest},
                {"largest_overlap", o.largest_overlap},
                {"overlap_at_rest", o.overlap_at_rest},
                {"median_penetration", o.median_penetration},
                {"median_overlap", o.median_overlap},
                {"friction_angle", o.friction_angle},
                {"step", o.step},
                {"blocks", o.n_blocks},
                {"unknowns", o.n_unknowns},
                {"released", o.released},
                {"start_seconds", o.start_time},
                {"motion_seconds", o.motion_time},
                {"way",
                 o.rows.back().center_of_mass.distance(
                   o.rows.front().center_of_mass)}});
      Tutorial::Table table;
      for (const Row &row : o.rows)
        table.add(cells(row));
      table.write(prefix + o.name + ".csv");
    }
    runs.write(prefix + "runs.csv");
    for (const Outcome &other : outcomes)
      for (const Outcome &first : outcomes)
        if (&other != &first && other.name.rfind(first.name + '-', 0) == 0)
          print_difference(first, other);
  }


  void
  print_means(const std::vector<Outcome> &outcomes)
  {
    // those of a friction angle as it is in names and a step
    std::map<std::pair<std::string, double>, std::vector<const Outcome *>> runs;
    for (const Outcome &outcome : outcomes)
      runs[{outcome.name.substr(0, outcome.name.find('-')), outcome.step}]
        .push_back(&outcome);
    for (const auto &[run, members] : runs)
    {
      const double n = members.size();
      if (n < 3.)
        continue;
      double end = 0.;
      for (const Outcome *outcome : members)
        end = std::max(end, outcome->rows.back().time);
      std::ostringstream title;
      title << "Way of the centre of mass [m], friction angle " << run.first
            << " degrees, steps of " << run.second << " s, " << members.size()
            << " runs";
      Tutorial::Table table(title.str());
      for (double time = std::min(1., end);; time = std::min(time + 1., end))
      {
        std::vector<double> ways;
        for (const Outcome *outcome : members)
          ways.push_back(center_of_mass_at(*outcome, time)
                           .distance(outcome->rows.front().center_of_mass));
        const double mean = std::accumulate(ways.begin(), ways.end(), 0.) / n;
        double       squares = 0.;
        for (const double way : ways)
          squares += (way - mean) * (way - mean);
        const double deviation = std::sqrt(squares / (n - 1.));
        const auto [least, largest] =
          std::minmax_element(ways.begin(), ways.end());
        table.add({{"time", time},
                   {"mean", mean},
                   {"its_error", deviation / std::sqrt(n)},
                   {"deviation", deviation},
                   {"least", *least},
                   {"largest", *largest}});
        if (time == end)
          break;
      }
    }
  }


  // @sect3{Pictures}

  // All in the same part of the plane.
  Film::Film(const Parameters &parameters_in, const Outcome &outcome)
    : prefix(parameters_in.output_directory + "/step-nmm-4-" + outcome.name)
  {
    std::ostringstream text;
    text << "Slope, friction angle " << outcome.friction_angle << " degrees";
    title                        = text.str();
    parameters.quantity          = NMM::Quantity::displacement;
    parameters.deformation_scale = 1.;
    parameters.mesh_lines        = false;
    parameters.picture_width     = 1200;
    if (is_first_rank())
    {
      // an earlier run's frames
      std::filesystem::remove(prefix + "-animation.frames");
      animation =
        std::make_unique<NMM::Animation>(prefix + "-animation.frames");
    }
  }


  const NMM::PictureParameters &
  Film::output() const
  {
    return parameters;
  }


  void
  Film::add_frame(const double time, const NMM::PictureData &data)
  {
    if (animation)
      animation->add_frame(time, data);
  }


  void
  Film::draw_stage(const double time, const NMM::PictureData &data)
  {
    if (!animation)
      return;
    std::ostringstream note;
    note << title << ", t = " << std::fixed << std::setprecision(2) << time
         << " s";
    NMM::PictureFrame frame;
    frame.view = std::make_pair(Point<2>(-33., -1.), Point<2>(21.5, 20.5));
    NMM::draw_picture(data,
                      parameters,
                      note.str(),
                      prefix + "-stage-" + std::to_string(++n_stages) + ".png",
                      frame);
  }


  void
  Film::finish()
  {
    if (!animation)
      return;
    std::ofstream out(prefix + "-animation.html");
    animation->write(out, title, parameters);
    animation->discard();
  }
} // namespace StepNMM4
