#ifndef nmm_source_contact_surface_step_states_h
#define nmm_source_contact_surface_step_states_h

#include <nmm/contact/surface/surface.h>

#include <deal.II/lac/trilinos_vector.h>

#include <contact/surface/chosen_bodies.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Displacements and times between which faces move: where faces were searched for, now, and, for a
     * step that conserves energy, at its end and in its middle. The surface is moved to one of
     * them; its last position is the one that counts.
     *
     * Order of calls: set_begin() when faces are searched for; of a conserving step begin(), then
     * set_end_time() and set_end() or set_expected_end(), and move_to_middle(). All references
     * must outlive this object.
     */
    class StepStates
    {
    public:
      using Vector       = dealii::TrilinosWrappers::MPI::Vector;
      using Displacement = dealii::Tensor<1, 2>;

      StepStates(ContactSurface &surface, const ChosenBodies &chosen);

      /// Move obstacles to the time @p new_time [s].
      void
      set_time(double new_time);

      /// Move all faces to the displacements @p u (locally relevant).
      void
      move_to(const Vector &u);

      /// The same for the displacement of each cover [m], and the obstacles to a time [s].
      void
      move_to(const std::vector<Displacement> &displacements, double new_time);

      /// A step begins at the present displacements and time.
      void
      set_begin();

      /// Move all faces and obstacles to the beginning of the step, or from there to the present
      /// displacements and time.
      void
      move_to_begin(bool to_begin);

      /// Begin a conserving step at the present displacements and the time @p t [s].
      void
      begin(double t);

      /// See ContactTimeStep::expect().
      void
      expect(const Vector &u);

      /// Let the conserving step end at the time @p end [s], and move the obstacles there.
      void
      set_end_time(double end);

      /// Let the step end at the displacements @p u in the chosen bodies, and move the faces there.
      void
      set_end(const Vector &u);

      /// The same for the displacements of expect(). Returns false if there are none.
      bool
      set_expected_end();

      /// Move faces and obstacles to the mean of both ends of the conserving step.
      void
      move_to_middle();

      /// Change of the displacement of a cover in the conserving step [m].
      Displacement
      change(const unsigned int cover) const
      {
        return end.nodal[cover] - nodal_begin[cover];
      }

      /// Add @p factor times the motion in the conserving step of a place with these weights on an
      /// edge to @p sum [m].
      void
      add_motion(unsigned int                        edge,
                 const ContactSurface::WeightValues &at,
                 double                              factor,
                 Displacement                       &sum) const;

      /// Let obstacle_change() be the displacements between two times [s].
      void
      find_obstacle_changes(double from, double to);

      /// Displacement of the obstacle of a rigid edge, by find_obstacle_changes() or in the conserving
      /// step [m].
      const Displacement &
      obstacle_change(unsigned int edge) const;

      /// Length of the conserving step [s].
      double
      length() const
      {
        return time_end - time_begin;
      }

      /// Present displacements of all covers [m].
      const std::vector<Displacement> &
      displacements() const
      {
        return nodal;
      }

      /// Present time [s].
      double
      time() const
      {
        return now;
      }

    private:
      void
      update_faces();

      ContactSurface           *surface;
      const ChosenBodies       *chosen;
      std::vector<Displacement> nodal, nodal_begin, nodal_expected;
      ContactSurface::State     end, middle;
      std::vector<Displacement> obstacle_changes;
      /// Times: now, of set_begin(), and of both ends of the conserving step [s].
      double now = 0., time_searched = 0., time_begin = 0., time_end = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
