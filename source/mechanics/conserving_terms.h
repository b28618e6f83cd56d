#ifndef nmm_source_mechanics_conserving_terms_h
#define nmm_source_mechanics_conserving_terms_h

#include <nmm/mechanics/hyperelasticity.h>

#include <mechanics/element_tables.h>
#include <mechanics/finite_terms.h>
#include <mechanics/local_system.h>

namespace NMM
{
  namespace internal
  {
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
      ConservingLaw(const Material &material, PlaneState plane_state);

      /// P [Pa] and, if @p with_tangent, A = 2 dP/dF_1, the derivative by F_m at
      /// given F_0, at [2i + J][2k + L]. Not symmetric.
      Deformation
      evaluate(const dealii::Tensor<2, 2> &F_0,
               const dealii::Tensor<2, 2> &F_1,
               bool                        with_tangent,
               dealii::Tensor<2, 2>       &P,
               double (&A)[4][4]) const;

    private:
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

      HyperelasticLaw               law;
      bool                          is_neo_hookean;
      PlaneElasticity               elasticity;
      dealii::SymmetricTensor<2, 2> initial_stress;
    };


    /**
     * Internal forces of an element between the displacements @p begin and @p end
     * and their derivative by the mean displacement at given @p begin, into
     * @p local.
     */
    Deformation
    add_conserving_terms(const ConservingLaw       &law,
                         unsigned int               n_per_cell,
                         const ElementTables::View &table,
                         const LocalDisplacement   &begin,
                         const LocalDisplacement   &end,
                         bool                       with_tangent,
                         LocalSystem               &local);
  } // namespace internal
} // namespace NMM

#endif
