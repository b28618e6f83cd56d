#ifndef nmm_base_double_double_h
#define nmm_base_double_double_h

#include <cmath>

namespace NMM
{
  namespace internal
  {
    /**
     * An unevaluated sum hi + lo of two doubles, about 32 decimal digits
     * (Dekker, Numer. Math. 18, 1971). A sliver of width 1e-14 cell sizes has
     * two significant digits left after its coordinates are subtracted in
     * double; these few operations keep all of them.
     */
    struct DoubleDouble
    {
      double hi = 0.;
      double lo = 0.;
    };


    /// a + b without error (Knuth).
    inline DoubleDouble
    two_sum(const double a, const double b)
    {
      const double sum = a + b;
      const double bb  = sum - a;
      return {sum, (a - (sum - bb)) + (b - bb)};
    }


    /// The product a b without error. Veltkamp's splitting is used where the machine has no
    /// fused multiply-add. Where it has one, the compiler would contract the operations of the
    /// splitting and thereby make it wrong.
    inline DoubleDouble
    two_product(const double a, const double b)
    {
#ifdef __FMA__
      const double product = a * b;
      return {product, std::fma(a, b, -product)};
#else
      constexpr double splitter = 134217729.; // 2^27 + 1
      const double     product  = a * b;
      const double     ta       = splitter * a;
      const double     ah       = ta - (ta - a);
      const double     al       = a - ah;
      const double     tb       = splitter * b;
      const double     bh       = tb - (tb - b);
      const double     bl       = b - bh;
      return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
#endif
    }


    inline DoubleDouble
    operator+(const DoubleDouble &a, const DoubleDouble &b)
    {
      const DoubleDouble sum  = two_sum(a.hi, b.hi);
      const double       rest = sum.lo + (a.lo + b.lo);
      const double       hi   = sum.hi + rest;
      return {hi, rest - (hi - sum.hi)};
    }


    inline DoubleDouble
    operator-(const DoubleDouble &a)
    {
      return {-a.hi, -a.lo};
    }


    inline DoubleDouble
    operator*(const DoubleDouble &a, const double b)
    {
      const DoubleDouble product = two_product(a.hi, b);
      const double       rest    = product.lo + a.lo * b;
      const double       hi      = product.hi + rest;
      return {hi, rest - (hi - product.hi)};
    }
  } // namespace internal
} // namespace NMM

#endif
