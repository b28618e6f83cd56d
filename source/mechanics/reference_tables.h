#ifndef nmm_source_mechanics_reference_tables_h
#define nmm_source_mechanics_reference_tables_h

#include <linear_algebra/cover_matrix_assembler.h>
#include <mechanics/curve_conditions.h>
#include <mechanics/edge_tables.h>
#include <mechanics/element_tables.h>
#include <mechanics/finite_terms.h>
#include <mechanics/point_terms.h>
#include <memory>

namespace NMM
{
  namespace internal
  {
    /**
     * What FiniteElasticity computes once in the reference configuration: tables at quadrature points of elements and edges, loads, and the
     * assembler of a matrix whose pattern couples elements that are tied.
     */
    struct ReferenceTables
    {
      /// Without @p may_float, each block needs supports.
      /// @throws InputError for a problem that does not fit the mesh, a block that floats, and a
      /// distributed mathematical mesh.
      ReferenceTables(const CoverSystem                       &covers,
                      const QuadratureCollection              &quadrature,
                      const dealii::AffineConstraints<double> &constraints,
                      const ElasticityProblem                 &problem,
                      bool                                     may_float);

      /// The covers of both elements of a tie.
      std::array<unsigned int, LocalSystem::max_covers>
      covers_of_tie(const EdgeTables::Site &tie) const
      {
        return covers_of_pair(*covers, tie.element, tie.neighbor);
      }

      /// Read the displacements of the covers of a site's element, then those of its neighbor.
      void
      gather(const EdgeTables::Site                  &site,
             const std::vector<dealii::Tensor<1, 2>> &from,
             LocalDisplacement                       &u) const
      {
        u.gather(covers->covers(site.element), from);
        if (site.neighbor != invalid_index)
          u.gather(covers->covers(site.neighbor), from, n_per_cell);
      }

      const CoverSystem                       *covers;
      const dealii::AffineConstraints<double> *constraints;
      const ElasticityProblem                 *problem;
      unsigned int                             n_per_cell;
      CurveConditions                          curve_conditions;
      PointTerms                               points;
      ElementTables                            tables;
      std::unique_ptr<EdgeTables>              edges;
      DeadLoads                                dead_loads;
      CoverMatrixAssembler                     assembler;
    };
  } // namespace internal
} // namespace NMM

#endif
