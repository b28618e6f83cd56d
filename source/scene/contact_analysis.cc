#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/contact/surface/initial_stress.h>
#include <nmm/dynamics/strength_reduction.h>

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

    ContactAnalysis::ContactAnalysis(const Scene        &scene,
                                     const PhysicalMesh &physical_mesh,
                                     CoverSystem        &covers)
      : scene(&scene)
      , covers(&covers)
      , surface(std::make_unique<ContactSurface>(
          covers,
          scene.make_obstacles(physical_mesh, &switches)))
    {
    }


    void
    ContactAnalysis::make_contact(
      const dealii::AffineConstraints<double> &constraints,
      const ElasticityProblem                 &problem)
    {
      cell_size         = contact_cell_size(*surface);
      this->constraints = &constraints;
      full_strength     = scene->make_contact_parameters(*surface, problem);
      // With a larger reach, all faces would be searched for every point.
      constexpr double most    = 10.;
      const auto       corners = covers->manifold_mesh()
                             .physical_mesh()
                             .bounding_box()
                             .get_boundary_points();
      const double extent = corners.first.distance(corners.second);
      AssertThrow(
        full_strength.reach <= most * extent,
        InputError("faces would be looked for within " +
                     to_text(full_strength.reach) +
                     " m, more than ten times the size of the solid, " +
                     to_text(extent) + " m",
                   "parameter 'Contact/Reach'",
                   "leave it out, or choose somewhat more than blocks "
                   "move in a step"));
      contact_pointer =
        std::make_unique<Contact>(*surface, constraints, full_strength);
      // The tolerance for the rounding of arcs, over the reach.
      constexpr double tolerance = 1e-6;
      contact_pointer->set_time(0.);
      surface->check_initial_overlap(tolerance * contact().parameters().reach);
    }


    const std::vector<ObstacleRelease> &
    ContactAnalysis::releases() const
    {
      return switches.releases;
    }


    void
    ContactAnalysis::begin_anew(const double factor)
    {
      contact_pointer =
        std::make_unique<Contact>(*surface,
                                  *constraints,
                                  reduce_strength(full_strength, factor));
      contact_pointer->set_time(0.);
    }


    const ContactAnalysis::State &
    ContactAnalysis::last_state() const
    {
      return state;
    }


    void
    ContactAnalysis::show_state(const State &earlier)
    {
      state = earlier;
    }


    void
    ContactAnalysis::hold_obstacles(const bool are_held)
    {
      *switches.is_frozen = are_held;
      contact().set_absent_bodies(std::vector<bool>(surface->n_bodies()));
      contact().set_time(0.);
    }


    Contact &
    ContactAnalysis::contact()
    {
      return *contact_pointer;
    }


    const Contact &
    ContactAnalysis::contact() const
    {
      return *contact_pointer;
    }


    bool
    ContactAnalysis::all_are_touched(const ElasticityProblem &problem) const
    {
      if (Parallel::n_mpi_processes(covers->communicator()) > 1)
        return true;
      using Type = BoundaryCondition::Type;
      const bool has_conditions =
        std::any_of(problem.boundary_conditions.begin(),
                    problem.boundary_conditions.end(),
                    [](const BoundaryCondition &condition) {
                      return condition.type == Type::displacement ||
                             condition.type == Type::normal_displacement;
                    });
      if (has_conditions || !problem.fixed_points.empty())
        return contact().report().n_stick + contact().report().n_slip > 0;
      const auto       &edges = surface->edges();
      std::vector<bool> is_touched(surface->n_bodies(), false);
      std::fill(is_touched.end() - surface->obstacles().size(),
                is_touched.end(),
                true);
      for (bool goes_on = true; goes_on;)
      {
        goes_on = false;
        for (const ContactPoint &point : contact().points())
          if (point.state != ContactState::open)
          {
            const unsigned int a = edges[point.edge].body,
                               b = edges[point.master].body;
            if (is_touched[a] != is_touched[b])
              is_touched[a] = is_touched[b] = goes_on = true;
          }
      }
      return std::find(is_touched.begin(), is_touched.end(), false) ==
             is_touched.end();
    }


    std::string
    ContactAnalysis::description() const
    {
      const ContactParameters &parameters = contact().parameters();
      const OutputParameters  &output     = scene->parameters().output;
      std::ostringstream       text;
      text.precision(3);
      text << surface->edges().size() << " edges of faces, "
           << surface->obstacles().size() << " obstacle(s), normal stiffness "
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
        surface->n_bodies() - surface->obstacles().size() + obstacle;
      const auto &edges = surface->edges();
      for (unsigned int e = 0; e < edges.size(); ++e)
      {
        if (surface->is_rigid(e))
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
              const auto                 place = surface->reference_place(k, t);
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
      for (unsigned int i = 0; i < surface->obstacles().size(); ++i)
        if (!is_in_front(i))
          result.push_back(
            "the whole solid lies on the left of the obstacle '" +
            surface->obstacles()[i].name +
            "', which is rigid there: draw its line in the other "
            "direction if they are to touch");
      const auto &corners = full_strength.rounded_corners;
      if (!corners.empty())
      {
        const LockedCorner &first = corners.front();
        const std::string   more =
          corners.size() == 1 ? ""
                                : " (and " + std::to_string(corners.size() - 1) +
                                  " more of this kind)";
        std::ostringstream length;
        length.precision(3);
        length << full_strength.corner_rounding << ' '
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
      if (!full_strength.initial_stress.empty() &&
          full_strength.integration == ContactIntegration::points)
        notices.push_back(
          "springs at vertices do not bear the initial stress, so that blocks "
          "move until their faces are pressed: choose 'Contact/Integration = "
          "length' for blocks that are to begin at rest");
      const OutputParameters &output = scene->parameters().output;
      for (const ExceededStrength &faces :
           find_exceeded_strength(*surface, full_strength))
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


    void
    ContactAnalysis::remember_states()
    {
      remembered.clear();
      if (contact().is_idle())
        return;
      for (const ContactPoint &point : contact().points())
        remembered.push_back({point.edge, point.s, point.state});
    }


    unsigned int
    ContactAnalysis::count_changes() const
    {
      const auto is_before = [](const PointState &a, const PointState &b) {
        return a.edge != b.edge ? a.edge < b.edge : a.s < b.s;
      };
      unsigned int count    = 0;
      bool         are_same = state.points.size() == remembered.size();
      for (std::size_t i = 0; are_same && i < remembered.size(); ++i)
      {
        are_same = state.points[i].edge == remembered[i].edge &&
                   state.points[i].s == remembered[i].s;
        count += state.points[i].state != remembered[i].state;
      }
      if (are_same)
        return Parallel::sum(count, covers->communicator());

      // The points have changed, so each is compared with the nearest stored point on the same
      // edge. A point without a stored one was out of reach, hence open.
      count                          = 0;
      std::vector<PointState> sorted = remembered;
      std::stable_sort(sorted.begin(), sorted.end(), is_before);
      for (const ContactPoint &point : state.points)
      {
        const PointState here{point.edge, point.s, point.state};
        const auto       after =
          std::lower_bound(sorted.begin(), sorted.end(), here, is_before);
        double       distance = std::numeric_limits<double>::max();
        ContactState before   = ContactState::open;
        for (const int offset : {0, -1})
        {
          if ((offset < 0 && after == sorted.begin()) ||
              (offset == 0 && after == sorted.end()))
            continue;
          const PointState &other = *(after + offset);
          if (other.edge != point.edge ||
              std::abs(other.s - point.s) >= distance)
            continue;
          distance = std::abs(other.s - point.s);
          before   = other.state;
        }
        count += before != point.state;
      }
      return Parallel::sum(count, covers->communicator());
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
      for (const RigidObstacle &obstacle : surface->obstacles())
      {
        names.push_back(obstacle.name + "_force_x");
        names.push_back(obstacle.name + "_force_y");
      }
      return names;
    }


    const ContactSurface &
    ContactAnalysis::faces() const
    {
      return *surface;
    }


    void
    ContactAnalysis::continue_from(const double earlier_penetration)
    {
      largest_penetration = std::max(largest_penetration, earlier_penetration);
    }


    double
    ContactAnalysis::largest_penetration_so_far() const
    {
      return largest_penetration;
    }


    void
    ContactAnalysis::take_state(const double work)
    {
      state.points.clear();
      state.report = ContactReport();
      if (!contact().is_idle())
      {
        state.points = contact().points();
        state.report = contact().report();
      }
      state.report.n_changes = count_changes();
      state.pressure         = largest_pressure(*surface, state.points);
      state.forces           = obstacle_forces(*surface, state.points);
      state.friction_work    = work;
      largest_penetration =
        std::max(largest_penetration, state.report.largest_penetration);
    }


    std::vector<double>
    ContactAnalysis::numbers(const double thickness) const
    {
      std::vector<double> values = {double(state.report.n_open),
                                    double(state.report.n_stick),
                                    double(state.report.n_slip),
                                    double(state.report.n_bonded),
                                    double(state.report.n_changes),
                                    state.report.largest_penetration,
                                    state.report.largest_penetration /
                                      cell_size,
                                    state.pressure,
                                    thickness * state.report.energy,
                                    thickness * state.friction_work};
      for (const auto &force : state.forces)
        values.insert(values.end(),
                      {thickness * force[0], thickness * force[1]});
      return values;
    }


    std::vector<ContactSample>
    ContactAnalysis::points() const
    {
      return gather_contact_points(*surface, state.points);
    }


    std::vector<ContactForce>
    ContactAnalysis::forces_on_faces() const
    {
      std::vector<ContactForce> forces;
      for (const ContactSample &point : points())
        if (point.weight > 0. && !surface->is_rigid(point.slave) &&
            !surface->is_rigid(point.master))
          forces.push_back(
            {point.reference, -point.normal, point.weight * point.traction()});
      return forces;
    }


    std::string
    ContactAnalysis::progress() const
    {
      std::ostringstream text;
      text.precision(2);
      text << state.report.n_stick << " stick, " << state.report.n_slip
           << " slip, " << state.report.n_open << " open";
      if (state.report.n_bonded > 0)
        text << ", " << state.report.n_bonded << " bonded";
      text << ", " << state.report.n_changes << " change(s), penetration "
           << state.report.largest_penetration << ' '
           << scene->parameters().output.length_unit;
      return text.str();
    }


    std::string
    ContactAnalysis::find_deep_penetration(const double penetration) const
    {
      const double given = scene->parameters().contact.max_penetration;
      const double limit = given > 0. ? given : cell_size;
      if (penetration <= limit)
        return "";
      std::ostringstream text;
      text << "a penetration of " << penetration << ' '
           << scene->parameters().output.length_unit << ", more than the "
           << (given > 0. ? "'Contact/Largest penetration'"
                          : "cell size at faces")
           << " of " << limit;
      return text.str();
    }


    std::string
    ContactAnalysis::find_deep_penetration() const
    {
      return find_deep_penetration(state.report.largest_penetration);
    }


    double
    ContactAnalysis::pressure_of_rounding() const
    {
      constexpr double rounding = 1e-15;
      const auto      &box      = covers->manifold_mesh()
                          .physical_mesh()
                          .bounding_box()
                          .get_boundary_points();
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
      summary.add("contact_open", state.report.n_open);
      summary.add("contact_stick", state.report.n_stick);
      summary.add("contact_slip", state.report.n_slip);
      summary.add("contact_bonded", state.report.n_bonded);
      summary.add("largest_pressure", state.pressure, output.stress_unit);
      summary.add("penetration",
                  state.report.largest_penetration,
                  output.length_unit);
      summary.add("largest_penetration",
                  largest_penetration,
                  output.length_unit);
      summary.add("largest_penetration_over_cell",
                  largest_penetration / cell_size);
      summary.add("contact_energy", thickness * state.report.energy, energy);
      summary.add("friction_work", thickness * state.friction_work, energy);
      for (unsigned int i = 0; i < state.forces.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c)
          summary.add(surface->obstacles()[i].name + "_force_" +
                        std::string(1, "xy"[c]),
                      thickness * state.forces[i][c],
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


    NewtonParameters
    contact_newton_parameters(const Scene &scene, Progress &progress)
    {
      const NewtonParameters &given    = scene.parameters().newton.newton;
      const NewtonParameters  defaults = NewtonParameters();
      NewtonParameters newton   = ContactStatics::default_newton_parameters();
      newton.residual_tolerance = given.residual_tolerance;
      if (given.energy_tolerance != defaults.energy_tolerance)
        newton.energy_tolerance = given.energy_tolerance;
      if (given.max_iterations != defaults.max_iterations)
        newton.max_iterations = given.max_iterations;
      return show_iterations(newton, progress);
    }


    AccountedContact::AccountedContact(const ModelLayout  &layout,
                                       ContactAnalysis    &analysis,
                                       const ContactUpdate update)
      : term(layout, analysis.contact(), analysis.releases(), update)
      , analysis(&analysis)
    {
    }


    StepFault
    AccountedContact::find_fault(const Vector &)
    {
      StepFault      fault;
      const Contact &contact = term.contact();
      if (contact.is_idle())
        return fault;
      double penetration = contact.report().largest_penetration;
      // In conserving steps the reported penetration is the mean of begin and end. The value
      // computed here is a lower bound of that at the end, since the deepest point may change.
      if (contact.report().is_between)
        penetration =
          2. * penetration - analysis->last_state().report.largest_penetration;
      fault.reason = analysis->find_deep_penetration(penetration);
      return fault;
    }


    StepWork
    AccountedContact::commit(const Trial &)
    {
      work += term.dissipated();
      // The state is taken now, since the integrator assembles once more with all points sticking.
      analysis->take_state(work);
      return {};
    }


    void
    AccountedContact::save(ByteWriter &archive) const
    {
      archive &work & analysis->largest_penetration_so_far();
    }


    void
    AccountedContact::restore(ByteReader &archive)
    {
      double         penetration;
      archive &work &penetration;
      require_in_checkpoint(std::isfinite(work) && std::isfinite(penetration),
                            "work or penetration of contact is not finite");
      analysis->continue_from(penetration);
    }


    void
    AccountedContact::continue_from(const ContactHistory &history,
                                    const double          friction_work)
    {
      work = friction_work;
      term.restore_history(history);
    }
  } // namespace internal
} // namespace NMM
