#ifndef nmm_source_mechanics_boundary_terms_h
#define nmm_source_mechanics_boundary_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <mechanics/curve_conditions.h>
#include <mechanics/local_system.h>
#include <mechanics/trace_constant.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Terms on edges of elements in small displacements: loads and displacement conditions on
     * boundaries, ties across interfaces and closed joints.
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
    class EdgeTerms
    {
    public:
      EdgeTerms(const CoverSystem       &covers,
                const ElasticityProblem &problem,
                const CurveConditions   &conditions,
                TraceConstants          &trace_constants);

      /// Add loads and displacement conditions on the boundary edges of an element.
      void
      add_conditions(unsigned int element, LocalSystem &system);

      /// Add a tie to a system of the covers of @p element, followed by those of
      /// edge.neighbor.
      void
      add_tie(unsigned int       element,
              const ElementEdge &edge,
              LocalSystem       &system);

    private:
      /// Factor of the penalties [-]. Coercivity requires more than 1; a larger value allows for
      /// several aggregated elements whose bounds use the energy of the same root.
      static constexpr double safety = 4.;

      /// The displacement jump and the flux (sigma n) at a point, as linear
      /// functions of the unknowns.
      struct PointFunctionals
      {
        unsigned int n_covers = 0;
        double       jump[LocalSystem::max_covers];
        /// Derivative of the flux: [cover][component of the flux][component of the displacement].
        double flux[LocalSystem::max_covers][2][2];
        /// Flux of the initial stress.
        dealii::Tensor<1, 2> initial_flux;
      };

      /// Append the functionals of an element: its displacement times @p sign to the jump,
      /// its traction times @p share to the flux.
      void
      append(unsigned int                element,
             const dealii::Point<2>     &xi,
             const dealii::Tensor<1, 2> &normal,
             double                      sign,
             double                      share,
             PointFunctionals           &functionals) const;

      /// Add Nitsche's terms at a point, see StaticElasticity.
      static void
      add_nitsche(const PointFunctionals              &functionals,
                  const dealii::SymmetricTensor<2, 2> &projection,
                  double                               penalty,
                  const dealii::Tensor<1, 2>          &prescribed,
                  double                               weight,
                  LocalSystem                         &system);

      void
      add_load(const BoundaryCondition &condition,
               unsigned int             cell,
               const EdgeRule          &rule,
               LocalSystem             &system) const;

      void
      add_displacement(const BoundaryCondition &condition,
                       unsigned int             element,
                       const EdgeRule          &rule,
                       LocalSystem             &system);

      const CoverSystem       *covers;
      const ElasticityProblem *problem;
      const CurveConditions   *conditions;
      TraceConstants          *trace_constants;
      unsigned int             degree, n_per_cell;

      std::vector<PlaneElasticity>               region_to_elasticity;
      std::vector<dealii::SymmetricTensor<2, 2>> region_to_initial_stress;
    };
  } // namespace internal
} // namespace NMM

#endif
