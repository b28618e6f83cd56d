#ifndef nmm_source_mechanics_edge_tables_h
#define nmm_source_mechanics_edge_tables_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <mechanics/curve_conditions.h>
#include <mechanics/local_system.h>
#include <mechanics/trace_constant.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * What the nonlinear analyses need at the quadrature points of edges, in the
     * reference configuration, made once: points of displacement conditions and
     * of ties (*weak points*) and of follower pressure.
     *
     * Penalties and the shares of averages are those of EdgeTerms.
     */
    class EdgeTables
    {
    public:
      EdgeTables(const CoverSystem       &covers,
                 const ElasticityProblem &problem,
                 const CurveConditions   &conditions,
                 TraceConstants          &trace_constants);

      /// One side of a weak point: the element's share of the mean stress.
      struct Side
      {
        unsigned int region;
        double       share;
        /// dw_i/dX_J [1/m]
        double gradients[WeightFunctions::max_per_cell][2];
      };

      /// A point of a displacement condition (one side) or of a tie (two).
      struct WeakPoint
      {
        /// Index into boundary_conditions, or invalid_index for a tie.
        unsigned int condition;
        unsigned int n_sides;
        /// [m]
        double weight;
        /// Times the jump: [Pa / m]
        double penalty;
        /// Lambda of TraceConstants, of a tie the larger one [1/m].
        double               trace_constant;
        dealii::Tensor<1, 2> normal;
        /// B: which components are held.
        dealii::SymmetricTensor<2, 2> projection;
        /// B g [m] at load factor 1.
        dealii::Tensor<1, 2> prescribed;
        Side                 sides[2];
        /// Jump of the displacement: sum over the covers of all sides, one side
        /// after the other.
        double jump[LocalSystem::max_covers];
      };

      struct FollowerPoint
      {
        unsigned int condition;
        /// Pressure times weight [Pa m] at load factor 1.
        double weighted_pressure;
        /// Unit tangent of the reference edge, the element on its left: the
        /// normal turned by 90 degrees.
        dealii::Tensor<1, 2> tangent;
        /// w_i, and dw_i/ds along the tangent [1/m].
        double values[WeightFunctions::max_per_cell];
        double tangential[WeightFunctions::max_per_cell];
      };

      /// Points of an element, or of a pair of elements that are tied.
      struct Site
      {
        unsigned int element;
        /// invalid_index: no tie.
        unsigned int neighbor;
        unsigned int first_point, last_point;
      };

      /// Displacement conditions, by ascending element; then ties, likewise.
      std::vector<Site>          conditions, ties, followers;
      std::vector<WeakPoint>     weak_points;
      std::vector<FollowerPoint> follower_points;

    private:
      void
      add_conditions(unsigned int           element,
                     const CurveConditions &curve_conditions);

      void
      add_tie(unsigned int element, const ElementEdge &edge);

      void
      add_follower(unsigned int    condition,
                   unsigned int    element,
                   const EdgeRule &rule);

      void
      add_displacement(unsigned int    condition,
                       unsigned int    element,
                       const EdgeRule &rule);

      /// Fill a side and its part of the jump.
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


    /**
     * Loads that keep direction and size, as forces on covers, one list per
     * load: boundary conditions in their order, then gravity, the body force and
     * point forces. A load that a problem does not have has an empty list.
     */
    class DeadLoads
    {
    public:
      DeadLoads(const CoverSystem          &covers,
                const QuadratureCollection &quadrature,
                const ElasticityProblem    &problem,
                const CurveConditions      &conditions);

      struct Load
      {
        std::vector<unsigned int> covers;
        /// Two per cover [N / m thickness].
        std::vector<double> forces;
      };

      std::vector<Load> boundary_conditions, point_forces;
      Load              gravity, body_force;

      /// Call action(load) for all loads: boundary conditions, point forces, gravity and
      /// the body force.
      template <typename Action>
      void
      for_each_load(const Action &action) const
      {
        for (const Load &load : boundary_conditions)
          action(load);
        for (const Load &load : point_forces)
          action(load);
        action(gravity);
        action(body_force);
      }

      /// Call action(cover, force) for the forces of all loads.
      template <typename Action>
      void
      for_each_force(const Action &action) const
      {
        for_each_load([&](const Load &load) {
          for (unsigned int i = 0; i < load.covers.size(); ++i)
          {
            dealii::Tensor<1, 2> force;
            force[0] = load.forces[2 * i];
            force[1] = load.forces[2 * i + 1];
            action(load.covers[i], force);
          }
        });
      }

    private:
      class Collector;

      void
      add_volume_loads(const QuadratureCollection &quadrature);

      void
      add_tractions(const CurveConditions &conditions);

      void
      add_point_forces();

      const CoverSystem       *covers;
      const ElasticityProblem *problem;
      unsigned int             degree, n_per_cell;
    };
  } // namespace internal
} // namespace NMM

#endif
