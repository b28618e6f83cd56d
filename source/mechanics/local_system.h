#ifndef nmm_source_mechanics_local_system_h
#define nmm_source_mechanics_local_system_h

#include <nmm/covers/cover_system.h>
#include <nmm/covers/weight_functions.h>

#include <algorithm>
#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The sum of some terms of one element, or of two that are tied, per unit thickness: their
     * energy, its derivative (the forces of terms without potential), and the matrix, which is the
     * derivative of the forces. Component c of local cover i is row 2i + c.
     */
    struct LocalSystem
    {
      static constexpr unsigned int max_covers =
        2 * WeightFunctions::max_per_cell;

      unsigned int n_covers = 0;
      /// Whether terms are also added to the matrix.
      bool with_matrix = true;
      /// Energy of the terms, and energy that they dissipate [J/m].
      double energy = 0., dissipated = 0.;
      /// The matrix (2 n_covers x 2 n_covers), stored row by row.
      double matrix[4 * max_covers * max_covers];
      /// The forces (2 n_covers); their sign is that of internal forces minus loads.
      double rhs[2 * max_covers];

      void
      reset(const unsigned int n, const bool needs_matrix = true)
      {
        n_covers    = n;
        with_matrix = needs_matrix;
        energy = dissipated = 0.;
        if (with_matrix)
          std::fill_n(matrix, 4 * n * n, 0.);
        std::fill_n(rhs, 2 * n, 0.);
      }

      /// Pointer to the first entry of the row of component c of cover i.
      double *
      row(const unsigned int i, const unsigned int c)
      {
        return matrix + unknown_of(i, c) * 2 * n_covers;
      }
    };


    /// Displacements of the covers of an element, or of two elements one after the other
    /// [m].
    struct LocalDisplacement
    {
      double values[LocalSystem::max_covers][2];

      /// Read the displacements of @p covers from @p nodal and store them
      /// from position @p first on.
      void
      gather(const dealii::ArrayView<const unsigned int> &covers,
             const std::vector<dealii::Tensor<1, 2>>     &nodal,
             const unsigned int                           first = 0)
      {
        for (unsigned int i = 0; i < covers.size(); ++i)
          for (unsigned int c = 0; c < 2; ++c)
            values[first + i][c] = nodal[covers[i]][c];
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
