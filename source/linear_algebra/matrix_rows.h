#ifndef nmm_source_linear_algebra_matrix_rows_h
#define nmm_source_linear_algebra_matrix_rows_h

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Epetra_CrsMatrix.h>

namespace NMM
{
  namespace internal
  {
    /// Direct access to the arrays of a matrix whose pattern is fixed: the entries of owned row r
    /// have the indices begins[r] to begins[r + 1] - 1 in the other two arrays; columns are local
    /// numbers. It avoids a call of Epetra_CrsMatrix for each row, which would take longer than
    /// reading a short row.
    struct MatrixRows
    {
      MatrixRows() = default;

      explicit MatrixRows(const Epetra_CrsMatrix &matrix)
      {
        int      *row_begins, *row_columns;
        const int error =
          matrix.ExtractCrsDataPointers(row_begins, row_columns, values);
        AssertThrow(error == 0,
                    dealii::ExcMessage("The matrix is not compressed."));
        begins  = row_begins;
        columns = row_columns;
      }

      explicit MatrixRows(const dealii::TrilinosWrappers::SparseMatrix &matrix)
        : MatrixRows(matrix.trilinos_matrix())
      {
      }

      const int *begins = nullptr, *columns = nullptr;
      double    *values = nullptr;
    };
  } // namespace internal
} // namespace NMM

#endif
