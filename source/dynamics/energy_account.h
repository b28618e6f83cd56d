#ifndef nmm_source_dynamics_energy_account_h
#define nmm_source_dynamics_energy_account_h

#include <nmm/dynamics/dynamic_state.h>

#include <dynamics/scheme_step.h>

namespace NMM
{
  namespace internal
  {
    /// The account of energies and momenta of a state: it adds what the terms of a model tell.
    /// Lifetime: model and state must outlive this object.
    class EnergyAccount
    {
    public:
      using Vector = MechanicalModel::Vector;

      EnergyAccount(const MechanicalModel &model, DynamicState &state);

      const Account &
      account() const
      {
        return sums;
      }

      /// Energy of material and conditions of the state [J/m].
      double
      stored() const
      {
        return sums.strain + sums.conditions;
      }

      /// Compute energies and momenta of the state. The model's last forces must be those of the
      /// state; @p static_forces is StepEquations::static_forces().
      void
      take(const Vector &static_forces);

      /// Begin with the energy of the state that was taken last.
      void
      start();

      /// Add @p energy [J/m] to one of the sums.
      void
      add(double EnergySums::*sum, double energy);

      /// Add the work of the step from the state, of the terms and of closing forces.
      void
      add_step(const SchemeStep &step, const StepWork &work);

    private:
      void
      balance();

      const MechanicalModel *model;
      DynamicState          *state;
      Account                sums;
      Vector                 momentum;
    };
  } // namespace internal
} // namespace NMM

#endif
