#ifndef nmm_source_mechanics_linear_terms_h
#define nmm_source_mechanics_linear_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <mechanics/nitsche_terms.h>
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


    /// The law of a region in small displacements: sigma = S_0 + C : epsilon.
    struct LinearRegion
    {
      PlaneElasticity elasticity;
      /// S_0 [Pa].
      dealii::SymmetricTensor<2, 2> initial_stress;
      /// C_MJNL at [2M + J][2N + L] [Pa].
      double moduli[4][4];
    };


    /// The laws of all regions of the physical mesh. The initial stress of inelastic materials is
    /// left to InelasticTerms.
    std::vector<LinearRegion>
    linear_regions(const CoverSystem &covers, const ElasticityProblem &problem);


    /// Compute the fluxes of a displacement condition or tie, whose jump is terms.d, in small
    /// displacements @p u of its covers.
    void
    set_linear_fluxes(const std::vector<LinearRegion> &regions,
                      const LocalDisplacement         &u,
                      NitscheTerms                    &terms);


    /**
     * The forces of elements in the theory of small displacements. Initial stress is a force, and does not
     * change the stiffness, since rotations are neglected: it would otherwise resist or drive the
     * rotation of blocks whose contact is that of the undeformed state.
     *
     * At rest they are the stiffness (7) and the force of initial stress (9).
     * With the integrals of products of reference gradients
     * S_ij^ab = sum_q w_q g_i^a g_j^b, which all whole elements share, the
     * stiffness follows from the Jacobian J of the cell alone:
     * A_ij^kl = det J (J^-T S_ij J^-1)^kl,
     * K_ij^kl = lambda A_ij^kl + mu (A_ij^lk + delta_kl tr A_ij).
     * This takes about 500 multiplications per element, and no loop over points.
     */
    class LinearTerms
    {
    public:
      LinearTerms(const CoverSystem          &covers,
                  const QuadratureCollection &quadrature,
                  const ElasticityProblem    &problem);

      /// The laws of all regions.
      const std::vector<LinearRegion> &
      laws() const
      {
        return regions;
      }

      /// Add the stiffness of an element and its forces at u = 0 to @p system, which must be zero
      /// before.
      void
      add_at_rest(unsigned int element, LocalSystem &system) const;

      /// Add forces and strain energy of the element at the displacements @p u, without matrix.
      void
      add_forces(unsigned int               element,
                 const ElementTables::View &table,
                 const LocalDisplacement   &u,
                 LocalSystem               &system) const;

    private:
      const CoverSystem          *covers;
      const QuadratureCollection *quadrature;
      unsigned int                degree, n_per_cell;
      bool                        has_whole_integrals;
      ReferenceIntegrals          whole_integrals;

      std::vector<LinearRegion> regions;
    };
  } // namespace internal
} // namespace NMM

#endif
