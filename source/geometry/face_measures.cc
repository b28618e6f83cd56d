#include "geometry/face_measures.h"

#include <algorithm>
#include <base/angle_minus_sine.h>
#include <base/cross.h>
#include <cmath>
#include <limits>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      // Angle of an arc of at most a half circle. Both arguments of atan2() are exact up to
      // rounding for short arcs and for half circles alike, unlike the arc sine of the chord or the
      // arc cosine of a dot product.
      double
      angle(const DirectedEdge &edge)
      {
        const dealii::Point<2> middle =
          edge.start + 0.5 * (edge.end - edge.start);
        return 2. * std::atan2(0.5 * edge.start.distance(edge.end),
                               middle.distance(edge.center));
      }

      bool
      is_lower(const DirectedEdge &edge)
      {
        return (edge.bulge > 0) == (edge.start[0] < edge.end[0]);
      }

      double
      height_at(const DirectedEdge &edge, const double x)
      {
        if (edge.bulge == 0)
          return edge.start[1] + (x - edge.start[0]) /
                                   (edge.end[0] - edge.start[0]) *
                                   (edge.end[1] - edge.start[1]);
        const double dx = x - edge.center[0];
        const double half =
          std::sqrt(std::max(0., (edge.radius - dx) * (edge.radius + dx)));
        return edge.center[1] + (is_lower(edge) ? -half : half);
      }
    } // namespace


    double
    length(const DirectedEdge &edge)
    {
      return edge.bulge == 0 ? edge.start.distance(edge.end)
                             : edge.radius * angle(edge);
    }


    double
    area_rounding(const std::vector<DirectedEdge> &edges)
    {
      double coordinate = 0.;
      for (const DirectedEdge &edge : edges)
        coordinate = std::max(
          {coordinate, std::abs(edge.start[0]), std::abs(edge.start[1])});
      double sum = 0.;
      for (const DirectedEdge &edge : edges)
        sum += length(edge) * std::max(coordinate, edge.radius);
      return 16. * std::numeric_limits<double>::epsilon() * sum;
    }


    double
    enclosed_area(const std::vector<DirectedEdge> &edges)
    {
      const dealii::Point<2> origin = edges.front().start;
      double                 area   = 0.;
      for (const DirectedEdge &edge : edges)
      {
        area += 0.5 * cross(edge.start - origin, edge.end - origin);
        if (edge.bulge != 0)
          area += 0.5 * edge.bulge * edge.radius * edge.radius *
                  angle_minus_sine(angle(edge));
      }
      return area;
    }


    dealii::Point<2>
    inside_point(const std::vector<DirectedEdge> &edges)
    {
      std::vector<double> abscissae;
      for (const DirectedEdge &edge : edges)
        abscissae.push_back(edge.start[0]);
      std::sort(abscissae.begin(), abscissae.end());
      abscissae.erase(std::unique(abscissae.begin(), abscissae.end()),
                      abscissae.end());

      // Pairs (negative width, middle) of the gaps.
      std::vector<std::pair<double, double>> gaps;
      for (unsigned int i = 1; i < abscissae.size(); ++i)
        gaps.emplace_back(abscissae[i - 1] - abscissae[i],
                          abscissae[i - 1] +
                            0.5 * (abscissae[i] - abscissae[i - 1]));
      const unsigned int n_scans =
        std::min<unsigned int>(64, static_cast<unsigned int>(gaps.size()));
      std::partial_sort(gaps.begin(), gaps.begin() + n_scans, gaps.end());

      dealii::Point<2>    best       = edges.front().start;
      double              best_width = -1.;
      std::vector<double> heights;
      for (unsigned int s = 0; s < n_scans; ++s)
      {
        const double x = gaps[s].second;
        heights.clear();
        for (const DirectedEdge &edge : edges)
          if ((edge.start[0] < x) != (edge.end[0] < x))
            heights.push_back(height_at(edge, x));
        std::sort(heights.begin(), heights.end());
        for (unsigned int i = 1; i < heights.size(); i += 2)
        {
          const double width =
            std::min(heights[i] - heights[i - 1], -gaps[s].first);
          if (width > best_width)
          {
            best_width = width;
            best = {x, heights[i - 1] + 0.5 * (heights[i] - heights[i - 1])};
          }
        }
      }
      return best;
    }


    dealii::BoundingBox<2>
    bounding_box(const std::vector<DirectedEdge> &edges)
    {
      constexpr double large = std::numeric_limits<double>::max();
      std::pair<dealii::Point<2>, dealii::Point<2>> corners(
        dealii::Point<2>(large, large), dealii::Point<2>(-large, -large));
      const auto include = [&](const dealii::Point<2> &point) {
        for (unsigned int d = 0; d < 2; ++d)
        {
          corners.first[d]  = std::min(corners.first[d], point[d]);
          corners.second[d] = std::max(corners.second[d], point[d]);
        }
      };
      for (const DirectedEdge &edge : edges)
      {
        include(edge.start);
        include(edge.end);
        // An x-monotone arc has its extreme y above or below its centre.
        if (edge.bulge != 0 &&
            (edge.start[0] < edge.center[0]) != (edge.end[0] < edge.center[0]))
          include(
            {edge.center[0],
             edge.center[1] + (is_lower(edge) ? -edge.radius : edge.radius)});
      }
      return dealii::BoundingBox<2>(corners);
    }
  } // namespace internal
} // namespace NMM
