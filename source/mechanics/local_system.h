#ifndef nmm_source_mechanics_local_system_h
#define nmm_source_mechanics_local_system_h

#include <nmm/covers/cover_system.h>
#include <nmm/covers/weight_functions.h>

#include <algorithm>
#include <array>

namespace NMM
{
  namespace internal
  {
    /**
     * Dense matrix and right-hand side of one element, or of two that are tied, per unit
     * thickness. Component c of local cover i is row 2i + c.
     */
    struct LocalSystem
    {
      static constexpr unsigned int max_covers =
        2 * WeightFunctions::max_per_cell;

      unsigned int n_covers = 0;
      /// The matrix (2 n_covers x 2 n_covers), stored row by row.
      double matrix[4 * max_covers * max_covers];
      /// The right-hand side (2 n_covers).
      double rhs[2 * max_covers];

      void
      reset(const unsigned int n)
      {
        n_covers = n;
        std::fill_n(matrix, 4 * n * n, 0.);
        std::fill_n(rhs, 2 * n, 0.);
      }

      /// Pointer to the first entry of the row of component c of cover i.
      double *
      row(const unsigned int i, const unsigned int c)
      {
        return matrix + (2 * i + c) * 2 * n_covers;
      }
    };


    /// The covers of an element, followed by those of its neighbor.
    inline std::array<unsigned int, LocalSystem::max_covers>
    covers_of_pair(const CoverSystem &covers,
                   const unsigned int element,
                   const unsigned int neighbor)
    {
      std::array<unsigned int, LocalSystem::max_covers> result{};
      unsigned int                                      n = 0;
      for (const unsigned int e : {element, neighbor})
        for (const unsigned int k : covers.covers(e))
          result[n++] = k;
      return result;
    }
  } // namespace internal
} // namespace NMM

#endif
