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
   * stress-free faces, in the tip's frame (CrackTip). Such fields are the terms of Williams'
   * series, of degree n/2 in the distance r. Kolosov's formulas give them by two analytic
   * functions,
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
   * @f$\pm\pi@f$ for a crack that bends. It remains an elastic field there, but its
   * tractions on the faces no longer vanish.
   *
   * Sources: N. Muskhelishvili, Some basic problems of the mathematical theory of
   * elasticity (1953), section 32; M. Williams, J. Appl. Mech. 24 (1957), 109-114.
   */
  class TipField
  {
  public:
    /// The terms that can be evaluated.
    enum class Kind
    {
      /// The term n with A = (2 pi)^(-1/2). For n = 1, K_I = 1 Pa m^(1/2):
      /// sigma_22 = (2 pi r)^(-1/2) ahead of the tip.
      opening,
      /// The term n with A = -i (2 pi)^(-1/2). For n = 1, K_II = 1 Pa m^(1/2):
      /// sigma_12 = (2 pi r)^(-1/2) ahead of the tip.
      sliding,
      /// The field of a force of 1 N per metre of thickness at the tip, in the direction e_1:
      /// psi = -phi = log(z) / (4 pi). The T-stress is computed with this field.
      point_force
    };

    /// The field @p kind for the given elastic constants; @p n is the number of the term.
    TipField(Kind kind, const PlaneElasticity &elasticity, unsigned int n = 1);

    /// Values of the field in components of the tip's frame.
    struct Values
    {
      /// Displacement u [m]; that of a point force is defined up to a translation.
      dealii::Tensor<1, 2> displacement;
      /// Displacement gradient du_i/dx_j [-].
      dealii::Tensor<2, 2> gradient;
      /// Stress, tension positive [Pa].
      dealii::SymmetricTensor<2, 2> stress;
      /// Derivatives of the stress d sigma / dx_j [Pa/m].
      std::array<dealii::SymmetricTensor<2, 2>, 2> stress_derivatives;
    };

    /// The field at the distance @p r > 0 [m] from the tip and at the angle @p theta [rad],
    /// counter-clockwise from the direction of the crack.
    Values
    evaluate(double r, double theta) const;

  private:
    double mu, kappa;
    /// The functions are given by phi' = phi_factor z^power and psi' = psi_factor z^power.
    double               power;
    std::complex<double> phi_factor, psi_factor;
  };


  /// Kolosov's constant kappa [-]: 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane stress.
  double
  kolosov_constant(const PlaneElasticity &elasticity);

  /// Young's modulus of the plane E' [Pa]: E / (1 - nu^2) in plane strain, E in plane stress.
  double
  plane_modulus(const PlaneElasticity &elasticity);
} // namespace NMM

#endif
