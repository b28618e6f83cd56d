#include <nmm/materials/hyperelastic_law.h>
#include <nmm/materials/neo_hooke_law.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    class NeoHooke : public HyperelasticLaw
    {
    public:
      NeoHooke(const Material &material, const PlaneState plane_state)
        : HyperelasticLaw(material, plane_state)
        , mu(elasticity.mu)
        , bulk_modulus(material.youngs_modulus /
                       (3. * (1. - 2. * material.poissons_ratio)))
      {
      }

      Deformation
      evaluate_stress(const Tensor<2, 2> &H, Response &response) const override
      {
        Derivatives d;
        if (differentiate(H, d) != Deformation::admissible)
          return Deformation::inverted;
        set_stress(H, d, response);
        return Deformation::admissible;
      }


      Deformation
      evaluate(const Tensor<2, 2> &H, Response &response) const override
      {
        Derivatives d;
        if (differentiate(H, d) != Deformation::admissible)
          return Deformation::inverted;
        set_stress(H, d, response);
        double(&A)[4][4]  = response.tangent;
        const double f[4] = {1. + H[0][0], H[0][1], H[1][0], 1. + H[1][1]};
        const double cofactor[4] = {f[3], -f[2], -f[1], f[0]};
        const double w_j         = d.pressure - 2. * d.w_I;
        for (unsigned int a = 0; a < 4; ++a)
        {
          for (unsigned int b = 0; b < 4; ++b)
            A[a][b] = 4. * d.w_II * f[a] * f[b] +
                      2. * d.w_Ij * (f[a] * cofactor[b] + cofactor[a] * f[b]) +
                      d.w_jj * cofactor[a] * cofactor[b];
          A[a][a] += 2. * d.w_I;
          // This is the term with the second derivative of det F.
          A[a][3 - a] += (a == 0 || a == 3) ? w_j : -w_j;
        }
        add_geometric_stiffness(initial_stress, A);
        return Deformation::admissible;
      }


      Deformation
      plane_stress_stretch(const Tensor<2, 2> &H,
                           double             &stretch) const override
      {
        const double j_1 = determinant_change(H);
        if (!(j_1 > -1.))
          return Deformation::inverted;
        stretch = 1. + find_stretch(square_change(H), j_1);
        return Deformation::admissible;
      }


      double
      plane_strain_stress(const Tensor<2, 2> &H) const override
      {
        const double J_1 = determinant_change(H), J = 1. + J_1;
        return -mu * std::pow(J, -2. / 3.) * square_change(H) / (3. * J) +
               bulk_modulus * J_1;
      }


      bool
      is_linear_in_green_strain() const override
      {
        return false;
      }

    private:
      /// The energy w(I, j), with I = F : F and j = det F, and its derivatives after condensation
      /// of s.
      struct Derivatives
      {
        double w, w_I;
        /// 2 w_I + w_j, which is 0 at rest.
        double pressure;
        double w_II, w_Ij, w_jj;
      };


      /// The energy, and P = 2 w_I F + w_j cof F = 2 w_I (F - cof F) + (2 w_I + w_j) cof F, whose
      /// parts are small where H is.
      void
      set_stress(const Tensor<2, 2> &H,
                 const Derivatives  &d,
                 Response           &response) const
      {
        const double deviator = H[0][0] - H[1][1], shear = H[0][1] + H[1][0];
        response.energy = d.w + initial_stress * green_strain(H);
        response.stress = first_stress(H, initial_stress);
        response.stress[0][0] +=
          2. * d.w_I * deviator + d.pressure * (1. + H[1][1]);
        response.stress[0][1] += 2. * d.w_I * shear - d.pressure * H[1][0];
        response.stress[1][0] += 2. * d.w_I * shear - d.pressure * H[0][1];
        response.stress[1][1] +=
          -2. * d.w_I * deviator + d.pressure * (1. + H[0][0]);
      }


      /**
       * The stretch s - 1 in plane stress, from dw/ds = 0 by Newton's method, where
       * w(s) = mu/2 ((j s)^(-2/3) (I + s^2) - 3) + K/2 (j s - 1)^2, with I_2 = I - 2 and
       * j_1 = j - 1. w'' > 0 for s > 0; a step that would make s negative is cut.
       */
      double
      find_stretch(const double I_2, const double j_1) const
      {
        const double K = bulk_modulus, I = 2. + I_2, j = 1. + j_1;
        double       t =
          std::expm1(-poissons_ratio / (1. - poissons_ratio) * std::log1p(j_1));
        for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const double s   = 1. + t;
          const double c   = 1. / std::cbrt(j * s * j * s);
          const double w_s = mu * c * (2. * t * (2. + t) - I_2) / (3. * s) +
                             K * (j_1 + j * t) * j;
          const double w_ss = mu * c * (5. * I / (s * s) + 2.) / 9. + K * j * j;
          const double next = std::max(t - w_s / w_ss, 0.3 * s - 1.);
          const bool   done =
            std::abs(next - t) <=
            1e-9 * (std::abs(t) + std::abs(I_2) + std::abs(j_1));
          t = next;
          // Convergence is quadratic, so the error is now of the order of rounding.
          if (done)
            break;
        }
        return t;
      }


      Deformation
      differentiate(const Tensor<2, 2> &H, Derivatives &d) const
      {
        const double I_2 = square_change(H), j_1 = determinant_change(H);
        if (!(j_1 > -1.))
          return Deformation::inverted;
        const bool   is_plane_stress = plane_state == PlaneState::plane_stress;
        const double t = is_plane_stress ? find_stretch(I_2, j_1) : 0.;
        const double K = bulk_modulus;
        const double I = 2. + I_2, j = 1. + j_1, s = 1. + t;
        const double J_1 = j_1 + j * t, J = 1. + J_1;
        // c = J^(-2/3) and F : F + s^2, both without their values at rest
        const double c_1 = std::expm1(-2. / 3. * std::log1p(J_1)), c = 1. + c_1;
        const double I_3 = I_2 + t * (2. + t);

        d.w        = 0.5 * mu * (3. * c_1 + c * I_3) + 0.5 * K * J_1 * J_1;
        d.w_I      = 0.5 * mu * c;
        d.pressure = mu * c * (3. * j_1 - I_3) / (3. * j) + K * J_1 * s;
        d.w_II     = 0.;
        d.w_Ij     = -mu * c / (3. * j);
        d.w_jj     = 5. * mu * c * (3. + I_3) / (9. * j * j) + K * s * s;
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

      double mu, bulk_modulus;
    };
  } // namespace


  std::shared_ptr<const HyperelasticLaw>
  NeoHookeLaw::hyperelastic_law(const Material  &material,
                                const PlaneState plane_state) const
  {
    return std::make_shared<NeoHooke>(material, plane_state);
  }
} // namespace NMM
