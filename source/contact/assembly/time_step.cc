// Contact in time steps: forces that conserve energy.
#include <nmm/contact/assembly/time_step.h>

#include <deal.II/base/mpi.h>

#include <contact/contact.h>
#include <contact/law/point_springs.h>

namespace NMM
{
  using namespace internal;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  namespace
  {
    /// Let the cohesion of a point be that of its present pressure until the geometry is not frozen.
    void
    keep_cohesion(const ContactPoint &point, PointData &fixed)
    {
      fixed.keeps_cohesion = true;
      if (fixed.law != nullptr && !fixed.law->depends_on_slip())
        fixed.kept_cohesion = fixed.law->cohesion_at(point.pressure).value;
    }


    /// Set what a point has at the beginning of a step. The anchor of a point that slides or has no
    /// shear follows from its shear: anchors that are interpolated between those of other points may
    /// be far away.
    void
    begin_point(const ContactSurface &surface,
                const bool            has_anchors,
                ContactPoint         &point,
                PointData            &fixed)
    {
      fixed.gap_begin    = point.gap - opening_before(point, fixed);
      fixed.master_begin = point.master;
      fixed.shear_begin  = point.shear;
      if (!has_anchors || point.master == invalid_index ||
          point.state == ContactState::stick || point.is_bonded)
        return;
      if (point.state == ContactState::open)
        point.shear = fixed.shear_begin = 0.;
      const double length = surface.place(point.master, point.t).a.norm();
      point.stick_edge    = point.master;
      point.stick_t       = point.t;
      point.stick_t -= (point.shear - initial_shear(point, fixed)) /
                       (fixed.law->shear_spring() * length);
    }
  } // namespace


  ContactTimeStep::ContactTimeStep(Contact &contact)
    : contact(&contact)
    , data(contact.data.get())
  {
  }


  void
  ContactTimeStep::begin(const Vector &u, const double time)
  {
    Data &d = *data;
    d.enter(Data::Stage::step_begun,
            d.stage != Data::Stage::created &&
              d.stage != Data::Stage::accepted);
    d.updater.set_positions(Data::Positions::of_motion);
    d.matrix.begin_step();
    contact->set_time(time);
    // Points that have moved between the last step and this one do not dilate.
    d.tractions.freeze_slip(true);
    contact->assemble(u, false);
    d.tractions.freeze_slip(false);
    d.stage = Data::Stage::step_begun;
    d.states.begin(time);
    const bool has_anchors = d.parameters.transmit_shear();
    for (unsigned int q = 0; d.updater.is_frozen() && q < d.set.data.size();
         ++q)
      keep_cohesion(d.set.points[q], d.set.data[q]);
    d.memory.keep_energies(*d.surface, d.set);
    for (unsigned int q = 0; q < d.set.data.size(); ++q)
      begin_point(*d.surface, has_anchors, d.set.points[q], d.set.data[q]);
  }


  void
  Contact::Data::find_ends()
  {
    using PointEnd = StepTractions::PointEnd;
    const std::vector<unsigned int> &numbers =
      chosen.chosen_points(set.points.size());
    set.near_points.clear();
    for_each_in_order<PointEnd>(
      0,
      numbers.size(),
      [&](const unsigned int i, PointEnd &end) {
        end =
          step_tractions.find_end(set.points[numbers[i]], set.data[numbers[i]]);
      },
      [&](const unsigned int i, const PointEnd &end) {
        sums.add_changes(end.has_opened);
        if (end.is_near)
          set.near_points.push_back(numbers[i]);
      });
  }


  std::vector<bool>
  ContactTimeStep::pressed_bodies() const
  {
    const Data       &d     = *data;
    const auto       &edges = d.surface->edges();
    std::vector<bool> result(d.surface->n_bodies(), false);
    for (const ContactPoint &point : d.set.points)
      if (point.pressure > 0.)
        result[edges[point.edge].body] = result[edges[point.master].body] =
          true;
    return result;
  }


  void
  ContactTimeStep::expect(const Vector &u)
  {
    data->states.expect(u);
  }


  void
  ContactTimeStep::assemble(const Vector &end,
                            const double  time,
                            const bool    with_tangent,
                            BodyMatrix   *body_matrix)
  {
    Data &d = *data;
    d.enter(Data::Stage::step_assembled,
            d.stage == Data::Stage::step_begun ||
              d.stage == Data::Stage::step_assembled ||
              (d.stage == Data::Stage::assembled && d.updater.is_between()));
    d.updater.set_positions(Data::Positions::between);
    d.sums.begin();
    if (contact->is_idle())
    {
      d.matrix.clear_forces();
      return;
    }
    const bool on_one_rank = Parallel::n_mpi_processes(d.communicator()) == 1;
    const bool is_sparse   = with_tangent && body_matrix == nullptr;
    d.updater.freeze(false);
    d.detection.projector.admit_any_depth();
    d.states.set_end_time(time);
    // The pattern depends only on the state at the beginning of the step and what is expected, or on
    // the first assembly, so that a computation that continues from a checkpoint has the same one.
    if (is_sparse && on_one_rank && !d.matrix.is_step_coupled())
    {
      if (!d.states.set_expected_end())
        d.states.set_end(end);
      d.find_ends();
      d.matrix.couple_step(d.set.near_slaves());
    }
    d.states.set_end(end);
    d.find_ends();
    d.states.move_to_middle();
    if (is_sparse && on_one_rank)
      d.matrix.couple(d.set.near_slaves());
    else if (is_sparse)
      d.matrix.couple_all();
    d.matrix.begin_assembly(with_tangent, body_matrix);
    d.add_points(d.set.near_points,
                 [&](const unsigned int q, Data::PointForces &forces) {
                   d.evaluate_between(q, with_tangent, forces);
                 });
  }


  void
  ContactTimeStep::restrict_to(const BlockSelection &blocks)
  {
    data->chosen.select(blocks);
    data->list_points_of_bodies();
  }


  double
  ContactTimeStep::work_of_obstacles(const double time_begin,
                                     const double time_end)
  {
    Data &d = *data;
    d.states.find_obstacle_changes(time_begin, time_end);
    double work = 0.;
    for (const ContactPoint &point : d.set.points)
      if (point.state != ContactState::open &&
          (d.surface->is_rigid(point.master) ||
           d.surface->is_rigid(point.edge)))
      {
        const bool         is_master = d.surface->is_rigid(point.master);
        const unsigned int edge      = is_master ? point.master : point.edge;
        const Tensor<1, 2> tangent =
          dealii::Point<2>(-point.normal[1], point.normal[0]);
        work += (is_master ? 1. : -1.) * point.weight *
                (point.pressure * point.normal - point.shear * tangent) *
                d.states.obstacle_change(edge);
      }
    return Parallel::sum(work, d.communicator());
  }
} // namespace NMM
