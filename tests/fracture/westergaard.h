#ifndef nmm_tests_fracture_westergaard_h
#define nmm_tests_fracture_westergaard_h

#include <nmm/covers/crack_tip.h>

#include <cmath>
#include <complex>
#include <mechanics/model.h>

namespace NMM
{
  namespace Test
  {
    /**
     * Westergaard's solution: an infinite plane under equibiaxial tension sigma with a
     * crack from (-2a, 0) to (0, 0), all orders of r (shared by many textbooks):
     * Z = sigma (z + a) (z (z + 2a))^(-1/2), K_I = sigma (pi a)^(1/2), K_II = T = 0.
     */
    struct Westergaard
    {
      using Complex = std::complex<double>;
      double a = 1., sigma = 1., mu, kappa;
      /// Of the tip's frame.
      double   angle;
      Point<2> tip;

      Westergaard(const CrackTip &tip, const PlaneElasticity &elasticity)
        : mu(elasticity.mu)
        , kappa((elasticity.lambda + 3. * mu) / (elasticity.lambda + mu))
        , angle(std::atan2(tip.direction[1], tip.direction[0]))
        , tip(tip.point)
      {
      }

      /// sqrt(z (z + 2a)) with the cut along the crack.
      Complex
      root(const Complex &z) const
      {
        return std::sqrt(z) * std::sqrt(z + 2. * a);
      }

      Tensor<2, 2>
      frame() const
      {
        Tensor<2, 2> Q;
        Q[0][0] = Q[1][1] = std::cos(angle);
        Q[1][0]           = std::sin(angle);
        Q[0][1]           = -Q[1][0];
        return Q;
      }

      Complex
      local(const Point<2> &x) const
      {
        const Tensor<1, 2> d = dealii::transpose(frame()) * (x - tip);
        return {d[0], d[1]};
      }

      Tensor<1, 2>
      displacement(const Point<2> &x) const
      {
        if (x == tip)
          return {};
        const Complex z = local(x), Z = sigma * (z + a) / root(z),
                      Zt = sigma * root(z);
        return frame() *
               Point<2>((0.5 * (kappa - 1.) * Zt.real() - z.imag() * Z.imag()) /
                          (2. * mu),
                        (0.5 * (kappa + 1.) * Zt.imag() - z.imag() * Z.real()) /
                          (2. * mu));
      }

      Tensor<2, 2>
      gradient(const Point<2> &x) const
      {
        const Complex z = local(x), Z = sigma * (z + a) / root(z);
        // Z' = -sigma a^2 (z (z + 2a))^(-3/2)
        const Complex dZ = -sigma * a * a / (root(z) * root(z) * root(z));
        const double  y  = z.imag();
        Tensor<2, 2>  g;
        g[0][0] = 0.5 * (kappa - 1.) * Z.real() - y * dZ.imag();
        g[0][1] = -0.5 * (kappa - 1.) * Z.imag() - Z.imag() - y * dZ.real();
        g[1][0] = 0.5 * (kappa + 1.) * Z.imag() - y * dZ.real();
        g[1][1] = 0.5 * (kappa + 1.) * Z.real() - Z.real() + y * dZ.imag();
        return frame() * (g / (2. * mu)) * dealii::transpose(frame());
      }
    };
  } // namespace Test
} // namespace NMM

#endif
