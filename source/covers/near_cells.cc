#include <nmm/covers/point_location.h>

#include "cutting.h"
#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      namespace bg     = boost::geometry;
      using BoostPoint = bg::model::point<double, 2, bg::cs::cartesian>;
      using BoostBox   = bg::model::box<BoostPoint>;

      /// A short stretch of a curve: all its points lie within `width` of the
      /// chord a b [m].
      struct Chunk
      {
        Point<2> a, b;
        double   width;
        /// The curve it belongs to.
        unsigned int owner;
      };

      using Tree = bg::index::rtree<std::pair<BoostBox, unsigned int>,
                                    bg::index::rstar<16>>;


      /// Edge length that most triangles have [m].
      double
      typical_size(const std::vector<Point<2>>    &vertices,
                   const ArrayView<const Triangle> triangles)
      {
        double area = 0., length = 0.;
        for (const auto &v : triangles)
        {
          const Tensor<1, 2> a = vertices[v[1]] - vertices[v[0]],
                             b = vertices[v[2]] - vertices[v[0]];
          area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
          length += std::max(a.norm(), b.norm());
        }
        // thin triangles are as long as the length says
        return std::max(std::sqrt(2. * area / triangles.size()),
                        length / triangles.size());
      }


      std::vector<Chunk>
      make_chunks(const PhysicalMesh &physical_mesh,
                  const double        spacing,
                  const double        margin)
      {
        std::vector<Chunk> chunks;
        const auto        &pieces = physical_mesh.pieces();
        for (unsigned int p = 0; p < pieces.size(); ++p)
        {
          const CurvePiece &piece = pieces[p];
          bool              first = true;
          Point<2>          previous;
          for_each_sample(piece, spacing, [&](const Point<2> &x) {
            if (!first)
            {
              // sagitta of a chord of length L: at most L^2 / (4 r) for
              // arcs up to a half circle
              const double chord = previous.distance(x);
              const double sagitta =
                piece.kind == CurvePiece::Kind::segment
                  ? 0.
                  : std::min(0.25 * chord * chord / piece.radius, piece.radius);
              // a whole tiny circle has coinciding or few samples
              const double tiny = (piece.kind != CurvePiece::Kind::segment &&
                                   2. * piece.radius < spacing)
                                    ? 2. * piece.radius
                                    : 0.;
              chunks.push_back(
                {previous, x, std::max(sagitta, tiny) + margin, p});
            }
            first    = false;
            previous = x;
          });
        }
        return chunks;
      }


      std::vector<Chunk>
      make_chunks(const std::vector<ElementEdge> &edges,
                  const double                    spacing,
                  const double                    margin)
      {
        std::vector<Chunk> chunks;
        for (unsigned int e = 0; e < edges.size(); ++e)
        {
          const ElementEdge &edge  = edges[e];
          const double       sweep = swept_angle(edge);
          const double length = edge.is_arc() ? std::abs(sweep * edge.radius)
                                              : edge.start.distance(edge.end);
          const auto   n      = static_cast<unsigned int>(
            std::max(1., std::ceil(length / spacing)));
          const double sagitta =
            std::abs(edge.radius) * (1. - std::cos(0.5 * sweep / n));
          const double first =
            edge.is_arc() ? angle_about(edge.center, edge.start) : 0.;
          Point<2> previous = edge.start;
          for (unsigned int k = 1; k <= n; ++k)
          {
            const double   t = static_cast<double>(k) / n;
            const Point<2> x =
              k == n ? edge.end
              : !edge.is_arc()
                ? edge.start + t * (edge.end - edge.start)
                : edge.center + std::abs(edge.radius) *
                                  Tensor<1, 2>({std::cos(first + t * sweep),
                                                std::sin(first + t * sweep)});
            chunks.push_back({previous, x, sagitta + margin, e});
            previous = x;
          }
        }
        return chunks;
      }


      /**
       * Separating axes: a triangle and a segment are further apart than
       * @p width if their projections on the normal of some edge of either are.
       */
      bool
      are_apart(const std::array<Point<2>, 3> &triangle, const Chunk &chunk)
      {
        const auto separates = [&](const Tensor<1, 2> &direction) {
          const double length = direction.norm();
          if (length == 0.)
            return false;
          const Tensor<1, 2> axis(
            {direction[1] / length, -direction[0] / length});
          double low = 1e300, high = -1e300;
          for (const Point<2> &v : triangle)
          {
            const double s = axis * (v - triangle[0]);
            low            = std::min(low, s);
            high           = std::max(high, s);
          }
          const double sa = axis * (chunk.a - triangle[0]),
                       sb = axis * (chunk.b - triangle[0]);
          return std::min(sa, sb) > high + chunk.width ||
                 std::max(sa, sb) < low - chunk.width;
        };
        for (unsigned int i = 0; i < 3; ++i)
          if (separates(triangle[(i + 1) % 3] - triangle[i]))
            return true;
        return separates(chunk.b - chunk.a);
      }
    } // namespace


    namespace
    {
      constexpr unsigned int several = several_edges;

      /// Rounding in coordinates of this size is far below it [m].
      double
      rounding_margin(const double scale)
      {
        return 1e-10 * scale;
      }


      /// The owner of the chunks near each triangle; invalid_index: none, `several`:
      /// more than one.
      std::vector<unsigned int>
      find_owners_near(const std::vector<Point<2>>    &vertices,
                       const ArrayView<const Triangle> triangles,
                       const std::vector<Chunk>       &chunks)
      {
        std::vector<std::pair<BoostBox, unsigned int>> boxes;
        boxes.reserve(chunks.size());
        for (unsigned int i = 0; i < chunks.size(); ++i)
        {
          const auto &[a, b, w, owner] = chunks[i];
          boxes.emplace_back(
            BoostBox({std::min(a[0], b[0]) - w, std::min(a[1], b[1]) - w},
                     {std::max(a[0], b[0]) + w, std::max(a[1], b[1]) + w}),
            i);
        }
        const Tree tree(boxes);

        std::vector<unsigned int> near(triangles.size(), invalid_index);
        for (std::size_t c = 0; c < triangles.size(); ++c)
        {
          const auto                   &v        = triangles[c];
          const std::array<Point<2>, 3> triangle = {
            {vertices[v[0]], vertices[v[1]], vertices[v[2]]}};
          const auto [x0, x1] =
            std::minmax({triangle[0][0], triangle[1][0], triangle[2][0]});
          const auto [y0, y1] =
            std::minmax({triangle[0][1], triangle[1][1], triangle[2][1]});
          tree.query(bg::index::intersects(BoostBox({x0, y0}, {x1, y1})),
                     boost::make_function_output_iterator(
                       [&, c](const auto &value) {
                         const Chunk &chunk = chunks[value.second];
                         if (near[c] != chunk.owner && near[c] != several &&
                             !are_apart(triangle, chunk))
                           near[c] =
                             near[c] == invalid_index ? chunk.owner : several;
                       }));
        }
        return near;
      }
    } // namespace


    namespace
    {
      std::vector<unsigned char>
      to_flags(const std::vector<unsigned int> &owners)
      {
        std::vector<unsigned char> flags(owners.size());
        for (std::size_t i = 0; i < owners.size(); ++i)
          flags[i] = owners[i] != invalid_index;
        return flags;
      }
    } // namespace


    std::vector<unsigned char>
    find_triangles_near_curves(const std::vector<Point<2>> &vertices,
                               const std::vector<Triangle> &triangles,
                               const PhysicalMesh          &physical_mesh)
    {
      if (triangles.empty())
        return {};
      const BoundingBox<2> &box   = physical_mesh.bounding_box();
      double                scale = 0.;
      for (unsigned int d = 0; d < 2; ++d)
        scale = std::max(
          {scale, std::abs(box.lower_bound(d)), std::abs(box.upper_bound(d))});
      const ArrayView<const Triangle> view(triangles.data(), triangles.size());
      return to_flags(
        find_owners_near(vertices,
                         view,
                         make_chunks(physical_mesh,
                                     2. * typical_size(vertices, view),
                                     rounding_margin(scale))));
    }


    std::vector<unsigned int>
    find_edges_near_triangles(const std::vector<Point<2>>    &vertices,
                              const ArrayView<const Triangle> triangles,
                              const std::vector<ElementEdge> &edges,
                              const double                    scale)
    {
      if (triangles.size() == 0)
        return {};
      return find_owners_near(vertices,
                              triangles,
                              make_chunks(edges,
                                          2. *
                                            typical_size(vertices, triangles),
                                          rounding_margin(scale)));
    }


    std::vector<unsigned char>
    find_triangles_near_edges(const std::vector<Point<2>>    &vertices,
                              const ArrayView<const Triangle> triangles,
                              const std::vector<ElementEdge> &edges,
                              const double                    scale)
    {
      return to_flags(
        find_edges_near_triangles(vertices, triangles, edges, scale));
    }
  } // namespace internal
} // namespace NMM
