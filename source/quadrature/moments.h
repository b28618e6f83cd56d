#ifndef nmm_quadrature_moments_h
#define nmm_quadrature_moments_h

#include "element_frame.h"
#include "slab_candidates.h"
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The products @f$P_i(s_1)P_j(s_2)@f$ of Legendre polynomials with
     * @f$i+j\le m@f$, ordered by i + j; the first is the constant.
     */
    class LegendreBasis
    {
    public:
      explicit LegendreBasis(unsigned int degree);

      unsigned int
      degree() const
      {
        return m;
      }

      unsigned int
      size() const
      {
        return (m + 1) * (m + 2) / 2;
      }

      /// Evaluates all functions at the points (s1[k], s2[k]); function i at point k goes to
      /// values[i * n_points + k].
      void
      evaluate(const std::vector<double> &s1,
               const std::vector<double> &s2,
               std::vector<double>       &values);

      /**
       * Moments @f$\int_E P_iP_j\,ds@f$ by Green's theorem,
       * @f[ \int_E q\,ds = \oint_{\partial E} Q\,ds_2,\quad
       *     \partial_1 Q=q,\quad
       *     \int P_i = \frac{P_{i+1}-P_{i-1}}{2i+1}, @f]
       * with Gauss points on every edge. A straight edge has as many as the degree m + 1 needs.
       * On an arc the integrand is a trigonometric polynomial of
       * degree m + 2 in the angle, and there are so many points that the error is
       * round-off.
       *
       * @return the sum over the edges of @f$\int|s_1\,ds_2|@f$: the round-off of
       * the moments is a few units in the last place of this sum.
       */
      double
      moments(const std::vector<FrameEdge> &edges,
              GaussTable                   &gauss,
              std::vector<double>          &result);

    private:
      void
      add_boundary_point(double               s1,
                         double               s2,
                         double               ds2,
                         std::vector<double> &result);

      unsigned int        m;
      std::vector<double> p1, p2, antiderivative;
      /// The coefficients (2k+1)/(k+1) and k/(k+1) of Legendre's recurrence.
      std::vector<double> recurrence_a, recurrence_b;
    };


    /// Number of Gauss points in the angle that integrate polynomials of degree @p degree in the
    /// coordinates of an arc to round-off; @p half_angle is half the angle of the arc [rad].
    unsigned int
    n_arc_points(unsigned int degree, double half_angle);
  } // namespace internal
} // namespace NMM

#endif
