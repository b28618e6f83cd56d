#ifndef nmm_materials_hyperelastic_law_h
#define nmm_materials_hyperelastic_law_h

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
   * An initial stress S_0 of the material adds S_0 : E to W, E being the Green-Lagrange strain.
   * At F = I a law has the stress S_0 and the moduli of PlaneElasticity.
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

    virtual ~HyperelasticLaw() = default;

    /// Energy and P alone.
    virtual Deformation
    evaluate_stress(const dealii::Tensor<2, 2> &F,
                    Response                   &response) const = 0;

    /// Energy, P and A. With @c inverted, the response is undefined.
    virtual Deformation
    evaluate(const dealii::Tensor<2, 2> &F, Response &response) const = 0;

    /// Stretch s of the third direction in plane stress [-].
    virtual Deformation
    plane_stress_stretch(const dealii::Tensor<2, 2> &F,
                         double                     &stretch) const = 0;

    /// Cauchy stress across the plane in plane strain, without initial stress [Pa].
    virtual double
    plane_strain_stress(const dealii::Tensor<2, 2> &F) const = 0;

    /// Whether S = F^{-1} P is linear in the Green-Lagrange strain, with the moduli at rest.
    virtual bool
    is_linear_in_green_strain() const = 0;

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
    small_strain() const
    {
      return elasticity;
    }

  protected:
    HyperelasticLaw(const Material &material, PlaneState plane_state);

    PlaneState                    plane_state;
    PlaneElasticity               elasticity;
    double                        poissons_ratio;
    dealii::SymmetricTensor<2, 2> initial_stress;
  };


  /// @name Parts that laws share
  /// @{

  /// P = F S.
  inline dealii::Tensor<2, 2>
  first_stress(const dealii::Tensor<2, 2>          &F,
               const dealii::SymmetricTensor<2, 2> &S)
  {
    dealii::Tensor<2, 2> P;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int J = 0; J < 2; ++J)
        P[i][J] = F[i][0] * S[0][J] + F[i][1] * S[1][J];
    return P;
  }


  /// Add d(F S)/dF at constant S, delta_ik S_JL, to A_iJkL at [2i + J][2k + L].
  inline void
  add_geometric_stiffness(const dealii::SymmetricTensor<2, 2> &S,
                          double (&A)[4][4])
  {
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int J = 0; J < 2; ++J)
        for (unsigned int L = 0; L < 2; ++L)
          A[2 * i + J][2 * i + L] += S[J][L];
  }


  /// E = (F^T F - I) / 2.
  inline dealii::SymmetricTensor<2, 2>
  green_strain(const dealii::Tensor<2, 2> &F)
  {
    dealii::SymmetricTensor<2, 2> E;
    E[0][0] = 0.5 * (F[0][0] * F[0][0] + F[1][0] * F[1][0] - 1.);
    E[1][1] = 0.5 * (F[0][1] * F[0][1] + F[1][1] * F[1][1] - 1.);
    E[0][1] = 0.5 * (F[0][0] * F[0][1] + F[1][0] * F[1][1]);
    return E;
  }
  /// @}
} // namespace NMM

#endif
