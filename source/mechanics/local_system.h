#ifndef nmm_source_mechanics_local_system_h
#define nmm_source_mechanics_local_system_h

#include <nmm/covers/weight_functions.h>

#include <algorithm>

namespace NMM
{
  namespace internal
  {
    /**
     * Dense matrix and right-hand side of one element, or of two that are tied:
     * unknown c of local cover i is row 2i + c. Per unit thickness.
     */
    struct LocalSystem
    {
      static constexpr unsigned int max_covers =
        2 * WeightFunctions::max_per_cell;

      unsigned int n_covers = 0;
      /// (2 n_covers x 2 n_covers), row-major.
      double matrix[4 * max_covers * max_covers];
      /// (2 n_covers)
      double rhs[2 * max_covers];

      void
      reset(const unsigned int n)
      {
        n_covers = n;
        std::fill_n(matrix, 4 * n * n, 0.);
        std::fill_n(rhs, 2 * n, 0.);
      }

      /// Entries (2i .. 2i+1, 2j .. 2j+1): the first of each row.
      double *
      row(const unsigned int i, const unsigned int c)
      {
        return matrix + (2 * i + c) * 2 * n_covers;
      }
    };
  } // namespace internal
} // namespace NMM

#endif
