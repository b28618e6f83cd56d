#include <nmm/covers/crack_tip.h>
#include <nmm/covers/point_location.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <covers/exact_curves.h>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace NMM
{
  namespace
  {
    using internal::Arrangement;
    using Halfedge = Arrangement::Halfedge_const_handle;
    using Vertex   = Arrangement::Vertex_const_handle;

    using internal::cross;

    /// Angle from @p a to @p b in (-pi, pi].
    double
    angle_between(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return std::atan2(cross(a, b), a * b);
    }


    /// Angle along an arc, in its own direction and in [0, 2 pi), at which the ray from its centre
    /// in the direction @p ray meets it.
    double
    angle_along(const ElementEdge &arc, const dealii::Tensor<1, 2> &ray)
    {
      double angle = angle_between(arc.start - arc.center, ray);
      if (arc.radius < 0.)
        angle = -angle;
      return angle < 0. ? angle + 2. * dealii::numbers::PI : angle;
    }


    /// Distance from @p tip up to which the path passes each distance once, if it continues with
    /// @p edge after edges that lead away from the tip.
    double
    distance_passed_once(const ElementEdge &edge, const dealii::Point<2> &tip)
    {
      const double begin = tip.distance(edge.start);
      const double end   = tip.distance(edge.end);
      if (edge.radius == 0.)
        return (edge.start - tip) * (edge.end - edge.start) >= 0.
                 ? end
                 : distance(edge, tip);
      // The farthest point of the circle is opposite to the tip. The distance grows along the half
      // circle that ends there, and falls after it.
      const double angle_to_turn = angle_along(edge, edge.center - tip);
      return begin > 0. && angle_to_turn > dealii::numbers::PI
               ? distance(edge, tip)
               : end;
    }


    /// Whether the distance from @p tip grows along the whole edge.
    bool
    leads_away(const ElementEdge &edge, const dealii::Point<2> &tip)
    {
      if (edge.radius == 0.)
        return (edge.start - tip) * (edge.end - edge.start) >= 0.;
      const double angle_to_turn = angle_along(edge, edge.center - tip);
      return (tip == edge.start || angle_to_turn <= dealii::numbers::PI) &&
             std::abs(swept_angle(edge)) <= angle_to_turn;
    }


    /// The point of an edge at the distance @p r from @p tip, if the distance grows along the edge
    /// from below r to above r.
    dealii::Point<2>
    point_at_distance(const ElementEdge      &edge,
                      const dealii::Point<2> &tip,
                      const double            r)
    {
      if (edge.radius == 0.)
      {
        // Solve |a + t d| = r for t.
        const dealii::Tensor<1, 2> a = edge.start - tip,
                                   d = edge.end - edge.start;
        const double b = a * d, c = r * r - a.norm_square();
        const double root =
          std::sqrt(std::max(0., b * b + d.norm_square() * c));
        return edge.start + (b + root > 0. ? c / (b + root) : 0.) * d;
      }
      // Law of cosines in the triangle of tip, centre and point.
      const dealii::Tensor<1, 2> ray    = edge.center - tip;
      const double               length = ray.norm();
      const double               cosine =
        (r * r + length * length - edge.radius * edge.radius) /
        (2. * r * length);
      const double phi = std::acos(std::min(1., std::max(-1., cosine)));
      // Where the distance grows along a counter-clockwise arc, the point is to the right of
      // the ray from the tip to the centre.
      const double               turn = edge.radius > 0. ? -phi : phi;
      const double               c = std::cos(turn), s = std::sin(turn);
      const dealii::Tensor<1, 2> e = ray / length;
      return tip +
             r * dealii::Point<2>(c * e[0] - s * e[1], s * e[0] + c * e[1]);
    }


    /// Edges of an arrangement in doubles, and which of them are cracks.
    class Edges
    {
    public:
      explicit Edges(const PhysicalMesh &mesh)
        : mesh(mesh)
      {
      }

      ElementEdge
      operator()(const Halfedge &halfedge) const
      {
        ElementEdge edge;
        edge.start = internal::to_double(halfedge->source()->point());
        edge.end   = internal::to_double(halfedge->target()->point());

        internal::set_circle(halfedge->curve(),
                             halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT,
                             mesh.pieces(),
                             edge);
        if (edge.is_arc() &&
            is_nearly_straight(edge.start, edge.end, std::abs(edge.radius)))
          edge.radius = 0.;
        return edge;
      }

      /// Whether there is solid on both sides and the displacement can jump.
      bool
      is_open(const Halfedge &halfedge) const
      {
        return is_inside(halfedge) && !all_curves(halfedge, is_tied_curve);
      }

      /// Whether there is solid on both sides, and open joints are the only curves at which the
      /// displacement can jump. Boundaries of two domains may coincide, and are none.
      bool
      is_crack(const Halfedge &halfedge) const
      {
        return is_open(halfedge) &&
               all_curves(halfedge, [](const Curve &curve) {
                 return curve.role == CurveRole::joint ||
                        curve.role == CurveRole::interface;
               });
      }

      /// Whether there is solid on both sides, which interfaces or closed joints tie to each other.
      bool
      is_tied(const Halfedge &halfedge) const
      {
        return is_inside(halfedge) && all_curves(halfedge, is_tied_curve);
      }

      /// Whether the edge belongs to the circle of a tip cover only.
      bool
      is_auxiliary(const Halfedge &halfedge) const
      {
        return all_curves(halfedge, [](const Curve &curve) {
          return curve.is_auxiliary;
        });
      }

      /// A curve on the edge, an index for PhysicalMesh::curves(): a joint that is open, if there
      /// is one.
      unsigned int
      curve(const Halfedge &halfedge) const
      {
        unsigned int result = invalid_index;
        for (const internal::Label label : halfedge->curve().data())
        {
          const unsigned int c = mesh.piece_to_curve()[label];
          if (result == invalid_index || is_tied_curve(mesh.curves()[result]))
            result = c;
        }
        return result;
      }

    private:
      const PhysicalMesh &mesh;

      static bool
      is_tied_curve(const Curve &curve)
      {
        return curve.role == CurveRole::interface ||
               (curve.role == CurveRole::joint &&
                curve.state == JointState::closed);
      }

      static bool
      is_inside(const Halfedge &halfedge)
      {
        return halfedge->face()->data().region != invalid_index &&
               halfedge->twin()->face()->data().region != invalid_index;
      }

      template <typename Predicate>
      bool
      all_curves(const Halfedge &halfedge, const Predicate &predicate) const
      {
        const auto &labels = halfedge->curve().data();
        return std::all_of(
          labels.begin(), labels.end(), [&](const internal::Label label) {
            return predicate(mesh.curves()[mesh.piece_to_curve()[label]]);
          });
      }
    };


    /// The edges of the arrangement that end at @p vertex, without circles of tip covers.
    std::vector<Halfedge>
    edges_at(const Vertex &vertex, const Edges &edges)
    {
      std::vector<Halfedge> result;
      const auto            first = vertex->incident_halfedges();
      auto                  next  = first;
      do
        if (!edges.is_auxiliary(next))
          result.push_back(next);
      while (++next != first);
      return result;
    }


    /// The edge on which the tip of a crack at @p vertex ends, or none if there is no tip.
    std::optional<Halfedge>
    find_end(const Vertex &vertex, const Edges &edges)
    {
      std::optional<Halfedge> end;
      if (vertex->is_isolated())
        return end;
      for (const Halfedge &halfedge : edges_at(vertex, edges))
        if (!edges.is_tied(halfedge))
        {
          if (end || !edges.is_crack(halfedge))
            return {};
          end = halfedge;
        }
      return end;
    }


    /// The edges that lead from the target of @p last to the first point at which another curve
    /// arrives, or at which @p belongs no longer holds.
    template <typename Predicate>
    std::vector<Halfedge>
    trace(const Halfedge &last, const Edges &edges, const Predicate &belongs)
    {
      std::vector<Halfedge> path = {last->twin()};
      while (path.back()->target() != last->target())
      {
        std::vector<Halfedge> others = edges_at(path.back()->target(), edges);
        others.erase(std::find(others.begin(), others.end(), path.back()));
        if (others.size() != 1 || !belongs(others[0]))
          break;
        path.push_back(others[0]->twin());
      }
      return path;
    }


    /// Distance from the start of a path up to which it passes each distance once.
    double
    distance_passed_once(const std::vector<ElementEdge> &path,
                         const dealii::Point<2>         &start)
    {
      double radius      = 0.;
      bool   has_changed = false;
      for (const ElementEdge &edge : path)
        if (has_changed)
          radius = std::min(radius, distance(edge, start));
        else
        {
          radius      = distance_passed_once(edge, start);
          has_changed = !leads_away(edge, start);
        }
      return radius;
    }
  } // namespace


  double
  CrackTip::angle(const dealii::Point<2>     &x,
                  const dealii::Tensor<1, 2> &into_solid) const
  {
    const dealii::Tensor<1, 2> ray = x - point;
    const double               r   = ray.norm();
    // Polar angle of the crack at the same distance, followed along the crack from the tip.
    double               crack    = dealii::numbers::PI;
    dealii::Tensor<1, 2> backward = -direction;
    for (const ElementEdge &edge : path)
    {
      const bool                 ends_here = point.distance(edge.end) >= r;
      const dealii::Tensor<1, 2> next =
        (ends_here ? point_at_distance(edge, point, r) : edge.end) - point;
      if (next.norm_square() > 0.)
      {
        crack += angle_between(backward, next);
        backward = next;
      }
      if (ends_here)
        break;
    }
    // Angle from the crack to x. Seen from the tip along the crack, it is just above -2 pi for
    // points on the left and just below 0 for points on the right.
    double from_crack = r > 0. ? angle_between(backward, ray) : 0.;
    if (into_solid.norm_square() > 0. &&
        std::abs(from_crack) < 0.5 * dealii::numbers::PI)
    {
      const bool is_left = cross(backward, into_solid) > 0.;
      return crack + from_crack - (is_left ? 2. * dealii::numbers::PI : 0.);
    }
    if (from_crack > 0.)
      from_crack -= 2. * dealii::numbers::PI;
    return crack + from_crack;
  }


  namespace
  {
    /// The largest coordinate of the solid times the rounding of a number [m].
    double
    rounding_of_coordinates(const PhysicalMesh &physical_mesh)
    {
      double largest = 0.;
      for (const dealii::Point<2> &corner :
           {physical_mesh.bounding_box().get_boundary_points().first,
            physical_mesh.bounding_box().get_boundary_points().second})
        for (unsigned int d = 0; d < 2; ++d)
          largest = std::max(largest, std::abs(corner[d]));
      return largest * std::numeric_limits<double>::epsilon();
    }


    /// The edges of the crack tips, in the order of their coordinates.
    std::vector<Halfedge>
    find_ends(const PhysicalMesh &physical_mesh, const Edges &edges)
    {
      const Arrangement &arrangement = physical_mesh.arrangement().arrangement;
      std::vector<std::pair<std::pair<double, double>, Halfedge>> ends;
      for (auto v = arrangement.vertices_begin();
           v != arrangement.vertices_end();
           ++v)
        if (const auto end = find_end(v, edges))
        {
          const dealii::Point<2> x = internal::to_double(v->point());
          ends.push_back({{x[0], x[1]}, *end});
        }
      std::stable_sort(ends.begin(),
                       ends.end(),
                       [](const auto &a, const auto &b) {
                         return a.first < b.first;
                       });
      std::vector<Halfedge> result;
      for (const auto &end : ends)
        result.push_back(end.second);
      return result;
    }


    /// Unit tangent at the start of an edge.
    dealii::Tensor<1, 2>
    tangent_at_start(const ElementEdge &edge)
    {
      dealii::Tensor<1, 2> tangent = edge.end - edge.start;
      if (edge.is_arc())
      {
        const dealii::Tensor<1, 2> spoke = edge.start - edge.center;
        tangent =
          (edge.radius > 0. ? 1. : -1.) * dealii::Point<2>(-spoke[1], spoke[0]);
      }
      return tangent / tangent.norm();
    }


    /// The tip at the target of @p end, without free radius and nearest curve, and the edges that
    /// may lie in its disk.
    CrackTip
    make_tip(const Halfedge         &end,
             const Edges            &edges,
             std::set<const void *> &own)
    {
      CrackTip tip;
      for (const Halfedge &halfedge :
           trace(end, edges, [&](const auto &h) { return edges.is_crack(h); }))
      {
        tip.path.push_back(edges(halfedge));
        own.insert({&*halfedge, &*halfedge->twin()});
      }
      for (const Halfedge &halfedge : edges_at(end->target(), edges))
      {
        const unsigned int region = halfedge->face()->data().region;
        if (std::find(tip.regions.begin(), tip.regions.end(), region) ==
            tip.regions.end())
          tip.regions.push_back(region);
        if (!edges.is_tied(halfedge))
          continue;
        tip.tied_curve = edges.curve(halfedge);
        for (const Halfedge &tied : trace(halfedge, edges, [&](const auto &h) {
               return edges.is_tied(h);
             }))
          own.insert({&*tied, &*tied->twin()});
      }
      tip.point     = tip.path.front().start;
      tip.direction = -tangent_at_start(tip.path.front());
      tip.region    = tip.regions.front();
      tip.curve     = edges.curve(end);
      return tip;
    }


    /// Free radii below this number of times the rounding of coordinates are not resolved.
    constexpr double resolved = 1e4;


    /// The edges with solid on at least one side, in doubles.
    std::vector<std::pair<Halfedge, ElementEdge>>
    find_solid_edges(const PhysicalMesh &physical_mesh, const Edges &edges)
    {
      const Arrangement &arrangement = physical_mesh.arrangement().arrangement;
      std::vector<std::pair<Halfedge, ElementEdge>> result;
      for (auto e = arrangement.edges_begin(); e != arrangement.edges_end();
           ++e)
      {
        const Halfedge halfedge = e;
        if (halfedge->face()->data().region != invalid_index ||
            halfedge->twin()->face()->data().region != invalid_index)
          result.emplace_back(halfedge, edges(halfedge));
      }
      return result;
    }


    /// The tips with room for a singular field, or those without.
    std::vector<CrackTip>
    find_tips(const PhysicalMesh &physical_mesh, const bool with_room)
    {
      const Edges                 edges(physical_mesh);
      const std::vector<Halfedge> ends = find_ends(physical_mesh, edges);
      if (ends.empty())
        return {};
      const auto   solid_edges = find_solid_edges(physical_mesh, edges);
      const double least_room =
        resolved * rounding_of_coordinates(physical_mesh);
      std::vector<CrackTip> tips;
      for (const Halfedge &end : ends)
      {
        std::set<const void *> own;
        CrackTip               tip  = make_tip(end, edges, own);
        double                 room = distance_passed_once(tip.path, tip.point),
               to_auxiliary         = std::numeric_limits<double>::max();
        tip.nearest_curve           = tip.curve;
        for (const auto &[halfedge, edge] : solid_edges)
        {
          if (own.count(&*halfedge) > 0)
            continue;
          const double length = distance(edge, tip.point);
          if (edges.is_auxiliary(halfedge))
            to_auxiliary = std::min(to_auxiliary, length);
          else if (length < room)
          {
            room              = length;
            tip.nearest_curve = edges.curve(halfedge);
          }
        }
        tip.free_radius = std::min(room, to_auxiliary);
        if ((room > least_room) == with_room)
          tips.push_back(std::move(tip));
      }
      return tips;
    }


    /// The largest angle of the solid between neighbours of the given open edges, which start at
    /// one vertex [rad].
    double
    largest_angle(const std::vector<Halfedge> &open, const Edges &edges)
    {
      std::vector<double> angles;
      for (const Halfedge &halfedge : open)
      {
        const dealii::Tensor<1, 2> tangent = tangent_at_start(edges(halfedge));
        angles.push_back(std::atan2(tangent[1], tangent[0]));
      }
      std::sort(angles.begin(), angles.end());
      double largest =
        angles.front() + 2. * dealii::numbers::PI - angles.back();
      for (unsigned int i = 1; i < angles.size(); ++i)
        largest = std::max(largest, angles[i] - angles[i - 1]);
      return largest;
    }


    /// The edges that start at @p vertex where cracks, and nothing else but tied curves, meet
    /// there. Otherwise none.
    std::vector<Halfedge>
    cracks_from(const Vertex &vertex, const Edges &edges)
    {
      std::vector<Halfedge> open;
      if (vertex->is_isolated())
        return open;
      for (const Halfedge &halfedge : edges_at(vertex, edges))
        if (edges.is_crack(halfedge))
          open.push_back(halfedge->twin());
        else if (!edges.is_tied(halfedge))
          return {};
      return open;
    }
  } // namespace


  std::vector<CrackCorner>
  find_crack_corners(const PhysicalMesh &physical_mesh, const double least_turn)
  {
    const Edges        edges(physical_mesh);
    const Arrangement &arrangement = physical_mesh.arrangement().arrangement;
    const double least_room = resolved * rounding_of_coordinates(physical_mesh);
    std::vector<std::pair<Halfedge, ElementEdge>> solid_edges;
    std::vector<CrackCorner>                      corners;
    for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end();
         ++v)
    {
      const std::vector<Halfedge> open = cracks_from(v, edges);
      if (open.size() < 2)
        continue;
      CrackCorner corner;
      corner.point = internal::to_double(v->point());
      corner.angle = largest_angle(open, edges);
      if (corner.angle < dealii::numbers::PI + least_turn)
        continue;
      if (solid_edges.empty())
        solid_edges = find_solid_edges(physical_mesh, edges);
      corner.free_radius = std::numeric_limits<double>::max();
      std::set<const void *> own;
      for (const Halfedge &first : open)
      {
        std::vector<ElementEdge> path;
        for (const Halfedge &halfedge :
             trace(first->twin(), edges, [&](const auto &h) {
               return edges.is_crack(h);
             }))
        {
          path.push_back(edges(halfedge));
          own.insert({&*halfedge, &*halfedge->twin()});
        }
        corner.free_radius = std::min(corner.free_radius,
                                      distance_passed_once(path, corner.point));
      }
      for (const auto &[halfedge, edge] : solid_edges)
        if (own.count(&*halfedge) == 0 && !edges.is_auxiliary(halfedge))
          corner.free_radius =
            std::min(corner.free_radius, distance(edge, corner.point));
      if (corner.free_radius > least_room)
        corners.push_back(corner);
    }
    return corners;
  }


  std::vector<CrackTip>
  find_crack_tips(const PhysicalMesh &physical_mesh)
  {
    return find_tips(physical_mesh, /* with_room = */ true);
  }


  std::vector<CrackTip>
  find_tips_without_room(const PhysicalMesh &physical_mesh)
  {
    return find_tips(physical_mesh, /* with_room = */ false);
  }


  std::vector<CrackEnd>
  find_crack_ends(const PhysicalMesh &physical_mesh)
  {
    const Edges           edges(physical_mesh);
    std::vector<CrackEnd> result;
    for (const Halfedge &end : find_ends(physical_mesh, edges))
    {
      CrackEnd crack_end;
      crack_end.point = internal::to_double(end->target()->point());
      for (const Halfedge &halfedge :
           trace(end, edges, [&](const auto &h) { return edges.is_crack(h); }))
      {
        const ElementEdge edge = edges(halfedge);
        crack_end.length += edge.is_arc()
                              ? std::abs(swept_angle(edge) * edge.radius)
                              : edge.start.distance(edge.end);
      }
      result.push_back(crack_end);
    }
    return result;
  }


  double
  least_cell_size(const PhysicalMesh &physical_mesh)
  {
    return 100. * rounding_of_coordinates(physical_mesh);
  }
} // namespace NMM
