#ifndef nmm_source_dynamics_step_equations_h
#define nmm_source_dynamics_step_equations_h

#include <nmm/base/types.h>
#include <nmm/dynamics/time_integrator.h>

#include <dynamics/sleeping_blocks.h>
#include <linear_algebra/active_items.h>
#include <linear_algebra/direct_solver.h>

namespace NMM
{
  /// The equations of a time step with the unknown u_1 (displacements at its end), their solution,
  /// and the account of energy.
  struct TimeIntegrator::Data : public NonlinearSystem
  {
    Data(MechanicalModel        &model,
         const TimeScheme       &scheme,
         const RayleighDamping  &damping,
         const NewtonParameters &newton);

    /// @name NonlinearSystem
    /// @{
    Deformation
    assemble(const Vector &u,
             Tangent       tangent,
             const Vector *increment) override;

    const Vector &
    residual() const override
    {
      return forces;
    }

    const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const override
    {
      return in_place != nullptr ? *in_place : matrix;
    }

    bool
    tangent_is_symmetric() const override
    {
      return scheme.is_conserving
               ? model->force_properties().is_symmetric_between
               : model->force_properties().is_symmetric;
    }

    double
    force_scale() const override
    {
      return scale;
    }

    double
    force_rounding() const override
    {
      return model->force_rounding();
    }

    unsigned int
    pattern_version() const override
    {
      return tangents->pattern_version();
    }

    const std::vector<unsigned int> &
    blocks_of_unknowns() const override
    {
      return blocks->blocks_of_unknowns();
    }

    void
    set_active_blocks(const std::vector<bool> &is_active) override
    {
      blocks->set_active_blocks(is_active, held_blocks());
      if (!is_active.empty() && active_rows.empty())
        active_rows.reinit(blocks->blocks_of_unknowns());
      active_rows.select(is_active);
    }

    const std::vector<bool> &
    held_blocks() const override
    {
      return sleeping ? sleeping->mask() : NonlinearSystem::held_blocks();
    }

    std::vector<unsigned int>
    take_touched_blocks() override
    {
      return blocks->take_touched_blocks();
    }

    const std::vector<BlockPair> *
    coupled_blocks() const override
    {
      return scheme.is_conserving ? blocks->coupled_blocks() : nullptr;
    }

    void
    forget_tangent() override
    {
      tangents->forget_tangent();
    }

    const BodyMatrix *
    body_tangent() const override
    {
      return body_matrix;
    }
    /// @}

    Vector
    owned_vector() const
    {
      return Vector(model->locally_owned(), model->communicator());
    }

    /// Compute v_1 and a_1 from u_1 in active rows.
    void
    set_rates();

    /// Add factor A in to out, in active rows.
    void
    add_product(double                                        factor,
                const dealii::TrilinosWrappers::SparseMatrix &A,
                const Vector                                 &in,
                Vector                                       &out);

    Deformation
    assemble_forces(const Vector &u, Tangent tangent, const Vector *increment);

    void
    make_matrix();

    /// Whether C contains a stiffness that is added here and not by the model.
    bool
    damps_by_stiffness() const
    {
      return damping.stiffness > 0. && !model_damps;
    }

    /// Add factor C in to out, in active rows.
    void
    add_damping(double factor, const Vector &in, Vector &out);

    /// Subtract the closing forces, times @p share, from the forces in active rows.
    void
    subtract_closing(double share);

    /// Set `forces` to C v + r - closing forces in the current state; the model's residual must be
    /// that at u.
    void
    set_static_forces();

    void
    predict();

    /// Set the initial guess of Newton's method if blocks are in contact: blocks with closed contact
    /// points start from their positions at the beginning of the step, all others are moved as
    /// rigid bodies, see BlockInertia::fly(). The velocities and accelerations of a stiff block are
    /// mostly vibrations, which the step does not resolve. So u + h v, or u + h v + h^2 a / 2, would
    /// deform the block and its contacts many times as much as the solution does: in the relaxation
    /// of a slope of 476 blocks, forces of 1e9 N at the first guess became 1e17 N in the iterations.
    void
    predict_blocks();

    void
    solve_linear();

    void
    measure(StepReport &report) const;

    /// Solve M a = -C v - r for the accelerations of the current state.
    void
    set_accelerations();

    /// Compute energies and momenta of the current state. The residual r of the model must be that
    /// at u.
    void
    take_account();

    double
    stored_energy() const
    {
      return account.strain + account.conditions;
    }

    void
    add_work();

    /// Add the work against closing forces in the step, with the displacements @p change.
    void
    add_fracture_work(const Vector &change);

    /// Solve the step by Newton's method, and repeat it whenever the result wakes a block.
    void
    solve_nonlinear(StepReport &report, double residual_tolerance);

    /// Let blocks fall asleep after a step.
    void
    let_sleep();

    /// Tell the model which blocks are absent, and compute the inertia of all others.
    void
    set_absent_blocks();

    MechanicalModel *model;
    SupportModel    *supports;
    SteppedModel    *steps;
    BlockModel      *blocks;
    TangentModel    *tangents;
    TimeScheme       scheme;
    RayleighDamping  damping;
    /// Whether the model's forces contain the damping by the stiffness.
    bool                                   model_damps = false;
    NewtonSolver                           newton;
    dealii::TrilinosWrappers::SparseMatrix stiffness_at_rest;
    dealii::TrilinosWrappers::SparseMatrix matrix;
    /// Pattern of `matrix`, see pattern_version(); invalid_index: none.
    unsigned int matrix_version = invalid_index;
    /// The model's matrix, to which mass and damping are added; null if they are added to `matrix`.
    dealii::TrilinosWrappers::SparseMatrix *in_place = nullptr;
    /// The model's matrix if it is a body matrix, otherwise null.
    BodyMatrix                             *body_matrix = nullptr;
    internal::ActiveItems                   active_rows;
    std::unique_ptr<internal::DirectSolver> mass_solver, linear_solver;
    /// Step and DynamicState::events_passed for which linear_solver was factorized [s].
    double factorized_step = 0., factorized_events = 0.;

    /// Null if sleeping is disabled.
    std::unique_ptr<internal::SleepingBlocks> sleeping;

    /// Inertia of blocks for predict_blocks(); null until it is needed.
    std::unique_ptr<internal::BlockInertia> inertia;

    DynamicState state;
    Account      account;
    double       total_mass = 0.;
    /// Norm of M u_0, by which the rounding of accelerations is estimated [kg].
    double mass_of_displacement = 0.;

    /// Length of the step being tried [s], whether it has converged, and displacements on locally
    /// relevant unknowns at both ends and in between.
    double h             = 0.;
    bool   has_candidate = false;
    Vector u_begin, u_end, u_middle;
    Vector u_1, v_1, a_1;
    Vector forces, scratch, other_scratch;
    double scale = 0.;
    /// Loads at the current state [N/m].
    Vector external;
  };
} // namespace NMM

#endif
