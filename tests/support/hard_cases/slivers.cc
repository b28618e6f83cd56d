#include <cstdio>
#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    const std::string &
    to_string(const Side side)
    {
      static const std::string names[] = {"free", "loaded", "fixed"};
      return names[static_cast<unsigned int>(side)];
    }


    const std::string &
    to_string(const Stabilization stabilization)
    {
      static const std::string names[] = {"none",
                                          "aggregation",
                                          "ghost penalty"};
      return names[static_cast<unsigned int>(stabilization)];
    }


    Result
    sliver(const double        epsilon,
           const double        angle,
           const Side          side,
           const Stabilization stabilization,
           const unsigned int  n,
           const unsigned int  polynomial_degree,
           const Measure      &what)
    {
      // h is a power of two and the square's corner a node, so that mesh lines
      // and sides agree exactly
      const double       h      = 1. / n;
      const double       height = 1. + epsilon * h;
      const Tensor<1, 2> tangent(
        {std::cos(angle * dealii::numbers::PI / 180.),
         std::sin(angle * dealii::numbers::PI / 180.)});
      const double      rise       = tangent[1] / tangent[0];
      const Point<2>    corners[4] = {{0., 0.},
                                      {1., 0.},
                                      {1., height + rise},
                                      {0., height}};
      const char *const names[4]   = {"bottom", "right", "top", "left"};
      Geometry          geometry;
      for (unsigned int i = 0; i < 4; ++i)
        geometry.add(single_piece_curve(
          names[i], CurvePiece::segment(corners[i], corners[(i + 1) % 4])));

      RegularMeshParameters mesh;
      mesh.cell_size = h;
      mesh.pattern   = MeshPattern::right_angled;
      mesh.offset    = -1. * Point<2>(0.5, 0.5 * (height + rise));
      Model model(std::move(geometry), mesh, 2, stabilization);

      std::shared_ptr<const SmoothField> field;
      if (polynomial_degree > 0)
        field = make_polynomial_field(7, polynomial_degree);
      else if (side == Side::free)
        field = make_free_surface_field({0., height}, tangent);
      else
        field = make_wave_field();
      std::vector<std::string> held = {"bottom"}, loaded = {"left", "right"};
      if (side == Side::fixed)
        held.push_back("top");
      else if (side == Side::loaded || polynomial_degree > 0)
        loaded.push_back("top");
      prescribe(model,
                field,
                material("rock", 1000., 0.3),
                PlaneState::plane_strain,
                held,
                loaded);

      char variant[80];
      if (angle != 0.)
        std::snprintf(variant,
                      sizeof(variant),
                      "%s, %g degrees",
                      to_string(side).c_str(),
                      angle);
      else
        std::snprintf(variant,
                      sizeof(variant),
                      "%s, epsilon %g",
                      to_string(side).c_str(),
                      epsilon);
      return measure(model, *field, variant, stabilization, what);
    }


    namespace
    {
      Curve
      make_arc(const std::string &name, const double from, const double to)
      {
        const auto at = [](const double degrees) {
          const double t = degrees * dealii::numbers::PI / 180.;
          return Point<2>(std::cos(t), std::sin(t));
        };
        return single_piece_curve(
          name, CurvePiece::arc(at(from), at(0.5 * (from + to)), at(to)));
      }
    } // namespace


    Geometry
    make_disk()
    {
      Geometry geometry;
      // the same end points for both halves
      const Curve right = make_arc("right", -90., 90.);
      geometry.add(right);
      geometry.add(single_piece_curve("left",
                                      CurvePiece::arc(right.pieces[0].end,
                                                      {-1., 0.},
                                                      right.pieces[0].start)));
      return geometry;
    }


    Result
    moved_disk(const unsigned int  seed,
               const double        cell_size,
               const Stabilization stabilization,
               const unsigned int  polynomial_degree,
               const Measure      &what)
    {
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> random(0., 1.);
      const double x = random(generator), y = random(generator),
                   angle = random(generator);

      Model      model(make_disk(),
                  mesh_parameters(cell_size,
                                  Tensor<1, 2>({cell_size * x, cell_size * y}),
                                  60. * angle),
                  2,
                  stabilization);
      const auto field = polynomial_degree > 0
                           ? make_polynomial_field(seed, polynomial_degree)
                           : make_wave_field();
      prescribe(model,
                field,
                material("rock", 1000., 0.3),
                PlaneState::plane_strain,
                {"left"},
                {"right"});
      return measure(
        model, *field, "seed " + std::to_string(seed), stabilization, what);
    }


    Result
    fitted_hexagon(const double   cell_size,
                   const Measure &what,
                   const double   poissons_ratio,
                   const bool     solenoidal)
    {
      // nodes p(i, j) = i a + j b, |i|, |j|, |i + j| <= n
      const int n = static_cast<int>(
        std::round(std::sqrt(dealii::numbers::PI * 2. / (3. * std::sqrt(3.))) /
                   cell_size));
      const Tensor<1, 2> a({cell_size, 0.}),
        b({0.5 * cell_size, std::sqrt(0.75) * cell_size});
      const auto inside = [n](const int i, const int j) {
        return std::abs(i) <= n && std::abs(j) <= n && std::abs(i + j) <= n;
      };
      std::map<std::pair<int, int>, unsigned int> number;
      std::vector<Point<2>>                       vertices;
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i)
          if (inside(i, j))
          {
            number[{i, j}] = vertices.size();
            vertices.push_back(Point<2>() + i * a + j * b);
          }
      std::vector<dealii::CellData<2>> cells;
      const auto add = [&](const std::array<std::pair<int, int>, 3> &corners) {
        dealii::CellData<2> cell(3);
        for (unsigned int v = 0; v < 3; ++v)
        {
          if (!inside(corners[v].first, corners[v].second))
            return;
          cell.vertices[v] = number[corners[v]];
        }
        cells.push_back(cell);
      };
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i)
        {
          add({{{i, j}, {i + 1, j}, {i, j + 1}}});
          add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
        }

      // all nodes on the sides are corners: collinear only up to rounding
      std::vector<Point<2>> outline;
      const int             direction[6][2] = {
                    {-1, 1}, {-1, 0}, {0, -1}, {1, -1}, {1, 0}, {0, 1}};
      int i = n, j = 0;
      for (const auto &d : direction)
        for (int k = 0; k < n; ++k)
        {
          outline.push_back(vertices[number[{i, j}]]);
          i += d[0];
          j += d[1];
        }
      outline.push_back(outline.front());
      // from the lower right corner round the right to the upper left: half
      const unsigned int half = outline.size() / 2;
      Geometry           geometry;
      for (unsigned int part = 0; part < 2; ++part)
      {
        Curve curve;
        curve.name = part == 0 ? "right" : "left";
        curve.role = CurveRole::boundary;
        for (unsigned int k = part * half; k < (part + 1) * half; ++k)
          curve.pieces.push_back(
            CurvePiece::segment(outline[k], outline[k + 1]));
        geometry.add(curve);
      }
      Model      model(std::move(geometry), [&](const PhysicalMesh &) {
        dealii::Triangulation<2> triangulation;
        triangulation.create_triangulation(vertices,
                                           cells,
                                           dealii::SubCellData());
        return MathematicalMesh(triangulation, 2);
      });
      const auto field =
        solenoidal ? make_solenoidal_field() : make_wave_field();
      prescribe(model,
                field,
                material("rock", 1000., poissons_ratio),
                PlaneState::plane_strain,
                {"left"},
                {"right"});
      char variant[60];
      std::snprintf(variant,
                    sizeof(variant),
                    "fitted hexagon, nu %g, h %g",
                    poissons_ratio,
                    cell_size);
      return measure(model, *field, variant, Stabilization::aggregation, what);
    }
  } // namespace HardCases
} // namespace NMM
