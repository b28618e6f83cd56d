#ifndef nmm_fracture_tip_field_h
#define nmm_fracture_tip_field_h

#include <nmm/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <complex>

namespace NMM
{
  /**
   * A plane elastic field without body force about the tip of a straight crack with
   * stress-free faces, in the tip's frame (CrackTip), of degree n/2 in the distance r:
   * Williams' terms. By Kolosov's formulas with two analytic functions,
   * @f[ \sigma_{11}+\sigma_{22} = 4\,\mathrm{Re}\,\varphi', \qquad
       \sigma_{22}-\sigma_{11}+2i\sigma_{12} = 2(\bar z\varphi''+\psi'), \qquad
       2\mu(u_1+iu_2) = \kappa\varphi - z\overline{\varphi'}-\overline{\psi}, @f]
   * where
   * @f[ \varphi = A z^{n/2}, \qquad
       \psi = -\left((-1)^n\bar A + \tfrac n2 A\right)z^{n/2},
       \qquad z = r e^{i\theta},\ \theta\in(-\pi,\pi) @f]
   * leaves the faces @f$\theta=\pm\pi@f$ free of stress.
   *
   * The caller gives the angle, so that the field can be continued beyond
   * @f$\pm\pi@f$ to a crack that bends: it remains an elastic field, and only its
   * tractions on the faces no longer vanish.
   *
   * Sources: N. Muskhelishvili, Some basic problems of the mathematical theory of
   * elasticity (1953), section 32; M. Williams, J. Appl. Mech. 24 (1957), 109-114.
   */
  class TipField
  {
  public:
    enum class Kind
    {
      /// n = 1, the stress intensity K_I = 1 Pa m^(1/2):
      /// sigma_22 = (2 pi r)^(-1/2) ahead of the tip.
      opening,
      /// n = 1, K_II = 1 Pa m^(1/2): sigma_12 = (2 pi r)^(-1/2) ahead of the tip.
      sliding,
      /// The force 1 N per metre of thickness at the tip, in the direction e_1:
      /// psi = -phi = log(z) / (4 pi). It is the field that extracts the T-stress.
      point_force
    };

    TipField(Kind kind, const PlaneElasticity &elasticity);

    /// Values of the field in components of the tip's frame.
    struct Values
    {
      /// u [m]; of a point force up to a translation.
      dealii::Tensor<1, 2> displacement;
      /// du_i/dx_j [-].
      dealii::Tensor<2, 2> gradient;
      /// [Pa]
      dealii::SymmetricTensor<2, 2> stress;
      /// d sigma / dx_j [Pa/m].
      std::array<dealii::SymmetricTensor<2, 2>, 2> stress_derivatives;
    };

    /// The field at the distance @p r > 0 [m] and angle @p theta [rad] from the tip.
    Values
    evaluate(double r, double theta) const;

  private:
    double mu, kappa;
    /// phi' = phi_factor z^power, psi' = psi_factor z^power
    double               power;
    std::complex<double> phi_factor, psi_factor;
  };


  /// Kolosov's constant: 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane stress.
  double
  kolosov_constant(const PlaneElasticity &elasticity);

  /// E' [Pa]: E / (1 - nu^2) in plane strain, E in plane stress.
  double
  plane_modulus(const PlaneElasticity &elasticity);
} // namespace NMM

#endif
