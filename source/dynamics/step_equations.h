#ifndef nmm_source_dynamics_step_equations_h
#define nmm_source_dynamics_step_equations_h

#include <nmm/solution/newton_solver.h>

#include <dynamics/scheme_step.h>
#include <dynamics/sleeping_blocks.h>
#include <dynamics/step_matrix.h>

namespace NMM
{
  namespace internal
  {
    /// The equations of a time step, whose unknowns are the displacements at its end. They are
    /// divided by SchemeStep::stiffness_factor(), so that the tangent of the terms need not be
    /// multiplied. Lifetime: the model and the state at the beginning must outlive this object.
    class StepEquations : public NonlinearSystem
    {
    public:
      StepEquations(MechanicalModel    &model,
                    const DynamicState &begin,
                    const TimeScheme   &scheme);

      /// Begin a step of @p h [s], and predict the displacements at its end.
      void
      begin_step(double h, double imbalance);

      /// C v + r - closing forces of the state, on owned unknowns, 0 for constrained ones [N/m]; C v
      /// only if @p with_damping. The model's last forces must be those of the state.
      Vector &
      static_forces(bool with_damping = true);

      /// @name NonlinearSystem
      /// @{
      Deformation
      assemble(const Vector         &u,
               Tangent               tangent,
               const Vector         *increment,
               const BlockSelection &blocks = {}) override;

      const std::vector<unsigned int> &
      blocks_of_unknowns() const override
      {
        return model->layout().blocks_of_unknowns;
      }
      /// @}

      SchemeStep step;
      StepMatrix matrix;
      /// Null if sleeping is disabled.
      std::unique_ptr<SleepingBlocks> sleeping;
      /// Displacements at the beginning and at the end, on locally relevant unknowns [m].
      Vector u_begin, u_end;

    private:
      Deformation
      assemble_model(const Vector         &u,
                     Tangent               tangent,
                     const Vector         *increment,
                     const BlockSelection &blocks);

      /// Compute forces and tangent in the chosen rows.
      Deformation
      assemble_rows(const Vector         &u,
                    Tangent               tangent,
                    const Vector         *increment,
                    const BlockSelection &blocks);

      void
      assemble_matrix(const AssembledForces &sum);

      /// Subtract the closing forces, times @p share, from the forces in chosen rows.
      void
      subtract_closing(double share);

      MechanicalModel    *model;
      const DynamicState *begin;
      Vector              forces, scratch, u_middle;
      /// Norm of M u_0, by which the rounding of accelerations is estimated [kg].
      double mass_of_displacement = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
