#include <nmm/covers/point_location.h>
#include <nmm/covers/triangulate.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <base/cross.h>
#include <cmath>
#include <map>

namespace NMM
{
  using namespace dealii;

  using internal::cross;

  namespace
  {
    using Kernel     = CGAL::Exact_predicates_inexact_constructions_kernel;
    using VertexBase = CGAL::Triangulation_vertex_base_2<Kernel>;
    using FaceBase   = CGAL::Constrained_triangulation_face_base_2<Kernel>;
    using Structure =
      CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
    // Chords of arcs may cross other edges of a sliver.
    using Delaunay =
      CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                                 Structure,
                                                 CGAL::Exact_predicates_tag>;

    /// A parabola through the ends and the middle of an arc of this angle
    /// deviates by less than 1e-4 of the radius [rad].
    constexpr double largest_arc = numbers::PI / 8.;


    /// Mid-point of the arc that a chord replaces, by the ends of the chord.
    using ArcMiddles =
      std::map<std::pair<std::pair<double, double>, std::pair<double, double>>,
               Point<2>>;

    std::pair<double, double>
    key(const Point<2> &x)
    {
      return {x[0], x[1]};
    }


    /// Append the edge itself, or the chords of an arc, whose mid-points on the arc are stored.
    void
    append_chords(const ElementEdge        &edge,
                  std::vector<ElementEdge> &chords,
                  ArcMiddles               &arc_middles)
    {
      if (!edge.is_arc())
      {
        chords.push_back(edge);
        return;
      }
      const double sweep = swept_angle(edge);
      const double first = angle_about(edge.center, edge.start);
      const auto   n =
        static_cast<unsigned int>(std::ceil(std::abs(sweep) / largest_arc));
      const auto at = [&](const double t) {
        return edge.center + std::abs(edge.radius) *
                               Tensor<1, 2>({std::cos(first + t * sweep),
                                             std::sin(first + t * sweep)});
      };
      ElementEdge chord;
      chord.start = edge.start;
      for (unsigned int k = 1; k <= n; ++k)
      {
        chord.end = k == n ? edge.end : at(static_cast<double>(k) / n);
        chords.push_back(chord);
        const Point<2> middle                           = at((k - 0.5) / n);
        arc_middles[{key(chord.start), key(chord.end)}] = middle;
        arc_middles[{key(chord.end), key(chord.start)}] = middle;
        chord.start                                     = chord.end;
      }
    }


    /// Area of a triangle with parabolic sides: that of its corners plus, for each side, 2/3 of
    /// chord times bulge [m^2].
    double
    curved_area(const QuadraticTriangle &t)
    {
      double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
      for (unsigned int i = 0; i < 3; ++i)
        area -= 2. / 3. * cross(t[(i + 1) % 3] - t[i], t[3 + i] - t[i]);
      return area;
    }


    /// Make a quadratic triangle. A sliver between an arc and a curve that nearly touches it can be
    /// thinner than the arc's bulge; its sides are then straight.
    QuadraticTriangle
    make_triangle(const std::array<Point<2>, 3> &corners,
                  const ArcMiddles              &arc_middles)
    {
      QuadraticTriangle triangle;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Point<2> &a = corners[i], &b = corners[(i + 1) % 3];
        triangle[i]      = a;
        const auto found = arc_middles.find({key(a), key(b)});
        triangle[3 + i] =
          found != arc_middles.end() ? found->second : Point<2>(0.5 * (a + b));
      }
      if (curved_area(triangle) <= 0.)
        for (unsigned int i = 0; i < 3; ++i)
          triangle[3 + i] = Point<2>(0.5 * (corners[i] + corners[(i + 1) % 3]));
      return triangle;
    }
  } // namespace


  std::vector<QuadraticTriangle>
  triangulate(const ManifoldMesh &mesh, const unsigned int element)
  {
    ArcMiddles arc_middles;
    if (mesh.is_whole(element))
    {
      const MathematicalMesh &cells = mesh.mathematical_mesh();
      const auto             &v     = cells.cell_vertices(mesh.cell(element));
      // The edges of a whole element are those of the cell, even if an arc touches them.
      return {make_triangle({{cells.vertices()[v[0]],
                              cells.vertices()[v[1]],
                              cells.vertices()[v[2]]}},
                            arc_middles)};
    }

    // Chords bound the triangles in place of arcs.
    std::vector<ElementEdge> chords;
    for (const ElementEdge &edge : mesh.edges(element))
      append_chords(edge, chords, arc_middles);
    Delaunay delaunay;
    for (const ElementEdge &chord : chords)
      if (chord.start != chord.end)
        delaunay.insert_constraint(Delaunay::Point(chord.start[0],
                                                   chord.start[1]),
                                   Delaunay::Point(chord.end[0], chord.end[1]));

    std::vector<QuadraticTriangle> triangles;
    for (const auto face : delaunay.finite_face_handles())
    {
      std::array<Point<2>, 3> corners;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const auto &p = face->vertex(i)->point();
        corners[i]    = Point<2>(p.x(), p.y());
      }
      const Point<2> center((corners[0] + corners[1] + corners[2]) / 3.);
      if (is_inside(ArrayView<const ElementEdge>(chords.data(), chords.size()),
                    center))
        triangles.push_back(make_triangle(corners, arc_middles));
    }
    return triangles;
  }
} // namespace NMM
