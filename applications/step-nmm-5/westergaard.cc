#include "westergaard.h"

#include <cmath>

namespace StepNMM5
{
  using namespace dealii;
  using Complex = std::complex<double>;

  Westergaard::Westergaard(const NMM::CrackTip        &tip,
                           const NMM::PlaneElasticity &elasticity)
    : tip(tip.point)
    , elasticity(elasticity)
  {
    for (unsigned int i = 0; i < 2; ++i)
      frame[i][0] = tip.direction[i];
    frame[0][1] = -tip.direction[1];
    frame[1][1] = tip.direction[0];
  }


  double
  Westergaard::K_I()
  {
    return sigma * std::sqrt(numbers::PI * a);
  }


  Complex
  Westergaard::local(const Point<2> &x) const
  {
    const Tensor<1, 2> d = transpose(frame) * (x - tip);
    return {d[0], d[1]};
  }


  namespace
  {
    /// sqrt(z (z + 2a)), which jumps on the crack.
    Complex
    root(const Complex &z)
    {
      return std::sqrt(z) * std::sqrt(z + 2. * Westergaard::a);
    }
  } // namespace


  Tensor<1, 2>
  Westergaard::displacement(const Point<2> &x) const
  {
    if (x == tip)
      return {};
    const double  mu = elasticity.mu, lambda = elasticity.lambda;
    const double  kappa = (lambda + 3. * mu) / (lambda + mu);
    const Complex z = local(x), Z = sigma * (z + a) / root(z),
                  integral = sigma * root(z);
    return frame *
           Tensor<1, 2>(
             {(0.5 * (kappa - 1.) * integral.real() - z.imag() * Z.imag()) /
                (2. * mu),
              (0.5 * (kappa + 1.) * integral.imag() - z.imag() * Z.real()) /
                (2. * mu)});
  }


  SymmetricTensor<2, 2>
  Westergaard::stress(const Point<2> &x) const
  {
    // sigma_11 = Re Z - x_2 Im Z', sigma_22 = Re Z + x_2 Im Z', sigma_12 = -x_2 Re Z'
    const Complex z = local(x), Z = sigma * (z + a) / root(z);
    const Complex derivative = -sigma * a * a / std::pow(root(z), 3);
    Tensor<2, 2>  stress;
    stress[0][0] = Z.real() - z.imag() * derivative.imag();
    stress[1][1] = Z.real() + z.imag() * derivative.imag();
    stress[0][1] = stress[1][0] = -z.imag() * derivative.real();
    return symmetrize(frame * stress * transpose(frame));
  }
} // namespace StepNMM5
