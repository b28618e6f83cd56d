#include <deal.II/base/mpi.h>

#include <cmath>
#include <dynamics/step_equations.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    StepEquations::StepEquations(MechanicalModel    &model,
                                 const DynamicState &begin,
                                 const TimeScheme   &scheme)
      : step(scheme, begin, model.layout())
      , matrix(model.layout())
      , model(&model)
      , begin(&begin)
    {
      const ModelLayout &layout = model.layout();
      result.residual           = &forces;
      for (Vector *vector : {&forces, &scratch})
        vector->reinit(layout.locally_owned, layout.communicator);
      for (Vector *vector : {&u_begin, &u_end, &u_middle})
        vector->reinit(layout.locally_owned,
                       layout.locally_relevant,
                       layout.communicator);
    }


    void
    StepEquations::begin_step(const double h, const double imbalance)
    {
      const ModelLayout &layout = model->layout();
      u_begin                   = begin->u;
      layout.mass->vmult(forces, begin->u);
      mass_of_displacement = forces.l2_norm();
      step.predict(h);
      layout.constraints->distribute(step.u);
      u_end = step.u;
      sleeping_blocks.clear();
      if (sleeping)
        sleeping_blocks = sleeping->mask();
      model->begin_step({u_begin, u_end, begin->time, h, imbalance});
    }


    StepEquations::Vector &
    StepEquations::static_forces(const bool with_damping)
    {
      const AssembledForces &sum = model->forces();
      forces                     = *sum.residual;
      if (with_damping)
        for (const auto *C : sum.damping)
          matrix.add_product(*C, begin->v, forces);
      subtract_closing(begin->closing.share(begin->time));
      model->layout().constraints->set_zero(forces);
      return forces;
    }


    void
    StepEquations::subtract_closing(const double share)
    {
      if (share == 0.)
        return;
      const auto to   = forces.begin();
      const auto from = std::as_const(begin->closing.forces).begin();
      matrix.rows.for_each(forces.locally_owned_size(),
                           [&](const unsigned int i) {
                             to[i] -= share * from[i];
                           });
    }


    Deformation
    StepEquations::assemble_model(const Vector         &u,
                                  const Tangent         tangent,
                                  const Vector         *increment,
                                  const BlockSelection &blocks)
    {
      Trial trial = Trial::at(u, step.time_of_forces(), tangent, increment);
      if (step.scheme.is_conserving)
      {
        trial = Trial::step(u_begin, u, begin->time, step.end_time(), true);
        trial.tangent = tangent;
      }
      else if (step.scheme.alpha_f != 0.)
      {
        scratch = step.u;
        scratch.sadd(step.stiffness_factor(), step.scheme.alpha_f, begin->u);
        u_middle        = scratch;
        trial.end       = &u_middle;
        trial.increment = nullptr;
      }
      trial.selection = &blocks;
      return model->assemble(trial);
    }


    void
    StepEquations::assemble_matrix(const AssembledForces &sum)
    {
      matrix.assemble(step, sum);
      const ForceProperties properties = model->properties();
      result.tangent                   = &matrix.matrix();
      result.body_tangent              = sum.body_tangent;
      result.is_symmetric              = step.scheme.is_conserving
                                           ? properties.is_symmetric_between
                                           : properties.is_symmetric;
      result.pattern_version           = sum.pattern_version;
    }


    Deformation
    StepEquations::assemble(const Vector         &u,
                            const Tangent         tangent,
                            const Vector         *increment,
                            const BlockSelection &blocks)
    {
      if (!blocks.empty() && matrix.rows.empty())
        matrix.rows.reinit(blocks_of_unknowns());
      matrix.rows.select(blocks);
      const Deformation state = assemble_rows(u, tangent, increment, blocks);
      matrix.rows.select({});
      return state;
    }


    Deformation
    StepEquations::assemble_rows(const Vector         &u,
                                 const Tangent         tangent,
                                 const Vector         *increment,
                                 const BlockSelection &blocks)
    {
      const unsigned int n    = step.u.locally_owned_size();
      const ChosenItems &rows = matrix.rows;
      if (rows.all())
        step.u = u;
      else
        for (const unsigned int i : rows.chosen())
          step.u.begin()[i] = u.begin()[i];
      step.set_rates(rows);
      if (assemble_model(u, tangent, increment, blocks) !=
          Deformation::admissible)
        return Deformation::inverted;
      const AssembledForces &sum = model->forces();
      if (tangent != Tangent::none)
        assemble_matrix(sum);

      const auto f = forces.begin();
      rows.for_each(n, [&](const unsigned int i) { f[i] = 0.; });
      step.mix_accelerations(rows, scratch);
      matrix.add_product(*model->layout().mass, scratch, forces);
      const auto r      = std::as_const(*sum.residual).begin();
      double     square = 0.;
      rows.for_each(n, [&](const unsigned int i) {
        square += f[i] * f[i];
        f[i] += r[i];
      });
      square =
        dealii::Utilities::MPI::sum(square, model->layout().communicator);
      const double scale = std::hypot(sum.scale, std::sqrt(square));
      // Accelerations are differences of displacements divided by the square of the step. The force
      // scale contains their rounding, so that tolerances can be met however small the step is.
      constexpr double rounding = 1e-6;
      const double     h        = step.length;
      result.force_scale        = std::hypot(scale,
                                      rounding / (step.scheme.beta * h * h) *
                                        mass_of_displacement);
      result.force_rounding     = sum.rounding;
      if (!sum.damping.empty())
        step.mix_velocities(rows, scratch);
      for (const auto *C : sum.damping)
        matrix.add_product(*C, scratch, forces);
      subtract_closing(step.closing_share());
      if (model->layout().constraints->n_constraints() > 0)
        model->layout().constraints->set_zero(forces);
      const double k = step.stiffness_factor();
      rows.for_each(n, [&](const unsigned int i) { f[i] /= k; });
      result.force_scale /= k;
      result.force_rounding /= k;
      return Deformation::admissible;
    }
  } // namespace internal
} // namespace NMM
