#include <nmm/materials/hyperelastic_law.h>

#include <algorithm>

namespace NMM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  HyperelasticLaw::HyperelasticLaw(const Material  &material,
                                   const PlaneState plane_state)
    : plane_state(plane_state)
    , elasticity(material.plane_elasticity(plane_state))
    , poissons_ratio(material.poissons_ratio)
    , initial_stress(material.initial_stress)
  {
  }


  Deformation
  HyperelasticLaw::tangent_derivative(const Tensor<2, 2> &H,
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
    // The step balances the truncation error step^2 against the rounding error 1e-16 / step.
    const double step = 1e-4 / norm;
    Response     plus, minus;
    if (evaluate(H + step * G, plus) != Deformation::admissible ||
        evaluate(H - step * G, minus) != Deformation::admissible)
      return Deformation::inverted;
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int b = 0; b < 4; ++b)
        derivative[a][b] =
          (plus.tangent[a][b] - minus.tangent[a][b]) / (2. * step);
    return Deformation::admissible;
  }


  Deformation
  HyperelasticLaw::out_of_plane_stretch(const Tensor<2, 2> &H,
                                        double             &stretch) const
  {
    stretch = 1.;
    return plane_state == PlaneState::plane_strain
             ? Deformation::admissible
             : plane_stress_stretch(H, stretch);
  }


  Deformation
  HyperelasticLaw::cauchy_stress(const Tensor<2, 2>    &H,
                                 SymmetricTensor<2, 2> &stress) const
  {
    Response     response;
    double       s;
    const double j = 1. + determinant_change(H);
    if (!(j > 0.) || out_of_plane_stretch(H, s) != Deformation::admissible ||
        evaluate_stress(H, response) != Deformation::admissible)
      return Deformation::inverted;
    stress = dealii::symmetrize(response.stress *
                                dealii::transpose(deformation_gradient(H))) /
             (s * j);
    return Deformation::admissible;
  }
} // namespace NMM
