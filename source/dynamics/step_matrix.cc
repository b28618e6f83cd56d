#include <nmm/base/exceptions.h>

#include <dynamics/step_matrix.h>
#include <linear_algebra/matrix_rows.h>
#include <linear_algebra/matrix_sum.h>

namespace NMM
{
  namespace internal
  {
    StepMatrix::StepMatrix(MechanicalModel       &model,
                           const RayleighDamping &damping_in,
                           const bool             is_conserving)
      : layout(&model.layout())
      , damping(damping_in)
    {
      AssertThrow(damping.mass >= 0. && damping.stiffness >= 0.,
                  InputError("A coefficient of Rayleigh damping is negative",
                             "",
                             "choose both at least 0"));
      product.reinit(layout->locally_owned, layout->communicator);
      const Matrix *const stiffness =
        model.damp_by_stiffness(damping.stiffness, is_conserving);
      if (stiffness == nullptr)
        damping.stiffness = 0.;
      else
      {
        stiffness_at_rest.reinit(*stiffness);
        stiffness_at_rest.copy_from(*stiffness);
      }
    }


    void
    StepMatrix::add_product(const double  factor,
                            const Matrix &A,
                            const Vector &in,
                            Vector       &out)
    {
      if (rows.all())
      {
        A.vmult(product, in);
        out.add(factor, product);
        return;
      }
      // rows are selected on one rank only
      const MatrixRows entries(A);
      const int *columns = A.trilinos_matrix().ColMap().MyGlobalElements();
      const auto x       = in.begin();
      const auto y       = out.begin();
      for (const unsigned int row : rows.chosen())
      {
        double    sum   = 0.;
        const int begin = entries.begins[row], end = entries.begins[row + 1];
        const int first = begin < end ? columns[entries.columns[begin]] : 0;
        const int last  = begin < end ? columns[entries.columns[end - 1]] : 0;
        // the columns are consecutive, as in rows of a small block, and need not be read
        if (last - first == end - begin - 1)
          for (int i = begin; i < end; ++i)
            sum += entries.values[i] * x[first + i - begin];
        else
          for (int i = begin; i < end; ++i)
            sum += entries.values[i] * x[columns[entries.columns[i]]];
        y[row] += factor * sum;
      }
    }


    void
    StepMatrix::add_damping(const double  factor,
                            const Vector &x,
                            Vector       &result)
    {
      if (damping.mass > 0.)
        add_product(factor * damping.mass, *layout->mass, x, result);
      if (damping.stiffness > 0.)
        add_product(factor * damping.stiffness, stiffness_at_rest, x, result);
    }


    void
    StepMatrix::assemble(const SchemeStep &step, const AssembledForces &forces)
    {
      const double k = step.stiffness_factor(), c = step.damping_factor(),
                   m    = step.mass_factor();
      in_place          = forces.scaled_tangent;
      const auto add_to = [&](const auto &add) {
        add(m + c * damping.mass, *layout->mass);
        if (damping.stiffness > 0. && c != 0.)
          add(c * damping.stiffness, stiffness_at_rest);
      };
      if (forces.body_tangent != nullptr)
      {
        add_to([&](const double factor, const Matrix &A) {
          forces.body_tangent->add(factor, A);
        });
        return;
      }
      if (in_place == nullptr && !rows.all() &&
          own_version == forces.pattern_version)
        // other rows have been assembled before, and have their mass and damping
        set_rows(k, *forces.tangent, own_matrix, rows);
      else if (in_place == nullptr)
      {
        own_matrix.copy_from(*forces.tangent);
        own_matrix *= k;
        own_version = forces.pattern_version;
      }
      Matrix &sum = in_place != nullptr ? *in_place : own_matrix;
      add_to([&](const double factor, const Matrix &A) {
        add_rows(factor, A, sum, rows);
      });
    }
  } // namespace internal
} // namespace NMM
