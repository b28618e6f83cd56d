#include <nmm/contact/contact_time_step.h>
#include <nmm/dynamics/contact_model.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <base/archive.h>
#include <cmath>
#include <limits>
#include <linear_algebra/active_items.h>
#include <linear_algebra/matrix_rows.h>
#include <utility>

namespace NMM
{
  struct ContactModel::Data
  {
    MechanicalModel             *model;
    SupportModel                *supports;
    SteppedModel                *steps;
    SavedModel                  *saved;
    BlockModel                  *blocks;
    TangentModel                *tangents;
    Contact                     *contact;
    std::vector<ObstacleRelease> releases;
    internal::ActiveItems        active_rows;
    Vector                       sum;
    double                       scale = 0., step_end = 0.;
    double                       dissipated_by_contact = 0.;
    bool                         is_detected           = false;
    /// Factor of the tangent, and whether the caller may add to it; see tangent_to_add_to().
    double tangent_factor  = 1.;
    bool   may_be_added_to = false;
    /// The tangent as a body matrix (null until it is needed), and whether it is the last tangent.
    std::unique_ptr<BodyMatrix> body_matrix;
    bool                        has_body_matrix = false;
    /// For each block, whether it is active; empty: all are.
    std::vector<bool> active;
    /// Whether the model's tangent couples no two blocks, so that only contact does. This is
    /// known from the first tangent on.
    bool is_block_diagonal = false, is_block_diagonal_known = false;
    /// For each block, whether it is absent; empty: none is.
    std::vector<bool> absent_blocks;
    /// Time up to which events have been applied [s].
    double events_passed = std::numeric_limits<double>::lowest();

    void
    detect_block_diagonal()
    {
      const std::vector<unsigned int> &block_of = blocks->blocks_of_unknowns();
      is_block_diagonal_known                   = true;
      is_block_diagonal                         = !block_of.empty();
      if (!is_block_diagonal)
        return;
      for (const auto &line : model->constraints().get_lines())
        is_block_diagonal = is_block_diagonal && line.entries.empty();
      const internal::MatrixRows rows(model->tangent());
      for (unsigned int i = 0; i < block_of.size() && is_block_diagonal; ++i)
        for (int e = rows.begins[i]; e < rows.begins[i + 1]; ++e)
          is_block_diagonal =
            is_block_diagonal && block_of[rows.columns[e]] == block_of[i];
    }

    void
    add_contact(const bool with_tangent, const double factor = 1.)
    {
      const auto to         = sum.begin();
      const auto of_model   = std::as_const(*model).residual().begin();
      const auto of_contact = std::as_const(*contact).residual().begin();
      double     square     = 0.;
      active_rows.for_each(sum.locally_owned_size(), [&](const unsigned int i) {
        *(to + i) = *(of_model + i) + *(of_contact + i);
        square += *(of_contact + i) * *(of_contact + i);
      });
      square = dealii::Utilities::MPI::sum(square, sum.get_mpi_communicator());
      scale  = std::hypot(model->force_scale(), std::sqrt(square));
      if (with_tangent && has_body_matrix)
        body_matrix->add(factor, model->tangent());
      else if (with_tangent)
        contact->add_to_tangent(model->tangent(), factor);
    }

    /// Start the rows of the body matrix for the tangent of a step. Returns null if the tangent
    /// must be a sparse matrix.
    BodyMatrix *
    begin_body_matrix()
    {
      has_body_matrix = may_be_added_to && is_block_diagonal &&
                        (body_matrix != nullptr ||
                         BodyMatrix::is_suitable(blocks->blocks_of_unknowns()));
      if (!has_body_matrix)
        return nullptr;
      if (body_matrix == nullptr)
        body_matrix =
          std::make_unique<BodyMatrix>(blocks->blocks_of_unknowns());
      body_matrix->begin_rows(active);
      return body_matrix.get();
    }
  };


  ContactModel::ContactModel(MechanicalModel             &model,
                             Contact                     &contact,
                             std::vector<ObstacleRelease> releases)
    : data(std::make_unique<Data>())
  {
    data->model    = &model;
    data->supports = &model_interface<SupportModel>(model);
    data->steps    = &model_interface<SteppedModel>(model);
    data->saved    = &model_interface<SavedModel>(model);
    data->blocks   = &model_interface<BlockModel>(model);
    data->tangents = &model_interface<TangentModel>(model);
    data->contact  = &contact;
    data->releases = std::move(releases);
    data->sum.reinit(contact.residual());
  }


  ContactModel::~ContactModel() = default;


  const ModelLayout &
  ContactModel::layout() const
  {
    return data->model->layout();
  }


  std::uint64_t
  ContactModel::fingerprint() const
  {
    // the fingerprint differs from that of the model without contact
    return data->saved->fingerprint() ^
           (0x9e3779b97f4a7c15u *
            (data->contact->surface().edges().size() + 1));
  }


  const ContactModel::Matrix &
  ContactModel::mass() const
  {
    return data->model->mass();
  }


  const ContactModel::Matrix &
  ContactModel::stiffness_at_rest()
  {
    return data->model->stiffness_at_rest();
  }


  bool
  ContactModel::set_stiffness_damping(const double coefficient)
  {
    return data->tangents->set_stiffness_damping(coefficient);
  }


  ForceProperties
  ContactModel::force_properties() const
  {
    const bool      is_idle = data->contact->is_idle();
    ForceProperties result  = data->model->force_properties();
    result.is_linear        = result.is_linear && is_idle;
    result.is_symmetric =
      result.is_symmetric && (is_idle || data->contact->tangent_is_symmetric());
    // unsymmetric, because forces act along the normals in the middle of the step, but gaps are
    // measured along those at its end
    result.is_symmetric_between = result.is_symmetric_between && is_idle;
    return result;
  }


  Deformation
  ContactModel::assemble(const Vector &u,
                         const double  t,
                         const Tangent tangent,
                         const Vector *increment)
  {
    Data &d = *data;
    d.contact->set_time(t);
    if (!d.is_detected)
    {
      d.contact->detect(u);
      d.is_detected = true;
    }
    const Deformation state = d.model->assemble(u, t, tangent, increment);
    if (state != Deformation::admissible || d.contact->is_idle())
      return state;
    d.contact->assemble(u, tangent != Tangent::none);
    d.add_contact(tangent != Tangent::none);
    return state;
  }


  Deformation
  ContactModel::assemble_between(const Vector &begin,
                                 const Vector &end,
                                 const double  t_0,
                                 const double  t_1,
                                 const Tangent tangent)
  {
    Data             &d = *data;
    const Deformation state =
      d.model->assemble_between(begin, end, t_0, t_1, tangent);
    const bool with_tangent = tangent != Tangent::none;
    if (state == Deformation::admissible && with_tangent &&
        !d.is_block_diagonal_known)
      d.detect_block_diagonal();
    if (with_tangent)
      d.has_body_matrix = false;
    if (state != Deformation::admissible || d.contact->is_idle())
      return state;
    ContactTimeStep(*d.contact)
      .assemble(end,
                t_1,
                with_tangent,
                d.tangent_factor,
                with_tangent ? d.begin_body_matrix() : nullptr);
    d.add_contact(with_tangent, d.tangent_factor);
    return state;
  }


  const ContactModel::Vector &
  ContactModel::residual() const
  {
    return data->contact->is_idle() ? data->model->residual() : data->sum;
  }


  const ContactModel::Matrix &
  ContactModel::tangent() const
  {
    return data->contact->is_idle() ? data->model->tangent()
                                    : data->contact->tangent();
  }


  ContactModel::Matrix *
  ContactModel::tangent_to_add_to(const double factor)
  {
    const bool may_be =
      !data->contact->is_idle() &&
      dealii::Utilities::MPI::n_mpi_processes(communicator()) == 1;
    data->tangent_factor  = may_be ? factor : 1.;
    data->may_be_added_to = may_be;
    return may_be ? &data->contact->tangent() : nullptr;
  }


  BodyMatrix *
  ContactModel::body_tangent()
  {
    return data->has_body_matrix ? data->body_matrix.get() : nullptr;
  }


  void
  ContactModel::forget_tangent()
  {
    data->tangents->forget_tangent();
    if (data->body_matrix)
      data->body_matrix->clear();
  }


  unsigned int
  ContactModel::pattern_version() const
  {
    return data->contact->is_idle() ? 0 : data->contact->pattern_version();
  }


  double
  ContactModel::force_scale() const
  {
    return data->contact->is_idle() ? data->model->force_scale() : data->scale;
  }


  double
  ContactModel::force_rounding() const
  {
    return std::hypot(data->model->force_rounding(),
                      data->contact->force_rounding());
  }


  ContactModel::Energies
  ContactModel::energies() const
  {
    Energies energies = data->model->energies();
    if (!data->contact->is_idle())
      energies.conditions += data->contact->report().energy;
    return energies;
  }


  void
  ContactModel::external_forces(const Vector &u, const double t, Vector &forces)
  {
    data->model->external_forces(u, t, forces);
  }


  double
  ContactModel::work_of_supports(const Vector &u,
                                 const double  t,
                                 const double  t_0,
                                 const double  t_1)
  {
    double work = data->supports->work_of_supports(u, t, t_0, t_1);
    if (!data->contact->is_idle())
      work += ContactTimeStep(*data->contact).work_of_obstacles(t_0, t_1);
    return work;
  }


  double
  ContactModel::work_of_supports_between(const Vector &begin,
                                         const Vector &end,
                                         const Vector &mean,
                                         const double  t_0,
                                         const double  t_1)
  {
    double work =
      data->supports->work_of_supports_between(begin, end, mean, t_0, t_1);
    if (!data->contact->is_idle())
      work += ContactTimeStep(*data->contact).work_of_obstacles(t_0, t_1);
    return work;
  }


  void
  ContactModel::begin_step(const Vector &begin,
                           const Vector &predicted,
                           const double  t,
                           const double  h)
  {
    Data &d = *data;
    d.steps->begin_step(begin, predicted, t, h);

    // both faces of a candidate pair may move by `largest`, and obstacles move as well
    const double largest   = d.contact->largest_motion(begin, predicted);
    double       obstacles = 0.;
    for (const RigidObstacle &obstacle : d.contact->surface().obstacles())
      if (obstacle.displacement)
        obstacles = std::max(
          obstacles,
          (obstacle.displacement(t + h) - obstacle.displacement(t)).norm());
    constexpr double margin = 1.5;
    d.contact->set_time(t);
    d.contact->detect(begin, margin * (2. * largest + obstacles));
    d.is_detected = true;
    if (!d.contact->is_idle())
    {
      ContactTimeStep step(*d.contact);
      step.begin(begin, t);
      step.expect(predicted);
    }
    d.step_end = t + h;
    d.contact->set_time(d.step_end);
  }


  StepFault
  ContactModel::find_fault(const Vector &end)
  {
    const StepFault fault = data->steps->find_fault(end);
    if (!fault.reason.empty())
      return fault;
    // the last assembly may have been at an intermediate time
    data->contact->set_time(data->step_end);
    return data->contact->find_fault(end);
  }


  double
  ContactModel::accept_step(const Vector &end, const double t)
  {
    Data        &d          = *data;
    const double dissipated = d.steps->accept_step(end, t);
    d.contact->set_time(t);
    d.contact->assemble(end, /* with_tangent = */ false);
    d.dissipated_by_contact = d.contact->accept();
    return dissipated + d.dissipated_by_contact;
  }


  double
  ContactModel::dissipated_by_contact() const
  {
    return data->dissipated_by_contact;
  }


  std::vector<char>
  ContactModel::internal_state() const
  {
    return internal::to_bytes(data->contact->history(),
                              data->saved->internal_state());
  }


  void
  ContactModel::restore_internal_state(const std::vector<char> &state)
  {
    ContactHistory    history;
    std::vector<char> of_model;
    internal::from_bytes(state, history, of_model);
    restore_history(history);
    data->saved->restore_internal_state(of_model);
  }


  void
  ContactModel::restore_history(const ContactHistory &history)
  {
    data->contact->restore_history(history);
    data->is_detected = false;
  }


  void
  ContactModel::set_absent_blocks(const std::vector<bool> &is_absent)
  {
    Data &d = *data;
    d.blocks->set_absent_blocks(is_absent);
    d.absent_blocks = is_absent;
    take_bodies_away();
  }


  unsigned int
  ContactModel::n_blocks() const
  {
    return data->blocks->n_blocks();
  }


  dealii::IndexSet
  ContactModel::absent_unknowns() const
  {
    return data->blocks->absent_unknowns();
  }


  std::vector<bool>
  ContactModel::pressed_blocks() const
  {
    if (blocks_of_unknowns().empty() || data->contact->is_idle())
      return {};
    std::vector<bool> result = ContactTimeStep(*data->contact).pressed_bodies();
    // remove the entries of obstacles, which come last
    result.resize(n_blocks());
    return result;
  }


  const std::vector<unsigned int> &
  ContactModel::blocks_of_unknowns() const
  {
    return data->blocks->blocks_of_unknowns();
  }


  void
  ContactModel::set_active_blocks(const std::vector<bool> &is_active,
                                  const std::vector<bool> &is_held)
  {
    data->blocks->set_active_blocks(is_active, is_held);
    ContactTimeStep(*data->contact).set_active_bodies(is_active, is_held);
    data->active = is_active;
    if (!is_active.empty() && data->active_rows.empty())
      data->active_rows.reinit(blocks_of_unknowns());
    data->active_rows.select(is_active);
  }


  std::vector<unsigned int>
  ContactModel::take_touched_blocks()
  {
    return ContactTimeStep(*data->contact).take_touched();
  }


  const std::vector<BlockPair> *
  ContactModel::coupled_blocks() const
  {
    if (!data->is_block_diagonal)
      return nullptr;
    static const std::vector<BlockPair> none;
    return data->contact->is_idle()
             ? &none
             : &ContactTimeStep(*data->contact).coupled_bodies();
  }


  std::vector<double>
  ContactModel::events() const
  {
    std::vector<double> times = data->supports->events();
    for (const ObstacleRelease &release : data->releases)
      times.push_back(release.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
  }


  void
  ContactModel::pass_events(const double t)
  {
    Data &d = *data;
    d.supports->pass_events(t);
    d.events_passed = t;
    take_bodies_away();
  }


  void
  ContactModel::take_bodies_away()
  {
    Data                 &d       = *data;
    const ContactSurface &surface = d.contact->surface();
    const std::size_t first = surface.n_bodies() - surface.obstacles().size();
    std::vector<bool> is_absent = d.absent_blocks;
    is_absent.resize(surface.n_bodies(), false);
    for (const ObstacleRelease &release : d.releases)
      if (release.time <= d.events_passed)
        is_absent[first + release.obstacle] = true;
    if (is_absent == surface.absent_bodies())
      return;
    d.contact->set_absent_bodies(is_absent);
    d.is_detected = false;
  }


  const Contact &
  ContactModel::contact() const
  {
    return *data->contact;
  }
} // namespace NMM
