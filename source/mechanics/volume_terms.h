#ifndef nmm_source_mechanics_volume_terms_h
#define nmm_source_mechanics_volume_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <mechanics/local_system.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Integrals of weight functions over an element, which is the reference cell or a part of it.
    struct ReferenceIntegrals
    {
      static constexpr unsigned int n_max = WeightFunctions::max_per_cell;

      ReferenceIntegrals() = default;

      /// Compute the integrals by a rule; @p degree is that of the weight functions.
      ReferenceIntegrals(const dealii::Quadrature<2> &rule,
                         unsigned int                 degree);

      /// Integrals of dw_i/dxi_a dw_j/dxi_b for j >= i, at [i][j][a][b].
      double gradient_products[n_max][n_max][2][2] = {};
      /// Integrals of dw_i/dxi_a.
      double gradients[n_max][2] = {};
    };


    /// Add the stiffness (7) of an element in a cell with the Jacobian @p jacobian [m] to
    /// @p system, which must be zero before.
    void
    add_linear_stiffness(const ReferenceIntegrals   &integrals,
                         const dealii::Tensor<2, 2> &jacobian,
                         const PlaneElasticity      &elasticity,
                         LocalSystem                &system);


    /**
     * The terms of stiffness (7) and initial stress (9) of an element in small displacements, at
     * rest.
     *
     * With the integrals of products of reference gradients
     * S_ij^ab = sum_q w_q g_i^a g_j^b, which all whole elements share, the
     * stiffness follows from the Jacobian J of the cell alone:
     * A_ij^kl = det J (J^-T S_ij J^-1)^kl,
     * K_ij^kl = lambda A_ij^kl + mu (A_ij^lk + delta_kl tr A_ij).
     * This takes about 500 multiplications per element, and no loop over points.
     */
    class VolumeTerms
    {
    public:
      VolumeTerms(const CoverSystem          &covers,
                  const QuadratureCollection &quadrature,
                  const ElasticityProblem    &problem);

      void
      add(unsigned int element, LocalSystem &system) const;

    private:
      const CoverSystem          *covers;
      const QuadratureCollection *quadrature;
      unsigned int                degree, n_per_cell;
      bool                        has_whole_integrals;
      ReferenceIntegrals          whole_integrals;

      std::vector<PlaneElasticity>               region_to_elasticity;
      std::vector<dealii::SymmetricTensor<2, 2>> region_to_initial_stress;
    };
  } // namespace internal
} // namespace NMM

#endif
