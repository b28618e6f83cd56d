#ifndef nmm_source_mechanics_boundary_terms_h
#define nmm_source_mechanics_boundary_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/disk_cover.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <mechanics/curve_conditions.h>
#include <mechanics/local_system.h>
#include <mechanics/trace_constant.h>
#include <optional>
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

      /// Terms of the functions F_j of a disk cover on an edge of its circle. Unknowns are those of
      /// an element, followed by those of its neighbour; v is a displacement of these.
      struct DiskEdge
      {
        /// Nitsche's bilinear form of F_j and v.
        std::vector<dealii::Vector<double>> couplings;
        /// Integrals of sigma(F_j) n . v on the inside.
        std::vector<dealii::Vector<double>> works;
        /// Nitsche's bilinear form of F_j and F_k.
        dealii::FullMatrix<double> matrix;
        /// Integrals of sigma(F_j) n . F_k.
        dealii::FullMatrix<double> work_matrix;
      };

      /**
       * Compute the terms of a tied edge of @p element; returns false if the edge is not on the
       * circle of @p disk. With n from the inside (1) to the outside (2) of the circle and
       * w_1 + w_2 = 1, the terms of a tie and the first integral of DiskCover give
       * @f[ B_j(v) = \int \sigma(F_j)n\cdot(w_2v_1+w_1v_2) - \{\sigma(v)\}n\cdot F_j
           + \gamma F_j\cdot(v_1-v_2)\,ds, @f]
       * @f[ C_{jk} = \int (1-2w_1)\,\sigma(F_j)n\cdot F_k + \gamma F_j\cdot F_k\,ds. @f]
       */
      bool
      compute_disk_edge(unsigned int       element,
                        const ElementEdge &edge,
                        const DiskCover   &disk,
                        DiskEdge          &result);

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

      /// Averages and penalty of a tie.
      struct TieWeights
      {
        /// Weights of the stress of the element and of its neighbour [-].
        double share[2];
        /// Penalty [Pa/m].
        double penalty;
      };

      /// The weights of a tied edge; none if neither element has an area, so that there is nothing
      /// to tie.
      std::optional<TieWeights>
      tie_weights(unsigned int element, const ElementEdge &edge);

      /// Append the functionals of an element: its displacement times @p sign to the jump,
      /// its traction times @p share to the flux.
      void
      append(unsigned int                element,
             const dealii::Point<2>     &xi,
             const dealii::Tensor<1, 2> &normal,
             double                      sign,
             double                      share,
             PointFunctionals           &functionals) const;

      /// Replace the functionals by those of both elements of a tied edge at the point @p x [m].
      /// The jump is the displacement of @p element minus that of its neighbour.
      void
      set_pair(unsigned int                element,
               const ElementEdge          &edge,
               const dealii::Point<2>     &x,
               const dealii::Tensor<1, 2> &normal,
               const TieWeights           &weights,
               PointFunctionals           &functionals) const;

      /// The functions F_j of a disk and their tractions sigma(F_j) n at a point of its circle.
      struct DiskPoint
      {
        std::vector<dealii::Tensor<1, 2>> displacements, tractions;
      };

      /// Add the terms of compute_disk_edge() at a point. @p inside is 0 if the element is inside of
      /// the circle, and 1 if its neighbour is.
      void
      add_disk_point(const PointFunctionals &functionals,
                     const DiskPoint        &point,
                     unsigned int            inside,
                     const TieWeights       &weights,
                     double                  weight,
                     DiskEdge               &result) const;

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
