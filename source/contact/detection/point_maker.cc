#include <algorithm>
#include <base/in_order.h>
#include <cmath>
#include <contact/detection/corner_rules.h>
#include <contact/detection/point_maker.h>
#include <contact/detection/points.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    void
    PointSet::append(const PointSet &other)
    {
      const unsigned int first = data.size(), n_faces = faces_beside.size();
      points.insert(points.end(), other.points.begin(), other.points.end());
      data.insert(data.end(), other.data.begin(), other.data.end());
      faces_beside.insert(faces_beside.end(),
                          other.faces_beside.begin(),
                          other.faces_beside.end());
      for (unsigned int q = first; q < data.size(); ++q)
      {
        data[q].beside_begin += n_faces;
        data[q].beside_end += n_faces;
      }
    }


    std::vector<unsigned int>
    PointSet::near_slaves() const
    {
      std::vector<unsigned int> result;
      result.reserve(near_points.size());
      for (const unsigned int q : near_points)
        result.push_back(data[q].slave);
      return result;
    }


    PointMaker::PointMaker(const ContactSurface    &surface,
                           const ContactSearch     &search,
                           const ContactParameters &parameters,
                           const ContactMemory     &memory,
                           const Multipliers       &multipliers)
      : surface(&surface)
      , search(&search)
      , narrow(surface, search)
      , parameters(&parameters)
      , memory(&memory)
      , multipliers(&multipliers)
      , corner_size(corner_sizes(surface))
    {
      lobatto_rule(parameters.n_points, rule_points, rule_weights);
    }


    void
    PointMaker::make(const bool with_faces_beside, PointSet &result) const
    {
      result.clear();
      for_each_in_order<PointSet>(
        0,
        search->slaves().size(),
        [&](const unsigned int i, PointSet &made) {
          made.clear();
          if (search->corner(i) == PointKind::along)
            add_points_of(i, made);
          else
            add_corner(i, made);
          if (with_faces_beside)
            find_faces_beside(made);
        },
        [&](unsigned int, const PointSet &made) { result.append(made); });
    }


    void
    PointMaker::find_faces_beside(PointSet &made) const
    {
      for (unsigned int q = 0; q < made.points.size(); ++q)
      {
        PointData         &fixed = made.data[q];
        const unsigned int edge  = made.points[q].edge;
        fixed.beside_begin       = made.faces_beside.size();
        narrow.append_faces_beside(edge,
                                   surface->place(edge, made.points[q].s).x,
                                   masters_of(*search, fixed),
                                   CornerRules::least_depth_beside *
                                     size_at(fixed),
                                   made.faces_beside);
        fixed.beside_end = made.faces_beside.size();
      }
    }


    void
    PointMaker::restore(ContactPoint      &point,
                        PointData         &fixed,
                        const unsigned int slave) const
    {
      const auto *sticking = memory->stick_places.find(
        place_key(*surface, point.edge, fixed.corner));
      StickPlace stick;
      if (sticking != nullptr && find_stick_place(*sticking, point.s, stick))
      {
        point.stick_edge = stick.edge;
        point.stick_t    = stick.t;
        point.is_bonded  = stick.is_bonded;
        fixed.slip       = stick.slip;
      }
      if (fixed.corner < PointKind::along)
        return;
      set_initial_traction(fixed);
      if (!multipliers->are_used())
        return;
      fixed.initial_multiplier = std::max(0., fixed.initial_pressure);
      point.multiplier =
        multipliers->value(slave, fixed.s) + fixed.initial_multiplier;
      fixed.stiffening = multipliers->stiffening(slave, fixed.s);
    }


    void
    PointMaker::set_initial_traction(PointData &fixed) const
    {
      if (parameters->initial_stress.empty())
        return;
      const unsigned int       slave   = search->slaves()[fixed.slave];
      const InitialFaceStress &initial = parameters->initial_stress[slave];
      // Of two faces that touch, the slave bears the traction; next to a corner, the other one may be
      // the slave of a third body.
      if (initial.mate == invalid_index ||
          !search->comes_first(slave, initial.mate))
        return;
      const ContactSurface::Place place =
        surface->reference_place(slave, fixed.s);
      const Tensor<1, 2> normal   = place.normal();
      const Tensor<1, 2> traction = initial.at(place.x) * normal;
      fixed.initial_pressure      = -(traction * normal);
      fixed.initial_shear         = traction * place.a / place.a.norm();
    }


    ContactSurface::WeightValues
    PointMaker::weights_at(const ContactPoint &point) const
    {
      ContactSurface::Weights result;
      surface->weights(point.edge, point.s, result);
      return result;
    }


    void
    PointMaker::add_corner(const unsigned int slave, PointSet &made) const
    {
      ContactPoint point;
      PointData    fixed;
      fixed.slave  = slave;
      fixed.corner = search->corner(slave);
      point.edge   = search->slaves()[slave];
      point.s      = fixed.corner;
      // This is the weight of the end of an edge of this length in the rule with four Gauss-Lobatto
      // points.
      point.weight  = parameters->integration == ContactIntegration::points
                        ? 1.
                        : corner_size[2 * point.edge + fixed.corner] / 12.;
      fixed.weights = weights_at(point);
      restore(point, fixed, point.edge);
      made.points.push_back(point);
      made.data.push_back(fixed);
    }


    /// Number of equal parts into which a slave is divided, so that a round body rolls on its face and
    /// not on the polygon of its points. Points at the distance s on a contact of relative curvature
    /// k are corners that turn by k s. Between them the bodies sink by k s^2 / 8 more, which is
    /// 1.25e-5 / k for k s = 0.01. A body that rolls at the speed v meets each corner with the normal
    /// velocity k s v. If all of that energy was lost, the body would lose the fraction k s of its
    /// kinetic energy on a way of 1 / k. Springs return most of it: 1e-3 are lost at most, on a way of
    /// 1.1 / k, for disks of 1 m and Young's moduli from 1e9 to 2e11 Pa. So the distance need not
    /// depend on stiffness and load, which a scene without gravity does not tell.
    unsigned int
    PointMaker::n_parts_of(const unsigned int slave) const
    {
      constexpr double largest_turn = 0.01;
      // A bound for straight slaves on arcs that are much smaller than cells.
      constexpr double most_parts = 100.;

      const double curvature = narrow.largest_curvature(slave);
      if (curvature == 0.)
        return 1;
      double widest = 0.;
      for (unsigned int q = 0; q + 1 < rule_points.size(); ++q)
        widest = std::max(widest, rule_points[q + 1] - rule_points[q]);
      const double length = surface->edges()[search->slaves()[slave]].length;
      return std::min(most_parts,
                      std::ceil(widest * length * curvature / largest_turn));
    }


    bool
    PointMaker::ends_near(const unsigned int face,
                          const unsigned int edge,
                          const double       s,
                          const double       other_s) const
    {
      using CornerRules::near_division;
      const ContactPosition x = surface->place(edge, s).x;
      const double length     = x.distance(surface->place(edge, other_s).x);
      return std::min(x.distance(surface->place(face, 0.).x),
                      x.distance(surface->place(face, 1.).x)) <=
             near_division * length;
    }


    bool
    PointMaker::is_in_front(const unsigned int           face,
                            const unsigned int           other,
                            const unsigned int           slave,
                            const NarrowPhase::Division &division,
                            const double                 other_s) const
    {
      if (other == invalid_index)
        return false;
      const auto        &edges = surface->edges();
      const unsigned int edge  = search->slaves()[slave],
                         body  = edges[face].body;
      if (ends_near(face, edge, division.s, other_s))
        return true;
      if (edges[other].body == body)
        return false;
      const unsigned int nearest = narrow.face_at(slave, division.s);
      if (nearest == invalid_index || edges[nearest].body != body ||
          edges[nearest].radius != 0.)
        return false;
      if (division.master == invalid_index)
        return true;
      // Blocks do not overlap where they are drawn, so that what lies behind the face there is no
      // corner that has been pressed into it.
      const auto depth = [](const auto &face_place, const auto &x) {
        return (face_place.x - x) * face_place.normal();
      };
      const ContactSurface::Place at = surface->reference_place(nearest, 0.);
      const auto                  drawn =
        surface->reference_place(division.master, division.end).x;
      const double t = (drawn - at.x) * at.a / at.a.norm_square();
      if (t > -CornerRules::beyond_division &&
          t < 1. + CornerRules::beyond_division &&
          depth(at, drawn) > -CornerRules::beyond_rounding * parameters->reach)
        return true;
      return depth(surface->place(nearest, 0.),
                   surface->place(division.master, division.end).x) >
             CornerRules::behind_division * parameters->reach;
    }


    void
    PointMaker::add_points_of(const unsigned int slave, PointSet &made) const
    {
      const unsigned int edge      = search->slaves()[slave];
      const auto         divisions = narrow.divisions(slave, n_parts_of(slave));
      for (unsigned int i = 0; i + 1 < divisions.size(); ++i)
      {
        const NarrowPhase::Division &begin = divisions[i];
        const NarrowPhase::Division &end   = divisions[i + 1];
        unsigned int first = invalid_index, last = invalid_index;
        const double at_start =
          begin.is_of_parts ? 0. : narrow.end_slack(slave, begin, end.s, first);
        const double at_end =
          end.is_of_parts ? 0. : narrow.end_slack(slave, end, begin.s, last);
        const double length = end.s - begin.s;
        // Where a joint crosses others, corners of several bodies coincide, and that of the division
        // may belong to a body behind the one that the piece touches. So may the corner of a body
        // behind a thin one, which divides the slave, but not the face that lies on it.
        const unsigned int between =
          first == invalid_index && last == invalid_index
            ? invalid_index
            : narrow.face_at(slave, begin.s + 0.5 * length);
        const bool is_known = between != invalid_index;
        if (is_known && is_in_front(between, first, slave, begin, end.s))
          first = between;
        if (is_known && is_in_front(between, last, slave, end, begin.s))
          last = between;
        for (unsigned int q = 0; q < rule_points.size(); ++q)
        {
          const bool   is_last = q + 1 == rule_points.size();
          ContactPoint point;
          PointData    fixed;
          fixed.slave        = slave;
          fixed.s            = q == 0    ? begin.s
                               : is_last ? end.s
                                         : begin.s + rule_points[q] * length;
          fixed.slack        = q == 0               ? at_start
                               : is_last            ? at_end
                               : at_start == at_end ? at_start
                                                    : 0.;
          point.edge         = edge;
          point.s            = fixed.s;
          const double speed = surface->reference_place(edge, fixed.s).a.norm();
          fixed.piece_length = length * speed;
          point.weight       = rule_weights[q] * length * speed;
          const NarrowPhase::Division &at = q == 0 ? begin : end;
          // A corner of another body does not end the face on which this piece lies.
          const unsigned int on = is_last               ? last
                                  : q == 0 || !is_known ? first
                                                        : between;
          if ((q == 0 || is_last) && fixed.slack > 0. &&
              at.master != invalid_index &&
              surface->edges()[at.master].body == surface->edges()[on].body)
          {
            point.edge   = at.master;
            point.s      = at.end;
            fixed.corner = PointKind::master_ends + at.end;
            fixed.home   = edge;
          }
          else if (fixed.slack > 0.)
          {
            fixed.home = narrow.find_home(slave, point.s, on);
            // The face below the piece does not reach the end of the piece, and the face that begins
            // there is not below the piece.
            if (fixed.home == invalid_index)
              fixed.slack = -fixed.slack;
          }
          fixed.weights = weights_at(point);
          restore(point, fixed, edge);
          if (fixed.corner > PointKind::along &&
              point.stick_edge == invalid_index)
            take_over_place(point, fixed, edge);
          made.points.push_back(point);
          made.data.push_back(fixed);
        }
      }
    }


    /// Anchor of a corner that has come onto the slave: where the slave's point at this place is
    /// stuck to the corner's body, seen from the other side.
    void
    PointMaker::take_over_place(ContactPoint      &point,
                                PointData         &fixed,
                                const unsigned int slave) const
    {
      const auto *sticking = memory->stick_places.find(slave);
      StickPlace  stick;
      if (sticking == nullptr || !find_stick_place(*sticking, fixed.s, stick) ||
          stick.edge != point.edge)
        return;
      point.stick_edge = slave;
      point.stick_t    = fixed.s - (point.s - stick.t) *
                                  surface->place(point.edge, point.s).a.norm() /
                                  surface->place(slave, fixed.s).a.norm();
      point.is_bonded = stick.is_bonded;
      fixed.slip      = stick.slip;
    }
  } // namespace internal
} // namespace NMM
