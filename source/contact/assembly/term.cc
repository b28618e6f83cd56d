#include <nmm/base/archive.h>
#include <nmm/contact/assembly/term.h>
#include <nmm/contact/assembly/time_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <linear_algebra/chosen_items.h>
#include <linear_algebra/matrix_rows.h>
#include <utility>

namespace NMM
{
  struct ContactTerm::Data
  {
    const ModelLayout           *layout;
    Contact                     *contact;
    std::vector<ObstacleRelease> releases;
    ContactUpdate                update = ContactUpdate::every_iteration;
    internal::ChosenItems        chosen_rows;
    Vector                       sum;
    double                       step_end = 0., dissipated = 0.;
    /// The tangent as a body matrix (null until it is needed).
    std::unique_ptr<BodyMatrix> body_matrix;
    /// Whether the tangent of the other terms couples no two blocks, so that only contact does.
    /// This is known from the first tangent on.
    bool is_block_diagonal = false, is_block_diagonal_known = false;

    void
    detect_block_diagonal(const Matrix &tangent);

    BodyMatrix *
    begin_body_matrix(const BlockSelection &blocks);

    void
    restrict_to(const BlockSelection &blocks);

    Deformation
    assemble(const Trial &trial, AssembledForces &total);

    void
    assemble_conserving(const Trial &trial, AssembledForces &total);

    void
    add_forces(AssembledForces &total);
  };


  void
  ContactTerm::Data::detect_block_diagonal(const Matrix &tangent)
  {
    const std::vector<unsigned int> &block_of = layout->blocks_of_unknowns;
    is_block_diagonal_known                   = true;
    is_block_diagonal                         = !block_of.empty();
    if (!is_block_diagonal)
      return;
    for (const auto &line : layout->constraints->get_lines())
      is_block_diagonal = is_block_diagonal && line.entries.empty();
    const internal::MatrixRows rows(tangent);
    for (unsigned int i = 0; i < block_of.size() && is_block_diagonal; ++i)
      for (int e = rows.begins[i]; e < rows.begins[i + 1]; ++e)
        is_block_diagonal =
          is_block_diagonal && block_of[rows.columns[e]] == block_of[i];
  }


  /// Start the rows of the body matrix for the tangent of a step. Returns null if the tangent
  /// must be a sparse matrix.
  BodyMatrix *
  ContactTerm::Data::begin_body_matrix(const BlockSelection &blocks)
  {
    const std::vector<unsigned int> &block_of = layout->blocks_of_unknowns;
    if (!is_block_diagonal ||
        (body_matrix == nullptr && !BodyMatrix::is_suitable(block_of)))
      return nullptr;
    if (body_matrix == nullptr)
      body_matrix = std::make_unique<BodyMatrix>(block_of);
    body_matrix->begin_rows(blocks);
    return body_matrix.get();
  }


  void
  ContactTerm::Data::assemble_conserving(const Trial     &trial,
                                         AssembledForces &total)
  {
    const bool with_tangent = trial.tangent != Tangent::none;
    if (with_tangent && !is_block_diagonal_known)
      detect_block_diagonal(*total.tangent);
    if (contact->is_idle())
      return;

    const bool is_writable =
      with_tangent &&
      dealii::Utilities::MPI::n_mpi_processes(layout->communicator) == 1;
    BodyMatrix *const bodies =
      is_writable ? begin_body_matrix(trial.blocks()) : nullptr;
    ContactTimeStep step(*contact);
    step.assemble(*trial.end, trial.end_time, with_tangent, bodies);
    add_forces(total);
    if (!with_tangent)
      return;
    if (bodies != nullptr)
      bodies->add(1., *total.tangent);
    else
      contact->add_to_tangent(*total.tangent);
    total.body_tangent     = bodies;
    total.tangent          = &contact->tangent();
    total.writable_tangent = is_writable ? &contact->tangent() : nullptr;
    total.pattern_version  = contact->pattern_version();
  }


  void
  ContactTerm::Data::add_forces(AssembledForces &total)
  {
    const auto to         = sum.begin();
    const auto of_others  = std::as_const(*total.residual).begin();
    const auto of_contact = std::as_const(*contact).residual().begin();
    double     square     = 0.;
    chosen_rows.for_each(sum.locally_owned_size(), [&](const unsigned int i) {
      to[i] = of_others[i] + of_contact[i];
      square += of_contact[i] * of_contact[i];
    });
    square         = dealii::Utilities::MPI::sum(square, layout->communicator);
    total.residual = &sum;
    total.scale    = std::hypot(total.scale, std::sqrt(square));
    total.rounding = std::hypot(total.rounding, contact->force_rounding());
    total.energy_of_conditions += contact->report().energy;
  }


  ContactTerm::ContactTerm(const ModelLayout           &layout,
                           Contact                     &contact,
                           std::vector<ObstacleRelease> releases,
                           const ContactUpdate          update)
    : data(std::make_unique<Data>())
  {
    data->layout   = &layout;
    data->contact  = &contact;
    data->releases = std::move(releases);
    data->update   = update;
    data->sum.reinit(contact.residual());
    for (const ObstacleRelease &release : data->releases)
      event_times.push_back(release.time);
    // the fingerprint differs from that of the solid without contact
    hash = 0x9e3779b97f4a7c15u * (contact.surface().edges().size() + 1);
  }


  ContactTerm::~ContactTerm() = default;


  void
  ContactTerm::begin_step(const StepBegin &step)
  {
    // candidate pairs of a load step are those of the search for the equilibrium
    if (step.is_at_rest)
      return;
    // see ContactUpdate
    constexpr double near_rest = 1e-4;

    Data        &d        = *data;
    const double step_end = step.time + step.length;
    // Obstacles move as they are told, blocks by about as much as is predicted.
    constexpr double    margin    = 1.5;
    std::vector<double> reaches   = d.contact->motions(step.u, step.predicted);
    const auto         &obstacles = d.contact->surface().obstacles();
    for (unsigned int i = 0; i < obstacles.size(); ++i)
      if (obstacles[i].displacement)
        reaches[reaches.size() - obstacles.size() + i] =
          (obstacles[i].displacement(step_end) -
           obstacles[i].displacement(step.time))
            .norm();
    for (double &reach : reaches)
      reach *= margin;
    d.contact->set_time(step.time);
    d.contact->freeze_geometry(d.update == ContactUpdate::every_step &&
                               step.imbalance > near_rest);
    d.contact->detect(step.u, reaches);
    if (!d.contact->is_idle())
    {
      ContactTimeStep contact_step(*d.contact);
      contact_step.begin(step.u, step.time);
      contact_step.expect(step.predicted);
    }
    d.step_end = step_end;
    d.contact->set_time(d.step_end);
  }


  Deformation
  ContactTerm::Data::assemble(const Trial &trial, AssembledForces &total)
  {
    if (trial.is_conserving)
    {
      Assert(update == ContactUpdate::every_iteration,
             dealii::ExcMessage("Conserving forces need exact geometry."));
      assemble_conserving(trial, total);
      return Deformation::admissible;
    }
    contact->set_time(trial.end_time);
    if (!contact->is_detected())
      contact->detect(*trial.end);
    if (contact->is_idle())
      return Deformation::admissible;
    const bool with_tangent = trial.tangent != Tangent::none;
    contact->assemble(*trial.end, with_tangent);
    add_forces(total);
    if (with_tangent)
    {
      contact->add_to_tangent(*total.tangent);
      total.tangent         = &contact->tangent();
      total.pattern_version = contact->pattern_version();
    }
    return Deformation::admissible;
  }


  void
  ContactTerm::Data::restrict_to(const BlockSelection &blocks)
  {
    ContactTimeStep(*contact).restrict_to(blocks);
    if (!blocks.empty() && chosen_rows.empty())
      chosen_rows.reinit(layout->blocks_of_unknowns);
    chosen_rows.select(blocks);
  }


  Deformation
  ContactTerm::assemble(const Trial &trial, AssembledForces &sum)
  {
    data->restrict_to(trial.blocks());
    const Deformation state = data->assemble(trial, sum);
    data->restrict_to({});
    return state;
  }


  ForceProperties
  ContactTerm::properties() const
  {
    const bool is_idle = data->contact->is_idle();
    // unsymmetric between, because forces act along the normals in the middle of the step, but gaps
    // are measured along those at its end
    return {/* is_linear = */ is_idle,
            /* is_symmetric = */ is_idle ||
              data->contact->tangent_is_symmetric(),
            /* is_symmetric_between = */ is_idle};
  }


  StepFault
  ContactTerm::find_fault(const Vector &end)
  {
    // the last assembly may have been at an intermediate time
    data->contact->set_time(data->step_end);
    return data->contact->find_fault(end);
  }


  StepWork
  ContactTerm::commit(const Trial &step)
  {
    Data    &d = *data;
    StepWork work;
    // At rest, points that touch have been found by the search for the equilibrium, but Newton's
    // method leaves contact out where nothing is near.
    if (step.begin == nullptr)
    {
      if (d.contact->is_idle())
        d.contact->assemble(*step.end, /* with_tangent = */ false);
      work.dissipated = d.dissipated = d.contact->accept();
      return work;
    }
    if (!d.contact->is_idle())
      work.supports = ContactTimeStep(*d.contact)
                        .work_of_obstacles(step.begin_time, step.end_time);
    d.contact->set_time(step.end_time);
    d.contact->freeze_geometry(false);
    d.contact->assemble(*step.end, /* with_tangent = */ false);
    work.dissipated = d.dissipated = d.contact->accept();
    return work;
  }


  void
  ContactTerm::set_presence(const Presence &presence)
  {
    Data                 &d       = *data;
    const ContactSurface &surface = d.contact->surface();
    const std::size_t first = surface.n_bodies() - surface.obstacles().size();
    std::vector<bool> is_absent = presence.absent_blocks;
    is_absent.resize(surface.n_bodies(), false);
    for (const ObstacleRelease &release : d.releases)
      if (release.time <= presence.events_passed)
        is_absent[first + release.obstacle] = true;
    if (is_absent == surface.absent_bodies())
      return;
    d.contact->set_absent_bodies(is_absent);
  }


  void
  ContactTerm::save(ByteWriter &archive) const
  {
    archive & data->contact->history();
  }


  void
  ContactTerm::restore(ByteReader &archive)
  {
    ContactHistory history;
    archive       &history;
    restore_history(history);
  }


  void
  ContactTerm::restore_history(const ContactHistory &history)
  {
    data->contact->restore_history(history);
  }


  std::vector<bool>
  ContactTerm::pressed_blocks() const
  {
    if (data->layout->blocks_of_unknowns.empty() || data->contact->is_idle())
      return {};
    std::vector<bool> result = ContactTimeStep(*data->contact).pressed_bodies();
    // remove the entries of obstacles, which come last
    result.resize(data->layout->n_blocks);
    return result;
  }


  double
  ContactTerm::dissipated() const
  {
    return data->dissipated;
  }


  const Contact &
  ContactTerm::contact() const
  {
    return *data->contact;
  }
} // namespace NMM
