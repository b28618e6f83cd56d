#include <dynamics/step_matrix.h>
#include <linear_algebra/matrix_rows.h>
#include <linear_algebra/matrix_sum.h>

namespace NMM
{
  namespace internal
  {
    StepMatrix::StepMatrix(const ModelLayout &layout)
      : layout(&layout)
      , product(layout.locally_owned, layout.communicator)
    {
    }


    void
    StepMatrix::add_product(const Matrix &A, const Vector &in, Vector &out)
    {
      if (rows.all())
      {
        A.vmult(product, in);
        out += product;
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
        y[row] += sum;
      }
    }


    void
    StepMatrix::assemble(const SchemeStep &step, const AssembledForces &forces)
    {
      in_place          = forces.writable_tangent;
      const auto add_to = [&](const auto &add) {
        add(step.mass_factor(), *layout->mass);
        for (const Matrix *C : forces.damping)
          add(step.damping_factor(), *C);
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
        set_rows(*forces.tangent, own_matrix, rows);
      else if (in_place == nullptr)
      {
        own_matrix.copy_from(*forces.tangent);
        own_version = forces.pattern_version;
      }
      Matrix &sum = in_place != nullptr ? *in_place : own_matrix;
      add_to([&](const double factor, const Matrix &A) {
        add_rows(factor, A, sum, rows);
      });
    }
  } // namespace internal
} // namespace NMM
