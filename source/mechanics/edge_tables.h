#ifndef nmm_source_mechanics_edge_tables_h
#define nmm_source_mechanics_edge_tables_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <mechanics/curve_conditions.h>
#include <mechanics/local_system.h>
#include <mechanics/point_terms.h>
#include <mechanics/weak_points.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Tables at the quadrature points of edges in the
     * reference configuration, computed once. Points of displacement conditions and
     * of ties are called *weak points*; the others are those of follower pressure.
     *
     * Penalties and the shares of averages are those of WeakPointMaker.
     */
    class EdgeTables
    {
    public:
      EdgeTables(const CoverSystem       &covers,
                 const ElasticityProblem &problem,
                 const CurveConditions   &conditions,
                 TraceConstants          &trace_constants);

      /// A point of follower pressure, of the boundary condition with the index `condition`.
      struct FollowerPoint
      {
        unsigned int condition;
        /// Pressure times quadrature weight at the load factor 1 [Pa m].
        double weighted_pressure;
        /// Unit tangent of the reference edge: the outward normal rotated by 90 degrees, so that
        /// the element is on its left.
        dealii::Tensor<1, 2> tangent;
        /// Weight functions w_i [-], and their derivatives dw_i/ds along the tangent [1/m].
        double values[WeightFunctions::max_per_cell];
        double tangential[WeightFunctions::max_per_cell];
      };

      /// The range of points of an element, or of a pair of elements that are tied.
      struct Site
      {
        unsigned int element;
        /// The other element of a tie; otherwise invalid_index.
        unsigned int neighbor;
        unsigned int first_point, last_point;
      };

      /// Sites of displacement conditions, ties and follower pressure, each list sorted by element.
      std::vector<Site>      conditions, ties, followers;
      std::vector<WeakPoint> weak_points;
      /// Place of each weak point in the reference configuration [m]; empty unless the initial stress
      /// of a material varies.
      std::vector<dealii::Point<2>> places;
      std::vector<FollowerPoint>    follower_points;

    private:
      void
      add_conditions(unsigned int           element,
                     const CurveConditions &curve_conditions);

      void
      add_tie(unsigned int element, const ElementEdge &edge);

      /// Append the places of the weak points that have been made by @p rule, if they are needed.
      void
      append_places(unsigned int element, const EdgeRule &rule);

      void
      add_follower(unsigned int    condition,
                   unsigned int    element,
                   const EdgeRule &rule);

      const CoverSystem       *covers;
      const ElasticityProblem *problem;
      WeakPointMaker           maker;
      unsigned int             degree, n_per_cell;
    };


    /**
     * Loads that keep direction and size, as forces on covers. There is one list of forces for
     * each boundary condition, each point force, gravity and the body force. The list is empty if
     * the problem does not have the load. Follower pressure is no such load.
     */
    class DeadLoads
    {
    public:
      DeadLoads(const CoverSystem          &covers,
                const QuadratureCollection &quadrature,
                const ElasticityProblem    &problem,
                const CurveConditions      &conditions,
                const PointTerms           &points);

      /// The forces of one load on covers, each of which occurs once.
      struct Load
      {
        std::vector<unsigned int> covers;
        /// The force on each cover, per unit thickness [N/m].
        std::vector<dealii::Tensor<1, 2>> forces;
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

    private:
      class Collector;

      void
      add_volume_loads(const QuadratureCollection &quadrature);

      void
      add_tractions(const CurveConditions &conditions);

      void
      add_point_forces(const std::vector<unsigned int> &elements);

      const CoverSystem       *covers;
      const ElasticityProblem *problem;
      unsigned int             degree, n_per_cell;
    };
  } // namespace internal
} // namespace NMM

#endif
