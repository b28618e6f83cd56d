#ifndef nmm_source_mechanics_conserving_terms_h
#define nmm_source_mechanics_conserving_terms_h

#include <nmm/materials/hyperelastic_law.h>

#include <array>
#include <mechanics/element_tables.h>
#include <mechanics/finite_terms.h>
#include <mechanics/local_system.h>
#include <memory>

namespace NMM
{
  namespace internal
  {
    /**
     * The conserving stress between two states 0 and 1, whose work is exactly the change of the
     * strain energy W. With F_m = (F_0 + F_1) / 2 and the Green-Lagrange strain E,
     * @f[ P = F_m\,\bar S, \qquad \bar S : (E_1 - E_0) = W_1 - W_0. @f]
     * \bar S is symmetric, so that P exerts no moment in the middle state.
     *
     * - St. Venant-Kirchhoff: \bar S = S((E_0 + E_1) / 2) (Simo & Tarnow, ZAMP 43
     *   (1992) 757, section 4).
     * - neo-Hookean: the mean of S(E_0 + s (E_1 - E_0)) over s in [0, 1] by
     *   three Gauss points (the average vector field of McLachlan, Quispel &
     *   Robidoux, Phil. Trans. R. Soc. A 357 (1999) 1021). The relative error of its work is
     *   of the order |E_1 - E_0|^6. If |E_1 - E_0| is above 0.01, the missing work is
     *   added along E_1 - E_0 by a discrete gradient (Gonzalez, CMAME 190 (2000) 1763,
     *   eq. (24)),
     *   @f[ \frac{W_1 - W_0 - \bar S:\Delta E}{\Delta E:\Delta E}\,\Delta E.
     *   @f]
     *   For smaller changes the missing work is less than 1e-14 of the work, and
     *   the fraction would be dominated by rounding of W. (With Gonzalez'
     *   stress at the mean of C this rounding prevented convergence in small steps.)
     */
    class ConservingLaw
    {
    public:
      ConservingLaw(std::shared_ptr<const HyperelasticLaw> law,
                    const dealii::SymmetricTensor<2, 2>   &initial_stress);

      /// Stress between two states.
      struct Response
      {
        /// P [Pa].
        dealii::Tensor<2, 2> stress;
        /// A_iJkL at [2i + J][2k + L] [Pa].
        double tangent[4][4];
        /// Energy that damping dissipates [J/m^3].
        double dissipated;
      };

      /**
       * The states are given by their displacement gradients H = F - I. With F, whose diagonal is 1,
       * strains would be rounded by 1e-16, however small they are, and damping multiplies that by
       * beta / h.
       *
       * The tangent is A = 2 dP/dF_1, the derivative with respect to F_m at fixed F_0. It is not
       * symmetric, and computed only if @p with_tangent.
       *
       * Stiffness-proportional damping adds to S the stress
       * @f[ S_v = \frac{\beta}{h}\,C : (E_1 - E_0), @f]
       * C being the moduli of the undeformed state and @p damping = beta / h [-]. This is a
       * Kelvin-Voigt solid: rigid motions are not damped, however large the rotation is, and
       * momenta are conserved. It dissipates S_v : (E_1 - E_0) >= 0.
       */
      Deformation
      evaluate(const dealii::Tensor<2, 2> &H_0,
               const dealii::Tensor<2, 2> &H_1,
               bool                        with_tangent,
               double                      damping,
               Response                   &response) const;

      /// The change of the second Piola-Kirchhoff stress S with E between two states. Moduli
      /// C_MJNL are stored at [2M + J][2N + L].
      struct Secant
      {
        dealii::SymmetricTensor<2, 2> E_0, E_1;
        /// The mean stress (S_0 + S_1) / 2 [Pa].
        dealii::SymmetricTensor<2, 2> mean_stress;
        /// Secant moduli C with C : (E_1 - E_0) = S_1 - S_0 exactly: the mean of dS/dE between
        /// both states, corrected along E_1 - E_0 like the stress of this class [Pa].
        double moduli[4][4];
        /// Tangent moduli dS/dE at E_1 [Pa].
        double end_moduli[4][4];
      };

      /// The secant between two states, given by their displacement gradients.
      Deformation
      secant(const dealii::Tensor<2, 2> &H_0,
             const dealii::Tensor<2, 2> &H_1,
             Secant                     &result) const;

      /// Derivative of (`moduli` : @p X) with respect to E_1, stored at [2M + J][c] for the strain
      /// components c = 00, 11 and 01 (equal to 10). It is computed by central differences, and 0
      /// if S is linear in E.
      Deformation
      secant_derivative(const Secant               &secant,
                        const dealii::Tensor<2, 2> &X,
                        double (&derivative)[4][3]) const;

    private:
      Deformation
      secant_moduli(const dealii::SymmetricTensor<2, 2> &E_0,
                    const dealii::SymmetricTensor<2, 2> &E_1,
                    double (&moduli)[4][4]) const;

      /// Compute S [Pa] and, if @p with_tangent, D = dS/dE, with D_MJNL at [2M + J][2N + L].
      Deformation
      second_stress(const dealii::SymmetricTensor<2, 2> &E,
                    bool                                 with_tangent,
                    dealii::SymmetricTensor<2, 2>       &S,
                    double (&D)[4][4]) const;

      /// Compute the conserving stress of a law that is not linear in E and, if @p with_tangent,
      /// D = 2 dS/dE_1, with D_MJNL at [2M + J][2N + L].
      Deformation
      discrete_gradient(const dealii::Tensor<2, 2>    &H_0,
                        const dealii::Tensor<2, 2>    &H_1,
                        bool                           with_tangent,
                        dealii::SymmetricTensor<2, 2> &S,
                        double (&D)[4][4]) const;

      std::shared_ptr<const HyperelasticLaw> law;
      PlaneElasticity                        elasticity;
      dealii::SymmetricTensor<2, 2>          initial_stress;
    };


    /**
     * Add to @p local the internal forces of an element between the displacements @p begin and
     * @p end and, if it has a matrix, their derivative with respect to the mean displacement at
     * fixed @p begin. The energy that ConservingLaw::evaluate() dissipates because of @p damping is
     * added to local.dissipated.
     */
    Deformation
    add_conserving_terms(const ConservingLaw       &law,
                         const ElementTables::View &table,
                         const LocalDisplacement   &begin,
                         const LocalDisplacement   &end,
                         double                     damping,
                         LocalSystem               &local);


    /**
     * Compute the fluxes of a displacement condition or tie at a point between two states, whose
     * forces do exactly the work by which the energy of elastic_fluxes() changes,
     * @f[ \Pi = \int -\sum_s \text{share}_s\,a_s\cdot S(E_s)N
     *      + \frac{\gamma}{2}|d|^2, \qquad a_s = F_s^T d, @f]
     * except for the work of moving supports. E, a and |d|^2 are quadratic in F and d, so
     * that their change is their derivative in the middle of the step times the change of F
     * and d. They are invariant under a rotation of a tied pair. With means (m) of both states,
     * C : (E_1 - E_0) = S_1 - S_0 (ConservingLaw::Secant) and M = C : (a_m (x) N), the fluxes
     * @f[ t = F_m S_m N, \qquad Q = d_m\otimes S_m N + F_m M @f]
     * conserve momenta wherever the derivative of Pi does, like
     * Gonzalez' G-equivariant discrete gradient (J. Nonlinear Sci. 6 (1996)
     * 449), but at each point separately. The derivatives are those of add_conserving_terms();
     * Tangent::robust omits all of their terms that vanish with the jumps.
     * @p d are the jumps of both states; terms.d becomes their mean.
     */
    Deformation
    conserving_fluxes(const std::vector<ConservingLaw>          &region_to_law,
                      const LocalDisplacement                   &begin,
                      const LocalDisplacement                   &end,
                      const std::array<dealii::Tensor<1, 2>, 2> &d,
                      Tangent                                    tangent,
                      NitscheTerms                              &terms);
  } // namespace internal
} // namespace NMM

#endif
