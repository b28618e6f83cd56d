#ifndef nmm_source_mechanics_element_tables_h
#define nmm_source_mechanics_element_tables_h

#include <nmm/covers/cover_system.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/quadrature/element_quadrature.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Quadrature weights and physical gradients dw_i/dX_J of the weight functions at the
     * quadrature points of all owned elements in the reference configuration. They are computed
     * once and read in every iteration. Whole elements whose cells have the
     * same Jacobian (the same orientation and size) share one table; each cut
     * element has its own.
     *
     * Memory: 8 (1 + 2 n) bytes per point of a cut element, n = 3 or 6.
     */
    class ElementTables
    {
    public:
      ElementTables(const CoverSystem          &covers,
                    const QuadratureCollection &quadrature);

      /// The table of an element.
      struct View
      {
        unsigned int n_points;
        /// Quadrature weights times det J [m^2].
        const double *weights;
        /// Gradients [1/m] at [point * number of weight functions + weight function][direction].
        const double (*gradients)[2];
      };

      View
      operator()(const unsigned int element) const
      {
        const Entry &entry = entries[element - first_element];
        return {entry.n_points,
                weights.data() + entry.first,
                reinterpret_cast<const double(*)[2]>(gradients.data()) +
                  entry.first * n_per_cell};
      }

    private:
      struct Entry
      {
        unsigned int n_points;
        std::size_t  first;
      };

      /// Append the table of a rule. Returns the index of its first point in the tables.
      std::size_t
      append(const dealii::Quadrature<2> &rule,
             const dealii::Tensor<2, 2>  &jacobian,
             unsigned int                 degree);

      unsigned int        first_element, n_per_cell;
      std::vector<Entry>  entries;
      std::vector<double> weights, gradients;
    };


    /// The displacement gradient H = sum_i u_i (x) grad w_i for @p n weight functions.
    inline dealii::Tensor<2, 2>
    displacement_gradient(const unsigned int n,
                          const double (*u)[2],
                          const double (*gradients)[2])
    {
      double h00 = 0., h01 = 0., h10 = 0., h11 = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        h00 += u[i][0] * gradients[i][0];
        h01 += u[i][0] * gradients[i][1];
        h10 += u[i][1] * gradients[i][0];
        h11 += u[i][1] * gradients[i][1];
      }
      dealii::Tensor<2, 2> H;
      H[0][0] = h00;
      H[0][1] = h01;
      H[1][0] = h10;
      H[1][1] = h11;
      return H;
    }


    /// Add the forces P_cJ dw_i/dX_J of a stress @p P to @p rhs, for @p n weight functions.
    inline DEAL_II_ALWAYS_INLINE void
    add_stress(const unsigned int n,
               const double (*gradients)[2],
               const dealii::Tensor<2, 2> &P,
               double                     *rhs)
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          rhs[unknown_of(i, c)] +=
            P[c][0] * gradients[i][0] + P[c][1] * gradients[i][1];
    }


    /// Add @p weight times the sum over (J, L) of dw_i/dX_J A_cJdL dw_j/dX_L, with A_cJdL at
    /// [2c + J][2d + L], to the entries of @p n weight functions in a matrix whose rows are
    /// @p stride apart. A need not be symmetric.
    inline DEAL_II_ALWAYS_INLINE void
    add_moduli(const unsigned int n,
               const double (*gradients)[2],
               const double weight,
               const double (&A)[4][4],
               double            *matrix,
               const unsigned int stride)
    {
      for (unsigned int i = 0; i < n; ++i)
      {
        const double g0 = weight * gradients[i][0],
                     g1 = weight * gradients[i][1];
        for (unsigned int c = 0; c < 2; ++c)
        {
          double M[4];
          for (unsigned int b = 0; b < 4; ++b)
            M[b] = g0 * A[2 * c][b] + g1 * A[2 * c + 1][b];
          double *row = matrix + stride * unknown_of(i, c);
          for (unsigned int j = 0; j < n; ++j)
          {
            row[unknown_of(j, 0)] +=
              M[0] * gradients[j][0] + M[1] * gradients[j][1];
            row[unknown_of(j, 1)] +=
              M[2] * gradients[j][0] + M[3] * gradients[j][1];
          }
        }
      }
    }
  } // namespace internal
} // namespace NMM

#endif
