#ifndef nmm_source_mechanics_finite_terms_h
#define nmm_source_mechanics_finite_terms_h

#include <nmm/materials/hyperelastic_law.h>

#include <mechanics/edge_tables.h>
#include <mechanics/element_tables.h>
#include <mechanics/nitsche_terms.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The law of each region of the physical mesh.
    using RegionLaws = std::vector<std::shared_ptr<const HyperelasticLaw>>;


    /// The product C : X, the sum over (N, L) of C_MJNL X_NL, where C_MJNL is stored at
    /// [2M + J][2N + L].
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


    /// Compute the moduli of small strains in the same order [Pa].
    inline void
    hooke_moduli(const PlaneElasticity &c, double (&moduli)[4][4])
    {
      for (unsigned int M = 0; M < 2; ++M)
        for (unsigned int J = 0; J < 2; ++J)
          for (unsigned int N = 0; N < 2; ++N)
            for (unsigned int L = 0; L < 2; ++L)
              moduli[2 * M + J][2 * N + L] =
                (M == J && N == L ? c.lambda : 0.) +
                c.mu *
                  ((M == N && J == L ? 1. : 0.) + (M == L && J == N ? 1. : 0.));
    }


    /// Largest |d| Lambda up to which Tangent::robust is the full derivative [-].
    constexpr double close_jump = 0.1;


    /**
     * Add the internal forces of an element to local.rhs, their derivative to local.matrix, and the
     * strain energy:
     * @f[ r_{ic} = \int P_{cJ}\,\partial_J w_i, \qquad
     *     K_{ic,jd} = \int \partial_J w_i\,A_{cJdL}\,\partial_L w_j @f]
     * @p local must be zero before. @p increment, if not null, is the displacement of the last
     * iteration. The stress in the geometric part of K is then not that of u but the
     * one linearized in the last iteration, S(u) - C : H^T H / 2 with
     * H = grad(increment). This is the mixed integration point Newton method (Magisano,
     * Leonetti & Garcea, CMAME 313 (2017) 986), which saves many
     * iterations for large rotations with small strains.
     */
    Deformation
    add_volume_terms(const HyperelasticLaw     &law,
                     const ElementTables::View &table,
                     const LocalDisplacement   &u,
                     const LocalDisplacement   *increment,
                     LocalSystem               &local);


    /**
     * Compute the fluxes of a displacement condition or tie at a point whose potential is
     * @f[ \Pi = \int -\{P\}:G + \frac{\gamma}{2}|d|^2, \qquad G = d\otimes N, @f]
     * for the jump terms.d. The derivative of Q is the third derivative of the strain energy in the
     * direction G; for Tangent::robust see FiniteElasticity::assemble().
     */
    Deformation
    elastic_fluxes(const RegionLaws        &region_to_law,
                   const LocalDisplacement &u,
                   Tangent                  tangent,
                   NitscheTerms            &terms);


    /// Norm of the moduli A at a weak point divided by that of the undeformed state [-], the
    /// largest ratio of all sides. The norm is the largest sum of absolute values in a row. 1 if
    /// the deformation is not admissible.
    double
    growth_of_moduli(const WeakPoint         &point,
                     const RegionLaws        &region_to_law,
                     unsigned int             n_per_cell,
                     const LocalDisplacement &u);


    /**
     * Add minus the force of follower pressure, where the force is -p cof(F) N per reference
     * length. With the tangent t = F T of the deformed edge, cof(F) N = (t_y, -t_x). So
     * only derivatives along the edge are needed, and the tangent matrix is not
     * symmetric. The pressure of the point is multiplied by @p factor.
     */
    void
    add_follower_point(const EdgeTables::FollowerPoint &point,
                       double                           factor,
                       const LocalDisplacement         &u,
                       LocalSystem                     &local);
  } // namespace internal
} // namespace NMM

#endif
