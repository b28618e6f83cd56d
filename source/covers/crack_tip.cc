#include <nmm/covers/crack_tip.h>
#include <nmm/covers/point_location.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <covers/exact_curves.h>
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

      /// Whether all curves on the edge are open joints and the same region is on both sides.
      bool
      is_crack(const Halfedge &halfedge) const
      {
        const unsigned int region = halfedge->face()->data().region;
        if (region == invalid_index ||
            halfedge->twin()->face()->data().region != region)
          return false;
        const auto &labels = halfedge->curve().data();
        return std::all_of(labels.begin(),
                           labels.end(),
                           [&](const internal::Label label) {
                             const Curve &curve =
                               mesh.curves()[mesh.piece_to_curve()[label]];
                             return curve.role == CurveRole::joint &&
                                    curve.state == JointState::open;
                           });
      }

    private:
      const PhysicalMesh &mesh;
    };


    /// Edges of the crack that ends in the target of @p last, starting there.
    std::vector<Halfedge>
    trace_crack(const Halfedge &last, const Edges &edges)
    {
      std::vector<Halfedge> path = {last->twin()};
      while (path.back()->target()->degree() == 2)
      {
        const Halfedge next = path.back()->next();
        if (!edges.is_crack(next))
          break;
        path.push_back(next);
      }
      return path;
    }


    /// Distance from the tip up to which the path of the tip passes each distance once.
    double
    distance_passed_once(const CrackTip &tip)
    {
      double radius      = 0.;
      bool   has_changed = false;
      for (const ElementEdge &edge : tip.path)
        if (has_changed)
          radius = std::min(radius, distance(edge, tip.point));
        else
        {
          radius      = distance_passed_once(edge, tip.point);
          has_changed = !leads_away(edge, tip.point);
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


  std::vector<CrackTip>
  find_crack_tips(const PhysicalMesh &physical_mesh)
  {
    const Arrangement &arrangement = physical_mesh.arrangement().arrangement;
    const Edges        edges(physical_mesh);

    std::vector<Halfedge> ends;
    for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end();
         ++v)
      if (!v->is_isolated() && v->degree() == 1 &&
          edges.is_crack(v->incident_halfedges()))
        ends.push_back(v->incident_halfedges());

    if (ends.empty())
      return {};

    std::vector<std::pair<Halfedge, ElementEdge>> solid_edges;
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e)
    {
      const Halfedge halfedge = e;
      if (halfedge->face()->data().region != invalid_index ||
          halfedge->twin()->face()->data().region != invalid_index)
        solid_edges.emplace_back(halfedge, edges(halfedge));
    }

    const auto  &corners = physical_mesh.bounding_box().get_boundary_points();
    const double least_radius = 1e-9 * corners.first.distance(corners.second);
    std::vector<CrackTip> tips;
    for (const Halfedge &end : ends)
    {
      const std::vector<Halfedge> path = trace_crack(end, edges);
      CrackTip                    tip;
      for (const Halfedge &halfedge : path)
        tip.path.push_back(edges(halfedge));
      const ElementEdge &first = tip.path.front();
      tip.point                = first.start;
      tip.region               = end->face()->data().region;
      tip.curve = physical_mesh.piece_to_curve()[*end->curve().data().begin()];
      if (first.radius == 0.)
        tip.direction = first.start - first.end;
      else
      {
        const dealii::Tensor<1, 2> spoke = first.start - first.center;
        tip.direction                    = (first.radius > 0. ? 1. : -1.) *
                        dealii::Point<2>(spoke[1], -spoke[0]);
      }
      tip.direction /= tip.direction.norm();

      tip.free_radius = distance_passed_once(tip);
      for (const auto &[halfedge, edge] : solid_edges)
        if (std::none_of(path.begin(),
                         path.end(),
                         [h = halfedge](const Halfedge &p) {
                           return p == h || p == h->twin();
                         }))
          tip.free_radius =
            std::min(tip.free_radius, distance(edge, tip.point));
      if (tip.free_radius > least_radius)
        tips.push_back(std::move(tip));
    }
    std::sort(tips.begin(),
              tips.end(),
              [](const CrackTip &a, const CrackTip &b) {
                return std::make_pair(a.point[0], a.point[1]) <
                       std::make_pair(b.point[0], b.point[1]);
              });
    return tips;
  }
} // namespace NMM
