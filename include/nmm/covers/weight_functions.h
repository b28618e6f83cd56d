#ifndef nmm_covers_weight_functions_h
#define nmm_covers_weight_functions_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  /**
   * The weight functions of the paper's eq. (3)-(5) on the reference triangle,
   * in the order of FE_SimplexP<2>: corners, then the middles of the edges
   * (0,1), (1,2), (2,0). They are written out here because a virtual call of the finite
   * element per function and point costs more than the function.
   */
  namespace WeightFunctions
  {
    /// Largest number of weight functions on a cell.
    constexpr unsigned int max_per_cell = 6;

    /// Number of weight functions on a cell: 3 for degree 1, 6 for degree 2.
    inline unsigned int
    n_per_cell(const unsigned int degree)
    {
      Assert(degree == 1 || degree == 2, dealii::ExcNotImplemented());
      return degree == 1 ? 3 : 6;
    }


    /// Compute w_i(xi) [-]; @p values has n_per_cell(degree) entries.
    inline void
    values(const unsigned int      degree,
           const dealii::Point<2> &xi,
           double                 *values)
    {
      const double l0 = 1. - xi[0] - xi[1];
      const double l1 = xi[0];
      const double l2 = xi[1];
      if (degree == 1)
      {
        values[0] = l0;
        values[1] = l1;
        values[2] = l2;
      }
      else
      {
        values[0] = l0 * (2. * l0 - 1.);
        values[1] = l1 * (2. * l1 - 1.);
        values[2] = l2 * (2. * l2 - 1.);
        values[3] = 4. * l0 * l1;
        values[4] = 4. * l1 * l2;
        values[5] = 4. * l2 * l0;
      }
    }


    /// Compute dw_i/dxi_j [-]; @p gradients has n_per_cell(degree) entries.
    inline void
    gradients(const unsigned int      degree,
              const dealii::Point<2> &xi,
              double (*gradients)[2])
    {
      if (degree == 1)
      {
        gradients[0][0] = -1.;
        gradients[0][1] = -1.;
        gradients[1][0] = 1.;
        gradients[1][1] = 0.;
        gradients[2][0] = 0.;
        gradients[2][1] = 1.;
        return;
      }
      const double l0 = 1. - xi[0] - xi[1];
      const double l1 = xi[0];
      const double l2 = xi[1];
      gradients[0][0] = 1. - 4. * l0;
      gradients[0][1] = 1. - 4. * l0;
      gradients[1][0] = 4. * l1 - 1.;
      gradients[1][1] = 0.;
      gradients[2][0] = 0.;
      gradients[2][1] = 4. * l2 - 1.;
      gradients[3][0] = 4. * (l0 - l1);
      gradients[3][1] = -4. * l1;
      gradients[4][0] = 4. * l2;
      gradients[4][1] = 4. * l1;
      gradients[5][0] = -4. * l2;
      gradients[5][1] = 4. * (l0 - l2);
    }
  } // namespace WeightFunctions
} // namespace NMM

#endif
