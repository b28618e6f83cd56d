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

      /// Index of the element's first quadrature point in a consecutive numbering of the points
      /// of all owned elements.
      unsigned int
      first_point(const unsigned int element) const
      {
        return entries[element - first_element].first_point;
      }

      unsigned int
      n_points() const
      {
        return n_all_points;
      }

      /// Number of tables that whole elements share.
      unsigned int
      n_shared() const
      {
        return n_shared_tables;
      }

    private:
      struct Entry
      {
        unsigned int n_points;
        unsigned int first_point;
        std::size_t  first;
      };

      /// Append the table of a rule. Returns the index of its first point in the tables.
      std::size_t
      append(const dealii::Quadrature<2> &rule,
             const dealii::Tensor<2, 2>  &jacobian,
             unsigned int                 degree);

      unsigned int        first_element, n_per_cell;
      unsigned int        n_all_points = 0, n_shared_tables = 0;
      std::vector<Entry>  entries;
      std::vector<double> weights, gradients;
    };


    /// The tensor @p diagonal * I + sum_i u_i (x) grad w_i for @p n weight functions: with the
    /// @p diagonal 0 the displacement gradient, with 1 the deformation gradient.
    inline dealii::Tensor<2, 2>
    displacement_gradient(const unsigned int n,
                          const double (*u)[2],
                          const double (*gradients)[2],
                          const double diagonal = 0.)
    {
      double f00 = diagonal, f01 = 0., f10 = 0., f11 = diagonal;
      for (unsigned int i = 0; i < n; ++i)
      {
        f00 += u[i][0] * gradients[i][0];
        f01 += u[i][0] * gradients[i][1];
        f10 += u[i][1] * gradients[i][0];
        f11 += u[i][1] * gradients[i][1];
      }
      dealii::Tensor<2, 2> F;
      F[0][0] = f00;
      F[0][1] = f01;
      F[1][0] = f10;
      F[1][1] = f11;
      return F;
    }


    /// The deformation gradient F = I + sum_i u_i (x) grad w_i for @p n weight functions.
    inline dealii::Tensor<2, 2>
    deformation_gradient(const unsigned int n,
                         const double (*u)[2],
                         const double (*gradients)[2])
    {
      return displacement_gradient(n, u, gradients, 1.);
    }
  } // namespace internal
} // namespace NMM

#endif
