#include "slab_candidates.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Slabs narrower than this in scaled coordinates are skipped, since their area is below
      /// round-off.
      constexpr double narrowest_slab = 1e-14;

      /// Points keep this distance from the edges, so that the round-off of
      /// the test whether they are inside does not matter.
      constexpr double inside_margin =
        8. * std::numeric_limits<double>::epsilon();

      /// Grades the points along a slab towards an end where an arc becomes
      /// vertical. The height of the arc behaves like a square root there, which a
      /// parametrization with a vanishing derivative makes smooth.
      struct Grading
      {
        bool at_left, at_right;

        std::pair<double, double>
        operator()(const double t) const
        {
          if (at_left && at_right)
            return {t * t * (3. - 2. * t), 6. * t * (1. - t)};
          if (at_left)
            return {t * t, 2. * t};
          if (at_right)
            return {t * (2. - t), 2. * (1. - t)};
          return {t, 1.};
        }
      };
    } // namespace


    const GaussTable::Rule &
    GaussTable::rule(const unsigned int n_points)
    {
      if (rules.size() <= n_points)
        rules.resize(n_points + 1);
      Rule &rule = rules[n_points];
      if (rule.points.empty())
      {
        const dealii::QGauss<1> gauss(n_points);
        for (unsigned int q = 0; q < n_points; ++q)
        {
          rule.points.push_back(gauss.point(q)[0]);
          rule.weights.push_back(gauss.weight(q));
        }
      }
      return rule;
    }


    // The root t = tan(tau/2) of s_1(tau) = s is that of the quadratic
    //   alpha t^2 + 2 beta t + gamma = 0,
    // whose derivative at the root, 2 (alpha t + beta), has the sign of
    // ds_1/dtau. Of the two ways to write the root, the one without cancellation is taken.
    double
    SlabCandidates::Piece::arc_parameter(const double s) const
    {
      const double v     = 2. * edge->cosine_axis[0];
      const double q     = edge->half_sine_squared;
      const double shift = s - edge->middle[0];
      const double alpha = v * (q - 1.) - shift;
      const double beta  = edge->sine_axis[0];
      const double gamma = v * q - shift;
      const double root =
        slope_sign * std::sqrt(std::max(beta * beta - alpha * gamma, 0.));
      const double sum        = -beta + root;
      const double difference = -beta - root;
      double       t          = 0.5 * (t_min + t_max);
      if (std::abs(sum) > std::abs(difference))
        t = sum / alpha;
      else if (difference != 0.)
        t = gamma / difference;
      return std::min(std::max(t, t_min), t_max);
    }


    double
    SlabCandidates::Piece::height(const double s) const
    {
      if (edge->is_arc)
        return edge->arc_coordinate(1, arc_parameter(s));
      const double t = (s - edge->start[0]) / (edge->end[0] - edge->start[0]);
      return t < 0.5
               ? edge->start[1] + t * (edge->end[1] - edge->start[1])
               : edge->end[1] - (1. - t) * (edge->end[1] - edge->start[1]);
    }


    double
    SlabCandidates::Piece::arc_speed(const double s) const
    {
      const double t       = arc_parameter(s);
      const double inverse = 1. / (1. + t * t);
      return std::abs(edge->sine_axis[0] * ((1. - t * t) * inverse) -
                      edge->cosine_axis[0] * (2. * t * inverse));
    }


    void
    SlabCandidates::make_pieces(const std::vector<FrameEdge> &edges)
    {
      pieces.clear();
      slices.clear();

      // The two faces of a crack within the element are traversed in opposite directions and
      // bound no area.
      is_cancelled.assign(edges.size(), false);
      for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = 0; j < i && !is_cancelled[i]; ++j)
          if (!is_cancelled[j] && edges[i].start == edges[j].end &&
              edges[i].end == edges[j].start &&
              edges[i].cosine_axis[0] == edges[j].cosine_axis[0] &&
              edges[i].cosine_axis[1] == edges[j].cosine_axis[1])
            is_cancelled[i] = is_cancelled[j] = true;

      for (std::size_t i = 0; i < edges.size(); ++i)
        if (!is_cancelled[i])
        {
          const FrameEdge &edge = edges[i];
          const double     a    = edge.start[0];
          const double     b    = edge.end[0];
          slices.push_back(a);
          if (!edge.is_arc)
          {
            if (a != b)
              pieces.push_back(
                {&edge, std::min(a, b), std::max(a, b), a < b, 0., 0., 0.});
            continue;
          }
          const double u      = edge.sine_axis[0];
          const double v      = edge.cosine_axis[0];
          const double t_end  = std::tan(0.5 * edge.half_angle);
          const double t_turn = v == 0. ? 2. : std::tan(0.5 * std::atan(u / v));
          if (std::abs(t_turn) < t_end)
          {
            // The extreme value of s_1 is inside the arc: a maximum if v > 0, else a minimum.
            const double s    = edge.arc_coordinate(0, t_turn);
            const double sign = v > 0. ? 1. : -1.;
            slices.push_back(s);
            pieces.push_back({&edge,
                              std::min(a, s),
                              std::max(a, s),
                              sign > 0.,
                              -t_end,
                              t_turn,
                              sign});
            pieces.push_back({&edge,
                              std::min(b, s),
                              std::max(b, s),
                              sign < 0.,
                              t_turn,
                              t_end,
                              -sign});
          }
          else if (a != b)
            pieces.push_back({&edge,
                              std::min(a, b),
                              std::max(a, b),
                              a < b,
                              -t_end,
                              t_end,
                              a < b ? 1. : -1.});
        }
      std::sort(slices.begin(), slices.end());
    }


    bool
    SlabCandidates::add_point(const ElementFrame          &frame,
                              const Trapezoid             &trapezoid,
                              const std::array<double, 2> &s,
                              const double                 weight)
    {
      const Piece &bottom = *trapezoid.bottom, &top = *trapezoid.top;
      // Where the element is not much wider than the spacing of doubles, the
      // rounded point may be outside. Then a correction towards the target is tried, then one
      // towards the middle of the trapezoid. If both fail, the point is left out, and the
      // correction by moments distributes its weight among the other points.
      std::array<double, 2> target = s;
      std::array<double, 2> xi     = frame.scaled_to_reference(target);
      for (unsigned int attempt = 0; attempt < 4; ++attempt)
      {
        const std::array<double, 2> rounded = frame.reference_to_scaled(xi);
        if (rounded[0] > trapezoid.left + inside_margin &&
            rounded[0] < trapezoid.right - inside_margin &&
            rounded[1] > bottom.height(rounded[0]) + inside_margin &&
            rounded[1] < top.height(rounded[0]) - inside_margin)
        {
          s1.push_back(rounded[0]);
          s2.push_back(rounded[1]);
          reference.emplace_back(xi[0], xi[1]);
          weights.push_back(weight);
          return true;
        }
        if (attempt == 1)
          target[1] = 0.5 * (bottom.height(s[0]) + top.height(s[0]));
        const std::array<double, 2> step = frame.scaled_to_reference_increment(
          {{target[0] - rounded[0], target[1] - rounded[1]}});
        xi[0] += step[0];
        xi[1] += step[1];
      }
      return false;
    }


    void
    SlabCandidates::fill_trapezoid(const ElementFrame &frame,
                                   const Trapezoid    &trapezoid,
                                   const PointCounts  &counts,
                                   GaussTable         &gauss)
    {
      const auto [bottom, top, left, right] = trapezoid;
      unsigned int n_along                  = counts.along;
      if (bottom->edge->is_arc || top->edge->is_arc)
        n_along += counts.extra_on_arcs;
      Grading grading = {false, false};
      for (const Piece *piece : {bottom, top})
        if (piece->edge->is_arc)
        {
          const double at_left  = piece->arc_speed(left);
          const double at_right = piece->arc_speed(right);
          const double middle   = piece->arc_speed(0.5 * (left + right));
          grading.at_left       = grading.at_left || at_left < 0.3 * middle;
          grading.at_right      = grading.at_right || at_right < 0.3 * middle;
        }
      // The first call grows the table, which must not happen after references are taken.
      gauss.rule(counts.across);
      const GaussTable::Rule &along = gauss.rule(
        n_along + (grading.at_left ? 1 : 0) + (grading.at_right ? 1 : 0));
      const GaussTable::Rule &across = gauss.rule(counts.across);
      for (std::size_t i = 0; i < along.points.size(); ++i)
      {
        const auto [x, dx]  = grading(along.points[i]);
        const double s      = left + x * (right - left);
        const double lower  = bottom->height(s);
        const double height = top->height(s) - lower;
        if (height <= 4. * inside_margin)
          continue;
        const double weight = along.weights[i] * dx * (right - left) * height;
        for (std::size_t j = 0; j < across.points.size(); ++j)
          add_point(frame,
                    trapezoid,
                    {{s, lower + across.points[j] * height}},
                    weight * across.weights[j]);
      }
    }


    void
    SlabCandidates::fill_slab(const ElementFrame &frame,
                              const double        left,
                              const double        right,
                              const PointCounts  &counts,
                              GaussTable         &gauss)
    {
      const double middle = 0.5 * (left + right);
      stack.clear();
      for (const Piece &piece : pieces)
        if (piece.left <= left + narrowest_slab &&
            piece.right >= right - narrowest_slab)
          stack.emplace_back(piece.height(middle), &piece);
      std::sort(stack.begin(), stack.end(), [](const auto &a, const auto &b) {
        return a.first != b.first ? a.first < b.first
                                  : a.second->is_bottom < b.second->is_bottom;
      });

      // The winding number distinguishes inside from outside. The parity of the number of edges
      // would fail where rounded edges overlap.
      int          winding = 0;
      const Piece *bottom  = nullptr;
      for (const auto &[height, piece] : stack)
      {
        if (piece->is_bottom && ++winding == 1)
          bottom = piece;
        else if (!piece->is_bottom && --winding == 0)
          fill_trapezoid(frame, {bottom, piece, left, right}, counts, gauss);
      }
    }


    void
    SlabCandidates::reinit(const ElementFrame &frame,
                           const unsigned int  degree,
                           const unsigned int  level,
                           GaussTable         &gauss)
    {
      s1.clear();
      s2.clear();
      reference.clear();
      weights.clear();
      make_pieces(frame.edges());

      // Across the slab the integrand is of degree m. Along the slab its integral over the height
      // of a trapezoid is of degree m + 1.
      PointCounts counts = {(degree + 3) / 2 + level,
                            (degree + 2) / 2 + level,
                            0};
      if (level >= 2)
        counts.along = counts.across = degree + 1 + 2 * (level - 2);
      // On arcs there are enough points for the moments to correct the rest, and at the last level
      // enough to need no correction.
      constexpr std::array<unsigned int, 4> extra = {{1, 2, 4, 14}};
      counts.extra_on_arcs                        = extra[std::min(level, 3u)];

      for (std::size_t i = 0; i + 1 < slices.size();)
      {
        std::size_t next = i + 1;
        while (next < slices.size() &&
               slices[next] - slices[i] <= narrowest_slab)
          ++next;
        if (next < slices.size())
          fill_slab(frame, slices[next - 1], slices[next], counts, gauss);
        i = next;
      }
    }
  } // namespace internal
} // namespace NMM
