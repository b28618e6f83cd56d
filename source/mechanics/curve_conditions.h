#ifndef nmm_source_mechanics_curve_conditions_h
#define nmm_source_mechanics_curve_conditions_h

#include <nmm/covers/manifold_mesh.h>
#include <nmm/mechanics/elasticity_problem.h>

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

      /// Conditions on the edge, as indices into
      /// ElasticityProblem::boundary_conditions.
      const std::vector<unsigned int> &
      conditions(const ElementEdge &edge) const
      {
        return edge.curve_set == invalid_index
                 ? none
                 : curve_set_to_conditions[edge.curve_set];
      }

      /// Does a displacement condition hold on the edge?
      bool
      has_displacement(const ElementEdge &edge) const
      {
        return edge.curve_set != invalid_index &&
               curve_set_to_displacement[edge.curve_set];
      }

      /// Does Nitsche's method act on the edge?
      bool
      is_weakly_held(const unsigned int element, const ElementEdge &edge) const
      {
        return has_displacement(edge) || is_tied(element, edge);
      }

    private:
      void
      add_curve_set(unsigned int             index,
                    const ManifoldMesh      &mesh,
                    const ElasticityProblem &problem);

      std::vector<unsigned int>              none;
      std::vector<std::vector<unsigned int>> curve_to_conditions;
      std::vector<bool> known, curve_set_to_tied, curve_set_to_displacement;
      std::vector<std::vector<unsigned int>> curve_set_to_conditions;
    };
  } // namespace internal
} // namespace NMM

#endif
