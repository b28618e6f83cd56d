#include <nmm/base/exceptions.h>
#include <nmm/contact/surface/initial_stress.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <scene/contact_analysis.h>
#include <scene/parsing.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace Parallel = dealii::Utilities::MPI;

    namespace
    {
      ContactSetup
      make_setup(const Scene &scene, const PhysicalMesh &mesh)
      {
        ContactSetup setup;
        setup.obstacles       = scene.make_obstacles(mesh, &setup.releases);
        setup.make_parameters = [&scene](const ContactSurface    &surface,
                                         const ElasticityProblem &problem) {
          return scene.make_contact_parameters(surface, problem);
        };
        setup.max_penetration = scene.parameters().contact.max_penetration;
        setup.length_unit     = scene.parameters().output.length_unit;
        return setup;
      }
    } // namespace


    ContactAnalysis::ContactAnalysis(const Scene             &scene,
                                     const Solid             &solid,
                                     const ElasticityProblem &problem)
      : ContactModel(solid, problem, make_setup(scene, solid.physical_mesh()))
      , scene(&scene)
      , solid(&solid)
    {
    }


    std::string
    ContactAnalysis::description() const
    {
      const ContactParameters &parameters = contact().parameters();
      const OutputParameters  &output     = scene->parameters().output;
      std::ostringstream       text;
      text.precision(3);
      text << faces().edges().size() << " edges of faces, "
           << faces().obstacles().size() << " obstacle(s), normal stiffness "
           << parameters.law->normal_stiffness << ' ' << output.stress_unit
           << '/' << output.length_unit;
      if (parameters.penetration_tolerance > 0.)
        text << ", penetration tolerance " << parameters.penetration_tolerance
             << ' ' << output.length_unit;
      text << ", reach " << parameters.reach << ' ' << output.length_unit;
      return text.str();
    }


    bool
    ContactAnalysis::is_in_front(const unsigned int obstacle) const
    {
      const unsigned int body =
        faces().n_bodies() - faces().obstacles().size() + obstacle;
      const auto &edges = faces().edges();
      for (unsigned int e = 0; e < edges.size(); ++e)
      {
        if (faces().is_rigid(e))
          continue;
        double distance = std::numeric_limits<double>::max();
        double gap      = 0.;
        for (unsigned int k = 0; k < edges.size(); ++k)
          if (edges[k].body == body)
          {
            // Take the nearest point of a straight edge, or the nearest of some points of an arc.
            std::vector<double> places;
            if (edges[k].radius == 0.)
            {
              const dealii::Tensor<1, 2> d = edges[k].end - edges[k].start;
              const double               t =
                ((edges[e].start - edges[k].start) * d) / d.norm_square();
              places = {std::min(1., std::max(0., t))};
            }
            else
              for (unsigned int i = 0; i <= 16; ++i)
                places.push_back(i / 16.);
            for (const double t : places)
            {
              const auto                 place = faces().reference_place(k, t);
              const dealii::Tensor<1, 2> d     = edges[e].start - place.x;
              if (d.norm() < distance)
              {
                distance = d.norm();
                gap      = d * place.normal();
              }
            }
          }
        if (gap > 1e-9 * edges[e].length)
          return true;
      }
      return false;
    }


    std::vector<std::string>
    ContactAnalysis::notices() const
    {
      std::vector<std::string> result;
      for (unsigned int i = 0; i < faces().obstacles().size(); ++i)
        if (!is_in_front(i))
          result.push_back(
            "the whole solid lies on the left of the obstacle '" +
            faces().obstacles()[i].name +
            "', which is rigid there: draw its line in the other "
            "direction if they are to touch");
      const auto &corners = full_strength().rounded_corners;
      if (!corners.empty())
      {
        const LockedCorner &first = corners.front();
        const std::string   more =
          corners.size() == 1 ? ""
                                : " (and " + std::to_string(corners.size() - 1) +
                                  " more of this kind)";
        std::ostringstream length;
        length.precision(3);
        length << full_strength().corner_rounding << ' '
               << scene->parameters().output.length_unit;
        result.push_back(
          "a corner of block " + std::to_string(first.block) + " at " +
          to_string(first.place) + " lies where '" + first.along +
          "' ends and '" + first.ahead + "' is ahead" + more +
          ": a sharp corner could not slide that way, so its faces give way "
          "within " +
          length.str() +
          " of it ('Contact/Corner rounding'). If it is to slide further than "
          "that, raise the rounding, or let the face that it lies on end above "
          "the one ahead");
      }
      add_notices_of_initial_stress(result);
      return result;
    }


    void
    ContactAnalysis::add_notices_of_initial_stress(
      std::vector<std::string> &notices) const
    {
      if (!full_strength().initial_stress.empty() &&
          full_strength().integration == ContactIntegration::points)
        notices.push_back(
          "springs at vertices do not bear the initial stress, so that blocks "
          "move until their faces are pressed: choose 'Contact/Integration = "
          "length' for blocks that are to begin at rest");
      const OutputParameters &output = scene->parameters().output;
      for (const ExceededStrength &faces :
           find_exceeded_strength(faces(), full_strength()))
      {
        const bool is_pulled = -faces.pressure > faces.shear - faces.strength;
        std::ostringstream text;
        text.precision(3);
        text << "the initial stress is more than "
             << (faces.first == faces.second
                   ? "'" + faces.first + "' bears"
                   : "'" + faces.first + "' and '" + faces.second +
                       "' bear between each other")
             << ", on " << faces.length << ' ' << output.length_unit << ": at "
             << to_string(faces.place);
        if (is_pulled)
          text << " a tension of " << -faces.pressure << ' '
               << output.stress_unit;
        else
          text << " a shear of " << faces.shear << ' ' << output.stress_unit
               << " instead of " << faces.strength << ' ' << output.stress_unit;
        text << ". These faces begin with what they bear, and blocks move "
                "until the rest is in balance";
        notices.push_back(text.str());
      }
    }


    std::vector<std::string>
    ContactAnalysis::columns() const
    {
      std::vector<std::string> names = {"contact_open",
                                        "contact_stick",
                                        "contact_slip",
                                        "contact_bonded",
                                        "contact_changes",
                                        "penetration",
                                        "penetration_over_cell",
                                        "largest_pressure",
                                        "contact_energy",
                                        "friction_work"};
      for (const RigidObstacle &obstacle : faces().obstacles())
      {
        names.push_back(obstacle.name + "_force_x");
        names.push_back(obstacle.name + "_force_y");
      }
      return names;
    }


    std::vector<double>
    ContactAnalysis::numbers(const double thickness) const
    {
      std::vector<double> values = {double(last_state().report.n_open),
                                    double(last_state().report.n_stick),
                                    double(last_state().report.n_slip),
                                    double(last_state().report.n_bonded),
                                    double(last_state().report.n_changes),
                                    last_state().report.largest_penetration,
                                    last_state().report.largest_penetration /
                                      cell_size(),
                                    last_state().pressure,
                                    thickness * last_state().report.energy,
                                    thickness * last_state().friction_work};
      for (const auto &force : last_state().forces)
        values.insert(values.end(),
                      {thickness * force[0], thickness * force[1]});
      return values;
    }


    std::vector<ContactSample>
    ContactAnalysis::points() const
    {
      return gather_contact_points(faces(), last_state().points);
    }


    std::vector<ContactForce>
    ContactAnalysis::forces_on_faces() const
    {
      std::vector<ContactForce> forces;
      for (const ContactSample &point : points())
        if (point.weight > 0. && !faces().is_rigid(point.slave) &&
            !faces().is_rigid(point.master))
          forces.push_back(
            {point.reference, -point.normal, point.weight * point.traction()});
      return forces;
    }


    std::string
    ContactAnalysis::progress() const
    {
      std::ostringstream text;
      text.precision(2);
      text << last_state().report.n_stick << " stick, "
           << last_state().report.n_slip << " slip, "
           << last_state().report.n_open << " open";
      if (last_state().report.n_bonded > 0)
        text << ", " << last_state().report.n_bonded << " bonded";
      text << ", " << last_state().report.n_changes
           << " change(s), penetration "
           << last_state().report.largest_penetration << ' '
           << scene->parameters().output.length_unit;
      return text.str();
    }


    double
    ContactAnalysis::pressure_of_rounding() const
    {
      constexpr double rounding = 1e-15;
      const auto      &box =
        solid->physical_mesh().bounding_box().get_boundary_points();
      return rounding * contact().parameters().law->normal_stiffness *
             std::max(box.first.distance(box.second),
                      std::max(box.first.norm(), box.second.norm()));
    }


    void
    ContactAnalysis::add_to_summary(Summary &summary) const
    {
      const OutputParameters &output    = scene->parameters().output;
      const double            thickness = scene->parameters().model.thickness;
      const std::string       energy =
        output.stress_unit + "*" + output.length_unit + "^3";
      const std::string force =
        output.stress_unit + "*" + output.length_unit + "^2";
      summary.add("contact_open", last_state().report.n_open);
      summary.add("contact_stick", last_state().report.n_stick);
      summary.add("contact_slip", last_state().report.n_slip);
      summary.add("contact_bonded", last_state().report.n_bonded);
      summary.add("largest_pressure",
                  last_state().pressure,
                  output.stress_unit);
      summary.add("penetration",
                  last_state().report.largest_penetration,
                  output.length_unit);
      summary.add("largest_penetration",
                  largest_penetration_so_far(),
                  output.length_unit);
      summary.add("largest_penetration_over_cell",
                  largest_penetration_so_far() / cell_size());
      summary.add("contact_energy",
                  thickness * last_state().report.energy,
                  energy);
      summary.add("friction_work",
                  thickness * last_state().friction_work,
                  energy);
      for (unsigned int i = 0; i < last_state().forces.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c)
          summary.add(faces().obstacles()[i].name + "_force_" +
                        std::string(1, "xy"[c]),
                      thickness * last_state().forces[i][c],
                      force);
    }


    NewtonParameters
    show_iterations(NewtonParameters parameters, Progress &progress)
    {
      parameters.after_iteration = [&progress](const NewtonReport &report) {
        progress.show_alive([&]() {
          std::ostringstream line;
          line << "iteration " << report.iterations.size()
               << " of a step, residual " << std::setprecision(2)
               << report.relative_residual;
          return line.str();
        });
      };
      return parameters;
    }
  } // namespace internal
} // namespace NMM
