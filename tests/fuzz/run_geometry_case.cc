#include <nmm/covers/point_location.h>

#include <algorithm>
#include <cmath>
#include <fuzz/fuzz.h>
#include <limits>
#include <mechanics/model.h>
#include <sstream>

namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      using namespace NMM::Test;

      constexpr double epsilon = std::numeric_limits<double>::epsilon();


      /// What rounding may change the sum of areas of elements by: of each of its
      /// edges as internal::area_rounding() says, with what lies on other doubles in two
      /// elements.
      double
      rounding_of_areas(const ManifoldMesh &mesh, const double coordinate)
      {
        double sum = 0.;
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const ElementEdge &edge : mesh.edges(e))
            sum += (edge.start.distance(edge.end) +
                    std::abs(edge.radius * swept_angle(edge))) *
                   std::max(coordinate, std::abs(edge.radius));
        return 16. * epsilon * sum;
      }


      /// Of the thinnest element that is tied to another one, twice its area by its
      /// perimeter [m].
      double
      least_width(const ManifoldMesh &mesh)
      {
        std::vector<double> widths(mesh.n_elements());
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        {
          double perimeter = 0.;
          for (const ElementEdge &edge : mesh.edges(e))
            perimeter += edge.start.distance(edge.end);
          widths[e] = perimeter > 0. ? 2. * mesh.area(e) / perimeter
                                     : std::sqrt(mesh.area(e));
        }
        double width = std::numeric_limits<double>::max();
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const ElementEdge &edge : mesh.edges(e))
            if (edge.curve_set != invalid_index &&
                edge.neighbor != invalid_index && edge.neighbor != e)
              width = std::min({width, widths[e], widths[edge.neighbor]});
        return width;
      }


      std::string
      compare(const std::string &what,
              const double       value,
              const double       expected,
              const double       tolerance)
      {
        if (std::abs(value - expected) <= tolerance)
          return "";
        std::ostringstream text;
        text.precision(17);
        text << what << " is " << value << " instead of " << expected
             << ", off by " << std::abs(value - expected) << ", bound "
             << tolerance;
        return text.str();
      }
    } // namespace


    std::string
    run_geometry_case(const Case &c)
    {
      const double size       = c.numbers.at("size"),
                   coordinate = c.numbers.at("coordinate"),
                   area       = c.numbers.at("area");
      Geometry geometry = parse_geometry(c.files.at("case.wkt"), "case.wkt");
      for (Curve &curve : geometry.curves())
        // what rounding has moved out of the solid is no mistake
        curve.is_clipped = curve.role != CurveRole::boundary;
      RegularMeshParameters mesh;
      mesh.cell_size = c.numbers.at("cell size");
      mesh.rotation  = c.numbers.at("rotation");
      mesh.pattern   = c.numbers.at("right-angled") != 0.
                         ? MeshPattern::right_angled
                         : MeshPattern::equilateral;
      Model model(std::move(geometry), mesh, c.numbers.at("degree"));

      double in_regions = 0., in_elements = 0.;
      for (const auto &region : model.physical_mesh.regions())
        in_regions += region.area;
      for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
        in_elements += model.manifold_mesh.area(e);
      const double rounding =
        rounding_of_areas(model.manifold_mesh, coordinate) +
        64. * epsilon * size * coordinate;
      std::string failure =
        compare("the area of regions", in_regions, area, rounding);
      if (failure.empty())
        failure = compare("the area of elements", in_elements, area, rounding);
      if (!failure.empty())
        return failure;

      Tensor<2, 2> gradient;
      gradient[0][0] = 0.7;
      gradient[0][1] = -0.4;
      gradient[1][0] = 0.2;
      gradient[1][1] = 0.5;
      gradient *= 1. / size;
      const auto    &box    = model.physical_mesh.bounding_box();
      const Point<2> middle = box.center();
      const auto     exact  = [&](const Point<2> &x) {
        return gradient * (x - middle) + Tensor<1, 2>({1., -1.});
      };
      model.problem.materials           = {material("m", 1e9, 0.3)};
      model.problem.boundary_conditions = {condition(
        BoundaryCondition::Type::displacement, "b", vector_function(exact))};
      LinearSolverReport report;
      try
      {
        report = model.solve();
      }
      catch (const NumericalFailure &)
      {
        // Entries of the matrix are E size / w at most, of the right-hand side E: rounding
        // leaves a relative residual of epsilon size / w, and the solver refuses 1e-5.
        if (epsilon * size / least_width(model.manifold_mesh) > 1e-5)
          return "";
        throw;
      }
      const PlaneElasticity elasticity =
        model.problem.materials[0].plane_elasticity(model.problem.plane_state);
      const ErrorNorms errors =
        compute_errors(*model.field, exact, [&](const Point<2> &) {
          return elasticity.stress(gradient);
        });
      // Coordinates are rounded by epsilon |X|, so that the strain of an element of the width w is
      // known to epsilon |X| / w, and its stress moves the rest by that part of u at most (0.2
      // times that in one of 50,000 cases). Sums of its equations are rounded by epsilon
      // size / w (the error was 6.8 times that in one of 900 cases, 0.3 times in most). The
      // solution is rounded as well; the error was at most 2.2 times the estimate of that in 500
      // cases above 1e-9.
      const double tolerance =
        1e-7 + 1e3 * epsilon * coordinate / size +
        epsilon * (coordinate + 16. * size) / least_width(model.manifold_mesh) +
        4. * report.rounding_effect;
      if (!(errors.displacement <= tolerance))
      {
        std::ostringstream text;
        text << "the displacement of a linear patch is off by "
             << errors.displacement << ", bound " << tolerance;
        return text.str();
      }
      return "";
    }
  } // namespace Fuzz
} // namespace NMM
