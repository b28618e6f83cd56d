#include "cell_cut.h"

#include <algorithm>
#include <base/double_double.h>
#include <cmath>
#include <limits>
#include <tuple>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// The product of two differences with twice the digits of a double.
      DoubleDouble
      product_of_differences(const double a,
                             const double b,
                             const double c,
                             const double d)
      {
        const DoubleDouble first = two_sum(a, -b), second = two_sum(c, -d);
        return first * second.hi + first * second.lo;
      }


      /// (b - a) x (x - a), from differences with twice the digits of a double.
      double
      accurate_twice_the_area(const Point<2> &a,
                              const Point<2> &b,
                              const Point<2> &x)
      {
        const DoubleDouble area =
          product_of_differences(b[0], a[0], x[1], a[1]) +
          -product_of_differences(b[1], a[1], x[0], a[0]);
        return area.hi;
      }


      /// Sum of the absolute values of the coordinates.
      double
      size_of(const Tensor<1, 2> &d)
      {
        return std::abs(d[0]) + std::abs(d[1]);
      }
    } // namespace


    CellCutter::CellCutter(const MathematicalMesh          &mesh,
                           const PhysicalEdges             &physical_edges,
                           const std::vector<unsigned int> &region_to_part,
                           const unsigned int               part)
      : mesh(mesh)
      , physical_edges(physical_edges)
      , region_to_part(region_to_part)
      , part(part)
    {
    }


    const std::vector<CellCutter::HalfEdge> &
    CellCutter::half_edges() const
    {
      return half_edge_list;
    }


    const std::array<unsigned int, 4> &
    CellCutter::first_of_side() const
    {
      return first_on_side;
    }


    const std::vector<unsigned int> &
    CellCutter::loops() const
    {
      return loop_list;
    }


    const std::vector<CellCutter::Face> &
    CellCutter::faces() const
    {
      return face_list;
    }


    CellCutter::Result
    CellCutter::divide(const unsigned int                   cell_to_divide,
                       const ArrayView<const unsigned int> &edges)
    {
      cell          = cell_to_divide;
      const auto &v = mesh.cell_vertices(cell);
      nodes.clear();
      chords.clear();
      along_sides.clear();
      for (unsigned int i = 0; i < 3; ++i)
      {
        corners[i]    = mesh.vertices()[v[i]];
        is_forward[i] = v[i] < v[(i + 1) % 3];
        nodes.push_back({corners[i], invalid_index, invalid_index, 0., 0.});
        side_nodes[i].clear();
      }
      for (const unsigned int e : edges)
        if (!physical_edges.edges()[e].is_linear || !add(e))
          return Result::not_divided;
      if (chords.empty() && along_sides.empty())
        return Result::whole;
      if (!sort_sides())
        return Result::not_divided;
      number_boundary();
      order_chords();
      reach_nodes();
      trace_faces();
      return has_simple_faces() ? Result::divided : Result::not_divided;
    }


    bool
    CellCutter::add(const unsigned int e)
    {
      const auto &[p, q]    = physical_edges.edges()[e].line;
      const auto [from, to] = physical_edges.edges()[e].vertices;
      std::array<int, 3> side_of;
      unsigned int       n_on = 0;
      for (unsigned int i = 0; i < 3; ++i)
      {
        side_of[i] = orientation(p, q, corners[i]);
        n_on += side_of[i] == 0;
      }
      if (n_on == 2)
      {
        add_along(e, side_of[0] != 0 ? 1 : side_of[1] != 0 ? 2 : 0);
        return true;
      }
      const int least    = std::min({side_of[0], side_of[1], side_of[2]}),
                greatest = std::max({side_of[0], side_of[1], side_of[2]});
      if (least >= 0 || greatest <= 0)
        return true;

      // Sides through which the line enters and leaves the cell. If it goes through a corner, the
      // side has the corner's number, and the node is known.
      unsigned int enters = 3, leaves = 3, corner = 3;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3;
        if (side_of[i] > 0 && side_of[j] < 0)
          enters = i;
        else if (side_of[i] < 0 && side_of[j] > 0)
          leaves = i;
        else if (side_of[i] == 0)
          corner = i;
      }
      const bool enters_at_corner = enters == 3, leaves_at_corner = leaves == 3;
      if (enters_at_corner)
        enters = corner;
      if (leaves_at_corner)
        leaves = corner;
      const auto side_of_vertex = [&](const unsigned int vertex,
                                      const unsigned int side) {
        return orientation(corners[side],
                           corners[(side + 1) % 3],
                           physical_edges,
                           vertex);
      };
      // A point is inside of a side if it is to the left of it.
      const int from_leaving = side_of_vertex(from, leaves),
                to_entering  = side_of_vertex(to, enters);
      if (from_leaving < 0 || to_entering < 0)
        return true;
      const int from_entering = side_of_vertex(from, enters),
                to_leaving    = side_of_vertex(to, leaves);
      for (const int sign :
           {from_leaving, to_entering, from_entering, to_leaving})
        if (sign == undecided)
          return false;
      if (from_leaving == 0 || to_entering == 0)
      {
        // The edge ends on the boundary of the cell and continues outside.
        if (from_leaving == 0 && !leaves_at_corner)
          vertex_on_side(from, leaves);
        if (to_entering == 0 && !enters_at_corner)
          vertex_on_side(to, enters);
        return true;
      }
      Chord chord;
      chord.physical_edge = e;
      chord.ends[0]       = from_entering > 0    ? vertex_inside(from)
                            : enters_at_corner   ? corner
                            : from_entering == 0 ? vertex_on_side(from, enters)
                                                 : crossing_on_side(e, enters);
      chord.ends[1]       = to_leaving > 0     ? vertex_inside(to)
                            : leaves_at_corner ? corner
                            : to_leaving == 0  ? vertex_on_side(to, leaves)
                                               : crossing_on_side(e, leaves);
      chords.push_back(chord);
      return true;
    }


    void
    CellCutter::add_along(const unsigned int e, const unsigned int side)
    {
      unsigned int low = side, high = (side + 1) % 3;
      if (std::tie(corners[high][0], corners[high][1]) <
          std::tie(corners[low][0], corners[low][1]))
        std::swap(low, high);
      const auto [from, to] = physical_edges.edges()[e].vertices;
      const int from_low    = compare(physical_edges, from, corners[low]),
                from_high   = compare(physical_edges, from, corners[high]),
                to_low      = compare(physical_edges, to, corners[low]),
                to_high     = compare(physical_edges, to, corners[high]);
      if (from_high >= 0 || to_low <= 0)
        return;
      Chord chord;
      chord.physical_edge = e;
      chord.ends[0]       = from_low <= 0 ? low : vertex_on_side(from, side);
      chord.ends[1]       = to_high >= 0 ? high : vertex_on_side(to, side);
      along_sides.push_back(chord);
    }


    unsigned int
    CellCutter::vertex_on_side(const unsigned int vertex,
                               const unsigned int side)
    {
      for (const unsigned int n : side_nodes[side])
        if (nodes[n].vertex == vertex)
          return n;
      const Point<2> &u    = corners[is_forward[side] ? side : (side + 1) % 3],
                     &v    = corners[is_forward[side] ? (side + 1) % 3 : side];
      const Point<2>    &x = physical_edges.vertices()[vertex];
      const Tensor<1, 2> d = v - u;
      // The coordinates have an error of eight roundings.
      side_nodes[side].push_back(nodes.size());
      nodes.push_back({x,
                       vertex,
                       invalid_index,
                       d * (x - u) / d.norm_square(),
                       1e-14 * (1. + size_of(x) / d.norm())});
      return nodes.size() - 1;
    }


    unsigned int
    CellCutter::crossing_on_side(const unsigned int e, const unsigned int side)
    {
      // Compute from the lower to the higher vertex, so that both cells of the side get the same
      // doubles.
      const Point<2> &u    = corners[is_forward[side] ? side : (side + 1) % 3],
                     &v    = corners[is_forward[side] ? (side + 1) % 3 : side];
      const auto &[p, q]   = physical_edges.edges()[e].line;
      const double a       = accurate_twice_the_area(p, q, u),
                   b       = accurate_twice_the_area(p, q, v);
      const double t       = a / (a - b);
      const double largest = size_of(q - p) * (size_of(u - p) + size_of(v - p));
      side_nodes[side].push_back(nodes.size());
      nodes.push_back({// from the nearer end
                       t < 0.5 ? u + t * (v - u) : v + (b / (b - a)) * (u - v),
                       invalid_index,
                       e,
                       t,
                       1e-15 + 1e-29 * largest / std::abs(a - b)});
      return nodes.size() - 1;
    }


    unsigned int
    CellCutter::vertex_inside(const unsigned int vertex)
    {
      for (unsigned int n = 3; n < nodes.size(); ++n)
        if (nodes[n].vertex == vertex)
          return n;
      nodes.push_back(
        {physical_edges.vertices()[vertex], vertex, invalid_index, 0., 0.});
      return nodes.size() - 1;
    }


    bool
    CellCutter::sort_sides()
    {
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Point<2> &u   = corners[is_forward[i] ? i : (i + 1) % 3],
                       &v   = corners[is_forward[i] ? (i + 1) % 3 : i];
        const auto to_exact = [&](const Node &node) {
          PointOnSide point;
          point.vertex = node.vertex;
          if (node.edge != invalid_index)
          {
            point.p = physical_edges.edges()[node.edge].line[0];
            point.q = physical_edges.edges()[node.edge].line[1];
          }
          return point;
        };
        bool       is_decided = true;
        const auto is_nearer = [&](const unsigned int a, const unsigned int b) {
          const Node &x = nodes[a], &y = nodes[b];
          if (std::abs(x.parameter - y.parameter) > x.error + y.error)
            return x.parameter < y.parameter;
          if (a == b)
            return false;
          const int sign =
            compare_along(u, v, physical_edges, to_exact(x), to_exact(y));
          is_decided = is_decided && sign != undecided;
          return sign == 1;
        };
        // Sort by insertion: there are few nodes, and comparisons may fail.
        auto &list = side_nodes[i];
        for (unsigned int k = 1; k < list.size(); ++k)
          for (unsigned int l = k; l > 0 && is_nearer(list[l], list[l - 1]);
               --l)
            std::swap(list[l], list[l - 1]);
        if (!is_decided)
          return false;
        if (!is_forward[i])
          std::reverse(list.begin(), list.end());
      }
      return true;
    }


    void
    CellCutter::number_boundary()
    {
      boundary.clear();
      node_to_boundary.assign(nodes.size(), invalid_index);
      for (unsigned int i = 0; i < 3; ++i)
      {
        first_on_side[i] = boundary.size();
        boundary.push_back(i);
        boundary.insert(boundary.end(),
                        side_nodes[i].begin(),
                        side_nodes[i].end());
      }
      first_on_side[3] = boundary.size();
      half_edge_list.clear();
      for (unsigned int b = 0; b < boundary.size(); ++b)
      {
        node_to_boundary[boundary[b]] = b;
        half_edge_list.push_back(
          {nodes[boundary[b]].x, invalid_index, invalid_index, boundary[b]});
      }
      for (const Chord &chord : along_sides)
      {
        // The chord covers one piece of the side, in either direction.
        const unsigned int a = node_to_boundary[chord.ends[0]],
                           b = node_to_boundary[chord.ends[1]];
        Assert((a + 1) % boundary.size() == b || (b + 1) % boundary.size() == a,
               ExcInternalError());
        half_edge_list[(a + 1) % boundary.size() == b ? a : b].physical_edge =
          chord.physical_edge;
      }
      for (const Chord &chord : chords)
        for (const unsigned int n : chord.ends)
          half_edge_list.push_back(
            {nodes[n].x, chord.physical_edge, invalid_index, n});
    }


    bool
    CellCutter::comes_before(const unsigned int a,
                             const unsigned int b,
                             const bool         is_inside) const
    {
      // Whether a half-edge runs against the direction of its line.
      const auto is_backward = [&](const unsigned int h) {
        return (h - boundary.size()) % 2 == 1;
      };
      const auto &[pa, qa] =
        physical_edges.edges()[half_edge_list[a].physical_edge].line;
      const auto &[pb, qb] =
        physical_edges.edges()[half_edge_list[b].physical_edge].line;
      if (is_inside)
      {
        // Sort by angle: first the half-edges that run to the right end of their line, which lie in
        // one half-plane.
        if (is_backward(a) != is_backward(b))
          return is_backward(b);
      }
      const int sign = turn(pa, qa, pb, qb);
      return is_backward(a) == is_backward(b) ? sign > 0 : sign < 0;
    }


    void
    CellCutter::order_chords()
    {
      first_out.assign(nodes.size() + 1, 0);
      const unsigned int n_sides = boundary.size();
      for (unsigned int h = n_sides; h < half_edge_list.size(); ++h)
        ++first_out[half_edge_list[h].node + 1];
      for (unsigned int n = 0; n < nodes.size(); ++n)
        first_out[n + 1] += first_out[n];
      out.resize(half_edge_list.size() - n_sides);
      position_out.assign(nodes.size(), 0);
      for (unsigned int h = n_sides; h < half_edge_list.size(); ++h)
      {
        const unsigned int n                  = half_edge_list[h].node;
        out[first_out[n] + position_out[n]++] = h;
      }
      for (unsigned int n = 0; n < nodes.size(); ++n)
        if (first_out[n + 1] > first_out[n] + 1)
        {
          const bool is_inside = node_to_boundary[n] == invalid_index;
          for (unsigned int k = first_out[n] + 1; k < first_out[n + 1]; ++k)
            for (unsigned int l = k;
                 l > first_out[n] &&
                 comes_before(out[l], out[l - 1], is_inside);
                 --l)
              std::swap(out[l], out[l - 1]);
        }
      position_out.resize(half_edge_list.size());
      for (unsigned int k = 0; k < out.size(); ++k)
        position_out[out[k]] = k;
    }


    void
    CellCutter::reach_nodes()
    {
      is_reached.assign(nodes.size(), 0);
      for (const unsigned int n : boundary)
        is_reached[n] = 1;
      bool grows = true;
      while (grows)
      {
        grows = false;
        for (const Chord &chord : chords)
        {
          const auto [a, b] = chord.ends;
          if (is_reached[a] != is_reached[b])
          {
            is_reached[a] = is_reached[b] = 1;
            grows                         = true;
          }
        }
      }
    }


    unsigned int
    CellCutter::next(const unsigned int h) const
    {
      const unsigned int n_sides = boundary.size();
      if (h < n_sides)
      {
        const unsigned int b = h + 1 < n_sides ? h + 1 : 0, n = boundary[b];
        return first_out[n] < first_out[n + 1] ? out[first_out[n + 1] - 1] : b;
      }
      const unsigned int twin = n_sides + ((h - n_sides) ^ 1u);
      const unsigned int n = half_edge_list[twin].node, k = position_out[twin];
      if (k > first_out[n])
        return out[k - 1];
      return node_to_boundary[n] != invalid_index ? node_to_boundary[n]
                                                  : out[first_out[n + 1] - 1];
    }


    unsigned int
    CellCutter::region_beside(const unsigned int h) const
    {
      const unsigned int e = half_edge_list[h].physical_edge;
      bool               is_left;
      if (h >= boundary.size())
        is_left = (h - boundary.size()) % 2 == 0;
      else
      {
        unsigned int side = 0;
        while (h >= first_on_side[side + 1])
          ++side;
        const Point<2> &a = corners[side], &b = corners[(side + 1) % 3];
        is_left = std::tie(a[0], a[1]) < std::tie(b[0], b[1]);
      }
      const unsigned int region =
        physical_edges.edges()[e].regions[is_left ? 0 : 1];
      return region == invalid_index || region_to_part.empty() ||
                 region_to_part[region] == part
               ? region
               : invalid_index;
    }


    void
    CellCutter::trace_faces()
    {
      loop_list.clear();
      face_list.clear();
      for (unsigned int start = 0; start < half_edge_list.size(); ++start)
      {
        if (half_edge_list[start].face != invalid_index)
          continue;
        Face         face = {invalid_index,
                             static_cast<unsigned int>(loop_list.size()),
                             0};
        unsigned int h    = start;
        do
        {
          half_edge_list[h].face = face_list.size();
          loop_list.push_back(h);
          if (half_edge_list[h].physical_edge != invalid_index)
          {
            Assert(face.begin == loop_list.size() ||
                     face.region == invalid_index ||
                     face.region == region_beside(h),
                   ExcInternalError());
            face.region = region_beside(h);
          }
          h = next(h);
        } while (h != start);
        face.end = loop_list.size();
        face_list.push_back(face);
      }
    }


    bool
    CellCutter::has_simple_faces() const
    {
      for (const Face &face : face_list)
      {
        if (is_reached[half_edge_list[loop_list[face.begin]].node])
          continue;
        // A loop that is not connected to the boundary goes around its face, or around a hole of
        // it. The sign of the area tells which, if it is larger than the rounding of the vertices
        // and of the sum.
        constexpr double   epsilon = std::numeric_limits<double>::epsilon();
        const unsigned int n       = face.end - face.begin;
        const Point<2>    &origin = half_edge_list[loop_list[face.begin]].start;
        double             area = 0., size = 0., length = 0., largest = 0.;
        for (unsigned int k = 0; k < n; ++k)
        {
          const Point<2> &x = half_edge_list[loop_list[face.begin + k]].start,
                         &y =
                           half_edge_list[loop_list[face.begin + (k + 1) % n]]
                             .start;
          const Tensor<1, 2> a = x - origin, b = y - origin;
          area += a[0] * b[1] - a[1] * b[0];
          size += std::abs(a[0] * b[1]) + std::abs(a[1] * b[0]);
          length += size_of(b - a);
          largest = std::max(largest, size_of(Tensor<1, 2>(x)));
        }
        const double rounding =
          64. * epsilon * largest * length + (n + 8) * epsilon * size;
        const bool is_outer = area > rounding,
                   is_void  = area < -rounding && face.region == invalid_index;
        if (!is_outer && !is_void)
          return false;
      }
      return true;
    }
  } // namespace internal
} // namespace NMM
