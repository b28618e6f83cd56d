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
    /// Integrals of weight functions over the reference cell or the part of it that an
    /// element is.
    struct ReferenceIntegrals
    {
      static constexpr unsigned int n_max = WeightFunctions::max_per_cell;

      ReferenceIntegrals() = default;

      /// By a rule; @p degree of the weight functions.
      ReferenceIntegrals(const dealii::Quadrature<2> &rule,
                         unsigned int                 degree);

      /// of dw_i/dxi_a dw_j/dxi_b, j >= i
      double gradient_products[n_max][n_max][2][2] = {};
      /// of dw_i/dxi_a
      double gradients[n_max][2] = {};
      /// of w_i
      double values[n_max] = {};
    };


    /// Add the stiffness (7) of an element in a cell of this Jacobian [m] to an empty
    /// @p system.
    void
    add_linear_stiffness(const ReferenceIntegrals   &integrals,
                         const dealii::Tensor<2, 2> &jacobian,
                         const PlaneElasticity      &elasticity,
                         LocalSystem                &system);


    /**
     * Stiffness (7), initial stress (9) and body force (10) of an element.
     *
     * With the integrals of products of reference gradients
     * S_ij^ab = sum_q w_q g_i^a g_j^b, which all whole elements share, the
     * stiffness follows from the cell's Jacobian alone:
     * A_ij^kl = det J (J^-T S_ij J^-1)^kl,
     * K_ij^kl = lambda A_ij^kl + mu (A_ij^lk + delta_kl tr A_ij),
     * about 500 multiplications per element instead of a loop over points.
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
      void
      add_body_force_function(unsigned int element, LocalSystem &system) const;

      const CoverSystem          *covers;
      const QuadratureCollection *quadrature;
      const ElasticityProblem    *problem;
      unsigned int                degree, n_per_cell;
      bool                        has_whole_integrals;
      ReferenceIntegrals          whole_integrals;

      std::vector<PlaneElasticity>               region_to_elasticity;
      std::vector<dealii::SymmetricTensor<2, 2>> region_to_initial_stress;
      std::vector<dealii::Tensor<1, 2>>          region_to_weight;
    };
  } // namespace internal
} // namespace NMM

#endif
