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
    /// sum over (N, L) of C_MJNL X_NL, C at [2M + J][2N + L].
    inline dealii::Tensor<2, 2>
    multiply(const double (&C)[4][4], const dealii::Tensor<2, 2> &X)
    {
      dealii::Tensor<2, 2> result;
      for (unsigned int M = 0; M < 2; ++M)
        for (unsigned int J = 0; J < 2; ++J)
        {
          const double(&row)[4] = C[2 * M + J];
          result[M][J]          = row[0] * X[0][0] + row[1] * X[0][1] +
                         row[2] * X[1][0] + row[3] * X[1][1];
        }
      return result;
    }


    /**
     * The stress between two states that does exactly the work by which the energy
     * W changes: with F_m = (F_0 + F_1) / 2 and E the Green-Lagrange strain
     * @f[ P = F_m\,\bar S, \qquad \bar S : (E_1 - E_0) = W_1 - W_0, @f]
     * \bar S symmetric, so that P exerts no moment in the middle state.
     *
     * - St. Venant-Kirchhoff: \bar S = S((E_0 + E_1) / 2) (Simo & Tarnow, ZAMP 43
     *   (1992) 757, section 4).
     * - neo-Hookean: the mean of S(E_0 + s (E_1 - E_0)) over s in [0, 1] by
     *   three Gauss points (the average vector field of McLachlan, Quispel &
     *   Robidoux, Phil. Trans. R. Soc. A 357 (1999) 1021), which does the work but for a
     *   share |E_1 - E_0|^6. What is missing is
     *   added along E_1 - E_0, a discrete gradient (Gonzalez, CMAME 190 (2000) 1763,
     *   eq. (24)),
     *   @f[ \frac{W_1 - W_0 - \bar S:\Delta E}{\Delta E:\Delta E}\,\Delta E,
     *   @f]
     *   where |Delta E| is above 0.01; below, it is less than 1e-14 of the work, and
     *   rounding of W would govern the fraction, which with Gonzalez'
     *   stress at the mean of C kept Newton's method from converging in small steps.
     */
    class ConservingLaw
    {
    public:
      ConservingLaw(std::shared_ptr<const HyperelasticLaw> law,
                    const dealii::SymmetricTensor<2, 2>   &initial_stress);

      /**
       * P [Pa] and, if @p with_tangent, A = 2 dP/dF_1, the derivative by F_m at
       * given F_0, at [2i + J][2k + L]. Not symmetric.
       *
       * To S is added what damps in proportion to the stiffness,
       * @f[ S_v = \frac{\beta}{h}\,C : (E_1 - E_0), @f]
       * C being the moduli at rest and @p damping = beta / h [-]. It is a Kelvin-Voigt
       * solid: what moves rigidly is not damped, however far it has turned, no
       * momentum is lost, and @p dissipated is S_v : (E_1 - E_0) >= 0 [J/m^3].
       */
      Deformation
      evaluate(const dealii::Tensor<2, 2> &F_0,
               const dealii::Tensor<2, 2> &F_1,
               bool                        with_tangent,
               double                      damping,
               dealii::Tensor<2, 2>       &P,
               double (&A)[4][4],
               double &dissipated) const;

      /// How S changes with E between two states, each at [2M + J][2N + L].
      struct Secant
      {
        dealii::SymmetricTensor<2, 2> E_0, E_1;
        /// (S_0 + S_1) / 2
        dealii::SymmetricTensor<2, 2> mean_stress;
        /// C with C : (E_1 - E_0) = S_1 - S_0 exactly: the mean of dS/dE over the
        /// way as above, and what is missing along E_1 - E_0.
        double moduli[4][4];
        /// dS/dE at E_1
        double end_moduli[4][4];
      };

      Deformation
      secant(const dealii::Tensor<2, 2> &F_0,
             const dealii::Tensor<2, 2> &F_1,
             Secant                     &result) const;

      /// Derivative of `moduli` : @p X by E_1, at [2M + J] and the components 00,
      /// 11 and 01 (with 10); by difference quotients, 0 for a linear S.
      Deformation
      secant_derivative(const Secant               &secant,
                        const dealii::Tensor<2, 2> &X,
                        double (&derivative)[4][3]) const;

    private:
      Deformation
      secant_moduli(const dealii::SymmetricTensor<2, 2> &E_0,
                    const dealii::SymmetricTensor<2, 2> &E_1,
                    double (&moduli)[4][4]) const;

      /// S and D = dS/dE at [2M + J][2N + L].
      Deformation
      second_stress(const dealii::SymmetricTensor<2, 2> &E,
                    bool                                 with_tangent,
                    dealii::SymmetricTensor<2, 2>       &S,
                    double (&D)[4][4]) const;

      /// S and 2 dS/dE_1 at [2M + J][2N + L].
      Deformation
      discrete_gradient(const dealii::Tensor<2, 2>    &F_0,
                        const dealii::Tensor<2, 2>    &F_1,
                        bool                           with_tangent,
                        dealii::SymmetricTensor<2, 2> &S,
                        double (&D)[4][4]) const;

      std::shared_ptr<const HyperelasticLaw> law;
      PlaneElasticity                        elasticity;
      dealii::SymmetricTensor<2, 2>          initial_stress;
    };


    /**
     * Internal forces of an element between the displacements @p begin and @p end
     * and their derivative by the mean displacement at given @p begin, into
     * @p local. What ConservingLaw::evaluate() dissipates by @p damping is added to
     * @p dissipated [J/m].
     */
    Deformation
    add_conserving_terms(const ConservingLaw       &law,
                         unsigned int               n_per_cell,
                         const ElementTables::View &table,
                         const LocalDisplacement   &begin,
                         const LocalDisplacement   &end,
                         bool                       with_tangent,
                         double                     damping,
                         LocalSystem               &local,
                         double                    &dissipated);


    /**
     * Displacement condition or tie at a point between two states: forces that do
     * exactly the work by which the energy of add_weak_point() changes,
     * @f[ \Pi = \int -\sum_s \text{share}_s\,a_s\cdot S(E_s)N
     *      + \frac{\gamma}{2}|d|^2, \qquad a_s = F_s^T d, @f]
     * but for the work of moving supports. E, a and |d|^2 are quadratic in F and d, so
     * that their change is their derivative in the middle of the step times that of F
     * and d; and they do not notice a rotation of a tied pair. With means (m) of both states,
     * and C : (E_1 - E_0) = S_1 - S_0 (ConservingLaw::Secant), M = C : (a_m (x) N)
     * @f[ r(v) = \int \gamma\,d_m\cdot v - \sum_s \text{share}_s
     *      \left((d_m\otimes S_m N + F_m M):\nabla v
     *      + F_m S_m N\cdot Bv\right) @f]
     * conserves the momenta where the condition's derivative does, as
     * Gonzalez' G-equivariant discrete gradient (J. Nonlinear Sci. 6 (1996)
     * 449), but point by point. Derivative as for add_conserving_terms(). Arguments
     * as for add_weak_point(), Tangent::robust leaves out all of the derivative that is
     * zero with the jumps. What is prescribed, B g, is given for both
     * states; by its change the supports do the @p work that is added to.
     */
    Deformation
    add_conserving_weak_point(
      const EdgeTables::WeakPoint               &point,
      const std::vector<ConservingLaw>          &region_to_law,
      unsigned int                               n_per_cell,
      const std::array<dealii::Tensor<1, 2>, 2> &prescribed,
      double                                     growth,
      const LocalDisplacement                   &begin,
      const LocalDisplacement                   &end,
      Tangent                                    tangent,
      LocalSystem                               &local,
      double                                    &work,
      double                                    &largest_jump);
  } // namespace internal
} // namespace NMM

#endif
