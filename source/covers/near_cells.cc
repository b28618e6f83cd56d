#include <nmm/covers/point_location.h>

#include "cutting.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// A short stretch of a curve: all its points lie within `width` of the chord a b [m].
      struct Chunk
      {
        Point<2> a, b;
        double   width;
        /// The curve it belongs to.
        unsigned int owner;
      };

      /// Typical edge length of the triangles [m].
      double
      typical_size(const std::vector<Point<2>>    &vertices,
                   const ArrayView<const Triangle> triangles)
      {
        // A sample is sufficient.
        const std::size_t step =
          std::max<std::size_t>(1, triangles.size() / 8192);
        std::size_t n    = 0;
        double      area = 0., length = 0.;
        for (std::size_t i = 0; i < triangles.size(); i += step, ++n)
        {
          const Triangle    &v = triangles[i];
          const Tensor<1, 2> a = vertices[v[1]] - vertices[v[0]],
                             b = vertices[v[2]] - vertices[v[0]];
          area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
          length += std::max(a.norm(), b.norm());
        }
        // For thin triangles the length of the edges is the better measure.
        return std::max(std::sqrt(2. * area / n), length / n);
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
          // Rounding of points on an arc, which are computed from centre and radius. A straight
          // edge may be an arc that is straight up to rounding, see is_nearly_straight().
          const double rounding =
            edge.is_arc() ? 16. * std::numeric_limits<double>::epsilon() *
                              std::abs(edge.radius)
                          : 1.1e-8 * length;
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
            chunks.push_back({previous, x, sagitta + margin + rounding, e});
            previous = x;
          }
        }
        return chunks;
      }


      /**
       * Separating axis test: a triangle and a segment are further apart than @p width if their
       * projections on the normal of some edge of either are.
       */
      bool
      are_apart(const std::array<Point<2>, 3> &triangle, const Chunk &chunk)
      {
        const auto separates = [&](const Tensor<1, 2> &direction) {
          // Distances are multiplied by the length of the direction.
          const Tensor<1, 2> axis({direction[1], -direction[0]});
          const double       s1 = axis * (triangle[1] - triangle[0]),
                       s2       = axis * (triangle[2] - triangle[0]),
                       sa       = axis * (chunk.a - triangle[0]),
                       sb       = axis * (chunk.b - triangle[0]);
          const double gap =
            std::max(std::min(sa, sb) - std::max({0., s1, s2}),
                     std::min({0., s1, s2}) - std::max(sa, sb));
          return gap > 0. &&
                 gap * gap > chunk.width * chunk.width * axis.norm_square();
        };
        for (unsigned int i = 0; i < 3; ++i)
          if (separates(triangle[(i + 1) % 3] - triangle[i]))
            return true;
        return separates(chunk.b - chunk.a);
      }
    } // namespace


    namespace
    {
      /// A length that is far above the rounding of coordinates of this size [m].
      double
      rounding_margin(const double scale)
      {
        return 1e-10 * scale;
      }


      /// A grid of squares over the boxes of the chunks; each square knows the chunks whose box
      /// meets it.
      class ChunkGrid
      {
      public:
        /// Make a grid of about @p max_squares squares at most.
        ChunkGrid(const std::vector<Chunk> &chunks,
                  const double              spacing,
                  const std::size_t         max_squares)
        {
          for (const Chunk &chunk : chunks)
          {
            const auto [low, high] = box_of(chunk);
            for (unsigned int d = 0; d < 2; ++d)
            {
              lower[d] = std::min(lower[d], low[d]);
              upper[d] = std::max(upper[d], high[d]);
            }
          }
          const double width  = upper[0] - lower[0],
                       height = upper[1] - lower[1];
          const double size   = std::max({spacing,
                                          std::sqrt(width * height / max_squares),
                                          (width + height) / max_squares});
          per_length          = 1. / size;
          n = {{static_cast<unsigned int>(width * per_length) + 1,
                static_cast<unsigned int>(height * per_length) + 1}};
          first.assign(static_cast<std::size_t>(n[0]) * n[1] + 1, 0);
          for (const Chunk &chunk : chunks)
          {
            const auto [low, high] = box_of(chunk);
            for_each_square(low, high, [&](const std::size_t i) {
              ++first[i + 1];
            });
          }
          std::partial_sum(first.begin(), first.end(), first.begin());
          members.resize(first.back());
          std::vector<unsigned int> next(first.begin(), first.end() - 1);
          for (unsigned int k = 0; k < chunks.size(); ++k)
          {
            const auto [low, high] = box_of(chunks[k]);
            for_each_square(low, high, [&](const std::size_t i) {
              members[next[i]++] = k;
            });
          }
        }

        /// Column and row of a square.
        struct Square
        {
          unsigned int i, j;
        };

        /// The square that contains a point, or the nearest one.
        Square
        square_of(const Point<2> &x) const
        {
          return {index(x[0], 0), index(x[1], 1)};
        }

        /// Call action(chunk) for all chunks that meet the squares between two squares, for some of
        /// them several times.
        template <typename Action>
        void
        for_each_near(const Square &low,
                      const Square &high,
                      const Action &action) const
        {
          // The squares of a row are consecutive.
          for (unsigned int j = low.j; j <= high.j; ++j)
          {
            const std::size_t  row = static_cast<std::size_t>(j) * n[0];
            const unsigned int end = first[row + high.i + 1];
            for (unsigned int k = first[row + low.i]; k < end; ++k)
              action(members[k]);
          }
        }

      private:
        static std::pair<Point<2>, Point<2>>
        box_of(const Chunk &chunk)
        {
          const auto &[a, b, w, owner] = chunk;
          (void)owner;
          return {Point<2>(std::min(a[0], b[0]) - w, std::min(a[1], b[1]) - w),
                  Point<2>(std::max(a[0], b[0]) + w, std::max(a[1], b[1]) + w)};
        }

        unsigned int
        index(const double x, const unsigned int d) const
        {
          const double i = (x - lower[d]) * per_length;
          return i <= 0. ? 0
                         : static_cast<unsigned int>(std::min(i, n[d] - 1.));
        }

        template <typename Action>
        void
        for_each_square(const Point<2> &low,
                        const Point<2> &high,
                        const Action   &action) const
        {
          const unsigned int i_end = index(high[0], 0),
                             j_end = index(high[1], 1);
          for (unsigned int j = index(low[1], 1); j <= j_end; ++j)
            for (unsigned int i = index(low[0], 0); i <= i_end; ++i)
              action(static_cast<std::size_t>(j) * n[0] + i);
        }

        Point<2> lower                         = Point<2>(1e300, 1e300),
                 upper                         = Point<2>(-1e300, -1e300);
        double                      per_length = 0.;
        std::array<unsigned int, 2> n;
        std::vector<unsigned int>   first, members;
      };


      NearEdges
      find_owners_near(const std::vector<Point<2>>    &vertices,
                       const ArrayView<const Triangle> triangles,
                       const std::vector<Chunk>       &chunks,
                       const double                    spacing)
      {
        NearEdges near;
        near.first.assign(triangles.size() + 1, 0);
        if (chunks.empty())
          return near;
        const ChunkGrid grid(chunks, spacing, 4 * triangles.size() + 1024);
        // Compute the squares of all vertices, unless the triangles are a small part of the mesh.
        std::vector<ChunkGrid::Square> squares;
        if (vertices.size() <= triangles.size())
        {
          squares.reserve(vertices.size());
          for (const Point<2> &vertex : vertices)
            squares.push_back(grid.square_of(vertex));
        }
        // A chunk can be in several squares.
        std::vector<std::size_t> last_triangle(chunks.size(), triangles.size());
        const auto               square_of = [&](const unsigned int vertex) {
          return squares.empty() ? grid.square_of(vertices[vertex])
                                               : squares[vertex];
        };
        for (std::size_t c = 0; c < triangles.size(); ++c)
        {
          const auto     &v = triangles[c];
          const Point<2> &x = vertices[v[0]], &y = vertices[v[1]],
                         &z = vertices[v[2]];
          const auto a = square_of(v[0]), b = square_of(v[1]),
                     d     = square_of(v[2]);
          const auto first = near.first[c];
          // Points beyond the grid count as those in the squares at its rim.
          grid.for_each_near({std::min(std::min(a.i, b.i), d.i),
                              std::min(std::min(a.j, b.j), d.j)},
                             {std::max(std::max(a.i, b.i), d.i),
                              std::max(std::max(a.j, b.j), d.j)},
                             [&](const unsigned int k) {
                               if (last_triangle[k] == c)
                                 return;
                               last_triangle[k]         = c;
                               const unsigned int owner = chunks[k].owner;
                               if (std::find(near.edges.begin() + first,
                                             near.edges.end(),
                                             owner) == near.edges.end() &&
                                   !are_apart({{x, y, z}}, chunks[k]))
                                 near.edges.push_back(owner);
                             });
          near.first[c + 1] = near.edges.size();
        }
        return near;
      }


      std::vector<unsigned char>
      to_flags(const NearEdges &near)
      {
        std::vector<unsigned char> flags(near.first.size() - 1);
        for (std::size_t i = 0; i < flags.size(); ++i)
          flags[i] = near[i].size() > 0;
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
      const double                    size = typical_size(vertices, view);
      return to_flags(find_owners_near(vertices,
                                       view,
                                       make_chunks(solid_edges(physical_mesh),
                                                   2. * size,
                                                   rounding_margin(scale)),
                                       size));
    }


    NearEdges
    find_edges_near_triangles(const std::vector<Point<2>>    &vertices,
                              const ArrayView<const Triangle> triangles,
                              const std::vector<ElementEdge> &edges,
                              const double                    scale)
    {
      if (triangles.size() == 0)
        return {{0}, {}};
      const double size = typical_size(vertices, triangles);
      return find_owners_near(vertices,
                              triangles,
                              make_chunks(edges,
                                          2. * size,
                                          rounding_margin(scale)),
                              size);
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
