#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    namespace
    {
      /// @p n_ulp numbers above @p x.
      double
      moved(double x, const unsigned int n_ulp)
      {
        for (unsigned int i = 0; i < n_ulp; ++i)
          x = std::nextafter(x, 2.);
        return x;
      }
    } // namespace


    const std::string &
    to_string(const Track track)
    {
      static const std::string names[] = {"along mesh lines",
                                          "along diagonals",
                                          "through nodes"};
      return names[static_cast<unsigned int>(track)];
    }


    Coincidence
    joint_on_mesh(const Track         track,
                  const JointState    state,
                  const unsigned int  n_ulp,
                  const Stabilization stabilization)
    {
      constexpr double h = 1. / 8.;
      // a square that fits the mesh
      Geometry geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      const double from = track == Track::along_mesh_lines  ? 0.5
                          : track == Track::along_diagonals ? 0.25
                                                            : 0.375;
      const double to   = track == Track::along_mesh_lines  ? 0.5
                          : track == Track::along_diagonals ? 0.25
                                                            : 0.75;
      // diagonals fall by one cell per cell
      if (track == Track::along_diagonals)
        geometry.add_polyline({{0., moved(1.25, n_ulp)},
                               {1., moved(0.25, n_ulp)}},
                              "joint",
                              CurveRole::joint,
                              state);
      else
        geometry.add_polyline({{-0.25, moved(from - 0.25 * (to - from), n_ulp)},
                               {1.25, moved(to + 0.25 * (to - from), n_ulp)}},
                              "joint",
                              CurveRole::joint,
                              state);
      RegularMeshParameters mesh;
      mesh.cell_size = h;
      mesh.pattern   = MeshPattern::right_angled;
      mesh.offset    = Tensor<1, 2>({-0.5, -0.5});
      Model model(std::move(geometry), mesh, 2, stabilization);

      // data that all rules integrate exactly, so that only the method shows
      model.problem.plane_state         = PlaneState::plane_strain;
      model.problem.materials           = {material("rock", 1000., 0.3)};
      model.problem.body_force          = vector_function([](const Point<2> &) {
        return Tensor<1, 2>({3., -10.});
      });
      using Type                        = BoundaryCondition::Type;
      model.problem.boundary_conditions = {
        condition(Type::displacement, "bottom"),
        condition(Type::displacement, "top"),
        condition(Type::traction,
                  "left",
                  vector_function([](const Point<2> &x) {
                    return Tensor<1, 2>({2. - x[1], 1. + 3. * x[1]});
                  }))};
      model.solve();

      Coincidence result;
      result.n_elements = model.manifold_mesh.n_elements();
      // away from joint and mesh lines, where stresses have two values
      for (unsigned int i = 0; i < 9; ++i)
        for (unsigned int j = 0; j < 9; ++j)
        {
          const Point<2> x(0.0537 + 0.1113 * i, 0.0713 + 0.1071 * j);
          const double   y = track == Track::along_diagonals
                               ? 1.25 - x[0]
                               : from + (to - from) * x[0];
          if (std::abs(x[1] - y) < 1e-3)
            continue;
          result.displacements.push_back(model.displacement(x));
          result.stresses.push_back(model.stress(x));
        }
      return result;
    }


    double
    difference(const Coincidence &a, const Coincidence &b)
    {
      double largest = 0., scale_u = 0., scale_s = 0.;
      for (unsigned int i = 0; i < a.displacements.size(); ++i)
      {
        scale_u = std::max(scale_u, a.displacements[i].norm());
        scale_s = std::max(scale_s, a.stresses[i].norm());
      }
      for (unsigned int i = 0; i < a.displacements.size(); ++i)
        largest =
          std::max({largest,
                    (a.displacements[i] - b.displacements[i]).norm() / scale_u,
                    (a.stresses[i] - b.stresses[i]).norm() / scale_s});
      return largest;
    }


    Network
    random_network(const unsigned int  seed,
                   const unsigned int  n_joints_max,
                   const Stabilization stabilization)
    {
      std::mt19937 generator(seed);
      const auto   number = [&](const unsigned int n) {
        return std::uniform_int_distribution<unsigned int>(0, n - 1)(generator);
      };
      Network result;
      result.seed             = seed;
      const unsigned int n    = 1 + number(n_joints_max);
      constexpr int      grid = 32;
      Geometry           geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      for (unsigned int j = 0; j < n; ++j)
      {
        Point<2> a, b;
        do
        {
          a = Point<2>(number(grid + 1), number(grid + 1)) / grid;
          b = Point<2>(number(grid + 1), number(grid + 1)) / grid;
        } while (a == b);
        geometry.add_polyline(
          {a, b},
          "joint " + std::to_string(j),
          number(4) == 0 ? CurveRole::interface : CurveRole::joint,
          JointState::closed);
      }
      // nodes lie on the grid of the joints' ends
      RegularMeshParameters mesh;
      mesh.cell_size = 1. / 8.;
      mesh.pattern   = MeshPattern::right_angled;
      mesh.offset    = Tensor<1, 2>({-0.5, -0.5});
      Model model(std::move(geometry), mesh, 2, stabilization);
      result.n_regions  = model.physical_mesh.regions().size();
      result.n_elements = model.manifold_mesh.n_elements();

      double area = 0.;
      for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
        area += model.manifold_mesh.area(e);
      result.area_error = std::abs(area - 1.);

      const auto field = make_polynomial_field(seed, 2);
      prescribe(model,
                field,
                material("rock", 1000., 0.3),
                PlaneState::plane_strain,
                {"bottom", "right", "top", "left"},
                {});
      result.notices = model.meshes.notices;
      // it takes longer than all the rest
      Measure what;
      what.condition = false;
      result.solved  = measure(model, *field, "network", stabilization, what);
      return result;
    }
  } // namespace HardCases
} // namespace NMM
