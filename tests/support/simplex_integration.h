#ifndef nmm_tests_support_simplex_integration_h
#define nmm_tests_support_simplex_integration_h

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

namespace NMM
{
  namespace Testing
  {
    using Rational      = boost::multiprecision::cpp_rational;
    using RationalPoint = std::array<Rational, 2>;

    inline Rational
    power(const Rational &x, const unsigned int n)
    {
      Rational result = 1;
      for (unsigned int i = 0; i < n; ++i)
        result *= x;
      return result;
    }


    inline Rational
    factorial(const unsigned int n)
    {
      Rational result = 1;
      for (unsigned int i = 2; i <= n; ++i)
        result *= i;
      return result;
    }


    inline Rational
    binomial(const unsigned int n, const unsigned int k)
    {
      return factorial(n) / (factorial(k) * factorial(n - k));
    }


    /**
     * Shi's simplex integration, exactly: the integral of @f$x^iy^j@f$ over the
     * oriented triangle (0, p, q),
     * @f[ |p,q| \sum_{k\le i,\,l\le j} \binom ik \binom jl
     *     p_x^kq_x^{i-k}p_y^lq_y^{j-l}
     *     \frac{(k+l)!\,(i+j-k-l)!}{(i+j+2)!}. @f]
     * Summed over the oriented edges of loops it is the integral over what they
     * enclose (Shi 1991; the triangles outside cancel).
     */
    inline Rational
    simplex_integral(const RationalPoint &p,
                     const RationalPoint &q,
                     const unsigned int   i,
                     const unsigned int   j)
    {
      Rational sum = 0;
      for (unsigned int k = 0; k <= i; ++k)
        for (unsigned int l = 0; l <= j; ++l)
          sum += binomial(i, k) * binomial(j, l) * power(p[0], k) *
                 power(q[0], i - k) * power(p[1], l) * power(q[1], j - l) *
                 factorial(k + l) * factorial(i + j - k - l);
      return (p[0] * q[1] - p[1] * q[0]) * sum / factorial(i + j + 2);
    }


    /// Sign of the area of (a, b, c).
    inline int
    orientation(const RationalPoint &a,
                const RationalPoint &b,
                const RationalPoint &c)
    {
      const Rational area =
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      return area.sign();
    }


    /// Times that the closed, oriented @p edges wind around @p x.
    inline int
    winding_number(
      const std::vector<std::pair<RationalPoint, RationalPoint>> &edges,
      const RationalPoint                                        &x)
    {
      int winding = 0;
      for (const auto &[a, b] : edges)
        if (a[1] <= x[1] && b[1] > x[1])
          winding += orientation(a, b, x) > 0;
        else if (a[1] > x[1] && b[1] <= x[1])
          winding -= orientation(a, b, x) < 0;
      return winding;
    }
  } // namespace Testing
} // namespace NMM

#endif
