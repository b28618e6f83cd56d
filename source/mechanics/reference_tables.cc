#include <nmm/base/exceptions.h>

#include <mechanics/floating_blocks.h>
#include <mechanics/reference_tables.h>
#include <mechanics/trace_constant.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// The mesh of @p covers, once it is known to be fit for @p problem.
      const ManifoldMesh &
      checked_mesh(const CoverSystem &covers, const ElasticityProblem &problem)
      {
        const ManifoldMesh &mesh = covers.manifold_mesh();
        AssertThrow(mesh.exchange() == nullptr,
                    InputError("a distributed mathematical mesh is for linear "
                               "static problems only",
                               "a nonlinear analysis",
                               "use make_regular_mesh()"));
        problem.check(mesh.physical_mesh());
        return mesh;
      }
    } // namespace


    ReferenceTables::ReferenceTables(
      const CoverSystem                       &covers,
      const QuadratureCollection              &quadrature,
      const dealii::AffineConstraints<double> &constraints,
      const ElasticityProblem                 &problem,
      const bool                               may_float)
      : covers(&covers)
      , constraints(&constraints)
      , problem(&problem)
      , n_per_cell(
          covers.manifold_mesh().mathematical_mesh().n_covers_per_cell())
      , curve_conditions(checked_mesh(covers, problem), problem)
      , points(covers, problem)
      , tables(covers, quadrature)
      , dead_loads(covers, quadrature, problem, curve_conditions)
      , assembler(covers, constraints)
    {
      if (!may_float)
        check_no_block_floats(covers, problem, curve_conditions, points);
      TraceConstants trace_constants(covers,
                                     quadrature,
                                     constraints,
                                     curve_conditions);
      edges = std::make_unique<EdgeTables>(covers,
                                           problem,
                                           curve_conditions,
                                           trace_constants);
      for (const EdgeTables::Site &tie : edges->ties)
        assembler.couple({covers_of_tie(tie).data(), 2 * n_per_cell});
      assembler.ignore_inhomogeneities();
    }
  } // namespace internal
} // namespace NMM
