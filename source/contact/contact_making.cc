// Contact points and the pattern of what they couple.
#include <nmm/base/exceptions.h>
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <contact/contact_data.h>

namespace NMM
{
  using namespace internal;
  using dealii::Point;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  void
  Contact::Data::make_points()
  {
    points.clear();
    point_data.clear();
    step_clearances.disable();
    for (unsigned int i = 0; i < search.slaves().size(); ++i)
      if (search.corner(i) == Kind::along)
        add_points_of(i);
      else
        add_corner(i);
    faces_beside.clear();
    if (is_conserving)
      find_faces_beside();
  }


  void
  Contact::Data::find_faces_beside()
  {
    // of the size: more than springs give way by, and less than the corners that
    // pass each other overlap by
    constexpr double deep = 0.02;

    for (unsigned int q = 0; q < points.size(); ++q)
    {
      PointData         &fixed = point_data[q];
      const unsigned int edge  = points[q].edge;
      fixed.beside_begin       = faces_beside.size();
      search.append_faces_beside(edge,
                                 surface->place(edge, points[q].s).x,
                                 masters_of(q),
                                 deep * size_at(q),
                                 faces_beside);
      fixed.beside_end = faces_beside.size();
    }
  }


  void
  Contact::Data::restore(ContactPoint      &point,
                         PointData         &fixed,
                         const unsigned int slave) const
  {
    const auto *sticking =
      stick_places.find(place_key(point.edge, fixed.corner));
    StickPlace stick;
    if (sticking != nullptr && find_stick_place(*sticking, point.s, stick))
    {
      point.stick_edge = stick.edge;
      point.stick_t    = stick.t;
      point.is_bonded  = stick.is_bonded;
      fixed.slip       = stick.slip;
    }
    if (multiplier_space != nullptr && fixed.corner >= Kind::along)
      point.multiplier = multiplier_space->value(multipliers, slave, fixed.s);
  }


  ContactSurface::WeightValues
  Contact::Data::weights_at(const ContactPoint &point) const
  {
    ContactSurface::Weights result;
    surface->weights(point.edge, point.s, result);
    return result;
  }


  void
  Contact::Data::add_corner(const unsigned int slave)
  {
    ContactPoint point;
    PointData    fixed;
    fixed.slave  = slave;
    fixed.corner = search.corner(slave);
    point.edge   = search.slaves()[slave];
    point.s      = fixed.corner;
    // that of the end of an edge of this length, with four Gauss-Lobatto points
    point.weight  = parameters.integration == ContactIntegration::points
                      ? 1.
                      : corner_size[2 * point.edge + fixed.corner] / 12.;
    fixed.weights = weights_at(point);
    restore(point, fixed, point.edge);
    points.push_back(point);
    point_data.push_back(fixed);
  }


  void
  Contact::Data::add_points_of(const unsigned int slave)
  {
    const unsigned int edge      = search.slaves()[slave];
    const auto         divisions = search.divisions(slave);
    for (unsigned int i = 0; i + 1 < divisions.size(); ++i)
    {
      const ContactSearch::Division &begin = divisions[i];
      const ContactSearch::Division &end   = divisions[i + 1];
      unsigned int                   first, last;
      const double at_start = search.end_slack(slave, begin, end.s, first);
      const double at_end   = search.end_slack(slave, end, begin.s, last);
      const double length   = end.s - begin.s;
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
        const ContactSearch::Division &at = q == 0 ? begin : end;
        // another body's corner does not end what this piece lies on
        const unsigned int on = is_last ? last : first;
        if ((q == 0 || is_last) && fixed.slack > 0. &&
            at.master != invalid_index &&
            surface->edges()[at.master].body == surface->edges()[on].body)
        {
          point.edge   = at.master;
          point.s      = at.end;
          fixed.corner = Kind::master_ends + at.end;
          fixed.home   = edge;
        }
        else if (fixed.slack > 0.)
        {
          fixed.home = search.find_home(slave, point.s, on);
          // what the piece lies on does not reach its end, and what begins there
          // does not lie on the piece
          if (fixed.home == invalid_index)
            fixed.slack = -fixed.slack;
        }
        fixed.weights = weights_at(point);
        restore(point, fixed, edge);
        if (fixed.corner > Kind::along && point.stick_edge == invalid_index)
          take_over_place(point, fixed, edge);
        points.push_back(point);
        point_data.push_back(fixed);
      }
    }
  }


  /// A corner that has come onto the slave sticks where the slave's point that it
  /// has met sticks to it, seen from the other side.
  void
  Contact::Data::take_over_place(ContactPoint      &point,
                                 PointData         &fixed,
                                 const unsigned int slave) const
  {
    const auto *sticking = stick_places.find(slave);
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


  /// Elements that are tied couple in the elasticity, whose pattern is to be within
  /// that of the contact.
  void
  Contact::Data::couple_ties()
  {
    const CoverSystem  &covers = surface->cover_system();
    const ManifoldMesh &mesh   = covers.manifold_mesh();
    const auto [first, last]   = covers.locally_owned_elements();
    const auto &curves         = mesh.physical_mesh().curves();
    const auto &piece_to_curve = mesh.physical_mesh().piece_to_curve();
    std::vector<unsigned int> both;
    for (unsigned int e = first; e < last; ++e)
      for (const ElementEdge &edge : mesh.edges(e))
      {
        if (edge.curve_set == invalid_index || edge.neighbor == invalid_index)
          continue;
        const auto &pieces = mesh.curve_set(edge.curve_set);
        if (std::all_of(pieces.begin(), pieces.end(), [&](const auto piece) {
              const Curve &curve = curves[piece_to_curve[piece]];
              return curve.role == CurveRole::joint &&
                     curve.state == JointState::open;
            }))
          continue;
        both.assign(covers.covers(e).begin(), covers.covers(e).end());
        both.insert(both.end(),
                    covers.covers(edge.neighbor).begin(),
                    covers.covers(edge.neighbor).end());
        assembler->couple({both.data(), both.size()});
      }
  }


  void
  Contact::Data::note_candidates()
  {
    is_idle =
      Parallel::max(search.slaves().empty() ? 0U : 1U, communicator) == 0U;
    if (is_idle)
      return;
    are_candidates_known = false;
    if (assembler != nullptr)
      return;
    if (Parallel::n_mpi_processes(communicator) > 1)
    {
      couple_all();
      return;
    }
    // enough for forces
    is_coupled.assign(search.slaves().size(), false);
    make_pattern();
  }


  void
  Contact::Data::look_at_candidates()
  {
    if (are_candidates_known)
      return;
    are_candidates_known = true;
    candidates.clear();
    for (unsigned int i = 0; i < search.slaves().size(); ++i)
      append_couplings(i, candidates);
    const bool is_new = candidates != coupled_candidates;
    if (Parallel::max(is_new ? 1U : 0U, communicator) == 0U)
      return;
    coupled_candidates = candidates;
    is_coupled.assign(search.slaves().size(), false);
    has_pattern = false;
  }


  /// Covers that may be coupled at a position: those of the slave, of masters of one body,
  /// and of places where it sticks to that body; body by body, each with their number
  /// before.
  void
  Contact::Data::append_couplings(const unsigned int         i,
                                  std::vector<unsigned int> &couplings) const
  {
    const auto        &edges   = surface->edges();
    const unsigned int slave   = search.slaves()[i];
    const auto         masters = search.masters(i);
    for (auto first = masters.begin(); first != masters.end(); ++first)
    {
      const unsigned int body     = edges[*first].body;
      const auto         is_of_it = [&](const unsigned int edge) {
        return edges[edge].body == body;
      };
      if (std::any_of(masters.begin(), first, is_of_it))
        continue;
      const unsigned int begin = couplings.size();
      couplings.push_back(0);
      const auto append = [&](const unsigned int edge) {
        const auto covers = surface->covers(edge);
        couplings.insert(couplings.end(), covers.begin(), covers.end());
      };
      const auto append_places = [&](const unsigned int key) {
        if (const auto *sticking = stick_places.find(key))
          for (const StickPlace &place : *sticking)
            if (!surface->is_rigid(place.edge))
              append(place.edge);
      };
      append(slave);
      append_places(place_key(slave, search.corner(i)));
      for (const unsigned int master : masters)
        if (is_of_it(master))
        {
          append(master);
          for (unsigned int end = 0; end < 2; ++end)
            if (search.corner(i) == Kind::along)
              append_places(place_key(master, Kind::master_ends + end));
        }
      std::sort(couplings.begin() + begin + 1, couplings.end());
      couplings.erase(std::unique(couplings.begin() + begin + 1,
                                  couplings.end()),
                      couplings.end());
      couplings[begin] = couplings.size() - begin - 1;
    }
  }


  void
  Contact::Data::couple_all()
  {
    look_at_candidates();
    const bool is_missing =
      !has_pattern || std::find(is_coupled.begin(), is_coupled.end(), false) !=
                        is_coupled.end();
    if (Parallel::max(is_missing ? 1U : 0U, communicator) == 0U)
      return;
    std::fill(is_coupled.begin(), is_coupled.end(), true);
    make_pattern();
  }


  void
  Contact::Data::couple_expected()
  {
    // how many times as far as expected anything may move
    constexpr double margin = 2.;

    look_at_candidates();
    std::fill(is_coupled.begin(), is_coupled.end(), false);
    for_each_active_point([&](const unsigned int q) {
      if (!step_clearances.is_clear(q, margin))
        is_coupled[point_data[q].slave] = true;
    });
    is_pattern_of_step = true;
  }


  void
  Contact::Data::couple_near()
  {
    look_at_candidates();
    for (const unsigned int q : near_points)
      is_coupled[point_data[q].slave] = true;
    if (!has_pattern || is_coupled != is_in_pattern)
      make_pattern();
  }


  void
  Contact::Data::make_pattern()
  {
    has_pattern   = true;
    is_in_pattern = is_coupled;
    assembler = std::make_unique<CoverMatrixAssembler>(surface->cover_system(),
                                                       *constraints);
    std::vector<unsigned int> couplings;
    for (unsigned int i = 0; i < is_coupled.size(); ++i)
      if (is_coupled[i])
        append_couplings(i, couplings);
    for (unsigned int i = 0; i < couplings.size(); i += couplings[i] + 1)
      assembler->couple({couplings.data() + i + 1, couplings[i]});
    couple_ties();
    assembler->ignore_inhomogeneities();
    assembler->leave_empty_rows();
    assembler->assemble_in_place();
    assembler->build();
    assembler->set_active_rows(is_active);
    matrix.clear();
    ++pattern_version;
  }
} // namespace NMM
