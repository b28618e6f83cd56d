#ifndef nmm_materials_hyperelasticity_h
#define nmm_materials_hyperelasticity_h

#include <nmm/base/assembly.h>
#include <nmm/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  /**
   * A hyperelastic law in the plane: energy W per reference volume [Pa] as
   * function of the in-plane deformation gradient F = I + du/dX [-], with
   * @f[ P = \frac{\partial W}{\partial F}, \qquad
   *     A = \frac{\partial P}{\partial F}. @f]
   *
   * The third direction has the stretch s = 1 in plane strain; in plane stress
   * s follows from dW/ds = 0.
   *
   * - St. Venant-Kirchhoff: @f$ W = \lambda/2\,(\mathrm{tr} E)^2 + \mu\,E:E,\;
   *   E = (F^TF - I)/2 @f$, with the plane lambda of PlaneElasticity, which is
   *   the condition S_33 = 0 in closed form. Defined for all F.
   * - neo-Hookean: @f$ W = \mu/2\,(J^{-2/3}(F:F+s^2)-3) + K/2\,(J-1)^2,\;
   *   J = s \det F,\; K = E/(3(1-2\nu)) @f$ (Simo & Miehe's isochoric split).
   *   In plane stress s is found by a Newton iteration, in which W is convex;
   *   A follows by static condensation of s.
   *
   * An initial stress S_0 of the material adds S_0 : E to W. At F = I both laws
   * have the stress S_0 and the moduli of PlaneElasticity.
   *
   * Stateless, no allocation: some 50 to 200 operations per evaluation.
   */
  class HyperelasticLaw
  {
  public:
    /// Energy [Pa], P [Pa] and A [Pa], A_iJkL at [2i + J][2k + L].
    struct Response
    {
      double               energy = 0.;
      dealii::Tensor<2, 2> stress;
      double               tangent[4][4];
    };

    HyperelasticLaw(const Material &material, PlaneState plane_state);

    /// Energy and P alone.
    Deformation
    evaluate_stress(const dealii::Tensor<2, 2> &F, Response &response) const;

    /// Energy, P and A. With @c inverted, the response is undefined.
    Deformation
    evaluate(const dealii::Tensor<2, 2> &F, Response &response) const;

    /**
     * Derivative of A along @p G, as A by a central difference: exact to
     * rounding for St. Venant-Kirchhoff, whose A is quadratic in F, and to 1e-8
     * relative otherwise.
     */
    Deformation
    tangent_derivative(const dealii::Tensor<2, 2> &F,
                       const dealii::Tensor<2, 2> &G,
                       double (&derivative)[4][4]) const;

    /// Stretch s of the third direction [-].
    Deformation
    out_of_plane_stretch(const dealii::Tensor<2, 2> &F, double &stretch) const;

    /// sigma = P F^T / (s det F) [Pa], in-plane components.
    Deformation
    cauchy_stress(const dealii::Tensor<2, 2>    &F,
                  dealii::SymmetricTensor<2, 2> &stress) const;

    /// The moduli at F = I.
    const PlaneElasticity &
    small_strain() const;

  private:
    /// Derivatives of w(I, j), I = F : F, j = det F, after condensation of s.
    struct Derivatives
    {
      double w, w_I, w_j, w_II, w_Ij, w_jj;
    };

    Deformation
    neo_hookean(double I, double j, Derivatives &derivatives) const;

    /// s in plane stress.
    double
    neo_hookean_stretch(double I, double j) const;

    void
    svk_stress(const dealii::Tensor<2, 2>    &F,
               dealii::SymmetricTensor<2, 2> &S,
               double                        &energy) const;

    bool                          is_neo_hookean;
    PlaneState                    plane_state;
    PlaneElasticity               elasticity;
    double                        mu, bulk_modulus, poissons_ratio;
    dealii::SymmetricTensor<2, 2> initial_stress;
  };
} // namespace NMM

#endif
