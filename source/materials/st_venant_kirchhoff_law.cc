#include <nmm/materials/hyperelastic_law.h>
#include <nmm/materials/st_venant_kirchhoff_law.h>

#include <cmath>

namespace NMM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    class StVenantKirchhoff : public HyperelasticLaw
    {
    public:
      StVenantKirchhoff(const Material &material, const PlaneState plane_state)
        : HyperelasticLaw(material, plane_state)
      {
      }


      Deformation
      evaluate_stress(const Tensor<2, 2> &H, Response &response) const override
      {
        response.stress = first_stress(H, second_stress(H, response.energy));
        return Deformation::admissible;
      }


      /// A_iJkL = lambda F_iJ F_kL + mu (F_iL F_kJ + delta_JL (F F^T)_ik) + delta_ik S_JL.
      Deformation
      evaluate(const Tensor<2, 2> &H, Response &response) const override
      {
        double(&A)[4][4]  = response.tangent;
        const double f[4] = {1. + H[0][0], H[0][1], H[1][0], 1. + H[1][1]};
        const SymmetricTensor<2, 2> S = second_stress(H, response.energy);
        response.stress               = first_stress(H, S);
        const double b[2][2]          = {
                   {f[0] * f[0] + f[1] * f[1], f[0] * f[2] + f[1] * f[3]},
                   {f[0] * f[2] + f[1] * f[3], f[2] * f[2] + f[3] * f[3]}};
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int J = 0; J < 2; ++J)
            for (unsigned int k = 0; k < 2; ++k)
              for (unsigned int L = 0; L < 2; ++L)
                A[2 * i + J][2 * k + L] =
                  elasticity.lambda * f[2 * i + J] * f[2 * k + L] +
                  elasticity.mu *
                    (f[2 * i + L] * f[2 * k + J] + (J == L ? b[i][k] : 0.));
        add_geometric_stiffness(S, A);
        return Deformation::admissible;
      }


      /// S_33 = 0 gives E_33 = -nu / (1 - nu) tr E, and the stretch is (1 + 2 E_33)^(1/2).
      Deformation
      plane_stress_stretch(const Tensor<2, 2> &H,
                           double             &stretch) const override
      {
        const double square = 1. - 2. * poissons_ratio / (1. - poissons_ratio) *
                                     dealii::trace(green_strain(H));
        if (!(square > 0.))
          return Deformation::inverted;
        stretch = std::sqrt(square);
        return Deformation::admissible;
      }


      double
      plane_strain_stress(const Tensor<2, 2> &H) const override
      {
        return elasticity.lambda * 0.5 * square_change(H) /
               (1. + determinant_change(H));
      }


      bool
      is_linear_in_green_strain() const override
      {
        return true;
      }

    private:
      SymmetricTensor<2, 2>
      second_stress(const Tensor<2, 2> &H, double &energy) const
      {
        const SymmetricTensor<2, 2> E  = green_strain(H);
        const double          pressure = elasticity.lambda * dealii::trace(E);
        SymmetricTensor<2, 2> S        = 2. * elasticity.mu * E;
        S[0][0] += pressure;
        S[1][1] += pressure;
        energy = 0.5 * (S * E) + initial_stress * E;
        return S + initial_stress;
      }
    };
  } // namespace


  std::shared_ptr<const HyperelasticLaw>
  LinearLaw::hyperelastic_law(const Material  &material,
                              const PlaneState plane_state) const
  {
    return std::make_shared<StVenantKirchhoff>(material, plane_state);
  }
} // namespace NMM
