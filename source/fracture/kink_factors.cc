#include <nmm/fracture/kink_factors.h>

#include <deal.II/base/numbers.h>

#include <cstddef>

namespace NMM
{
  namespace
  {
    /// Sum of a_i x^i.
    template <std::size_t n>
    double
    polynomial(const double (&a)[n], const double x)
    {
      double sum = 0.;
      for (std::size_t i = n; i > 0; --i)
        sum = sum * x + a[i - 1];
      return sum;
    }
  } // namespace


  KinkFactors
  kink_factors(const double angle)
  {
    constexpr double pi = dealii::numbers::PI;
    constexpr double p2 = pi * pi, p3 = p2 * pi, p4 = p2 * p2, p5 = p4 * pi,
                     p6 = p3 * p3;
    // These are the coefficients of m^0, m^2, ...
    constexpr double F_11[] = {1.,
                               -3. * p2 / 8.,
                               p2 - 5. * p4 / 128.,
                               p2 / 9. - 11. * p4 / 72. + 119. * p6 / 15360.,
                               5.07790,
                               -2.88312,
                               -0.0925,
                               2.996,
                               -4.059,
                               1.63,
                               4.1};
    constexpr double F_22[] = {1.,
                               -4. - 3. * p2 / 8.,
                               8. / 3. + 29. * p2 / 18. - 5. * p4 / 128.,
                               -32. / 15. - 4. * p2 / 9. - 1159. * p4 / 7200. +
                                 119. * p6 / 15360.,
                               10.58254,
                               -4.78511,
                               -1.8804,
                               7.280,
                               -7.591,
                               0.25,
                               12.5};
    // These are the coefficients of m, m^3, ...
    constexpr double F_12[] = {-3. * pi / 2.,
                               10. * pi / 3. + p3 / 16.,
                               -2. * pi - 133. * p3 / 180. + 59. * p5 / 1280.,
                               12.313906,
                               -7.32433,
                               1.5793,
                               4.0216,
                               -6.915,
                               4.21,
                               4.56};
    constexpr double F_21[] = {pi / 2.,
                               -4. * pi / 3. - p3 / 48.,
                               -2. * pi / 3. + 13. * p3 / 30. -
                                 59. * p5 / 3840.,
                               -6.176023,
                               4.44112,
                               -1.5340,
                               -2.0700,
                               4.684,
                               -3.95,
                               -1.32};
    const double     m = angle / pi, square = m * m;
    return {polynomial(F_11, square),
            m * polynomial(F_12, square),
            m * polynomial(F_21, square),
            polynomial(F_22, square)};
  }
} // namespace NMM
