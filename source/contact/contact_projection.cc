// Projection of contact points onto the faces of other bodies.
#include <nmm/contact/contact.h>

#include <algorithm>
#include <cmath>
#include <contact/contact_data.h>

namespace NMM
{
  using namespace internal;
  using dealii::Tensor;

  namespace
  {
    /// Rounding of a difference of two positions on edges, one of which is @p place, in the reference
    /// configuration [m].
    double
    rounding_of(const ContactSurface::Place &place)
    {
      // The coordinates of both edges are rounded.
      constexpr double parts = 1e-15;
      return parts *
             (std::abs(place.x[0]) + std::abs(place.x[1]) + place.a.norm());
    }
  } // namespace


  double
  Contact::Data::gap_of_displacements(const unsigned int       q,
                                      const ContactProjection &projection) const
  {
    // Fraction of the reach below which faces are drawn as touching and have no gap.
    constexpr double touching = 1e-9;

    const ContactPoint         &point = points[q];
    const unsigned int          face  = projection.master;
    const ContactSurface::Place slave =
      surface->reference_place(point.edge, point.s);
    const ContactSurface::Place master =
      surface->reference_place(face, projection.t);
    const ContactSurface::Edge &edge   = surface->edges()[face];
    const Tensor<1, 2>          normal = master.normal();
    const Tensor<1, 2>          d      = slave.x - master.x;
    // For a straight face the gap does not depend on where it is measured.
    double gap = (edge.radius == 0. ? slave.x - edge.start : d) * normal;
    if (std::abs(gap) <= touching * reach)
      gap = 0.;
    return gap + d * (projection.normal - normal) +
           (surface->displacement(point.edge, point.s) -
            surface->displacement(face, projection.t)) *
             projection.normal;
  }


  ContactProjection
  Contact::Data::project_frozen(const unsigned int           q,
                                const ContactSurface::Place &slave)
  {
    FrozenPoint       &known      = frozen[q];
    ContactProjection &projection = known.projection;
    ContactPoint      &point      = points[q];
    if (!known.is_known)
    {
      projection     = project(q, slave);
      known.is_known = true;
      if (projection.master != invalid_index)
        known.gap = projection.gap - gap_of_displacements(q, projection);
      return projection;
    }
    point.x = slave.x;
    if (projection.master == invalid_index)
      return projection;
    point.gap = projection.gap =
      gap_of_displacements(q, projection) + known.gap;
    // Forces are those at the frozen place. The anchor after this state is accepted is the place
    // that the point has reached.
    const ContactSurface::Place place =
      surface->place(projection.master, projection.t);
    point.t =
      projection.t + ((slave.x - place.x) * place.a) / place.a.norm_square();
    return projection;
  }


  Tensor<1, 2>
  Contact::Data::way_from_stick(const unsigned int           q,
                                const ContactSurface::Place &slave) const
  {
    const ContactPoint &point = points[q];
    if (is_moving())
      return slave.x - surface->place(point.stick_edge, point.stick_t).x;
    const ContactSurface::Place from =
      surface->reference_place(point.stick_edge, point.stick_t);
    Tensor<1, 2> way = surface->reference_place(point.edge, point.s).x - from.x;
    if (way.norm() <= rounding_of(from))
      way = 0.;
    return way + surface->displacement(point.edge, point.s) -
           surface->displacement(point.stick_edge, point.stick_t);
  }


  double
  Contact::Data::new_anchor(const unsigned int       q,
                            const ContactProjection &projection) const
  {
    // Fraction of the reach within which places coincide in the reference configuration.
    constexpr double same = 1e-6;

    const double initial = initial_shear(q);
    if (initial == 0.)
      return projection.t;
    const ContactPosition x =
      surface->reference_place(points[q].edge, points[q].s).x;
    double t = projection.t;
    for (unsigned int i = 0; i < 3; ++i)
    {
      const ContactSurface::Place place =
        surface->reference_place(projection.master, t);
      t += (x - place.x) * place.a / place.a.norm_square();
    }
    if (t >= -same && t <= 1. + same &&
        surface->reference_place(projection.master, t).x.distance(x) <=
          same * reach)
      return t;
    return projection.t + initial / (point_data[q].law->shear_spring() *
                                     projection.place.a.norm());
  }


  AdmittedContact
  Contact::Data::find_admitted(const unsigned int q) const
  {
    AdmittedContact admitted;
    const double own = edge_motions.empty() ? 0. : edge_motions[points[q].edge];
    admitted.depth   = admitted_depth + own;
    admitted.motions = {edge_motions.data(), edge_motions.size()};
    // Another point of the same edge may be far behind the same face, beyond a corner of it.
    admitted.touching_depth = admitted.depth + memory.touching_reach;
    const PointData &fixed  = point_data[q];
    admitted.beside         = {faces_beside.data() + fixed.beside_begin,
                               fixed.beside_end - fixed.beside_begin};
    admitted.rounded        = rounded.excluded(points[q].edge, points[q].s);
    if (points[q].edge < memory.touching.size())
    {
      const auto &known = memory.touching[points[q].edge];
      admitted.touching = {known.data(), known.size()};
    }
    return admitted;
  }


  ContactProjection
  Contact::Data::find_master(const unsigned int           q,
                             const ContactSurface::Place &slave) const
  {
    const PointData &fixed   = point_data[q];
    const auto       masters = masters_of(search, fixed);

    const AdmittedContact admitted = find_admitted(q);
    if (fixed.corner >= PointKind::along)
    {
      ContactProjection result =
        search.project(slave, masters, fixed.slack, fixed.home, admitted);
      // An overlap that is much deeper than long came in through the other face of the corner.
      if (result.master != invalid_index &&
          result.gap < -CornerRules::deepest_of_piece * fixed.piece_length -
                         CornerRules::shortest_piece * maker.size_at(fixed))
        result = ContactProjection();
      return result;
    }
    const auto entrance =
      memory.entrances.find(place_key(*surface, points[q].edge, fixed.corner));
    const auto project_on =
      [&](const dealii::ArrayView<const unsigned int> faces) {
        return search.project_corner(slave,
                                     normal_of_other_edge(q),
                                     faces,
                                     entrance == memory.entrances.end()
                                       ? invalid_index
                                       : entrance->second,
                                     admitted);
      };
    const ContactProjection result = project_on(masters);
    const unsigned int      beyond = face_beyond_concave_end(result);
    if (beyond == invalid_index ||
        std::find(masters.begin(), masters.end(), beyond) == masters.end() ||
        share(q, slave.normal(), result.normal) > 0.)
      return result;
    const ContactProjection other =
      project_on(dealii::ArrayView<const unsigned int>(&beyond, 1));
    return other.master != invalid_index && other.gap < 0. ? other : result;
  }


  unsigned int
  Contact::Data::face_beyond_concave_end(
    const ContactProjection &projection) const
  {
    constexpr auto concave = ContactSurface::Corner::concave;
    if (projection.master == invalid_index)
      return invalid_index;
    const ContactSurface::Edge &face = surface->edges()[projection.master];
    return projection.t > 1. && face.at_end == concave     ? face.next
           : projection.t < 0. && face.at_start == concave ? face.previous
                                                           : invalid_index;
  }


  bool
  Contact::Data::goes_on(const unsigned int edge,
                         const unsigned int other,
                         const unsigned int n_edges) const
  {
    constexpr auto smooth = ContactSurface::Corner::smooth;
    const auto    &edges  = surface->edges();
    if (edge == other)
      return true;
    for (const bool forward : {true, false})
    {
      unsigned int e = edge;
      for (unsigned int i = 0; i < n_edges && e != invalid_index; ++i)
      {
        const auto &at = edges[e];
        if ((forward ? at.at_end : at.at_start) != smooth)
          break;
        e = forward ? at.next : at.previous;
        if (e == other)
          return true;
      }
    }
    return false;
  }


  Tensor<1, 2>
  Contact::Data::normal_of_other_edge(const unsigned int q) const
  {
    const unsigned int          corner = point_data[q].corner;
    const ContactSurface::Edge &edge   = surface->edges()[points[q].edge];
    const unsigned int          other = corner == 0 ? edge.previous : edge.next;
    return other == invalid_index ? Tensor<1, 2>()
                                  : surface->place(other, 1. - corner).normal();
  }


  double
  Contact::Data::share(const unsigned int  q,
                       const Tensor<1, 2> &slave_normal,
                       const Tensor<1, 2> &master_normal) const
  {
    // Faces that are not parallel touch along their projection only.
    const double       facing = -(slave_normal * master_normal);
    double             along  = ContactSearch::along_face(facing);
    const unsigned int corner = point_data[q].corner;
    if (corner >= PointKind::along)
      return facing * along;
    const double other_facing = -(normal_of_other_edge(q) * master_normal);
    // Both edges that end at a vertex have a point there; together they are one spring.
    if (parameters.integration == ContactIntegration::points)
      return facing / (facing + std::max(0., other_facing));
    // A corner touches as a point if neither of its edges touches along its length.
    along = std::max(along, ContactSearch::along_face(other_facing));
    return facing * (1. - along);
  }


  void
  Contact::Data::stay_with_face_of_end(const unsigned int           q,
                                       const ContactSurface::Place &slave,
                                       ContactProjection &projection) const
  {
    const PointData   &fixed   = point_data[q];
    const bool         touches = fixed.gap_end < fixed.offset;
    const unsigned int face = touches ? fixed.master_end : fixed.master_begin;
    if (touches == (fixed.gap_begin < fixed.offset) || face == invalid_index ||
        face == projection.master || projection.master == invalid_index ||
        surface->edges()[face].body != surface->edges()[projection.master].body)
      return;
    const ContactProjection there =
      search.project_corner(slave,
                            normal_of_other_edge(q),
                            dealii::ArrayView<const unsigned int>(&face, 1),
                            invalid_index,
                            find_admitted(q));
    if (there.master != invalid_index)
      projection = there;
  }


  ContactProjection
  Contact::Data::project(const unsigned int           q,
                         const ContactSurface::Place &slave)
  {
    ContactPoint &point = points[q];
    PointData    &fixed = point_data[q];
    // The point has no share of the contact until points are made again.
    if (fixed.has_angle && point.weight == 0.)
      return ContactProjection();
    ContactProjection projection = find_master(q, slave);
    const auto        project_on = [&](const unsigned int &edge) {
      return search.project(slave,
                            dealii::ArrayView<const unsigned int>(&edge, 1),
                            fixed.slack,
                            fixed.home,
                            find_admitted(q));
    };
    if (is_between() && fixed.corner < PointKind::along)
      stay_with_face_of_end(q, slave, projection);
    // A piece ends where two edges of the master meet. Its end point stays with one of them,
    // because their normals differ slightly and the iteration would not converge.
    if (fixed.corner == PointKind::along && point.master != invalid_index &&
        projection.master != invalid_index &&
        point.master != projection.master &&
        goes_on(point.master, projection.master, 1))
    {
      const ContactProjection last = project_on(point.master);
      if (last.master != invalid_index)
        projection = last;
    }
    // Points that are made again in a concave corner during a motion stay on their face, because
    // each change would lose or create the energy of the spring. Within a step, find_end()
    // determines the face.
    if (is_moving() && !is_between() && fixed.corner >= PointKind::along &&
        point.master == invalid_index && point.stick_edge != invalid_index &&
        projection.master != invalid_index && projection.gap < 0. &&
        point.stick_edge != projection.master)
    {
      const ContactProjection last = project_on(point.stick_edge);
      if (last.master != invalid_index && last.gap < 0.)
        projection = last;
    }
    // This does not apply to gaps that corners measure from another face.
    if (!is_moving() && projection.master != invalid_index &&
        projection.gap == (slave.x - projection.place.x) * projection.normal)
      projection.gap = gap_of_displacements(q, projection);
    point.x      = slave.x;
    point.master = projection.master;
    if (projection.master == invalid_index)
    {
      point.gap = reach;
      return projection;
    }
    point.t      = projection.t;
    point.gap    = projection.gap;
    point.normal = projection.normal;
    if (!fixed.has_angle)
    {
      point.weight *= share(q, slave.normal(), projection.normal);
      fixed.has_angle = true;
      if (point.weight == 0.)
      {
        point.master    = invalid_index;
        point.gap       = reach;
        point.is_bonded = false;
        return ContactProjection();
      }
      constexpr double touching = 1e-6;
      if (!memory.has_accepted_state &&
          std::abs(projection.gap) <= touching * reach)
        point.is_bonded = laws(point.edge, projection.master).is_bond;
    }
    fixed.law = &laws(point.edge, projection.master);
    if (transmits_shear && (point.stick_edge == invalid_index ||
                            !goes_on(point.stick_edge, projection.master)))
    {
      point.stick_edge = projection.master;
      point.stick_t    = new_anchor(q, projection);
    }
    return projection;
  }
} // namespace NMM
