#include <nmm/analysis/contact_model.h>
#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/contact/diagnostics/face_forces.h>
#include <nmm/dynamics/strength_reduction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace Parallel = dealii::Utilities::MPI;

  namespace
  {
    /// The obstacles of @p setup, which stay at their positions of t = 0 while @p is_frozen.
    std::vector<RigidObstacle>
    make_obstacles(const ContactSetup          &setup,
                   const std::shared_ptr<bool> &is_frozen)
    {
      std::vector<RigidObstacle> obstacles = setup.obstacles;
      for (RigidObstacle &obstacle : obstacles)
        if (const auto motion = obstacle.displacement)
          obstacle.displacement = [motion, is_frozen](const double t) {
            return motion(*is_frozen ? 0. : t);
          };
      return obstacles;
    }


    /// @throws InputError for a reach with which all faces would be searched for every point.
    void
    check_reach(const double reach, const PhysicalMesh &mesh)
    {
      constexpr double most    = 10.;
      const auto       corners = mesh.bounding_box().get_boundary_points();
      const double     extent  = corners.first.distance(corners.second);
      if (reach <= most * extent)
        return;
      std::ostringstream text;
      text << "faces would be looked for within " << reach
           << " m, more than ten times the size of the solid, " << extent
           << " m";
      throw InputError(text.str(),
                       "parameter 'Contact/Reach'",
                       "leave it out, or choose somewhat more than blocks "
                       "move in a step");
    }
  } // namespace


  ContactModel::ContactModel(const Solid             &solid,
                             const ElasticityProblem &problem,
                             ContactSetup             given)
    : solid(&solid)
    , setup(std::move(given))
    , is_frozen(std::make_shared<bool>(false))
    , surface(
        std::make_unique<ContactSurface>(solid.covers(),
                                         make_obstacles(setup, is_frozen)))
    , size_of_cells(contact_cell_size(*surface))
    , parameters(
        setup.make_parameters
          ? setup.make_parameters(*surface, problem)
          : choose_contact_parameters(*surface, problem, setup.choices))
  {
    check_reach(parameters.reach, solid.physical_mesh());
    begin_anew();
    // The tolerance for the rounding of arcs, over the reach.
    constexpr double tolerance = 1e-6;
    surface->check_initial_overlap(tolerance * contact().parameters().reach);
  }


  void
  ContactModel::begin_anew(const double factor)
  {
    law = std::make_unique<Contact>(*surface,
                                    solid->constraints(),
                                    factor == 1.
                                      ? parameters
                                      : reduce_strength(parameters, factor));
    law->set_time(0.);
  }


  void
  ContactModel::hold_obstacles(const bool are_held)
  {
    *is_frozen = are_held;
    law->set_absent_bodies(std::vector<bool>(surface->n_bodies()));
    law->set_time(0.);
  }


  bool
  ContactModel::all_are_touched(const ElasticityProblem &problem) const
  {
    if (Parallel::n_mpi_processes(solid->covers().communicator()) > 1)
      return true;
    const bool has_conditions =
      std::any_of(problem.boundary_conditions.begin(),
                  problem.boundary_conditions.end(),
                  [](const BoundaryCondition &condition) {
                    return condition.is_support();
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


  void
  ContactModel::remember_states()
  {
    remembered.clear();
    if (law->is_idle())
      return;
    for (const ContactPoint &point : law->points())
      remembered.push_back({point.edge, point.s, point.state});
  }


  unsigned int
  ContactModel::count_changes() const
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
      return Parallel::sum(count, solid->covers().communicator());

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
        if (other.edge != point.edge || std::abs(other.s - point.s) >= distance)
          continue;
        distance = std::abs(other.s - point.s);
        before   = other.state;
      }
      count += before != point.state;
    }
    return Parallel::sum(count, solid->covers().communicator());
  }


  void
  ContactModel::continue_from(const double earlier_penetration)
  {
    largest_penetration = std::max(largest_penetration, earlier_penetration);
  }


  void
  ContactModel::take_state(const double work)
  {
    state.points.clear();
    state.report = ContactReport();
    if (!law->is_idle())
    {
      state.points = law->points();
      state.report = law->report();
    }
    state.report.n_changes = count_changes();
    state.pressure         = largest_pressure(*surface, state.points);
    state.forces           = obstacle_forces(*surface, state.points);
    state.friction_work    = work;
    continue_from(state.report.largest_penetration);
  }


  std::string
  ContactModel::find_deep_penetration(const double penetration) const
  {
    const double given = setup.max_penetration;
    const double limit = given > 0. ? given : size_of_cells;
    if (penetration <= limit)
      return "";
    std::ostringstream text;
    text << "a penetration of " << penetration << ' ' << setup.length_unit
         << ", more than the "
         << (given > 0. ? "'Contact/Largest penetration'"
                        : "cell size at faces")
         << " of " << limit;
    return text.str();
  }


  AccountedContact::AccountedContact(const ModelLayout  &layout,
                                     ContactModel       &model,
                                     const ContactUpdate update)
    : term(layout, model.contact(), model.releases(), update)
    , model(&model)
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
        2. * penetration - model->last_state().report.largest_penetration;
    fault.reason = model->find_deep_penetration(penetration);
    return fault;
  }


  StepWork
  AccountedContact::commit(const Trial &)
  {
    work += term.dissipated();
    // The state is taken now, since the integrator assembles once more with all points sticking.
    model->take_state(work);
    return {};
  }


  void
  AccountedContact::save(ByteWriter &archive) const
  {
    archive &work & model->largest_penetration_so_far();
  }


  void
  AccountedContact::restore(ByteReader &archive)
  {
    double         penetration;
    archive &work &penetration;
    require_in_checkpoint(std::isfinite(work) && std::isfinite(penetration),
                          "work or penetration of contact is not finite");
    model->continue_from(penetration);
  }


  void
  AccountedContact::continue_from(const ContactHistory &history,
                                  const double          friction_work)
  {
    work = friction_work;
    term.restore_history(history);
  }
} // namespace NMM
