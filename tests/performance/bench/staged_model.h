#ifndef nmm_tests_performance_bench_staged_model_h
#define nmm_tests_performance_bench_staged_model_h

#include <nmm/contact/surface/surface.h>
#include <nmm/covers/graded_mesh.h>

#include "measure.h"
#include <mechanics/finite_model.h>

namespace NMM
{
  namespace Bench
  {
    using namespace Test;

    /// From the curves to the quadrature, each stage timed into a row.
    class StagedModel
    {
    public:
      struct Options
      {
        unsigned int  degree        = 2;
        Stabilization stabilization = Stabilization::aggregation;
        MPI_Comm      communicator  = MPI_COMM_WORLD;
        /// Of whole and cut elements; 0: what a linear problem needs, 2(p-1) and 2p.
        unsigned int degree_whole = 0, degree_cut = 0;
        /// Make a surface with these bodies beside the solid.
        bool                       has_contact = false;
        std::vector<RigidObstacle> obstacles;
      };

      StagedModel(Geometry                    geometry,
                  const GradedMeshParameters &mesh_parameters,
                  const Options              &options,
                  Row                        &row);

      /// The linear problem: assembly and solution; unknowns and non-zeros of the row, too.
      void
      solve(const LinearSolverParameters &parameters, Row &row);

      /// What the last stage ends.
      double
      lap();

      /// From the curves to the last lap.
      double
      total() const;

      /// Displacement at a point [m] that may be on the boundary: looked for a little towards
      /// @p inside. The same on all ranks.
      Tensor<1, 2>
      displacement(const DisplacementField &field,
                   const Point<2>          &x,
                   const Point<2>          &inside) const;

    private:
      /// Elements, unknowns, and the memory of a rank; @p memory: before [MB].
      void
      count(double memory, Row &row) const;

      Stopwatch watch;

    public:
      std::unique_ptr<PhysicalMesh>         physical_mesh;
      std::unique_ptr<MathematicalMesh>     mathematical_mesh;
      std::unique_ptr<ManifoldMesh>         manifold_mesh;
      std::unique_ptr<CoverSystem>          covers;
      std::unique_ptr<ContactSurface>       surface;
      Aggregation                           aggregation;
      dealii::AffineConstraints<double>     constraints;
      std::unique_ptr<GhostPenalty>         ghost_penalty;
      std::unique_ptr<QuadratureCollection> quadrature;
      ElasticityProblem                     problem;
      std::unique_ptr<StaticElasticity>     elasticity;
    };


    /// The unit square with joints of a tenth of its side, anywhere in it.
    Geometry
    jointed_square(unsigned int n_joints);

    /// "none", "aggregation", "ghost penalty".
    std::string
    name(Stabilization stabilization);

    /// 15 digits each, separated by spaces.
    std::string
    to_text(const std::vector<double> &numbers);
  } // namespace Bench
} // namespace NMM

#endif
