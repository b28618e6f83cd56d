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
      evaluate_stress(const Tensor<2, 2> &F, Response &response) const override
      {
        Derivatives  d;
        const double I = F.norm_square(), j = dealii::determinant(F);
        if (differentiate(I, j, d) != Deformation::admissible)
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
      evaluate(const Tensor<2, 2> &F, Response &response) const override
      {
        double(&A)[4][4]  = response.tangent;
        const double f[4] = {F[0][0], F[0][1], F[1][0], F[1][1]};
        Derivatives  d;
        const double I = F.norm_square(), j = dealii::determinant(F);
        if (differentiate(I, j, d) != Deformation::admissible)
          return Deformation::inverted;
        const double cofactor[4] = {f[3], -f[2], -f[1], f[0]};
        response.energy          = d.w + initial_stress * green_strain(F);
        response.stress          = first_stress(F, initial_stress);
        for (unsigned int a = 0; a < 4; ++a)
        {
          response.stress[a / 2][a % 2] +=
            2. * d.w_I * f[a] + d.w_j * cofactor[a];
          for (unsigned int b = 0; b < 4; ++b)
            A[a][b] = 4. * d.w_II * f[a] * f[b] +
                      2. * d.w_Ij * (f[a] * cofactor[b] + cofactor[a] * f[b]) +
                      d.w_jj * cofactor[a] * cofactor[b];
          A[a][a] += 2. * d.w_I;
          // This is the term with the second derivative of det F.
          A[a][3 - a] += (a == 0 || a == 3) ? d.w_j : -d.w_j;
        }
        add_geometric_stiffness(initial_stress, A);
        return Deformation::admissible;
      }


      Deformation
      plane_stress_stretch(const Tensor<2, 2> &F,
                           double             &stretch) const override
      {
        const double j = dealii::determinant(F);
        if (!(j > 0.))
          return Deformation::inverted;
        stretch = find_stretch(F.norm_square(), j);
        return Deformation::admissible;
      }


      double
      plane_strain_stress(const Tensor<2, 2> &F) const override
      {
        const double J = dealii::determinant(F);
        return mu * std::pow(J, -2. / 3.) * (1. - (F.norm_square() + 1.) / 3.) /
                 J +
               bulk_modulus * (J - 1.);
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
        double w, w_I, w_j, w_II, w_Ij, w_jj;
      };


      /**
       * The stretch s in plane stress, from dw/ds = 0 by Newton's method, where
       * w(s) = mu/2 ((j s)^(-2/3) (I + s^2) - 3) + K/2 (j s - 1)^2.
       * w'' > 0 for s > 0; a step that would make s negative is cut.
       */
      double
      find_stretch(const double I, const double j) const
      {
        const double K = bulk_modulus;
        double       s = std::pow(j, -poissons_ratio / (1. - poissons_ratio));
        for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const double c = 1. / std::cbrt(j * s * j * s);
          const double w_s =
            mu * c * (2. * s - I / s) / 3. + K * (j * s - 1.) * j;
          const double w_ss = mu * c * (5. * I / (s * s) + 2.) / 9. + K * j * j;
          const double next = std::max(s - w_s / w_ss, 0.3 * s);
          const bool   done = std::abs(next - s) < 1e-9 * s;
          s                 = next;
          // Convergence is quadratic, so the error is now of the order of rounding.
          if (done)
            break;
        }
        return s;
      }


      Deformation
      differentiate(const double I, const double j, Derivatives &d) const
      {
        if (!(j > 0.))
          return Deformation::inverted;
        const bool   is_plane_stress = plane_state == PlaneState::plane_stress;
        const double s   = is_plane_stress ? find_stretch(I, j) : 1.;
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
