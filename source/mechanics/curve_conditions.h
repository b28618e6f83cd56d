#ifndef nmm_source_mechanics_curve_conditions_h
#define nmm_source_mechanics_curve_conditions_h

#include <nmm/covers/manifold_mesh.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <map>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * What holds on an edge of a manifold element, worked out once per set of
     * coinciding curve pieces: the conditions on a boundary; or that both sides
     * are tied (interface, closed joint). Where curves coincide, a boundary
     * counts before an open joint before a tie.
     *
     * A condition holds on the face of the domain whose boundary bears its name
     * (PhysicalMesh::is_face_of()): where two domains share a side, on one of
     * the two elements there. A pressure on an open joint holds on both of its faces.
     * This class is the only place that decides it.
     */
    class CurveConditions
    {
    public:
      CurveConditions(const ManifoldMesh      &mesh,
                      const ElasticityProblem &problem);

      /// Are the elements on both sides of the edge held together? An edge with
      /// the same element on both sides (the end of a crack) needs nothing.
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

      /// Does a displacement condition hold on the element's side of the edge?
      bool
      has_displacement(const unsigned int element,
                       const ElementEdge &edge) const
      {
        return face(element, edge).has_displacement;
      }

      /// Does Nitsche's method act on the edge?
      bool
      is_weakly_held(const unsigned int element, const ElementEdge &edge) const
      {
        return has_displacement(element, edge) || is_tied(element, edge);
      }

    private:
      /// What a region feels along a set of coinciding curve pieces.
      struct Face
      {
        std::vector<unsigned int> conditions;
        bool                      has_displacement = false;
      };

      const Face &
      face(unsigned int element, const ElementEdge &edge) const;

      /// @p curve_to_conditions: indices of conditions by their curves.
      void
      add_curve_set(
        unsigned int                                  index,
        const std::vector<std::vector<unsigned int>> &curve_to_conditions);

      /// Of the pieces in curve set @p index those that bound @p region.
      Face
      make_face(unsigned int             index,
                unsigned int             region,
                const ElasticityProblem &problem,
                const std::vector<std::vector<unsigned int>>
                  &curve_to_conditions) const;

      const ManifoldMesh *mesh;
      std::vector<bool>   known, curve_set_to_tied, curve_set_has_conditions;
      /// By curve set and region, of sets that have conditions.
      std::map<std::pair<unsigned int, unsigned int>, Face> faces;
      Face                                                  free;
    };
  } // namespace internal
} // namespace NMM

#endif
