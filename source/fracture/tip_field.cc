#include <nmm/fracture/tip_field.h>

#include <cmath>

namespace NMM
{
  namespace
  {
    using Complex = std::complex<double>;

    dealii::SymmetricTensor<2, 2>
    stress_of(const double sum, const Complex &difference)
    {
      dealii::SymmetricTensor<2, 2> stress;
      stress[0][0] = 0.5 * (sum - difference.real());
      stress[1][1] = 0.5 * (sum + difference.real());
      stress[0][1] = 0.5 * difference.imag();
      return stress;
    }
  } // namespace


  double
  kolosov_constant(const PlaneElasticity &elasticity)
  {
    return (elasticity.lambda + 3. * elasticity.mu) /
           (elasticity.lambda + elasticity.mu);
  }


  double
  plane_modulus(const PlaneElasticity &elasticity)
  {
    return 8. * elasticity.mu / (kolosov_constant(elasticity) + 1.);
  }


  TipField::TipField(const Kind             kind,
                     const PlaneElasticity &elasticity,
                     const unsigned int     n)
    : mu(elasticity.mu)
    , kappa(kolosov_constant(elasticity))
  {
    if (kind == Kind::point_force)
    {
      power      = -1.;
      psi_factor = 0.25 / dealii::numbers::PI;
      phi_factor = -psi_factor;
      return;
    }
    // For n = 1, phi' = (K_I - i K_II) / (2 (2 pi z)^(1/2)).
    power = 0.5 * n - 1.;
    const Complex A =
      (kind == Kind::opening ? Complex(1., 0.) : Complex(0., -1.)) /
      std::sqrt(2. * dealii::numbers::PI);
    phi_factor = 0.5 * n * A;
    psi_factor =
      -0.5 * n * ((n % 2 == 0 ? 1. : -1.) * std::conj(A) + 0.5 * n * A);
  }


  TipField::Values
  TipField::evaluate(const double r, const double theta) const
  {
    const Complex i(0., 1.);
    const Complex z       = std::polar(r, theta);
    const Complex z_power = std::polar(std::pow(r, power), power * theta);
    const Complex phi_1   = phi_factor * z_power;
    const Complex phi_2   = power * phi_1 / z;
    const Complex phi_3   = (power - 1.) * phi_2 / z;
    const Complex psi_1   = psi_factor * z_power;
    const Complex psi_2   = power * psi_1 / z;
    const Complex primitive =
      power == -1. ? Complex(std::log(r), theta) : z * z_power / (power + 1.);

    Values        values;
    const Complex u = (kappa * phi_factor * primitive - z * std::conj(phi_1) -
                       std::conj(psi_factor * primitive)) /
                      (2. * mu);
    values.displacement[0] = u.real();
    values.displacement[1] = u.imag();
    const Complex common   = z * std::conj(phi_2) + std::conj(psi_1);
    const Complex u_1 = (kappa * phi_1 - std::conj(phi_1) - common) / (2. * mu);
    const Complex u_2 =
      i * (kappa * phi_1 - std::conj(phi_1) + common) / (2. * mu);
    values.gradient[0][0] = u_1.real();
    values.gradient[1][0] = u_1.imag();
    values.gradient[0][1] = u_2.real();
    values.gradient[1][1] = u_2.imag();
    values.stress =
      stress_of(4. * phi_1.real(), 2. * (std::conj(z) * phi_2 + psi_1));
    const Complex slope = std::conj(z) * phi_3 + psi_2;
    values.stress_derivatives[0] =
      stress_of(4. * phi_2.real(), 2. * (phi_2 + slope));
    values.stress_derivatives[1] =
      stress_of(4. * (i * phi_2).real(), 2. * i * (slope - phi_2));
    return values;
  }
} // namespace NMM
