#include <chrono>
#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    namespace
    {
      /// Shortest of five runs [s].
      template <typename Action>
      double
      shortest(const Action &action)
      {
        double best = 1e300;
        for (unsigned int i = 0; i < 5; ++i)
        {
          const auto start = std::chrono::steady_clock::now();
          action();
          best = std::min(best,
                          std::chrono::duration<double>(
                            std::chrono::steady_clock::now() - start)
                            .count());
        }
        return best;
      }


      /// Symmetry lines and a pressure of 1 on the inner circle.
      void
      load_ring(Model &model)
      {
        using Type                        = BoundaryCondition::Type;
        model.problem.materials           = {material("steel", 1000., 0.25)};
        model.problem.boundary_conditions = {
          condition(Type::normal_displacement, "bottom"),
          condition(Type::normal_displacement, "left"),
          condition(Type::pressure, "inner", constant(1.))};
      }


      unsigned int
      cg_iterations(Model &model)
      {
        LinearSolverParameters parameters;
        parameters.type = LinearSolverParameters::Type::iterative;
        return model.solve(parameters).n_iterations;
      }


      /// A polar mesh of straight triangles and the polygon it fills.
      unsigned int
      fitted_ring_iterations(const unsigned int n_r, const unsigned int n_t)
      {
        std::vector<Point<2>>            vertices;
        std::vector<dealii::CellData<2>> cells;
        const auto                       add = [&](const unsigned int a,
                             const unsigned int b,
                             const unsigned int c) {
          dealii::CellData<2> cell(3);
          cell.vertices = {a, b, c};
          cells.push_back(cell);
        };
        for (unsigned int j = 0; j <= n_t; ++j)
          for (unsigned int i = 0; i <= n_r; ++i)
          {
            const double r = 1. + static_cast<double>(i) / n_r,
                         t = dealii::numbers::PI_2 * j / n_t;
            vertices.emplace_back(j == n_t ? 0. : r * std::cos(t),
                                  j == 0 ? 0. : r * std::sin(t));
            if (i == n_r || j == n_t)
              continue;
            const unsigned int v = j * (n_r + 1) + i, up = v + n_r + 1;
            if ((i + j) % 2 == 0)
            {
              add(v, v + 1, up + 1);
              add(v, up + 1, up);
            }
            else
            {
              add(v, v + 1, up);
              add(v + 1, up + 1, up);
            }
          }
        const auto at = [&](const unsigned int i, const unsigned int j) {
          return vertices[j * (n_r + 1) + i];
        };
        Geometry   geometry;
        const auto add_side = [&](const std::string           &name,
                                  const std::vector<Point<2>> &points) {
          Curve curve;
          curve.name = name;
          curve.role = CurveRole::boundary;
          for (unsigned int k = 0; k + 1 < points.size(); ++k)
            curve.pieces.push_back(
              CurvePiece::segment(points[k], points[k + 1]));
          geometry.add(curve);
        };
        std::vector<Point<2>> inner, outer;
        for (unsigned int j = 0; j <= n_t; ++j)
        {
          outer.push_back(at(n_r, j));
          inner.push_back(at(0, n_t - j));
        }
        add_side("bottom", {at(0, 0), at(n_r, 0)});
        add_side("outer", outer);
        add_side("left", {at(n_r, n_t), at(0, n_t)});
        add_side("inner", inner);
        Model model(std::move(geometry), [&](const PhysicalMesh &) {
          dealii::Triangulation<2> triangulation;
          triangulation.create_triangulation(vertices,
                                             cells,
                                             dealii::SubCellData());
          return MathematicalMesh(triangulation, 2);
        });
        load_ring(model);
        return cg_iterations(model);
      }
    } // namespace


    Cost
    cost_on_ring(const double cell_size)
    {
      Cost                        result;
      const RegularMeshParameters mesh =
        mesh_parameters(cell_size, Tensor<1, 2>({0.003, 0.002}), 7.);
      {
        Model model(quarter_ring(1., 2.), mesh, 2);
        load_ring(model);
        result.n_unknowns = 2 * (model.covers.n_covers() -
                                 model.aggregation.cover_to_root.size());

        result.aggregation_seconds = shortest([&]() {
          const Aggregation aggregation = aggregate(model.covers);
          make_constraints(model.covers, aggregation, 2);
        });
        result.assembly_seconds    = shortest([&]() {
          StaticElasticity system(model.covers,
                                  *model.quadrature,
                                  model.constraints,
                                  model.problem);
          system.assemble();
        });
        result.cg_iterations       = cg_iterations(model);
      }
      {
        Model model(quarter_ring(1., 2.),
                    mesh,
                    2,
                    Stabilization::ghost_penalty);
        load_ring(model);
        result.ghost_cg_iterations = cg_iterations(model);
      }
      // as many unknowns: (2 n_r + 1) (2 n_t + 1) nodes, cells as long as wide
      const auto n_r = static_cast<unsigned int>(std::round(
        std::sqrt(result.n_unknowns / 8. / (0.75 * dealii::numbers::PI))));
      const auto n_t =
        static_cast<unsigned int>(std::round(0.75 * dealii::numbers::PI * n_r));
      result.n_fitted_unknowns    = 2 * (2 * n_r + 1) * (2 * n_t + 1);
      result.fitted_cg_iterations = fitted_ring_iterations(n_r, n_t);
      return result;
    }
  } // namespace HardCases
} // namespace NMM
