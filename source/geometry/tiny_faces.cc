#include "geometry/tiny_faces.h"

#include "geometry/curve.h"
#include "geometry/trimming.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      constexpr unsigned int n_ranks = 3;

      /// Order in which curves are given up: 0 for interfaces, then joints, then others.
      unsigned int
      rank(const LabelledFaces::Edge &edge, const std::vector<Curve> &curves)
      {
        unsigned int result = 0;
        for (const unsigned int c : edge.curves)
          result = std::max(result,
                            curves[c].role == CurveRole::interface ? 0u
                            : curves[c].role == CurveRole::joint   ? 1u
                                                                   : 2u);
        return result;
      }
    } // namespace


    TinyFaces::TinyFaces(const LabelledFaces      &faces,
                         const std::vector<Curve> &curves)
      : faces(faces)
      , curves(curves)
    {
      const auto &all = faces.faces();
      for (unsigned int f = 0; f < all.size(); ++f)
        if (faces.is_solid(f) &&
            !(all[f].area > area_rounding(all[f].boundary)))
          tiny.push_back(f);
      if (!tiny.empty())
        unite();
    }


    void
    TinyFaces::unite()
    {
      const auto &all = faces.faces();
      parent.resize(all.size());
      std::iota(parent.begin(), parent.end(), 0u);
      largest = parent;
      areas.assign(all.size(), 0.);
      roundings.assign(all.size(), 0.);
      is_dropped.assign(all.size(), false);
      group_edges.resize(all.size());
      for (unsigned int f = 0; f < all.size(); ++f)
        if (faces.is_solid(f))
        {
          areas[f]     = all[f].area;
          roundings[f] = area_rounding(all[f].boundary);
        }
      for (unsigned int e = 0; e < faces.edges().size(); ++e)
      {
        const auto &edge = faces.edges()[e];
        if (edge.left == edge.right)
          continue;
        for (const unsigned int f : {edge.left, edge.right})
          if (faces.is_solid(f))
            group_edges[f].push_back(e);
      }

      // The smallest face comes first; equal ones are in the order of their numbers.
      std::set<std::pair<double, unsigned int>> queue;
      for (const unsigned int f : tiny)
        queue.emplace(areas[f], f);
      while (!queue.empty())
      {
        const unsigned int group = queue.begin()->second;
        queue.erase(queue.begin());
        const unsigned int other = neighbor(group);
        if (other == invalid_index)
        {
          is_dropped[group] = true;
          continue;
        }
        queue.erase({areas[other], other});
        parent[group] = other;
        if (all[largest[group]].area > all[largest[other]].area)
          largest[other] = largest[group];
        areas[other] += areas[group];
        roundings[other] += roundings[group];
        group_edges[other].insert(group_edges[other].end(),
                                  group_edges[group].begin(),
                                  group_edges[group].end());
        group_edges[group].clear();
        if (!(areas[other] > roundings[other]))
          queue.emplace(areas[other], other);
      }
    }


    unsigned int
    TinyFaces::neighbor(const unsigned int group) const
    {
      // Lengths of the common boundary with each neighbour, by the rank of the curves.
      std::map<unsigned int, std::array<double, n_ranks>> lengths;
      for (const unsigned int e : group_edges[group])
      {
        const auto        &edge = faces.edges()[e];
        const unsigned int left = edge.left, right = edge.right;
        if (!faces.is_solid(left) || !faces.is_solid(right))
          continue;
        const unsigned int a = find(left), b = find(right);
        if (a != b)
          lengths[a == group ? b : a][rank(edge, curves)] +=
            length(faces.geometry(edge));
      }
      double longest = 0.;
      for (const auto &entry : lengths)
        for (const double l : entry.second)
          longest = std::max(longest, l);
      for (unsigned int r = 0; r < n_ranks; ++r)
      {
        unsigned int best        = invalid_index;
        double       best_length = -1.;
        for (const auto &[other, by_rank] : lengths)
          if (by_rank[r] >= 0.5 * longest && by_rank[r] > best_length &&
              (by_rank[r] > 0. || longest == 0.))
          {
            best        = other;
            best_length = by_rank[r];
          }
        if (best != invalid_index)
          return best;
      }
      return invalid_index;
    }


    unsigned int
    TinyFaces::find(unsigned int face) const
    {
      while (parent[face] != face)
        face = parent[face] = parent[parent[face]];
      return face;
    }


    unsigned int
    TinyFaces::owner(const unsigned int face) const
    {
      if (tiny.empty())
        return face;
      const unsigned int group = find(face);
      return is_dropped[group] ? invalid_index : largest[group];
    }


    double
    TinyFaces::area(const unsigned int owner) const
    {
      return tiny.empty() ? faces.faces()[owner].area : areas[find(owner)];
    }


    std::vector<std::string>
    TinyFaces::notices() const
    {
      std::vector<std::string> result;
      for (const bool dropped : {false, true})
      {
        unsigned int n = 0, worst = invalid_index;
        for (const unsigned int f : tiny)
          if ((owner(f) == invalid_index) == dropped)
          {
            ++n;
            if (worst == invalid_index ||
                faces.faces()[f].area > faces.faces()[worst].area)
              worst = f;
          }
        if (n == 0)
          continue;
        const auto        &face = faces.faces()[worst];
        const bool         one  = n == 1;
        std::ostringstream text;
        text << std::setprecision(3);
        if (one)
          text << "a region is";
        else
          text << n << " regions are";
        text << " smaller than coordinates can tell apart ("
             << (one ? "" : "the largest: ") << std::max(0., face.area)
             << " m^2 at " << to_string(face.corner) << "): ";
        if (dropped)
          text << (one ? "it has" : "they have") << " no solid neighbour and "
               << (one ? "is" : "are") << " left out";
        else
          text << (one ? "it counts as part of the region"
                       : "each counts as part of the region")
               << " that it shares the longest edge with";
        result.push_back(text.str());
      }
      return result;
    }


    void
    TinyFaces::remove_edges(Arrangement &arrangement) const
    {
      if (tiny.empty())
        return;
      // Edges of a crack, which had the same face on both sides before, are kept.
      for (const auto &edge : faces.edges())
        if (edge.left != edge.right && faces.is_solid(edge.left) &&
            faces.is_solid(edge.right) && find(edge.left) == find(edge.right))
          arrangement.remove_edge(edge.halfedge);
      merge_edges(arrangement);
    }


    namespace
    {
      double
      perimeter(const LabelledFaces::Face &face)
      {
        double sum = 0.;
        for (const DirectedEdge &edge : face.boundary)
          sum += length(edge);
        return sum;
      }
    } // namespace


    double
    width_of_strip(const LabelledFaces::Face &face)
    {
      return 2. * face.area / perimeter(face);
    }


    bool
    is_sliver(const LabelledFaces::Face &face)
    {
      return width_of_strip(face) < 1e-6 * 0.5 * perimeter(face);
    }


    std::string
    describe_slivers(const LabelledFaces             &faces,
                     const std::vector<unsigned int> &slivers,
                     const std::vector<Curve>        &curves)
    {
      const unsigned int n = slivers.size();
      const unsigned int thinnest =
        *std::min_element(slivers.begin(),
                          slivers.end(),
                          [&](const unsigned int f, const unsigned int g) {
                            return width_of_strip(faces.faces()[f]) <
                                   width_of_strip(faces.faces()[g]);
                          });

      // Curves along the thinnest face, the longest ones first.
      std::map<unsigned int, double> lengths;
      for (const auto &edge : faces.edges())
        if ((edge.left == thinnest) != (edge.right == thinnest))
          for (const unsigned int c : edge.curves)
            lengths[c] += length(faces.geometry(edge));
      std::vector<std::pair<double, unsigned int>> sorted;
      for (const auto &[curve, l] : lengths)
        sorted.emplace_back(-l, curve);
      std::sort(sorted.begin(), sorted.end());

      const auto        &face = faces.faces()[thinnest];
      std::ostringstream text;
      text << std::setprecision(3);
      if (n == 1)
        text << "a region is a sliver";
      else
        text << n << " regions are slivers";
      text << ", thinner than a millionth of "
           << (n == 1 ? "its length: " : "their length; the thinnest: ")
           << describe_length(width_of_strip(face)) << " at "
           << to_string(face.inside) << ", between "
           << describe(curves[sorted[0].second]);
      if (sorted.size() > 1)
        text << " and " << describe(curves[sorted[1].second]);
      text << "; if these are meant to be one line, draw one of them only";
      // Boundaries of the face are off by rounding, so that the strain of a sliver is known to
      // rounding over width. Its stress moves what is around it by that part.
      const double rounding =
        std::numeric_limits<double>::epsilon() *
        std::max(std::abs(face.inside[0]), std::abs(face.inside[1]));
      if (rounding > 1e-5 * width_of_strip(face))
        text << ". Coordinates there are rounded by "
             << describe_length(rounding)
             << ", so that displacements around it may be wrong by up to "
             << std::setprecision(1) << rounding / width_of_strip(face)
             << " of their size";
      return text.str();
    }
  } // namespace internal
} // namespace NMM
