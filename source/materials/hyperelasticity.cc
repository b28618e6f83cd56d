#include <nmm/materials/hyperelasticity.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    /// P = F S.
    Tensor<2, 2>
    first_stress(const Tensor<2, 2> &F, const SymmetricTensor<2, 2> &S)
    {
      Tensor<2, 2> P;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int J = 0; J < 2; ++J)
          P[i][J] = F[i][0] * S[0][J] + F[i][1] * S[1][J];
      return P;
    }


    /// d(F S)/dF at constant S: delta_ik S_JL.
    void
    add_geometric(const SymmetricTensor<2, 2> &S, double (&A)[4][4])
    {
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int J = 0; J < 2; ++J)
          for (unsigned int L = 0; L < 2; ++L)
            A[2 * i + J][2 * i + L] += S[J][L];
    }


    /// E = (F^T F - I) / 2.
    SymmetricTensor<2, 2>
    green_strain(const Tensor<2, 2> &F)
    {
      SymmetricTensor<2, 2> E;
      E[0][0] = 0.5 * (F[0][0] * F[0][0] + F[1][0] * F[1][0] - 1.);
      E[1][1] = 0.5 * (F[0][1] * F[0][1] + F[1][1] * F[1][1] - 1.);
      E[0][1] = 0.5 * (F[0][0] * F[0][1] + F[1][0] * F[1][1]);
      return E;
    }
  } // namespace


  HyperelasticLaw::HyperelasticLaw(const Material  &material,
                                   const PlaneState plane_state)
    : is_neo_hookean(material.law == MaterialLaw::neo_hookean)
    , plane_state(plane_state)
    , elasticity(material.plane_elasticity(plane_state))
    , mu(elasticity.mu)
    , bulk_modulus(material.youngs_modulus /
                   (3. * (1. - 2. * material.poissons_ratio)))
    , poissons_ratio(material.poissons_ratio)
    , initial_stress(material.initial_stress)
  {
  }


  const PlaneElasticity &
  HyperelasticLaw::small_strain() const
  {
    return elasticity;
  }


  void
  HyperelasticLaw::svk_stress(const Tensor<2, 2>    &F,
                              SymmetricTensor<2, 2> &S,
                              double                &energy) const
  {
    const SymmetricTensor<2, 2> E        = green_strain(F);
    const double                pressure = elasticity.lambda * dealii::trace(E);
    S                                    = 2. * mu * E;
    S[0][0] += pressure;
    S[1][1] += pressure;
    energy = 0.5 * (S * E) + initial_stress * E;
    S += initial_stress;
  }


  /**
   * dw/ds = 0 with w(s) = mu/2 ((j s)^(-2/3) (I + s^2) - 3) + K/2 (j s - 1)^2.
   * w'' > 0 for s > 0; a step that would leave the positive axis is cut.
   */
  double
  HyperelasticLaw::neo_hookean_stretch(const double I, const double j) const
  {
    const double K = bulk_modulus;
    double       s = std::pow(j, -poissons_ratio / (1. - poissons_ratio));
    for (unsigned int iteration = 0; iteration < 50; ++iteration)
    {
      const double c    = 1. / std::cbrt(j * s * j * s);
      const double w_s  = mu * c * (2. * s - I / s) / 3. + K * (j * s - 1.) * j;
      const double w_ss = mu * c * (5. * I / (s * s) + 2.) / 9. + K * j * j;
      const double next = std::max(s - w_s / w_ss, 0.3 * s);
      const bool   done = std::abs(next - s) < 1e-9 * s;
      s                 = next;
      // quadratic: the error is now of the order of rounding
      if (done)
        break;
    }
    return s;
  }


  Deformation
  HyperelasticLaw::neo_hookean(const double I,
                               const double j,
                               Derivatives &d) const
  {
    if (!(j > 0.))
      return Deformation::inverted;
    const bool   is_plane_stress = (plane_state == PlaneState::plane_stress);
    const double s   = is_plane_stress ? neo_hookean_stretch(I, j) : 1.;
    const double K   = bulk_modulus;
    const double J   = j * s;
    const double c   = 1. / std::cbrt(J * J);
    const double I_3 = I + s * s;

    d.w    = 0.5 * mu * (c * I_3 - 3.) + 0.5 * K * (J - 1.) * (J - 1.);
    d.w_I  = 0.5 * mu * c;
    d.w_j  = -mu * c * I_3 / (3. * j) + K * (J - 1.) * s;
    d.w_II = 0.;
    d.w_Ij = -mu * c / (3. * j);
    d.w_jj = 5. * mu * c * I_3 / (9. * j * j) + K * s * s;
    if (is_plane_stress)
    {
      const double w_Is = -mu * c / (3. * s);
      const double w_js =
        mu * c * (2. * I / s - 4. * s) / (9. * j) + K * (2. * J - 1.);
      const double w_ss = mu * c * (5. * I / (s * s) + 2.) / 9. + K * j * j;
      d.w_II -= w_Is * w_Is / w_ss;
      d.w_Ij -= w_Is * w_js / w_ss;
      d.w_jj -= w_js * w_js / w_ss;
    }
    return Deformation::admissible;
  }


  Deformation
  HyperelasticLaw::evaluate_stress(const Tensor<2, 2> &F,
                                   Response           &response) const
  {
    if (!is_neo_hookean)
    {
      SymmetricTensor<2, 2> S;
      svk_stress(F, S, response.energy);
      response.stress = first_stress(F, S);
      return Deformation::admissible;
    }

    Derivatives  d;
    const double I = F.norm_square(), j = dealii::determinant(F);
    if (neo_hookean(I, j, d) != Deformation::admissible)
      return Deformation::inverted;
    response.energy = d.w + initial_stress * green_strain(F);
    response.stress = first_stress(F, initial_stress) + 2. * d.w_I * F;
    response.stress[0][0] += d.w_j * F[1][1];
    response.stress[0][1] -= d.w_j * F[1][0];
    response.stress[1][0] -= d.w_j * F[0][1];
    response.stress[1][1] += d.w_j * F[0][0];
    return Deformation::admissible;
  }


  Deformation
  HyperelasticLaw::evaluate(const Tensor<2, 2> &F, Response &response) const
  {
    double(&A)[4][4]  = response.tangent;
    const double f[4] = {F[0][0], F[0][1], F[1][0], F[1][1]};
    if (!is_neo_hookean)
    {
      SymmetricTensor<2, 2> S;
      svk_stress(F, S, response.energy);
      response.stress = first_stress(F, S);
      // lambda F_iJ F_kL + mu (F_iL F_kJ + delta_JL (F F^T)_ik)
      const double b[2][2] = {
        {f[0] * f[0] + f[1] * f[1], f[0] * f[2] + f[1] * f[3]},
        {f[0] * f[2] + f[1] * f[3], f[2] * f[2] + f[3] * f[3]}};
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int J = 0; J < 2; ++J)
          for (unsigned int k = 0; k < 2; ++k)
            for (unsigned int L = 0; L < 2; ++L)
              A[2 * i + J][2 * k + L] =
                elasticity.lambda * f[2 * i + J] * f[2 * k + L] +
                mu * (f[2 * i + L] * f[2 * k + J] + (J == L ? b[i][k] : 0.));
      add_geometric(S, A);
      return Deformation::admissible;
    }

    Derivatives  d;
    const double I = F.norm_square(), j = dealii::determinant(F);
    if (neo_hookean(I, j, d) != Deformation::admissible)
      return Deformation::inverted;
    const double cofactor[4] = {f[3], -f[2], -f[1], f[0]};
    response.energy          = d.w + initial_stress * green_strain(F);
    response.stress          = first_stress(F, initial_stress);
    for (unsigned int a = 0; a < 4; ++a)
    {
      response.stress[a / 2][a % 2] += 2. * d.w_I * f[a] + d.w_j * cofactor[a];
      for (unsigned int b = 0; b < 4; ++b)
        A[a][b] = 4. * d.w_II * f[a] * f[b] +
                  2. * d.w_Ij * (f[a] * cofactor[b] + cofactor[a] * f[b]) +
                  d.w_jj * cofactor[a] * cofactor[b];
      A[a][a] += 2. * d.w_I;
      // the second derivative of det F
      A[a][3 - a] += (a == 0 || a == 3) ? d.w_j : -d.w_j;
    }
    add_geometric(initial_stress, A);
    return Deformation::admissible;
  }


  Deformation
  HyperelasticLaw::tangent_derivative(const Tensor<2, 2> &F,
                                      const Tensor<2, 2> &G,
                                      double (&derivative)[4][4]) const
  {
    const double norm = G.norm();
    if (!(norm > 0.))
    {
      for (auto &row : derivative)
        std::fill_n(row, 4, 0.);
      return Deformation::admissible;
    }
    // truncation step^2 against rounding 1e-16 / step
    const double step = 1e-4 / norm;
    Response     plus, minus;
    if (evaluate(F + step * G, plus) != Deformation::admissible ||
        evaluate(F - step * G, minus) != Deformation::admissible)
      return Deformation::inverted;
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int b = 0; b < 4; ++b)
        derivative[a][b] =
          (plus.tangent[a][b] - minus.tangent[a][b]) / (2. * step);
    return Deformation::admissible;
  }


  Deformation
  HyperelasticLaw::out_of_plane_stretch(const Tensor<2, 2> &F,
                                        double             &stretch) const
  {
    stretch = 1.;
    if (plane_state == PlaneState::plane_strain)
      return Deformation::admissible;
    if (!is_neo_hookean)
    {
      const double square = 1. - 2. * poissons_ratio / (1. - poissons_ratio) *
                                   dealii::trace(green_strain(F));
      if (!(square > 0.))
        return Deformation::inverted;
      stretch = std::sqrt(square);
      return Deformation::admissible;
    }
    const double j = dealii::determinant(F);
    if (!(j > 0.))
      return Deformation::inverted;
    stretch = neo_hookean_stretch(F.norm_square(), j);
    return Deformation::admissible;
  }


  Deformation
  HyperelasticLaw::cauchy_stress(const Tensor<2, 2>    &F,
                                 SymmetricTensor<2, 2> &stress) const
  {
    Response     response;
    double       s;
    const double j = dealii::determinant(F);
    if (!(j > 0.) || out_of_plane_stretch(F, s) != Deformation::admissible ||
        evaluate_stress(F, response) != Deformation::admissible)
      return Deformation::inverted;
    stress =
      dealii::symmetrize(response.stress * dealii::transpose(F)) / (s * j);
    return Deformation::admissible;
  }
} // namespace NMM
