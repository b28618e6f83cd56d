// Cutting, covers and quadrature of a mesh with many joints against what deal.II itself
// needs for the mesh: for displacements on both sides, and for a scalar on both.

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>

#include "staged_model.h"
#include <cmath>
#include <support/random_scenes.h>

namespace NMM
{
  namespace Bench
  {
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


    namespace
    {
      GradedMeshParameters
      mesh_of(const unsigned int n_cells)
      {
        GradedMeshParameters mesh;
        mesh.cell_size = std::sqrt(4. / (std::sqrt(3.) * n_cells));
        mesh.rotation  = 7.;
        return mesh;
      }


      std::string
      name_of(const unsigned int n_joints, const unsigned int n_components)
      {
        return (n_components == 1 ? "scalar cut mesh " : "cut mesh ") +
               std::to_string(n_joints) + " joints";
      }


      /// deal.II's triangulation and dofs of the same triangles.
      Row
      run_deal_ii(const MeshPart    &part,
                  const unsigned int n_joints,
                  const unsigned int n_components)
      {
        Row row;
        row.name     = name_of(n_joints, n_components);
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
        dealii::DoFHandler<2>        dof_handler(triangulation);
        const dealii::FE_SimplexP<2> element(2);
        if (n_components == 1)
          dof_handler.distribute_dofs(element);
        else
          dof_handler.distribute_dofs(
            dealii::FESystem<2>(element, n_components));
        row.covers      = watch.lap();
        row.total       = watch.total();
        row.live_memory = allocated_memory() - before;
        row.unknowns    = dof_handler.n_dofs();
        return row;
      }


      Row
      run(const PhysicalMesh     &physical_mesh,
          const MathematicalMesh &mesh,
          const unsigned int      n_joints,
          const unsigned int      n_components)
      {
        Row row;
        row.name                  = name_of(n_joints, n_components);
        row.method                = "cutting; covers; quadrature (manifold)";
        row.degree                = 2;
        const double       before = allocated_memory();
        Stopwatch          watch;
        const ManifoldMesh manifold_mesh(mesh, physical_mesh);
        row.cutting = watch.lap();
        CoverSystem       covers(manifold_mesh, MPI_COMM_SELF);
        const Aggregation aggregation = aggregate(covers);
        const auto        constraints =
          make_constraints(covers, aggregation, n_components);
        row.covers = watch.lap();
        const QuadratureCollection quadrature(manifold_mesh,
                                              2,
                                              4,
                                              covers.locally_owned_elements());
        // most rules are made when they are asked for
        std::vector<double> sums_of_weights;
        for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
          if (!manifold_mesh.is_whole(e))
          {
            const ElementRule rule = quadrature.rule(e);
            double            sum  = 0.;
            for (unsigned int q = 0; q < rule.size(); ++q)
              sum += rule.weight(q);
            sums_of_weights.push_back(sum);
          }
        row.quadrature = watch.lap();
        row.total      = watch.total();

        double      area = 0.;
        std::size_t cut  = 0;
        for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
          area +=
            mesh.cell_area(manifold_mesh.cell(e)) *
            (manifold_mesh.is_whole(e) ? 1. : 2. * sums_of_weights[cut++]);
        AssertThrow(std::abs(area - 1.) < 1e-9, dealii::ExcInternalError());
        row.elements     = manifold_mesh.n_elements();
        row.cut_elements = sums_of_weights.size();
        sums_of_weights  = std::vector<double>();
        row.live_memory  = allocated_memory() - before;
        row.unknowns     = static_cast<double>(n_components) *
                       (covers.n_covers() - aggregation.cover_to_root.size());
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
        for (const unsigned int n_components : {2U, 1U})
        {
          if (n == 0 && n_components == 1)
            continue;
          recorder.record([&]() { return run_deal_ii(part, n, n_components); });
          recorder.record([&]() {
            Row row      = run(physical_mesh, mesh, n, n_components);
            row.geometry = geometry;
            row.mesh     = making;
            return row;
          });
        }
      }
    }
  } // namespace Bench
} // namespace NMM
