#ifndef nmm_source_linear_algebra_matrix_sum_h
#define nmm_source_linear_algebra_matrix_sum_h

#include <linear_algebra/chosen_items.h>
#include <linear_algebra/matrix_rows.h>

namespace NMM
{
  namespace internal
  {
    /// Add @p factor times @p from to @p to, in these rows. The pattern of @p from must lie within
    /// that of @p to.
    inline void
    add_rows(const double                                  factor,
             const dealii::TrilinosWrappers::SparseMatrix &from,
             dealii::TrilinosWrappers::SparseMatrix       &to,
             const ChosenItems                            &rows)
    {
      if (rows.all())
      {
        to.add(factor, from);
        return;
      }
      // rows are selected on one rank only, where both matrices number columns in the same way
      const MatrixRows source(from), sum(to);
      for (const unsigned int row : rows.chosen())
      {
        int p = sum.begins[row];
        for (int i = source.begins[row]; i < source.begins[row + 1]; ++i)
        {
          while (sum.columns[p] != source.columns[i])
          {
            ++p;
            Assert(p < sum.begins[row + 1], dealii::ExcInternalError());
          }
          sum.values[p] += factor * source.values[i];
        }
      }
    }


    /// Set chosen rows of @p to to those of @p from. The patterns must be the same.
    inline void
    set_rows(const dealii::TrilinosWrappers::SparseMatrix &from,
             dealii::TrilinosWrappers::SparseMatrix       &to,
             const ChosenItems                            &rows)
    {
      const MatrixRows source(from), copy(to);
      for (const unsigned int row : rows.chosen())
        for (int i = source.begins[row]; i < source.begins[row + 1]; ++i)
          copy.values[i] = source.values[i];
    }
  } // namespace internal
} // namespace NMM

#endif
