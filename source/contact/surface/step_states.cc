#include <contact/surface/step_states.h>
#include <mechanics/nodal_values.h>

namespace NMM
{
  namespace internal
  {
    StepStates::StepStates(ContactSurface &surface, const ChosenBodies &chosen)
      : surface(&surface)
      , chosen(&chosen)
      , nodal(surface.cover_system().n_covers())
    {
      surface.set_displacements(&nodal);
    }


    void
    StepStates::set_time(const double new_time)
    {
      now = new_time;
      surface->set_time(now);
    }


    void
    StepStates::move_to(const Vector &u)
    {
      read_nodal_values(surface->cover_system(), u, nodal);
      surface->set_displacements(&nodal);
    }


    void
    StepStates::move_to(const std::vector<Displacement> &displacements,
                        const double                     new_time)
    {
      nodal = displacements;
      surface->set_displacements(&nodal);
      set_time(new_time);
    }


    void
    StepStates::set_begin()
    {
      nodal_begin   = nodal;
      time_searched = now;
    }


    void
    StepStates::move_to_begin(const bool to_begin)
    {
      surface->set_displacements(to_begin ? &nodal_begin : &nodal);
      surface->set_time(to_begin ? time_searched : now);
    }


    void
    StepStates::begin(const double t)
    {
      time_begin = t;
      nodal_expected.clear();
      end = middle = surface->state();
    }


    void
    StepStates::expect(const Vector &u)
    {
      read_nodal_values(surface->cover_system(), u, nodal_expected);
    }


    void
    StepStates::set_end_time(const double t)
    {
      time_end = t;
      find_obstacle_changes(time_begin, time_end);
      surface->set_time(time_end);
    }


    void
    StepStates::set_end(const Vector &u)
    {
      read_nodal_values(surface->cover_system(),
                        u,
                        chosen->covers(),
                        end.nodal);
      chosen->for_each_cover(end.nodal.size(), [&](const unsigned int k) {
        middle.nodal[k] = 0.5 * (nodal_begin[k] + end.nodal[k]);
      });
      update_faces();
    }


    bool
    StepStates::set_expected_end()
    {
      chosen->for_each_cover(nodal_expected.size(), [&](const unsigned int k) {
        end.nodal[k] = nodal_expected[k];
      });
      if (!nodal_expected.empty())
        update_faces();
      return !nodal_expected.empty();
    }


    void
    StepStates::update_faces()
    {
      surface->set_state(end);
      chosen->for_each_edge([&](const unsigned int e) {
        surface->update(end, e);
        surface->update(middle, e);
      });
    }


    void
    StepStates::move_to_middle()
    {
      surface->set_time(time_begin, time_end);
      surface->set_state(middle);
    }


    void
    StepStates::add_motion(const unsigned int                  edge,
                           const ContactSurface::WeightValues &at,
                           const double                        factor,
                           Displacement                       &sum) const
    {
      if (surface->is_rigid(edge))
        sum += factor * obstacle_change(edge);
      const auto covers = surface->covers(edge);
      for (unsigned int i = 0; i < at.n; ++i)
        sum += factor * at.w[i] * change(covers[i]);
    }


    void
    StepStates::find_obstacle_changes(const double from, const double to)
    {
      const unsigned int n = surface->obstacles().size();
      obstacle_changes.resize(n);
      surface->set_time(to);
      for (unsigned int i = 0; i < n; ++i)
        obstacle_changes[i] = surface->obstacle_displacement(i);
      surface->set_time(from);
      for (unsigned int i = 0; i < n; ++i)
        obstacle_changes[i] -= surface->obstacle_displacement(i);
      surface->set_time(now);
    }


    const StepStates::Displacement &
    StepStates::obstacle_change(const unsigned int edge) const
    {
      const unsigned int first_obstacle =
        surface->n_bodies() - obstacle_changes.size();
      return obstacle_changes[surface->edges()[edge].body - first_obstacle];
    }
  } // namespace internal
} // namespace NMM
