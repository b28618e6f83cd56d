// Detection of bodies that pass through each other in a step.
#include <nmm/base/exceptions.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <contact/detection/crossings.h>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      using Corner = ContactSurface::Corner;

      /// Cosine of 32 degrees: faces whose normals differ by less look the same way.
      constexpr double same_way = 0.85;
      /// Largest rotation of a body on a piece of its path [rad].
      constexpr double piece_angle = 0.2;
      /// Fraction of a chord by which it is continued beyond its ends, so that no point passes
      /// between two chords.
      constexpr double chord_slack = 1e-9;


      Tensor<1, 2>
      rotated(const Tensor<1, 2> &d, const double angle)
      {
        const double c = std::cos(angle), s = std::sin(angle);
        return Tensor<1, 2>({c * d[0] - s * d[1], s * d[0] + c * d[1]});
      }


      /// The straight way of a point.
      struct Way
      {
        Point<2> begin, end;
      };


      /// Find the times, from 0 to 1, at which a point p meets a chord from a to b. Calls
      /// action(time, parameter of the chord).
      template <typename Action>
      void
      meet(const Way &p, const Way &a, const Way &b, const Action &action)
      {
        const Tensor<1, 2> P = p.begin - a.begin, dP = (p.end - a.end) - P;
        const Tensor<1, 2> B = b.begin - a.begin, dB = (b.end - a.end) - B;
        const double       c_0 = cross(B, P), c_1 = cross(B, dP) + cross(dB, P),
                     c_2 = cross(dB, dP);
        double       times[2];
        unsigned int n    = 0;
        const double root = c_1 * c_1 - 4. * c_0 * c_2;
        if (root < 0.)
          return;
        const double q = -0.5 * (c_1 + std::copysign(std::sqrt(root), c_1));
        if (q != 0.)
          times[n++] = c_0 / q;
        if (c_2 != 0.)
          times[n++] = q / c_2;
        for (unsigned int i = 0; i < n; ++i)
        {
          const double time = times[i];
          // This is false for NaN, too.
          if (!(time >= 0. && time <= 1.))
            continue;
          const Tensor<1, 2> chord = B + time * dB, way = P + time * dP;
          const double       t = (way * chord) / chord.norm_square();
          if (t >= -chord_slack && t <= 1. + chord_slack)
            action(time, std::clamp(t, 0., 1.));
        }
      }


      StepFault
      fault_of(const ContactSurface &surface,
               const unsigned int    edge,
               const Point<2>       &begin,
               const std::string    &what,
               const double          retry)
      {
        return {"a point of '" + surface.name(edge) + "', at " +
                  to_string(begin) + " when the step begins, " + what,
                "allow smaller steps, make what is hit thicker, or contact "
                "stiffer; a sliver between two lines vanishes with "
                "'Geometry/Small blocks = merge'",
                retry};
      }
    } // namespace


    ContactCrossings::ContactCrossings(const ContactSurface &surface,
                                       const double          reach)
      : surface(&surface)
      , bodies(surface.n_bodies())
      , least_thickness(std::numeric_limits<double>::max())
    {
      // Parts of tau and of the length of a corner, see the class.
      constexpr double reach_part = 0.5, circumference_part = 1. / 40.,
                       width_part = 0.2;

      const auto         &edges = surface.edges();
      std::vector<double> circumference(bodies.size(), 0.),
        area(bodies.size(), 0.);
      std::vector<unsigned int> n_edges(bodies.size(), 0),
        first(bodies.size(), invalid_index);
      std::vector<bool> is_convex(bodies.size(), true);
      for (unsigned int e = 0; e < edges.size(); ++e)
      {
        const auto        &edge = edges[e];
        const unsigned int body = edge.body;
        circumference[body] += edge.length;
        is_convex[body] = is_convex[body] && edge.radius >= 0. &&
                          edge.at_start != Corner::concave &&
                          edge.next != invalid_index;
        ++n_edges[body];
        if (first[body] == invalid_index)
          first[body] = e;
        // Area of the polygon, from triangles with a corner of it; arcs add to it.
        const Point<2> &corner = edges[first[body]].start;
        area[body] += 0.5 * cross(edge.start - corner, edge.end - corner);
      }
      for (unsigned int body = 0; body < bodies.size(); ++body)
      {
        if (first[body] == invalid_index)
          continue;
        // Follow one closed boundary.
        unsigned int e = first[body], n = 0;
        do
        {
          e = edges[e].next;
          ++n;
        } while (e != invalid_index && e != first[body] && n <= n_edges[body]);
        const double tau           = std::min(reach_part * reach,
                                    circumference_part * circumference[body]);
        bodies[body].tau           = tau;
        bodies[body].circumference = circumference[body];
        bodies[body].width         = area[body] > 0. && n == n_edges[body]
                                       ? 2. * area[body] / circumference[body]
                                       : circumference[body];
        bodies[body].corner_length = tau;
        if (area[body] > 0. && n == n_edges[body])
          bodies[body].corner_length =
            std::max(tau,
                     std::min(circumference_part * circumference[body],
                              width_part * bodies[body].width));
        // A straight line is the boundary of a half-plane.
        if (n_edges[body] == 1 && edges[first[body]].next == invalid_index &&
            edges[first[body]].radius == 0.)
          bodies[body].thickness = tau;
        else if (is_convex[body] && n == n_edges[body] && area[body] > 0.)
        {
          const double r         = area[body] / circumference[body];
          bodies[body].thickness = tau * r / (0.5 * circumference[body] + r);
        }
        least_thickness = std::min(least_thickness, bodies[body].thickness);
      }
      find_incident_ends();
    }


    void
    ContactCrossings::set_step(const std::vector<ContactPosition> &begin,
                               const std::vector<ContactPosition> &end)
    {
      const auto &edges   = surface->edges();
      const auto relative = [&](const std::vector<ContactPosition> &positions) {
        std::vector<Point<2>> result;
        for (const ContactPosition &x : positions)
          result.emplace_back(x - edges.front().start);
        return result;
      };
      at_begin = relative(begin);
      at_end   = relative(end);
      for (Body &body : bodies)
      {
        body.center = Point<2>();
        body.motion = Tensor<1, 2>();
        body.radius = body.angle = 0.;
        body.n                   = 0;
      }
      for (unsigned int i = 0; i < at_begin.size(); ++i)
      {
        Body &body = bodies[edges[i / 3].body];
        body.center += at_begin[i];
        body.motion += at_end[i] - at_begin[i];
        ++body.n;
      }
      for (Body &body : bodies)
        if (body.n > 0)
        {
          body.center /= double(body.n);
          body.motion /= double(body.n);
        }
      std::vector<Point<2>> turns(bodies.size());
      for (unsigned int i = 0; i < at_begin.size(); ++i)
      {
        Body              &body = bodies[edges[i / 3].body];
        const Tensor<1, 2> d_0  = at_begin[i] - body.center,
                           d_1  = at_end[i] - body.center - body.motion;
        Point<2> &turn          = turns[edges[i / 3].body];
        turn[0] += d_0 * d_1;
        turn[1] += cross(d_0, d_1);
        body.radius = std::max(body.radius, (d_1 - d_0).norm());
      }
      for (unsigned int body = 0; body < bodies.size(); ++body)
      {
        bodies[body].angle = std::atan2(turns[body][1], turns[body][0]);
        // Smaller rotations are neglected: the path is then one straight piece.
        if (std::abs(bodies[body].angle) < 0.5 * piece_angle)
          bodies[body].angle = 0.;
      }
    }


    bool
    ContactCrossings::may_cross(const unsigned int edge,
                                const unsigned int other,
                                const double       depth) const
    {
      const Body &a = bodies[surface->edges()[edge].body],
                 &b = bodies[surface->edges()[other].body];
      const double motion =
        (a.motion - b.motion).norm() + a.radius + b.radius + depth;
      return 2. * motion >= std::min(a.thickness, b.thickness);
    }


    unsigned int
    ContactCrossings::n_chords(const unsigned int edge) const
    {
      // Tolerance as a fraction of the body's width, and the largest number of chords of an edge.
      constexpr double precision = 0.02, most = 64.;
      const double     tolerance =
        precision * bodies[surface->edges()[edge].body].width;
      double sagitta = 0.;
      for (const auto *positions : {&at_begin, &at_end})
      {
        const Point<2> *x = positions->data() + 3 * edge;
        sagitta =
          std::max(sagitta, 0.5 * ((x[0] - x[1]) + (x[2] - x[1])).norm());
      }
      return static_cast<unsigned int>(
        std::clamp(std::ceil(std::sqrt(sagitta / tolerance)), 1., most));
    }


    Point<2>
    ContactCrossings::position(const unsigned int edge,
                               const double       t,
                               const double       time) const
    {
      const double weights[3] = {(1. - t) * (1. - 2. * t),
                                 4. * t * (1. - t),
                                 t * (2. * t - 1.)};
      Point<2>     x_0, x_1;
      for (unsigned int i = 0; i < 3; ++i)
        if (weights[i] != 0.)
        {
          x_0 += weights[i] * at_begin[3 * edge + i];
          x_1 += weights[i] * at_end[3 * edge + i];
        }
      if (time == 0. || time == 1.)
        return time == 0. ? x_0 : x_1;
      const Body &body = bodies[surface->edges()[edge].body];
      if (body.angle == 0.)
        return x_0 + time * (x_1 - x_0);
      const Tensor<1, 2> d_0 = x_0 - body.center;
      const Tensor<1, 2> d_1 =
        rotated(x_1 - body.center - body.motion, -body.angle);
      return body.center + time * body.motion +
             rotated(d_0 + time * (d_1 - d_0), time * body.angle);
    }


    ContactCrossings::Place
    ContactCrossings::nearest(const Point<2>           &x,
                              const std::vector<Chord> &chords,
                              const double              time,
                              const double              bound,
                              std::vector<Chord>       *near) const
    {
      // Distances that differ by less than this fraction of a chord's length are equal.
      constexpr double same = 1e-12;

      Place result;
      result.distance = std::numeric_limits<double>::max();
      for (const Chord &chord : chords)
      {
        const Point<2>     a      = position(chord.edge, chord.first, time);
        const Tensor<1, 2> along  = position(chord.edge, chord.last, time) - a;
        const double       square = along.norm_square();
        if (!(square > 0.))
          continue;
        const double       t   = std::clamp(((x - a) * along) / square, 0., 1.);
        const Tensor<1, 2> way = x - a - t * along;
        const double       distance = way.norm(), length = std::sqrt(square);
        if (near != nullptr && distance <= bound)
          near->push_back(chord);
        // Outside is to the right of the chord.
        double      gap  = cross(way, along) / length;
        const auto &edge = surface->edges()[chord.edge];
        // There is no inside beyond the ends of an open boundary.
        if ((t == 0. && chord.first == 0. && edge.previous == invalid_index) ||
            (t == 1. && chord.last == 1. && edge.next == invalid_index))
          gap = distance;
        // At a corner, the face with the larger normal distance determines the side.
        const bool is_tied =
          std::abs(distance - result.distance) <= same * length;
        if (is_tied ? std::abs(gap) > std::abs(result.gap)
                    : distance < result.distance)
        {
          result.edge     = chord.edge;
          result.t        = chord.first + t * (chord.last - chord.first);
          result.distance = distance;
          result.gap      = gap;
        }
      }
      return result;
    }


    void
    ContactCrossings::follow(const unsigned int        edge,
                             const double              s,
                             const std::vector<Chord> &chords,
                             Path                     &path) const
    {
      const Body  &body  = bodies[surface->edges()[edge].body];
      const Body  &other = bodies[surface->edges()[chords[0].edge].body];
      const double angle =
        std::max(std::abs(body.angle), std::abs(other.angle));
      const unsigned int n = 1 + static_cast<unsigned int>(angle / piece_angle);
      for (unsigned int piece = 0; piece < n; ++piece)
      {
        const double begin = piece / double(n), end = (piece + 1) / double(n);
        const auto   way = [&](const unsigned int one, const double t) {
          return Way{position(one, t, begin), position(one, t, end)};
        };
        const Way p = way(edge, s);
        for (const Chord &chord : chords)
          meet(p,
               way(chord.edge, chord.first),
               way(chord.edge, chord.last),
               [&](const double time, const double t) {
                 const double now = begin + time / n;
                 Place        place;
                 place.edge = chord.edge;
                 place.t    = chord.first + t * (chord.last - chord.first);
                 if (!path.crosses || now < path.begin)
                 {
                   path.begin = now;
                   path.first = place;
                 }
                 if (!path.crosses || now >= path.end)
                 {
                   path.end  = now;
                   path.last = place;
                 }
                 path.crosses = true;
               });
      }
    }


    Tensor<1, 2>
    ContactCrossings::normal(const Place &place) const
    {
      const Point<2>    *x = at_end.data() + 3 * place.edge;
      const Tensor<1, 2> a =
        (x[2] - x[0]) + (4. * place.t - 2.) * ((x[0] - x[1]) + (x[2] - x[1]));
      return Point<2>(a[1], -a[0]) / a.norm();
    }


    void
    ContactCrossings::find_incident_ends()
    {
      const auto &edges = surface->edges();
      const auto  key = [&](const std::pair<unsigned int, unsigned int> &end) {
        const auto     &edge = edges[end.first];
        const Point<2> &x    = end.second == 0 ? edge.start : edge.end;
        return std::make_tuple(edge.body, x[0], x[1]);
      };
      for (unsigned int e = 0; e < edges.size(); ++e)
        for (const unsigned int end : {0U, 1U})
          incident_ends.emplace_back(e, end);
      std::sort(incident_ends.begin(),
                incident_ends.end(),
                [&](const auto &a, const auto &b) { return key(a) < key(b); });
      range_of_end.resize(incident_ends.size());
      for (unsigned int first = 0, i = 1; i <= incident_ends.size(); ++i)
        if (i == incident_ends.size() ||
            key(incident_ends[i]) != key(incident_ends[first]))
        {
          for (unsigned int k = first; k < i; ++k)
            range_of_end[2 * incident_ends[k].first + incident_ends[k].second] =
              {first, i};
          first = i;
        }
    }


    std::vector<ContactCrossings::Passage>
    ContactCrossings::continuations(const Passage &passage) const
    {
      std::vector<Passage> result;
      const auto          &edge = surface->edges()[passage.edge];
      const unsigned int   next = passage.forward ? edge.next : edge.previous;
      if (next != invalid_index)
        result.push_back({next, passage.forward});
      const auto [first, last] =
        range_of_end[2 * passage.edge + (passage.forward ? 1 : 0)];
      for (unsigned int i = first; i < last; ++i)
      {
        const auto [other, end] = incident_ends[i];
        if (other != passage.edge && other != next)
          result.push_back({other, end == 0});
      }
      return result;
    }


    bool
    ContactCrossings::reaches(const Place &from,
                              const Place &to,
                              const double tau) const
    {
      const auto        &edges     = surface->edges();
      const Tensor<1, 2> to_normal = normal(to);
      // Length of a passage that looks another way than the place to be reached.
      const auto others_of =
        [&](const unsigned int edge, const double t, const double length) {
          Place place;
          place.edge = edge;
          place.t    = t;
          return normal(place) * to_normal < same_way ? length : 0.;
        };
      std::vector<std::pair<Passage, double>>         waiting;
      std::map<std::pair<unsigned int, bool>, double> known;
      for (const bool forward : {true, false})
        waiting.emplace_back(Passage{from.edge, forward},
                             others_of(from.edge,
                                       from.t,
                                       edges[from.edge].length *
                                         (forward ? 1. - from.t : from.t)));
      while (!waiting.empty())
      {
        const auto [passage, others] = waiting.back();
        waiting.pop_back();
        if (others > tau)
          continue;
        for (const Passage &next : continuations(passage))
        {
          if (next.edge == to.edge)
            return true;
          const double sum =
            others + others_of(next.edge, 0.5, edges[next.edge].length);
          const auto [entry, is_new] =
            known.insert({{next.edge, next.forward}, sum});
          if (!is_new && entry->second <= sum)
            continue;
          entry->second = sum;
          waiting.emplace_back(next, sum);
        }
      }
      return false;
    }


    bool
    ContactCrossings::is_same_side(const Place &a,
                                   const Place &b,
                                   const double tau) const
    {
      if (a.edge != b.edge)
        return reaches(a, b, tau) || reaches(b, a, tau);
      return normal(a) * normal(b) >= same_way ||
             std::abs(a.t - b.t) * surface->edges()[a.edge].length <= tau;
    }


    void
    ContactCrossings::examine(const unsigned int        edge,
                              const double              s,
                              const std::vector<Chord> &chords,
                              const IsInContact        &is_in_contact,
                              StepFault                &fault) const
    {
      // Upper bound of the ratio of an arc's length to its chord.
      constexpr double arc = 2.;
      // Fraction of the path inside the body after which the repeated step ends.
      constexpr double part = 0.25;
      // Part of tau: a point that is less deep than that begins at the face.
      constexpr double at_face = 0.1;

      const auto        &edges        = surface->edges();
      const Body        &body         = bodies[edges[edge].body];
      const unsigned int other_number = edges[chords[0].edge].body;
      const Body        &other        = bodies[other_number];
      const Point<2> x_0 = position(edge, s, 0.), x_1 = position(edge, s, 1.);
      const double   bound =
        arc * ((x_1 - x_0 - other.motion).norm() + other.radius);
      std::vector<Chord> near_chords;
      const Place        begin = nearest(x_0, chords, 0., bound, &near_chords);
      if (near_chords.empty() && begin.gap >= 0.)
        return;
      Path path;
      if (!near_chords.empty())
        follow(edge, s, near_chords, path);
      if (!path.crosses && begin.gap >= 0.)
        return;

      const Place  end        = nearest(x_1, chords, 1., 0., nullptr);
      const bool   was_inside = begin.gap < 0., is_inside = end.gap < 0.;
      const bool   ends_inside = is_inside || !path.crosses;
      const double entered     = was_inside ? 0. : path.begin;
      const double left        = ends_inside ? 1. : path.end;
      const Place &in          = was_inside ? begin : path.first;
      const Place &out         = ends_inside ? end : path.last;
      const double tau         = std::min(body.tau, other.tau);
      const auto   is_touching = [&]() {
        return is_in_contact(edge, other_number) ||
               (s == 0. && edges[edge].previous != invalid_index &&
                is_in_contact(edges[edge].previous, other_number));
      };
      // A point that is pushed out all the time and crosses no face is at most nearer to another one.
      const bool  stays_inside = was_inside && is_inside && !path.crosses;
      double      retry        = 0.;
      std::string what;
      const auto  would_pass = [&](const std::string &where) {
        return "that would pass " + where + " '" + surface->name(in.edge) +
               "' without being stopped";
      };
      if (out.edge == invalid_index)
      {
        retry = part;
        what  = "near '" + surface->name(in.edge) +
               "', from which it would move so far that the ends of a face "
               "there are one and the same number";
      }
      else if (!is_same_side(in, out, other.tau) &&
               !(stays_inside && is_touching() &&
                 is_same_side(in, out, other.corner_length)))
      {
        retry = entered + part * (left - entered);
        what  = would_pass(is_inside ? "beyond the middle of" : "through");
      }
      else if (-begin.gap < at_face * tau && is_inside && -end.gap > tau &&
               !is_touching())
      {
        retry = entered + 0.5 * tau / -end.gap * (1. - entered);
        what  = would_pass("into");
      }
      if (retry == 0. || (fault.retry > 0. && fault.retry <= retry))
        return;
      fault = fault_of(
        *surface, edge, edges.front().start + Tensor<1, 2>(x_0), what, retry);
    }


    StepFault
    ContactCrossings::find_excessive_deformation() const
    {
      for (unsigned int e = 0; e < surface->edges().size(); ++e)
      {
        const Body &body = bodies[surface->edges()[e].body];
        // This is true for NaN, too.
        if (!(body.radius <= body.circumference))
        {
          std::ostringstream text;
          text << "a body with the face '" << surface->name(e)
               << "' that deforms by " << body.radius
               << " m in the step, more than its circumference";
          return {text.str(), "allow smaller steps, or reduce the loads", 0.};
        }
      }
      return {};
    }


    StepFault
    ContactCrossings::find(std::vector<Pair>  pairs,
                           const IsInContact &is_in_contact) const
    {
      const StepFault excessive = find_excessive_deformation();
      if (!excessive.reason.empty())
        return excessive;
      const auto &edges = surface->edges();
      const auto  key   = [&](const Pair &pair) {
        return std::make_tuple(pair.first,
                               edges[pair.second].body,
                               pair.second);
      };
      std::sort(pairs.begin(), pairs.end(), [&](const Pair &a, const Pair &b) {
        return key(a) < key(b);
      });
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

      StepFault          fault;
      std::vector<Chord> chords;
      for (unsigned int k = 0; k < pairs.size();)
      {
        const unsigned int edge = pairs[k].first;
        const unsigned int body = edges[pairs[k].second].body;
        chords.clear();
        for (; k < pairs.size() && pairs[k].first == edge &&
               edges[pairs[k].second].body == body;
             ++k)
        {
          const unsigned int face = pairs[k].second, n = n_chords(face);
          for (unsigned int i = 0; i < n; ++i)
            chords.push_back({face, i / double(n), (i + 1) / double(n)});
        }
        const unsigned int n = n_chords(edge);
        for (unsigned int i = 0; i < n; ++i)
          // A concave corner cannot reach anything before its neighbours do.
          if (i > 0 || edges[edge].at_start != Corner::concave)
            examine(edge, i / double(n), chords, is_in_contact, fault);
        if (edges[edge].next == invalid_index)
          examine(edge, 1., chords, is_in_contact, fault);
      }
      return fault;
    }
  } // namespace internal
} // namespace NMM
