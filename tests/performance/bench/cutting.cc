// Cutting, covers and quadrature of a mesh with many joints against what deal.II itself
// needs for the mesh.

#include <deal.II/fe/fe_simplex_p.h>

#include "staged_model.h"
#include <cmath>
#include <support/random_scenes.h>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      /// The unit square with joints of a tenth of its side, anywhere in it.
      Geometry
      jointed_square(const unsigned int n_joints)
      {
        Geometry        geometry = Testing::make_box(1., 1.);
        Testing::Random random(7);
        for (unsigned int j = 0; j < n_joints; ++j)
        {
          const Point<2>     middle(random.uniform(0.06, 0.94),
                                random.uniform(0.06, 0.94));
          const double       angle = random.uniform(0., dealii::numbers::PI);
          const Tensor<1, 2> half =
            0.05 * Tensor<1, 2>({std::cos(angle), std::sin(angle)});
          geometry.add_polyline({middle - half, middle + half},
                                "joint " + std::to_string(j),
                                CurveRole::joint);
        }
        return geometry;
      }


      GradedMeshParameters
      mesh_of(const unsigned int n_cells)
      {
        GradedMeshParameters mesh;
        mesh.cell_size = std::sqrt(4. / (std::sqrt(3.) * n_cells));
        mesh.rotation  = 7.;
        return mesh;
      }


      /// deal.II's triangulation and dofs of the same triangles.
      Row
      run_deal_ii(const MeshPart &part, const unsigned int n_joints)
      {
        Row row;
        row.name     = "cut mesh " + std::to_string(n_joints) + " joints";
        row.method   = "Triangulation and DoFHandler (deal.II)";
        row.degree   = 2;
        row.elements = part.cells.size();
        std::vector<dealii::CellData<2>> cells;
        for (const auto &vertices : part.cells)
        {
          cells.emplace_back(3);
          cells.back().vertices.assign(vertices.begin(), vertices.end());
        }
        const double             before = allocated_memory();
        Stopwatch                watch;
        dealii::Triangulation<2> triangulation;
        triangulation.create_triangulation(part.vertices,
                                           cells,
                                           dealii::SubCellData());
        row.mesh = watch.lap();
        dealii::DoFHandler<2> dof_handler(triangulation);
        dof_handler.distribute_dofs(dealii::FE_SimplexP<2>(2));
        row.covers      = watch.lap();
        row.total       = watch.total();
        row.live_memory = allocated_memory() - before;
        row.unknowns    = 2. * dof_handler.n_dofs();
        return row;
      }


      Row
      run(const PhysicalMesh     &physical_mesh,
          const MathematicalMesh &mesh,
          const unsigned int      n_joints)
      {
        Row row;
        row.name   = "cut mesh " + std::to_string(n_joints) + " joints";
        row.method = "cutting; covers; quadrature (manifold)";
        row.degree = 2;
        const double       before = allocated_memory();
        Stopwatch          watch;
        const ManifoldMesh manifold_mesh(mesh, physical_mesh);
        row.cutting = watch.lap();
        CoverSystem       covers(manifold_mesh, MPI_COMM_SELF);
        const Aggregation aggregation = aggregate(covers);
        const auto constraints = make_constraints(covers, aggregation, 2);
        row.covers             = watch.lap();
        const QuadratureCollection quadrature(manifold_mesh,
                                              2,
                                              4,
                                              covers.locally_owned_elements());
        // most rules are made when they are asked for
        double area = 0.;
        for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
        {
          const double of_cell = mesh.cell_area(manifold_mesh.cell(e));
          if (manifold_mesh.is_whole(e))
          {
            area += of_cell;
            continue;
          }
          const ElementRule rule = quadrature.rule(e);
          for (unsigned int q = 0; q < rule.size(); ++q)
            area += 2. * of_cell * rule.weight(q);
        }
        row.quadrature = watch.lap();
        row.total      = watch.total();
        AssertThrow(std::abs(area - 1.) < 1e-9, dealii::ExcInternalError());
        row.live_memory  = allocated_memory() - before;
        row.elements     = manifold_mesh.n_elements();
        row.cut_elements = 0.;
        for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
          row.cut_elements += manifold_mesh.is_whole(e) ? 0. : 1.;
        row.unknowns =
          2. * (covers.n_covers() - aggregation.cover_to_root.size());
        AssertThrow(quadrature.n_fallbacks() == 0, dealii::ExcInternalError());
        return row;
      }
    } // namespace


    void
    measure_cutting(Recorder &recorder)
    {
      // as many cells per joint at each size
      const unsigned int n_joints = recorder.size() == Size::full    ? 1000
                                    : recorder.size() == Size::quick ? 100
                                                                     : 2;
      for (const unsigned int n : {n_joints, 0U})
      {
        Stopwatch              watch;
        const PhysicalMesh     physical_mesh(jointed_square(n));
        const double           geometry = watch.lap();
        const MathematicalMesh mesh =
          make_regular_mesh(physical_mesh, mesh_of(1000 * n_joints), 2);
        const double   making = watch.lap();
        const MeshPart part   = make_mesh_part(mesh);
        recorder.record([&]() { return run_deal_ii(part, n); });
        recorder.record([&]() {
          Row row      = run(physical_mesh, mesh, n);
          row.geometry = geometry;
          row.mesh     = making;
          return row;
        });
      }
    }
  } // namespace Bench
} // namespace NMM
