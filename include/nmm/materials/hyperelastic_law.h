#ifndef nmm_materials_hyperelastic_law_h
#define nmm_materials_hyperelastic_law_h

#include <nmm/base/assembly.h>
#include <nmm/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  /**
   * A hyperelastic law in the plane. It gives the energy W per reference volume [Pa] as a
   * function of the in-plane displacement gradient H = du/dX [-], with F = I + H and
   * @f[ P = \frac{\partial W}{\partial F}, \qquad
   *     A = \frac{\partial P}{\partial F}. @f]
   * It is given H instead of F, since F has lost the digits of H below 1e-16. A law that computes
   * strains from H (green_strain(), determinant_change(), square_change()) has a stress whose
   * relative error is that of rounding however small H is.
   *
   * The stretch of the third direction is s = 1 in plane strain; in plane stress
   * s follows from dW/ds = 0.
   *
   * An initial stress S_0 of the material adds S_0 : E to W, E being the Green-Lagrange strain. Each
   * law adds it itself: S_0 : E to W, first_stress(H, S_0) to P, and add_geometric_stiffness(S_0, A)
   * to A. At H = 0 a law has the stress S_0 and the moduli of PlaneElasticity.
   *
   * A law has no state and allocates no memory. An evaluation takes some 50 to 200 operations.
   */
  class HyperelasticLaw
  {
  public:
    /// The energy and its derivatives at one deformation.
    struct Response
    {
      /// W per reference volume, with the part of the initial stress [Pa].
      double energy = 0.;
      /// First Piola-Kirchhoff stress P, initial stress included [Pa].
      dealii::Tensor<2, 2> stress;
      /// A = dP/dF, with A_iJkL at [2i + J][2k + L] [Pa]; only evaluate() sets it.
      double tangent[4][4];
    };

    virtual ~HyperelasticLaw() = default;

    /// Computes the energy and P, but not A. If it returns @c inverted, the response is undefined.
    virtual Deformation
    evaluate_stress(const dealii::Tensor<2, 2> &H,
                    Response                   &response) const = 0;

    /// Computes the energy, P and A. If it returns @c inverted, the response is undefined.
    virtual Deformation
    evaluate(const dealii::Tensor<2, 2> &H, Response &response) const = 0;

    /// Computes the stretch s of the third direction in plane stress [-]. It is undefined if
    /// @c inverted is returned.
    virtual Deformation
    plane_stress_stretch(const dealii::Tensor<2, 2> &H,
                         double                     &stretch) const = 0;

    /// Cauchy stress sigma_zz in plane strain, without initial stress [Pa]. Requires det F > 0.
    virtual double
    plane_strain_stress(const dealii::Tensor<2, 2> &H) const = 0;

    /// Whether S = F^{-1} P is linear in the Green-Lagrange strain, with the moduli at rest, which
    /// makes conserving steps cheaper. False is always right.
    virtual bool
    is_linear_in_green_strain() const = 0;

    /**
     * Computes the derivative of A in the direction @p G by a central difference [Pa], in the
     * order of Response::tangent. It is exact to rounding for St. Venant-Kirchhoff's law, whose A
     * is quadratic in H, and has a relative error of 1e-8 otherwise.
     */
    Deformation
    tangent_derivative(const dealii::Tensor<2, 2> &H,
                       const dealii::Tensor<2, 2> &G,
                       double (&derivative)[4][4]) const;

    /// Computes the stretch s of the third direction [-]: 1 in plane strain,
    /// plane_stress_stretch() in plane stress.
    Deformation
    out_of_plane_stretch(const dealii::Tensor<2, 2> &H, double &stretch) const;

    /// Computes the in-plane Cauchy stress sigma = P F^T / (s det F), initial stress included [Pa].
    Deformation
    cauchy_stress(const dealii::Tensor<2, 2>    &H,
                  dealii::SymmetricTensor<2, 2> &stress) const;

    /// The elastic constants at H = 0.
    const PlaneElasticity &
    small_strain() const
    {
      return elasticity;
    }

  protected:
    /// Copies the constants below from @p material.
    HyperelasticLaw(const Material &material, PlaneState plane_state);

    /// Whether the third direction is free of stress or of strain.
    PlaneState plane_state;
    /// The elastic constants at H = 0 [Pa].
    PlaneElasticity elasticity;
    /// nu [-].
    double poissons_ratio;
    /// S_0, in-plane components, tension positive [Pa].
    dealii::SymmetricTensor<2, 2> initial_stress;
  };


  /// @name Parts that laws share
  /// @{

  /// The deformation gradient F = I + H [-].
  inline dealii::Tensor<2, 2>
  deformation_gradient(dealii::Tensor<2, 2> H)
  {
    H[0][0] += 1.;
    H[1][1] += 1.;
    return H;
  }


  /// The first Piola-Kirchhoff stress P = F S [Pa] of the second one @p S [Pa].
  inline dealii::Tensor<2, 2>
  first_stress(const dealii::Tensor<2, 2>          &H,
               const dealii::SymmetricTensor<2, 2> &S)
  {
    const dealii::Tensor<2, 2> F = deformation_gradient(H);
    dealii::Tensor<2, 2>       P;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int J = 0; J < 2; ++J)
        P[i][J] = F[i][0] * S[0][J] + F[i][1] * S[1][J];
    return P;
  }


  /// Adds the derivative of F S with respect to F at constant S, delta_ik S_JL [Pa], to A_iJkL at
  /// [2i + J][2k + L].
  inline void
  add_geometric_stiffness(const dealii::SymmetricTensor<2, 2> &S,
                          double (&A)[4][4])
  {
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int J = 0; J < 2; ++J)
        for (unsigned int L = 0; L < 2; ++L)
          A[2 * i + J][2 * i + L] += S[J][L];
  }


  /// The Green-Lagrange strain E = (F^T F - I) / 2 = (H + H^T + H^T H) / 2 [-].
  inline dealii::SymmetricTensor<2, 2>
  green_strain(const dealii::Tensor<2, 2> &H)
  {
    dealii::SymmetricTensor<2, 2> E;
    E[0][0] = H[0][0] + 0.5 * (H[0][0] * H[0][0] + H[1][0] * H[1][0]);
    E[1][1] = H[1][1] + 0.5 * (H[0][1] * H[0][1] + H[1][1] * H[1][1]);
    E[0][1] = 0.5 * (H[0][1] + H[1][0] + H[0][0] * H[0][1] + H[1][0] * H[1][1]);
    return E;
  }


  /// det F - 1 [-].
  inline double
  determinant_change(const dealii::Tensor<2, 2> &H)
  {
    return dealii::trace(H) + dealii::determinant(H);
  }


  /// F : F - 2 [-].
  inline double
  square_change(const dealii::Tensor<2, 2> &H)
  {
    return 2. * dealii::trace(H) + H.norm_square();
  }
  /// @}
} // namespace NMM

#endif
