#ifndef nmm_tests_fracture_westergaard_h
#define nmm_tests_fracture_westergaard_h

#include <nmm/covers/crack_tip.h>

#include <array>
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

      virtual ~Westergaard() = default;

      /// Integral of Z, Z, and its derivative, at the distance @p z from the tip.
      virtual std::array<Complex, 3>
      potential(const Complex &z) const
      {
        const Complex root = this->root(z);
        return {sigma * root,
                sigma * (z + a) / root,
                -sigma * a * a / (root * root * root)};
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
        const Complex z        = local(x);
        const auto [Zt, Z, dZ] = potential(z);
        return frame() *
               Point<2>((0.5 * (kappa - 1.) * Zt.real() - z.imag() * Z.imag()) /
                          (2. * mu),
                        (0.5 * (kappa + 1.) * Zt.imag() - z.imag() * Z.real()) /
                          (2. * mu));
      }

      Tensor<2, 2>
      gradient(const Point<2> &x) const
      {
        const Complex z        = local(x);
        const auto [Zt, Z, dZ] = potential(z);
        const double y         = z.imag();
        Tensor<2, 2> g;
        g[0][0] = 0.5 * (kappa - 1.) * Z.real() - y * dZ.imag();
        g[0][1] = -0.5 * (kappa - 1.) * Z.imag() - Z.imag() - y * dZ.real();
        g[1][0] = 0.5 * (kappa + 1.) * Z.imag() - y * dZ.real();
        g[1][1] = 0.5 * (kappa + 1.) * Z.real() - Z.real() + y * dZ.imag();
        return frame() * (g / (2. * mu)) * dealii::transpose(frame());
      }
    };

    /**
     * The same plane without load but a pressure sigma x / a on the faces, x being the distance from
     * the middle of the crack. It has the displacements of a plane with the initial stress
     * sigma_22 = sigma x / a and free faces. K_I = sigma (pi a)^(1/2) / 2 (Tada, Paris & Irwin, The
     * stress analysis of cracks handbook, section 5).
     */
    struct LinearPressure : Westergaard
    {
      using Westergaard::Westergaard;

      std::array<Complex, 3>
      potential(const Complex &z) const override
      {
        const Complex root = this->root(z), x = z + a, w = x * x - 0.5 * a * a;
        const double  s = sigma / a;
        return {0.5 * s * x * (root - x),
                s * (w / root - x),
                s * (x / root * (2. - w / (root * root)) - 1.)};
      }
    };
  } // namespace Test
} // namespace NMM

#endif
