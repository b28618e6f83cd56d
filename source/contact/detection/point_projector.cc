#include <algorithm>
#include <cmath>
#include <contact/detection/corner_rules.h>
#include <contact/detection/point_projector.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    bool
    goes_on(const ContactSurface &surface,
            const unsigned int    edge,
            const unsigned int    other,
            const unsigned int    n_edges)
    {
      constexpr auto smooth = ContactSurface::Corner::smooth;
      const auto    &edges  = surface.edges();
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


    PointProjector::PointProjector(const ContactSurface    &surface,
                                   const ContactSearch     &search,
                                   const PointMaker        &maker,
                                   const ContactMemory     &memory,
                                   const ContactParameters &parameters)
      : surface(&surface)
      , search(&search)
      , narrow(surface, search)
      , maker(&maker)
      , memory(&memory)
      , integration(parameters.integration)
      , rounded(surface, parameters.rounded_corners, parameters.corner_rounding)
    {
    }


    void
    PointProjector::begin_step(const double new_reach, const PointSet &new_set)
    {
      reach = new_reach;
      set   = &new_set;
    }


    void
    PointProjector::admit_any_depth()
    {
      edge_motions.clear();
      admitted_depth = std::numeric_limits<double>::max();
    }


    void
    PointProjector::bound_new_contact()
    {
      constexpr double rounding = 1e-6;
      if (admits_any_depth())
        return;
      admitted_depth = rounding * reach;
      search->find_motions_since_begin(edge_motions);
    }


    double
    PointProjector::gap_of_displacements(
      const ContactPoint      &point,
      const ContactProjection &projection) const
    {
      // Fraction of the reach below which faces are drawn as touching and have no gap.
      constexpr double touching = 1e-9;

      const unsigned int          face = projection.master;
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


    AdmittedContact
    PointProjector::find_admitted(const ContactPoint &point,
                                  const PointData    &fixed) const
    {
      AdmittedContact admitted;
      const double own = edge_motions.empty() ? 0. : edge_motions[point.edge];
      admitted.depth   = admitted_depth + own;
      admitted.motions = {edge_motions.data(), edge_motions.size()};
      // Another point of the same edge may be far behind the same face, beyond a corner of it.
      admitted.touching_depth = admitted.depth + memory->touching_reach;
      admitted.beside         = {set->faces_beside.data() + fixed.beside_begin,
                                 fixed.beside_end - fixed.beside_begin};
      admitted.rounded        = rounded.excluded(point.edge, point.s);
      if (point.edge < memory->touching.size())
      {
        const auto &known = memory->touching[point.edge];
        admitted.touching = {known.data(), known.size()};
      }
      return admitted;
    }


    ContactProjection
    PointProjector::find_master(const ContactPoint          &point,
                                const PointData             &fixed,
                                const ContactSurface::Place &slave) const
    {
      const auto masters = masters_of(*search, fixed);

      const AdmittedContact admitted = find_admitted(point, fixed);
      if (fixed.corner >= PointKind::along)
      {
        ContactProjection result =
          narrow.project(slave, masters, fixed.slack, fixed.home, admitted);
        // An overlap that is much deeper than long came in through the other face of the corner.
        if (result.master != invalid_index &&
            result.gap < -CornerRules::deepest_of_piece * fixed.piece_length -
                           CornerRules::shortest_piece * maker->size_at(fixed))
          result = ContactProjection();
        return result;
      }
      const auto entrance =
        memory->entrances.find(place_key(*surface, point.edge, fixed.corner));
      const auto project_on =
        [&](const dealii::ArrayView<const unsigned int> faces) {
          return narrow.project_corner(slave,
                                       normal_of_other_edge(point, fixed),
                                       faces,
                                       entrance == memory->entrances.end()
                                         ? invalid_index
                                         : entrance->second,
                                       admitted);
        };
      const ContactProjection result = project_on(masters);
      const unsigned int      beyond = face_beyond_concave_end(result);
      if (beyond == invalid_index ||
          std::find(masters.begin(), masters.end(), beyond) == masters.end() ||
          share(point, fixed, slave.normal(), result.normal) > 0.)
        return result;
      const ContactProjection other =
        project_on(dealii::ArrayView<const unsigned int>(&beyond, 1));
      return other.master != invalid_index && other.gap < 0. ? other : result;
    }


    unsigned int
    PointProjector::face_beyond_concave_end(
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


    Tensor<1, 2>
    PointProjector::normal_of_other_edge(const ContactPoint &point,
                                         const PointData    &fixed) const
    {
      const unsigned int          corner = fixed.corner;
      const ContactSurface::Edge &edge   = surface->edges()[point.edge];
      const unsigned int other = corner == 0 ? edge.previous : edge.next;
      return other == invalid_index
               ? Tensor<1, 2>()
               : surface->place(other, 1. - corner).normal();
    }


    double
    PointProjector::share(const ContactPoint &point,
                          const PointData    &fixed,
                          const Tensor<1, 2> &slave_normal,
                          const Tensor<1, 2> &master_normal) const
    {
      // Faces that are not parallel touch along their projection only.
      const double       facing = -(slave_normal * master_normal);
      double             along  = NarrowPhase::along_face(facing);
      const unsigned int corner = fixed.corner;
      if (corner >= PointKind::along)
        return facing * along;
      const double other_facing =
        -(normal_of_other_edge(point, fixed) * master_normal);
      // Both edges that end at a vertex have a point there; together they are one spring.
      if (integration == ContactIntegration::points)
        return facing / (facing + std::max(0., other_facing));
      // A corner touches as a point if neither of its edges touches along its length.
      along = std::max(along, NarrowPhase::along_face(other_facing));
      return facing * (1. - along);
    }


    void
    PointProjector::stay_with_face_of_end(const ContactPoint          &point,
                                          const PointData             &fixed,
                                          const ContactSurface::Place &slave,
                                          ContactProjection &projection) const
    {
      const bool         touches = fixed.gap_end < fixed.offset;
      const unsigned int face = touches ? fixed.master_end : fixed.master_begin;
      if (touches == (fixed.gap_begin < fixed.offset) ||
          face == invalid_index || face == projection.master ||
          projection.master == invalid_index ||
          surface->edges()[face].body !=
            surface->edges()[projection.master].body)
        return;
      const ContactProjection there =
        narrow.project_corner(slave,
                              normal_of_other_edge(point, fixed),
                              dealii::ArrayView<const unsigned int>(&face, 1),
                              invalid_index,
                              find_admitted(point, fixed));
      if (there.master != invalid_index)
        projection = there;
    }


    ContactProjection
    PointProjector::project_on(const unsigned int           edge,
                               const ContactPoint          &point,
                               const PointData             &fixed,
                               const ContactSurface::Place &slave) const
    {
      return narrow.project(slave,
                            dealii::ArrayView<const unsigned int>(&edge, 1),
                            fixed.slack,
                            fixed.home,
                            find_admitted(point, fixed));
    }


    ContactProjection
    PointProjector::project_end(const ContactPoint          &point,
                                const PointData             &fixed,
                                const ContactSurface::Place &slave) const
    {
      const ContactProjection projection = find_master(point, fixed, slave);
      if (fixed.corner == PointKind::along && point.master != invalid_index &&
          projection.master != invalid_index &&
          point.master != projection.master &&
          goes_on(*surface, point.master, projection.master, 1))
      {
        const ContactProjection last =
          project_on(point.master, point, fixed, slave);
        if (last.master != invalid_index)
          return last;
      }
      return projection;
    }


    ContactProjection
    PointProjector::project(const ContactPoint          &point,
                            const PointData             &fixed,
                            const ContactSurface::Place &slave,
                            const Positions              positions) const
    {
      ContactProjection projection = project_end(point, fixed, slave);
      if (positions == Positions::between && fixed.corner < PointKind::along)
        stay_with_face_of_end(point, fixed, slave, projection);
      // Points that are made again in a concave corner during a motion stay on their face, because
      // each change would lose or create the energy of the spring. Within a step, the face at its end
      // is found first.
      if (positions == Positions::of_motion &&
          fixed.corner >= PointKind::along && point.master == invalid_index &&
          point.stick_edge != invalid_index &&
          projection.master != invalid_index && projection.gap < 0. &&
          point.stick_edge != projection.master)
      {
        const ContactProjection last =
          project_on(point.stick_edge, point, fixed, slave);
        if (last.master != invalid_index && last.gap < 0.)
          projection = last;
      }
      // This does not apply to gaps that corners measure from another face.
      if (positions == Positions::of_statics &&
          projection.master != invalid_index &&
          projection.gap == (slave.x - projection.place.x) * projection.normal)
        projection.gap = gap_of_displacements(point, projection);
      return projection;
    }
  } // namespace internal
} // namespace NMM
