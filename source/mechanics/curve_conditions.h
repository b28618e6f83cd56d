#ifndef nmm_source_mechanics_curve_conditions_h
#define nmm_source_mechanics_curve_conditions_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <map>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The boundary conditions that hold on an edge of a manifold element, or whether both sides
     * of the edge are tied (interface, closed joint). They are determined once for each set of
     * coinciding curve pieces. Where curves coincide, a boundary takes precedence over an open
     * joint, and an open joint over a tie.
     *
     * A condition holds on the face of the domain whose boundary has its name
     * (PhysicalMesh::is_face_of()). Where two domains share an edge, this is the face of only one
     * of the two elements. A pressure on an open joint holds on both of its faces.
     * All other classes use this one to decide which conditions hold.
     */
    class CurveConditions
    {
    public:
      CurveConditions(const ManifoldMesh      &mesh,
                      const ElasticityProblem &problem);

      /// Whether the elements on both sides of the edge are tied. An edge with
      /// the same element on both sides (at the end of a crack) is not tied.
      bool
      is_tied(const unsigned int element, const ElementEdge &edge) const
      {
        return edge.curve_set != invalid_index &&
               edge.neighbor != invalid_index && edge.neighbor != element &&
               curve_set_to_tied[edge.curve_set];
      }

      /// Conditions on the element's side of the edge, as indices into
      /// ElasticityProblem::boundary_conditions.
      const std::vector<unsigned int> &
      conditions(const unsigned int element, const ElementEdge &edge) const
      {
        return face(element, edge).conditions;
      }

      /// Whether a displacement condition holds on the element's side of the edge.
      bool
      has_displacement(const unsigned int element,
                       const ElementEdge &edge) const
      {
        return face(element, edge).has_displacement;
      }

      /// Whether the edge has terms of Nitsche's method, by a displacement condition or a tie.
      bool
      is_weakly_held(const unsigned int element, const ElementEdge &edge) const
      {
        return has_displacement(element, edge) || is_tied(element, edge);
      }

    private:
      /// The conditions on a region along a set of coinciding curve pieces.
      struct Face
      {
        std::vector<unsigned int> conditions;
        bool                      has_displacement = false;
      };

      const Face &
      face(unsigned int element, const ElementEdge &edge) const;

      /// Determine whether a curve set is tied or has conditions. @p curve_to_conditions are the
      /// indices of the conditions on each curve.
      void
      add_curve_set(
        unsigned int                                  index,
        const std::vector<std::vector<unsigned int>> &curve_to_conditions);

      /// Collect the conditions of those pieces in curve set @p index that bound @p region.
      Face
      make_face(unsigned int             index,
                unsigned int             region,
                const ElasticityProblem &problem,
                const std::vector<std::vector<unsigned int>>
                  &curve_to_conditions) const;

      const ManifoldMesh *mesh;
      std::vector<bool>   known, curve_set_to_tied, curve_set_has_conditions;
      /// For each curve set that has conditions, and each region at it.
      std::map<std::pair<unsigned int, unsigned int>, Face> faces;
      Face                                                  free;
    };


    /// Call action(element, edge) for each tied edge of owned elements. Each edge occurs once,
    /// as an edge of the element with the lower number.
    template <typename Action>
    void
    for_each_tie(const CoverSystem     &covers,
                 const CurveConditions &conditions,
                 const Action          &action)
    {
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
        for (const ElementEdge &edge : covers.manifold_mesh().edges(e))
          if (conditions.is_tied(e, edge) && e < edge.neighbor)
            action(e, edge);
    }
  } // namespace internal
} // namespace NMM

#endif
