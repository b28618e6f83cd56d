#ifndef nmm_source_mechanics_weak_points_h
#define nmm_source_mechanics_weak_points_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <array>
#include <mechanics/local_system.h>
#include <mechanics/trace_constant.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// A quadrature point, in the reference configuration, of a displacement condition (one side)
    /// or of a tie (two), which Nitsche's method imposes.
    struct WeakPoint
    {
      /// One side: the region of its element, the share of its stress in the mean stress [-], and
      /// gradients of its weight functions.
      struct Side
      {
        unsigned int region;
        double       share;
        /// Gradients dw_i/dX_J [1/m].
        double gradients[WeightFunctions::max_per_cell][2];
      };

      /// Index into boundary_conditions, or invalid_index for a tie.
      unsigned int condition;
      unsigned int n_sides;
      /// Quadrature weight in the reference configuration [m].
      double weight;
      /// Penalty gamma [Pa/m].
      double penalty;
      /// Lambda of TraceConstants; for a tie the larger one of both sides [1/m].
      double               trace_constant;
      dealii::Tensor<1, 2> normal;
      /// The projection B onto the components that are held.
      dealii::SymmetricTensor<2, 2> projection;
      /// Prescribed displacement B g at the load factor 1 [m].
      dealii::Tensor<1, 2> prescribed;
      Side                 sides[2];
      /// Coefficients of the displacements in their jump, for the covers of the first side and
      /// then of the second one [-].
      double jump[LocalSystem::max_covers];
    };


    /**
     * Makes the points at which Nitsche's method imposes displacement conditions and ties, with
     * penalties and averages.
     *
     * The integral of |sigma(u) n|^2 on the edges of an element is bounded by k = C Lambda times
     * the energy of the element, where C is the largest eigenvalue of the elasticity tensor and
     * Lambda is that of TraceConstants. The penalty of a displacement condition is
     * safety * k. A tie between elements 1 and 2 uses the averages
     * {sigma} = w_1 sigma_1 + w_2 sigma_2, w_1 = k_2 / (k_1 + k_2), and the
     * penalty safety * k_1 k_2 / (k_1 + k_2). So the softer or larger side dominates
     * the average, and neither stiffness contrast nor slivers impair the accuracy
     * (Annavarapu, Hautefeuille & Dolbow, Comput. Methods Appl. Mech. Engrg.
     * 225 (2012) 44).
     */
    class WeakPointMaker
    {
    public:
      WeakPointMaker(const CoverSystem       &covers,
                     const ElasticityProblem &problem,
                     TraceConstants          &trace_constants);

      /// Append the points of the displacement condition with the index @p condition on an edge of
      /// @p element with the given rule. None for an element without area, which has no energy:
      /// the conditions of its neighbours suffice.
      void
      append_condition(unsigned int            condition,
                       unsigned int            element,
                       const EdgeRule         &rule,
                       std::vector<WeakPoint> &points) const;

      /// Append the points of a tied edge of @p element with the given rule. The jump is the
      /// displacement of @p element minus that of its neighbour. None if neither element has an
      /// area, so that there is nothing to tie.
      void
      append_tie(unsigned int            element,
                 const ElementEdge      &edge,
                 const EdgeRule         &rule,
                 std::vector<WeakPoint> &points) const;

    private:
      /// Factor of the penalties [-]. Coercivity requires more than 1; a larger value allows for
      /// several aggregated elements whose bounds use the energy of the same root.
      static constexpr double safety = 4.;

      /// The bound k of an element [Pa/m]; infinite for an element without area.
      double
      bound(unsigned int element) const;

      /// Set one side of a point, and its coefficients in the jump.
      void
      set_side(WeakPoint              &point,
               unsigned int            side,
               unsigned int            element,
               const dealii::Point<2> &xi,
               double                  share) const;

      const CoverSystem           *covers;
      const ElasticityProblem     *problem;
      TraceConstants              *trace_constants;
      unsigned int                 degree, n_per_cell;
      std::vector<PlaneElasticity> region_to_elasticity;
    };
  } // namespace internal
} // namespace NMM

#endif
