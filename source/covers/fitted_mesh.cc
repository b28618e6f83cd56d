#include "fitted_mesh.h"

#include <nmm/covers/point_location.h>

#include "cutting.h"
#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// Number of chords or tangents that replace an arc (of at most a half circle).
      constexpr unsigned int n_arc_steps = 16;

      /// Margins of the region's frame at both ends [cells].
      constexpr double low_margin = 0.05, high_margin = 0.035;

      /// Factor by which a single triangle is enlarged about its centroid.
      constexpr double enlargement = 1.08;

      /// Number of directions that the sides of a single triangle may have, a multiple of 4.
      constexpr unsigned int n_directions = 24;

      /// A frame is thin if the ratio of its sides is below this.
      constexpr double thin_ratio = 0.05;

      /// Lengths and areas that differ by less than this ratio are equal. The coordinates of a metre
      /// in a national grid are rounded to 1e-9 of it.
      constexpr double tie = 1e-7;


      Tensor<1, 2>
      turned_left(const Tensor<1, 2> &a)
      {
        return Tensor<1, 2>({-a[1], a[0]});
      }


      /// Corners of polygons along the edges: of chords of arcs, or of tangents, whose convex hull
      /// contains the arcs.
      std::vector<Point<2>>
      corners(const std::vector<ElementEdge> &edges, const bool around_arcs)
      {
        std::vector<Point<2>> points;
        for (const ElementEdge &edge : edges)
        {
          points.push_back(edge.start);
          points.push_back(edge.end);
          if (!edge.is_arc())
            continue;
          const double first = angle_about(edge.center, edge.start),
                       step  = swept_angle(edge) / n_arc_steps;
          const double radius =
            std::abs(edge.radius) / (around_arcs ? std::cos(0.5 * step) : 1.);
          for (unsigned int k = 0; k < n_arc_steps; ++k)
          {
            const double angle = first + step * (k + (around_arcs ? 0.5 : 0.));
            points.push_back(
              edge.center +
              radius * Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
          }
        }
        return points;
      }


      /// Convex hull by Andrew's monotone chain; one or two points if all points are collinear.
      std::vector<Point<2>>
      convex_hull(std::vector<Point<2>> points)
      {
        const auto less = [](const Point<2> &a, const Point<2> &b) {
          return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
        };
        std::sort(points.begin(), points.end(), less);
        points.erase(std::unique(points.begin(), points.end()), points.end());
        std::vector<Point<2>> hull;
        const auto append_chain = [&](const auto begin, const auto end) {
          const std::size_t first = hull.size();
          for (auto p = begin; p != end; ++p)
          {
            while (hull.size() >= first + 2 &&
                   cross(hull.back() - hull[hull.size() - 2],
                         *p - hull.back()) <= 0.)
              hull.pop_back();
            hull.push_back(*p);
          }
          // The other chain begins with this point.
          hull.pop_back();
        };
        if (points.size() < 3)
          return points;
        append_chain(points.begin(), points.end());
        append_chain(points.rbegin(), points.rend());
        return hull;
      }
    } // namespace


    RegionShape::RegionShape(const PhysicalEdges &edges,
                             const unsigned int   region)
    {
      for (const unsigned int e : edges.region_edges(region))
        if (edges.edges()[e].regions[0] != edges.edges()[e].regions[1])
          outline.push_back(edges.edges()[e].shape);
      const std::vector<Point<2>> inner_hull =
        convex_hull(corners(outline, false));
      inner_hull_area = 0.;
      for (std::size_t i = 2; i < inner_hull.size(); ++i)
        inner_hull_area += 0.5 * cross(inner_hull[i - 1] - inner_hull[0],
                                       inner_hull[i] - inner_hull[0]);
      hull  = convex_hull(corners(outline, true));
      scale = 0.;
      for (const Point<2> &x : hull)
        scale = std::max({scale, std::abs(x[0]), std::abs(x[1])});
      rounding = 64. * std::numeric_limits<double>::epsilon() * scale;
      for (const unsigned int e : edges.region_edges(region))
        // Points on an arc are computed from centre and radius.
        rounding = std::max({rounding,
                             edges.edges()[e].sagitta,
                             8. * std::numeric_limits<double>::epsilon() *
                               std::abs(edges.edges()[e].shape.radius)});

      choose_rectangle();
    }


    void
    RegionShape::choose_rectangle()
    {
      // Of rectangles that are equally small, the one with the shortest longer side is taken, and
      // of these the one whose longer side is nearest to a direction which is not that of the sides
      // of ordinary blocks. A triangle has the same area in the rectangles on all its sides.
      const Tensor<1, 2> preferred(
        {std::cos(numbers::PI / 36.), std::sin(numbers::PI / 36.)});
      double smallest = std::numeric_limits<double>::max(), nearest = 0.;
      // A minimum-area rectangle has a side along one of the hull's edges.
      for (std::size_t i = 0; i < hull.size(); ++i)
      {
        const Tensor<1, 2> side = hull[(i + 1) % hull.size()] - hull[i];
        const Tensor<1, 2> e0 = side / side.norm(), e1 = turned_left(e0);
        double             low[2] = {0., 0.}, high[2] = {0., 0.};
        for (const Point<2> &x : hull)
        {
          const double s[2] = {(x - hull[i]) * e0, (x - hull[i]) * e1};
          for (unsigned int d = 0; d < 2; ++d)
          {
            low[d]  = std::min(low[d], s[d]);
            high[d] = std::max(high[d], s[d]);
          }
        }
        // The rectangle must not be so thin that rounding matters.
        double length[2];
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double excess =
            std::max(0., 40. * rounding - (high[d] - low[d]));
          low[d] -= 0.5 * excess;
          length[d] = high[d] - low[d] + 0.5 * excess;
        }
        const bool     is_longer = length[0] >= (1. - tie) * length[1];
        const double   area      = length[0] * length[1];
        const double   longer    = length[is_longer ? 0 : 1];
        const double   nearness  = (is_longer ? e0 : e1) * preferred;
        const Point<2> lower     = hull[i] + low[0] * e0 + low[1] * e1;
        if (area > (1. + tie) * smallest)
          continue;
        if (area >= (1. - tie) * smallest)
        {
          if (longer > (1. + tie) * sides[0])
            continue;
          if (longer >= (1. - tie) * sides[0] && nearness <= nearest + tie)
            continue;
        }
        smallest = area;
        nearest  = nearness;
        if (is_longer)
        {
          origin = lower;
          axes   = {{e0, e1}};
          sides  = {{length[0], length[1]}};
        }
        else
        {
          origin = lower + length[0] * e0;
          axes   = {{e1, -1. * e0}};
          sides  = {{length[1], length[0]}};
        }
      }
    }


    MeshPart
    make_single_triangle(const RegionShape &shape)
    {
      // Use coordinates of the frame, in which the region spans the unit square.
      std::array<Tensor<1, 2>, n_directions> normals;
      std::array<double, n_directions>       support;
      for (unsigned int k = 0; k < n_directions; ++k)
      {
        const double angle = 2. * numbers::PI * k / n_directions;
        normals[k]         = Tensor<1, 2>({std::cos(angle), std::sin(angle)});
        support[k]         = -std::numeric_limits<double>::max();
        for (const Point<2> &x : shape.hull)
        {
          const Tensor<1, 2> d = x - shape.origin;
          const Tensor<1, 2> s({d * shape.axes[0] / shape.sides[0],
                                d * shape.axes[1] / shape.sides[1]});
          support[k] = std::max(support[k], normals[k] * s);
        }
        // Exact curves may deviate from their shapes in doubles by this rounding.
        for (unsigned int d = 0; d < 2; ++d)
          support[k] +=
            shape.rounding * std::abs(normals[k][d]) / shape.sides[d];
      }
      const auto corner = [&](const unsigned int k, const unsigned int l) {
        const double det = cross(normals[k], normals[l]);
        return Point<2>(
          (support[k] * normals[l][1] - support[l] * normals[k][1]) / det,
          (support[l] * normals[k][0] - support[k] * normals[l][0]) / det);
      };

      constexpr unsigned int quarter = n_directions / 4;
      const bool thin     = shape.sides[1] < thin_ratio * shape.sides[0];
      double     smallest = std::numeric_limits<double>::max();
      std::array<Point<2>, 3> best;
      for (unsigned int k = 0; k < n_directions; ++k)
        for (unsigned int a = 1; a < n_directions / 2; ++a)
          for (unsigned int b = 1; b < n_directions / 2; ++b)
          {
            // The three sides turn counter-clockwise by less than a half turn each.
            if (a + b <= n_directions / 2)
              continue;
            // Sides k and l meet in the first corner; for thin regions they must be along the
            // frame.
            if (thin && (k % quarter != 0 || a != quarter))
              continue;
            const unsigned int l                   = (k + a) % n_directions,
                               m                   = (k + a + b) % n_directions;
            const std::array<Point<2>, 3> triangle = {
              {corner(k, l), corner(l, m), corner(m, k)}};
            const double area =
              0.5 * cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
            // Take the first one of equal triangles, in spite of rounding.
            if (area < smallest * (1. - tie))
            {
              smallest = area;
              best     = triangle;
            }
          }

      const Point<2> centroid((best[0] + best[1] + best[2]) / 3.);
      MeshPart       mesh;
      for (const Point<2> &x : best)
      {
        const Point<2> s = centroid + enlargement * (x - centroid);
        mesh.vertices.push_back(shape.origin +
                                s[0] * shape.sides[0] * shape.axes[0] +
                                s[1] * shape.sides[1] * shape.axes[1]);
      }
      mesh.cells.push_back({{0, 1, 2}});
      return mesh;
    }


    namespace
    {
      /// Remove the cells outside the region; the cells of a row are consecutive.
      void
      keep_needed_cells(const RegionShape &shape,
                        const unsigned int n_cells_per_row,
                        MeshPart          &mesh)
      {
        const std::vector<unsigned char> near = find_triangles_near_edges(
          mesh.vertices,
          ArrayView<const Triangle>(mesh.cells.data(), mesh.cells.size()),
          shape.outline,
          shape.scale);

        const ArrayView<const ElementEdge> outline(shape.outline.data(),
                                                   shape.outline.size());
        std::vector<Triangle>              needed;
        // Cells without a curve between them are all inside or all outside.
        bool is_known = false, inside = false;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          if (c % n_cells_per_row == 0)
            is_known = false;
          const Triangle &v = mesh.cells[c];
          if (near[c])
            is_known = false;
          else if (!is_known)
          {
            is_known = true;
            inside =
              is_inside(outline,
                        Point<2>((mesh.vertices[v[0]] + mesh.vertices[v[1]] +
                                  mesh.vertices[v[2]]) /
                                 3.));
          }
          if (near[c] || inside)
            needed.push_back(v);
        }
        mesh.cells = std::move(needed);
      }
    } // namespace


    MeshPart
    make_rectangles(const RegionShape                 &shape,
                    const std::array<unsigned int, 2> &n)
    {
      Point<2>                    origin = shape.origin;
      std::array<Tensor<1, 2>, 2> step;
      for (unsigned int d = 0; d < 2; ++d)
      {
        step[d] =
          shape.sides[d] / (n[d] - low_margin - high_margin) * shape.axes[d];
        origin -= low_margin * step[d];
      }
      MeshPart mesh;
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          mesh.vertices.push_back(origin + i * step[0] + j * step[1]);
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
        {
          const unsigned int v00 = j * (n[0] + 1) + i, v10 = v00 + 1,
                             v01 = v00 + n[0] + 1, v11 = v01 + 1;
          mesh.cells.push_back({{v00, v10, v01}});
          mesh.cells.push_back({{v11, v01, v10}});
        }
      if (n[1] > 1)
        keep_needed_cells(shape, 2 * n[0], mesh);
      return mesh;
    }


    double
    mesh_area(const MeshPart &mesh)
    {
      double area = 0.;
      for (const auto &v : mesh.cells)
        area += 0.5 * cross(mesh.vertices[v[1]] - mesh.vertices[v[0]],
                            mesh.vertices[v[2]] - mesh.vertices[v[0]]);
      return area;
    }
  } // namespace internal
} // namespace NMM
