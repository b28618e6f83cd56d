#include <deal.II/base/mpi.h>

#include <dynamics/energy_account.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    EnergyAccount::EnergyAccount(const MechanicalModel &model,
                                 DynamicState          &state)
      : model(&model)
      , state(&state)
      , momentum(model.layout().locally_owned, model.layout().communicator)
    {
    }


    void
    EnergyAccount::take(const Vector &static_forces)
    {
      const AssembledForces &forces = model->forces();
      const ModelLayout     &layout = model->layout();
      sums.strain                   = forces.strain_energy;
      sums.conditions               = forces.energy_of_conditions;
      const double norm             = static_forces.l2_norm();
      sums.imbalance                = norm > 0. ? norm / forces.scale : 0.;

      layout.mass->vmult(momentum, state->v);
      layout.constraints->set_zero(momentum);
      sums.kinetic     = 0.5 * (momentum * state->v);
      state->kinetic   = sums.kinetic;
      double result[3] = {0., 0., 0.};
      auto   p         = std::as_const(momentum).begin();
      auto   u         = std::as_const(state->u).begin();
      auto   x         = layout.reference_positions->begin();
      for (; p != std::as_const(momentum).end(); p += 2, u += 2, x += 2)
      {
        result[0] += *p;
        result[1] += *(p + 1);
        result[2] += (*x + *u) * *(p + 1) - (*(x + 1) + *(u + 1)) * *p;
      }
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(result, 3),
                                  layout.communicator,
                                  dealii::ArrayView<double>(result, 3));
      sums.linear_momentum[0] = result[0];
      sums.linear_momentum[1] = result[1];
      sums.angular_momentum   = result[2];
      balance();
    }


    void
    EnergyAccount::start()
    {
      state->sums.initial = sums.kinetic + stored();
      sums.balance        = 0.;
    }


    void
    EnergyAccount::add(double EnergySums::*sum, const double energy)
    {
      state->sums.*sum += energy;
      balance();
    }


    void
    EnergyAccount::balance()
    {
      sums.external_work = state->sums.external_work;
      sums.dissipated    = state->sums.dissipated;
      sums.left          = state->sums.left;
      sums.fracture      = state->sums.fracture;
      sums.cuts          = state->sums.cuts;
      sums.balance = sums.kinetic + stored() + sums.dissipated + sums.left +
                     sums.fracture - sums.cuts - sums.external_work -
                     state->sums.initial;
    }


    void
    EnergyAccount::add_step(const SchemeStep &step, const StepWork &work)
    {
      EnergySums &totals = state->sums;
      totals.external_work += work.loads;
      totals.external_work += work.supports;
      totals.dissipated += work.dissipated;
      const double share = step.closing_share_in_work();
      if (share == 0.)
        return;
      Vector change(step.u);
      change -= state->u;
      totals.fracture -= share * (state->closing.forces * change);
    }
  } // namespace internal
} // namespace NMM
