#include <nmm/base/exceptions.h>
#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <contact/detection/corner_rules.h>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /// Whether an edge is a boundary or the face of an open joint.
    bool
    is_free(const ManifoldMesh &mesh, const ElementEdge &edge)
    {
      if (edge.curve_set == invalid_index)
        return false;
      if (edge.neighbor == invalid_index)
        return true;
      const PhysicalMesh &physical_mesh = mesh.physical_mesh();
      for (const unsigned int piece : mesh.curve_set(edge.curve_set))
      {
        const Curve &curve =
          physical_mesh.curves()[physical_mesh.piece_to_curve()[piece]];
        if (curve.role == CurveRole::boundary ||
            curve.role == CurveRole::hole ||
            (curve.role == CurveRole::joint && curve.state == JointState::open))
          return true;
      }
      return false;
    }


    /// Whether an edge is longer than rounding. Cutting is exact but coordinates are not, and an
    /// edge as short as their rounding has no direction; it cannot touch anything.
    bool
    has_length(const ManifoldMesh &mesh,
               const unsigned int  element,
               const ElementEdge  &edge)
    {
      constexpr double tolerance = 1e-12;
      const double     size =
        std::sqrt(mesh.mathematical_mesh().cell_area(mesh.cell(element)));
      return edge.start.distance(edge.end) > tolerance * size;
    }


    /// Of the curves that coincide on an edge, the one that is a face of the element.
    unsigned int
    own_curve(const ManifoldMesh &mesh,
              const unsigned int  element,
              const unsigned int  curve_set)
    {
      const PhysicalMesh              &physical_mesh = mesh.physical_mesh();
      const std::vector<unsigned int> &pieces = mesh.curve_set(curve_set);
      const auto                       own    = std::find_if(
        pieces.begin(), pieces.end(), [&](const unsigned int piece) {
          return physical_mesh.is_face_of(physical_mesh.piece_to_curve()[piece],
                                          mesh.region(element));
        });
      return physical_mesh
        .piece_to_curve()[own == pieces.end() ? pieces.front() : *own];
    }


    /// Position of the next edge in the same loop.
    unsigned int
    next_in_loop(const dealii::ArrayView<const ElementEdge> &edges,
                 const unsigned int                          position)
    {
      if (position + 1 < edges.size() &&
          edges[position + 1].start == edges[position].end)
        return position + 1;
      unsigned int first = position;
      while (first > 0 && edges[first - 1].end == edges[first].start)
        --first;
      return first;
    }


    void
    set_angles(ContactSurface::Edge &edge)
    {
      if (edge.radius == 0.)
      {
        edge.length = edge.start.distance(edge.end);
        return;
      }
      const Tensor<1, 2> first = edge.start - edge.center;
      const Tensor<1, 2> last  = edge.end - edge.center;
      edge.first_angle         = std::atan2(first[1], first[0]);
      edge.last_angle          = std::atan2(last[1], last[0]);
      const double turn        = 2. * dealii::numbers::PI;
      const double sign        = edge.radius > 0. ? 1. : -1.;
      double       range       = sign * (edge.last_angle - edge.first_angle);
      if (range < 0.)
        range += turn;
      // A sliver whose ends coincide or are swapped by rounding is not a full circle.
      constexpr double rounding = 1e-9, least = 1e-15;
      if (range > turn - rounding)
        range = 0.;
      edge.last_angle = edge.first_angle + sign * std::max(range, least);
      edge.length =
        std::abs(edge.radius * (edge.last_angle - edge.first_angle));
    }


    /// Convert a piece of an obstacle to an edge with the body on the left.
    ContactSurface::Edge
    edge_of_piece(const CurvePiece &piece)
    {
      ContactSurface::Edge edge;
      edge.start = piece.start;
      edge.end   = piece.end;
      if (piece.kind == CurvePiece::Kind::arc)
      {
        edge.center          = piece.center;
        const Tensor<1, 2> d = piece.through - piece.start;
        const Tensor<1, 2> e = piece.end - piece.through;
        edge.radius =
          d[0] * e[1] - d[1] * e[0] > 0. ? piece.radius : -piece.radius;
      }
      set_angles(edge);
      return edge;
    }
  } // namespace


  ContactSurface::ContactSurface(const CoverSystem         &covers,
                                 std::vector<RigidObstacle> obstacles)
    : cover_pointer(&covers)
    , rigid_obstacles(std::move(obstacles))
    , obstacle_displacements(rigid_obstacles.size())
    , degree(covers.manifold_mesh().mathematical_mesh().degree())
    , n_blocks(covers.manifold_mesh().physical_mesh().n_blocks())
  {
    add_elements();
    add_obstacles();
    set_corners();
    position_to_edge.clear();
    position_to_edge.shrink_to_fit();
    is_body_absent.assign(n_bodies(), false);
    set_time(0.);

    for (unsigned int e = 0; e < all_edges.size(); ++e)
      for (const unsigned int cover : this->covers(e))
      {
        (void)cover;
        Assert(covers.locally_relevant_covers().is_element(cover),
               dealii::ExcMessage(
                 "Call CoverSystem::make_boundary_relevant() first."));
      }
    set_start_weights();
  }


  void
  ContactSurface::set_start_weights()
  {
    edge_displacements.resize(all_edges.size());
    current = edge_displacements.data();
    start_weights_begin.assign(1, 0);
    Weights f;
    for (unsigned int e = 0; e < all_edges.size(); ++e)
    {
      if (!is_rigid(e) && all_edges[e].radius == 0.)
      {
        weights(e, 0., f);
        for (unsigned int i = 0; i < f.n; ++i)
          start_weights.push_back({{f.w[i], f.dw[i], 0.5 * f.ddw[i]}});
      }
      start_weights_begin.push_back(start_weights.size());
    }
  }


  void
  ContactSurface::add_elements()
  {
    const ManifoldMesh &mesh = cover_pointer->manifold_mesh();
    const auto [first, last] = cover_pointer->locally_owned_elements();
    owned                    = {0, 0};
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
    {
      if (e == first)
        owned.first = all_edges.size();
      const auto boundary = mesh.edges(e);
      for (unsigned int k = 0; k < boundary.size(); ++k)
        if (is_free(mesh, boundary[k]) && has_length(mesh, e, boundary[k]))
        {
          Edge edge;
          edge.element = e;
          edge.body    = mesh.block(e);
          edge.curve   = own_curve(mesh, e, boundary[k].curve_set);
          edge.start   = boundary[k].start;
          edge.end     = boundary[k].end;
          edge.center  = boundary[k].center;
          edge.radius  = boundary[k].radius;
          set_angles(edge);

          const MathematicalMesh &cells = mesh.mathematical_mesh();
          const unsigned int      cell  = mesh.cell(e);
          edge.origin = cells.reference_to_real(cell, Point<2>(0., 0.));
          const Tensor<1, 2> x =
            cells.reference_to_real(cell, Point<2>(1., 0.)) - edge.origin;
          const Tensor<1, 2> y =
            cells.reference_to_real(cell, Point<2>(0., 1.)) - edge.origin;
          Tensor<2, 2> jacobian;
          for (unsigned int c = 0; c < 2; ++c)
          {
            jacobian[c][0] = x[c];
            jacobian[c][1] = y[c];
          }
          edge.inverse = dealii::invert(jacobian);
          position_to_edge.push_back(
            {{e, k}, static_cast<unsigned int>(all_edges.size())});
          all_edges.push_back(edge);
        }
      if (e + 1 == last)
        owned.second = all_edges.size();
    }
    for (unsigned int i = 0; i < position_to_edge.size(); ++i)
      find_next(position_to_edge[i].first.first,
                position_to_edge[i].first.second,
                position_to_edge[i].second);
  }


  /// Find the edge that follows an edge on the boundary: turn about its end from element to element
  /// until the next free edge. This is exact at pinched points and tips of cracks, where
  /// coordinates do not determine the next edge.
  void
  ContactSurface::find_next(const unsigned int element,
                            const unsigned int position,
                            const unsigned int edge)
  {
    const ManifoldMesh    &mesh    = cover_pointer->manifold_mesh();
    constexpr unsigned int n_turns = 1000;

    const MathematicalMesh &cells = mesh.mathematical_mesh();
    Point<2>                pivot = all_edges[edge].end;
    // Current element, and its edge that ends at the pivot.
    unsigned int e = element, k = position;
    for (unsigned int i = 0; i < n_turns; ++i)
    {
      const unsigned int last_element = e;
      const auto         boundary     = mesh.edges(e);
      Point<2>           from;
      if (boundary.size() > 0)
      {
        k = next_in_loop(boundary, k);
        if (is_free(mesh, boundary[k]) && !has_length(mesh, e, boundary[k]))
        {
          pivot = boundary[k].end;
          continue;
        }
        if (is_free(mesh, boundary[k]))
        {
          const auto found =
            std::lower_bound(position_to_edge.begin(),
                             position_to_edge.end(),
                             std::make_pair(std::make_pair(e, k), 0U));
          all_edges[edge].next              = found->second;
          all_edges[found->second].previous = edge;
          return;
        }
        e    = boundary[k].neighbor;
        from = boundary[k].end;
      }
      else
      {
        // The element is a whole cell that touches the boundary with one corner only.
        const auto  &corners = cells.cell_vertices(mesh.cell(e));
        unsigned int local   = 0;
        while (local < 3 && cells.vertices()[corners[local]] != pivot)
          ++local;
        e = invalid_index;
        if (local < 3)
          from = cells.vertices()[corners[(local + 1) % 3]];
        for (const auto &link : mesh.joined(last_element))
          if (link.edge_here == local)
            e = link.neighbor;
      }
      if (e == invalid_index)
        return;
      const auto         other = mesh.edges(e);
      const unsigned int n     = other.size();
      for (k = 0; k < n; ++k)
        if (other[k].start == from && other[k].end == pivot &&
            other[k].neighbor == last_element)
          break;
      if (k == n && n > 0)
        return;
    }
  }


  void
  ContactSurface::add_obstacles()
  {
    for (unsigned int i = 0; i < rigid_obstacles.size(); ++i)
    {
      const RigidObstacle &obstacle = rigid_obstacles[i];
      const unsigned int   first    = all_edges.size();
      obstacle_begins.push_back(first);
      for (const CurvePiece &piece : obstacle.pieces)
      {
        AssertThrow(piece.kind != CurvePiece::Kind::circle,
                    InputError("A piece of the obstacle '" + obstacle.name +
                                 "' is a full circle",
                               "the obstacle",
                               "give two arcs"));
        const bool is_first = all_edges.size() == first;
        AssertThrow(is_first || all_edges.back().end == piece.start,
                    InputError("A piece of the obstacle '" + obstacle.name +
                                 "' does not start where the last one ends",
                               "the obstacle",
                               "give consecutive pieces"));
        AssertThrow(piece.start != piece.end,
                    InputError("A piece of the obstacle '" + obstacle.name +
                                 "' has no length",
                               NMM::to_string(piece.start),
                               "leave it out"));
        Edge edge = edge_of_piece(piece);
        edge.body = n_blocks + i;
        if (!is_first)
        {
          edge.previous                        = all_edges.size() - 1;
          all_edges[all_edges.size() - 1].next = all_edges.size();
        }
        all_edges.push_back(edge);
      }
      if (all_edges.size() > first + 1 &&
          all_edges.back().end == all_edges[first].start)
      {
        all_edges.back().next     = first;
        all_edges[first].previous = all_edges.size() - 1;
      }
    }
    obstacle_begins.push_back(all_edges.size());
  }


  void
  ContactSurface::set_corners()
  {
    for (unsigned int e = 0; e < all_edges.size(); ++e)
    {
      Edge &edge = all_edges[e];
      if (edge.next == invalid_index)
        continue;
      const Tensor<1, 2> here  = reference_place(e, 1.).a;
      const Tensor<1, 2> there = reference_place(edge.next, 0.).a;
      const double       angle =
        std::atan2(internal::cross(here, there), here * there);
      // The two faces at the tip of a crack: rounding may give an angle of -pi or pi.
      const Edge &next   = all_edges[edge.next];
      const bool  is_tip = next.start == edge.end && next.end == edge.start &&
                          next.center == edge.center;
      edge.at_end =
        is_tip ? Corner::concave
        : std::abs(angle) < internal::CornerRules::largest_smooth_angle
          ? Corner::smooth
        : angle > 0. ? Corner::convex
                     : Corner::concave;
      all_edges[edge.next].at_start = edge.at_end;
    }
  }


  const std::vector<RigidObstacle> &
  ContactSurface::obstacles() const
  {
    return rigid_obstacles;
  }


  const CoverSystem &
  ContactSurface::cover_system() const
  {
    return *cover_pointer;
  }


  unsigned int
  ContactSurface::n_bodies() const
  {
    return n_blocks + rigid_obstacles.size();
  }


  void
  ContactSurface::set_absent_bodies(std::vector<bool> is_absent)
  {
    AssertDimension(is_absent.size(), n_bodies());
    is_body_absent = std::move(is_absent);
  }


  std::pair<unsigned int, unsigned int>
  ContactSurface::locally_owned_edges() const
  {
    return owned;
  }


  void
  ContactSurface::set_time(const double time)
  {
    for (unsigned int i = 0; i < rigid_obstacles.size(); ++i)
      if (rigid_obstacles[i].displacement)
        obstacle_displacements[i] = rigid_obstacles[i].displacement(time);
  }


  void
  ContactSurface::set_time(const double time_begin, const double time_end)
  {
    for (unsigned int i = 0; i < rigid_obstacles.size(); ++i)
      if (rigid_obstacles[i].displacement)
        obstacle_displacements[i] =
          0.5 * (rigid_obstacles[i].displacement(time_begin) +
                 rigid_obstacles[i].displacement(time_end));
  }


  const Tensor<1, 2> &
  ContactSurface::obstacle_displacement(const unsigned int obstacle) const
  {
    AssertIndexRange(obstacle, obstacle_displacements.size());
    return obstacle_displacements[obstacle];
  }


  void
  ContactSurface::set_displacements(
    const std::vector<Tensor<1, 2>> *displacements)
  {
    nodal   = displacements;
    current = edge_displacements.data();
    for (unsigned int e = 0; e < all_edges.size(); ++e)
      find_displacement(e, *nodal, edge_displacements[e]);
  }


  void
  ContactSurface::find_displacement(const unsigned int               e,
                                    const std::vector<Tensor<1, 2>> &from,
                                    EdgeDisplacement &displacement) const
  {
    const unsigned int begin = start_weights_begin[e],
                       n     = start_weights_begin[e + 1] - begin;
    if (n == 0)
      return;
    const auto   edge_covers = covers(e);
    Tensor<1, 2> value, slope, bend;
    for (unsigned int i = 0; i < n; ++i)
    {
      const Tensor<1, 2>          &u = from[edge_covers[i]];
      const std::array<double, 3> &f = start_weights[begin + i];
      value += f[0] * u;
      slope += f[1] * u;
      bend += f[2] * u;
    }
    displacement = {{value, slope, bend}};
  }


  ContactSurface::State
  ContactSurface::state() const
  {
    return {*nodal, {current, current + all_edges.size()}};
  }


  void
  ContactSurface::update(State &state, const unsigned int edge) const
  {
    find_displacement(edge, state.nodal, state.edges[edge]);
  }


  void
  ContactSurface::set_state(const State &state)
  {
    nodal   = &state.nodal;
    current = state.edges.data();
  }


  ContactSurface::Place
  ContactSurface::reference_place(const unsigned int e, const double t) const
  {
    const Edge &edge = all_edges[e];
    Place       place;
    if (edge.radius == 0.)
    {
      place.a = edge.end - edge.start;
      if (t < 0.5)
        place.x = {edge.start, t * place.a};
      else
        place.x = {edge.end, (t - 1.) * place.a};
    }
    else
    {
      const double range = edge.last_angle - edge.first_angle;
      const double angle = edge.first_angle + t * range;
      const double r     = std::abs(edge.radius);
      const double c = r * std::cos(angle), s = r * std::sin(angle);
      // The chord from the start, 2 r sin(phi / 2) long, loses no digits where the radius is much
      // larger than the arc.
      const double half  = 0.5 * t * range;
      const double chord = 2. * r * std::sin(half);
      const double along = edge.first_angle + half;
      place.x            = {edge.start,
                            Point<2>(-chord * std::sin(along), chord * std::cos(along))};
      place.a            = Point<2>(-range * s, range * c);
      place.b            = Point<2>(-range * range * c, -range * range * s);
    }
    return place;
  }


  void
  ContactSurface::weights(const unsigned int e,
                          const double       t,
                          Weights           &weights) const
  {
    const Edge &edge = all_edges[e];
    if (edge.element == invalid_index)
    {
      weights.n = 0;
      return;
    }
    const Place        X   = reference_place(e, t);
    const Tensor<1, 2> xi  = edge.inverse * (X.x - edge.origin);
    const Tensor<1, 2> dxi = edge.inverse * X.a;
    const Tensor<1, 2> ddxi =
      edge.radius == 0. ? Tensor<1, 2>() : Tensor<1, 2>(edge.inverse * X.b);
    // Barycentric coordinates along the edge, and their derivatives by t.
    const double l[3]   = {1. - xi[0] - xi[1], xi[0], xi[1]};
    const double dl[3]  = {-dxi[0] - dxi[1], dxi[0], dxi[1]};
    const double ddl[3] = {-ddxi[0] - ddxi[1], ddxi[0], ddxi[1]};
    weights.n           = WeightFunctions::n_per_cell(degree);
    for (unsigned int i = 0; i < 3; ++i)
    {
      if (degree == 1)
      {
        weights.w[i]   = l[i];
        weights.dw[i]  = dl[i];
        weights.ddw[i] = ddl[i];
        continue;
      }
      const unsigned int j = (i + 1) % 3;
      weights.w[i]         = l[i] * (2. * l[i] - 1.);
      weights.dw[i]        = (4. * l[i] - 1.) * dl[i];
      weights.ddw[i]       = 4. * dl[i] * dl[i] + (4. * l[i] - 1.) * ddl[i];
      weights.w[3 + i]     = 4. * l[i] * l[j];
      weights.dw[3 + i]    = 4. * (dl[i] * l[j] + l[i] * dl[j]);
      weights.ddw[3 + i] =
        4. * (ddl[i] * l[j] + 2. * dl[i] * dl[j] + l[i] * ddl[j]);
    }
  }


  ContactSurface::Place
  ContactSurface::place(const unsigned int e, const double t) const
  {
    const Edge &edge  = all_edges[e];
    Place       place = reference_place(e, t);
    if (is_rigid(e))
    {
      place.x += obstacle_displacements[edge.body - n_blocks];
      return place;
    }
    if (edge.radius == 0.)
    {
      const auto &d = current[e].d;
      place.x += d[0] + t * (d[1] + t * d[2]);
      place.a += d[1] + (2. * t) * d[2];
      place.b += 2. * d[2];
      return place;
    }
    Weights f;
    weights(e, t, f);
    const auto edge_covers = covers(e);
    for (unsigned int i = 0; i < f.n; ++i)
    {
      const Tensor<1, 2> &u = (*nodal)[edge_covers[i]];
      place.x += f.w[i] * u;
      place.a += f.dw[i] * u;
      place.b += f.ddw[i] * u;
    }
    return place;
  }


  Tensor<1, 2>
  ContactSurface::displacement(const unsigned int e, const double t) const
  {
    const Edge &edge = all_edges[e];
    if (is_rigid(e))
      return obstacle_displacements[edge.body - n_blocks];
    if (edge.radius == 0.)
    {
      const auto &d = current[e].d;
      return d[0] + t * (d[1] + t * d[2]);
    }
    Weights f;
    weights(e, t, f);
    const auto   edge_covers = covers(e);
    Tensor<1, 2> result;
    for (unsigned int i = 0; i < f.n; ++i)
      result += f.w[i] * (*nodal)[edge_covers[i]];
    return result;
  }


  bool
  ContactSurface::is_further(const unsigned int     e,
                             const ContactPosition &x,
                             const double           distance,
                             const double           before,
                             const double           after) const
  {
    const Edge &edge = all_edges[e];
    if (edge.radius != 0.)
      return false;
    Tensor<1, 2> way = x - edge.start, chord = edge.end - edge.start;
    double       most = distance;
    if (is_rigid(e))
      way -= obstacle_displacements[edge.body - n_blocks];
    else
    {
      // The place differs from the chord by d_2 t (t - 1), with |t (t - 1)| <= 3/4.
      const auto &d = current[e].d;
      way -= d[0];
      chord += d[1] + d[2];
      most += 0.75 * d[2].norm();
    }
    const double square = chord.norm_square();
    const double across = way[0] * chord[1] - way[1] * chord[0];
    if (across * across > most * most * square)
      return true;
    const double along = way * chord, more = most * std::sqrt(square);
    return along < -before * square - more ||
           along > (1. + after) * square + more;
  }


  Point<2>
  ContactSurface::position(const unsigned int e,
                           const Point<2>    &reference,
                           const Weights     &f) const
  {
    Point<2> x = reference;
    if (is_rigid(e))
      return x + obstacle_displacements[all_edges[e].body - n_blocks];
    const auto edge_covers = covers(e);
    for (unsigned int i = 0; i < f.n; ++i)
      x += f.w[i] * (*nodal)[edge_covers[i]];
    return x;
  }


  dealii::ArrayView<const unsigned int>
  ContactSurface::covers(const unsigned int e) const
  {
    return is_rigid(e) ? dealii::ArrayView<const unsigned int>()
                       : cover_pointer->covers(all_edges[e].element);
  }


  std::string
  ContactSurface::name(const unsigned int e) const
  {
    return is_rigid(e) ? rigid_obstacles[all_edges[e].body - n_blocks].name
                       : cover_pointer->manifold_mesh()
                           .physical_mesh()
                           .curves()[all_edges[e].curve]
                           .name;
  }
} // namespace NMM
