// What cannot touch in a time step, and need not be looked at.
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <base/fetch.h>
#include <contact/contact_data.h>
#include <limits>

namespace NMM
{
  using namespace internal;

  namespace
  {
    /// What is further away than this part of the reach is clear, whatever is rounded.
    constexpr double clear_by = 1e-6;


    template <typename Item>
    void
    fetch(const Item &item)
    {
      internal::fetch(&item, 1);
    }
  } // namespace


  void
  Contact::Data::find_clearances()
  {
    clearances.assign(points.size(), Clearance());
    position_motion.resize(search.slaves().size());
    position_assembly.assign(search.slaves().size(), 0);
    n_assemblies = 0;
    moved_at.assign(surface->n_bodies(), 0);
    changed_at.assign(surface->n_bodies(), 0);
    found_at.assign(surface->n_bodies(), 0);
    is_near.assign(points.size(), 0);
    far_distance.assign(points.size(), 0.);
    bound_assembly.assign(surface->n_bodies(), 0);
    motion_bounds.resize(surface->n_bodies());
    if (point_to_body.empty())
      list_bodies_of_points();
    if (faced_bodies.begins.empty())
      list_near_bodies();
    if (active_covers.empty() &&
        dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      list_covers_of_bodies();
    // what slides apart may open faces that are in contact
    if (laws.has_dilation())
      return;
    motion.begin(*surface);
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      const ContactPoint &point     = points[q];
      const PointData    &fixed     = point_data[q];
      const bool          is_corner = fixed.corner < Kind::along;
      Clearance          &clearance = clearances[q];
      clearance.position            = fixed.slave;
      clearance.edge                = point.edge;
      // a corner of the master has a single candidate; others of a position the same ones
      clearance.is_master_end = fixed.corner > Kind::along;
      if (fixed.gap_begin < fixed.offset || point.is_bonded ||
          surface->edges()[point.edge].radius != 0.)
        continue;
      clearance.s     = point.s;
      clearance.slack = is_corner ? ContactSearch::rounding_slack : fixed.slack;
      clearance.home  = is_corner ? ContactSearch::any_edge : fixed.home;
      // it has no share until points are made anew
      clearance.distance =
        fixed.has_angle && point.weight == 0.
          ? std::numeric_limits<double>::max()
          : search.clearance(surface->place(point.edge, point.s).x,
                             masters_of(q),
                             clearance.slack,
                             clearance.home);
      clearance.was_clear = clearance.distance > 0.;
      far_distance[q]     = clearance.distance;
      if (clearance.was_clear)
        note_clear(q);
    }
  }


  double
  Contact::Data::motion_bound(const unsigned int body)
  {
    if (bound_assembly[body] != n_assemblies)
    {
      double moved = 0.;
      for (const unsigned int other : faced_bodies[body])
        moved = std::max(moved, motion.bound_of_bodies(body, other, reach));
      motion_bounds[body]  = moved + clear_by * reach;
      bound_assembly[body] = n_assemblies;
    }
    return motion_bounds[body];
  }


  bool
  Contact::Data::is_clear(const Clearance &clearance, const double margin)
  {
    if (clearance.distance == 0.)
      return false;
    const unsigned int position = clearance.position;
    const auto         bound    = [&](const unsigned int master) {
      return motion.bound(clearance.edge, master, reach);
    };
    double moved = 0.;
    if (clearance.is_master_end)
      moved = bound(search.slaves()[position]);
    else if (position_assembly[position] == n_assemblies)
      moved = position_motion[position];
    else
    {
      for (const unsigned int master : search.masters(position))
        moved = std::max(moved, bound(master));
      position_motion[position]   = moved;
      position_assembly[position] = n_assemblies;
    }
    return clearance.distance > (1. + margin) * moved + clear_by * reach;
  }


  bool
  Contact::Data::is_clear_now(const unsigned int q) const
  {
    const Clearance &clearance = clearances[q];
    if (clearance.distance == 0.)
      return false;
    const auto masters = clearance.is_master_end
                           ? dealii::ArrayView<const unsigned int>(
                               &search.slaves()[clearance.position], 1)
                           : search.masters(clearance.position);
    return search.clearance(surface->place(clearance.edge, clearance.s).x,
                            masters,
                            clearance.slack,
                            clearance.home) > clear_by * reach;
  }


  void
  Contact::Data::find_ends()
  {
    asked_points.clear();
    for_each_active_point([&](const unsigned int q) {
      if (!is_far(q, point_to_body[q]))
        asked_points.push_back(q);
    });
    near_points.clear();
    for (unsigned int i = 0; i < asked_points.size(); ++i)
    {
      fetch_ahead(asked_points, i);
      const unsigned int q = asked_points[i];
      is_near[q] = is_known[point_to_body[q]] ? find_same_end(q) : find_end(q);
      if (is_near[q])
        near_points.push_back(q);
    }
  }


  void
  Contact::Data::fetch_ahead(const std::vector<unsigned int> &list,
                             const unsigned int               i) const
  {
    constexpr unsigned int far = 12, near = 5;
    if (i + far < list.size())
      fetch(clearances[list[i + far]]);
    if (i + near >= list.size())
      return;
    const unsigned int q         = list[i + near];
    const Clearance   &clearance = clearances[q];
    // what was clear most likely is so again
    if (clearance.was_clear)
      return;
    fetch(points[q]);
    fetch(point_data[q]);
    if (clearance.edge == invalid_index)
      return;
    fetch(surface->edges()[clearance.edge]);
    if (clearance.edge < touching.size())
      fetch(touching[clearance.edge]);
  }


  void
  Contact::Data::note_clear(const unsigned int q)
  {
    PointData &fixed = point_data[q];
    fixed.dilation   = Dilation();
    fixed.new_slip = fixed.shear_work = fixed.normal_loss = fixed.offset_end =
      0.;
    fixed.master_end    = invalid_index;
    fixed.gap_end       = reach;
    ContactPoint &point = points[q];
    report.n_changes += point.state != ContactState::open;
    point.pressure = point.shear = 0.;
    point.state                  = ContactState::open;
  }


  void
  Contact::Data::note_motion(const unsigned int body)
  {
    if (moved_at[body] == n_assemblies)
      return;
    moved_at[body] = changed_at[body] = n_assemblies;
    for (const unsigned int other : near_bodies[body])
      changed_at[other] = n_assemblies;
  }


  void
  Contact::Data::note_known(const double time)
  {
    // obstacles move with time; openings are those of the last law
    if (time != found_time || laws.has_dilation())
      std::fill(found_at.begin(), found_at.end(), 0);
    found_time = time;

    is_known.assign(surface->n_bodies(), false);
    for (unsigned int body = 0; body < is_known.size(); ++body)
    {
      is_known[body] = found_at[body] > changed_at[body];
      if (is_active.empty() || (body < is_active.size() && is_active[body]))
        found_at[body] = n_assemblies + 1;
    }
  }


  void
  Contact::Data::move_as_expected()
  {
    active_covers.for_each(nodal_expected.size() / 2,
                           [&](const unsigned int k) {
                             for (const unsigned int i : {2 * k, 2 * k + 1})
                               end_state.nodal[i] = nodal_expected[i];
                           });
    ++n_assemblies;
    std::fill(changed_at.begin(), changed_at.end(), n_assemblies);
    have_all_moved = true;
    update_faces();
  }
} // namespace NMM
