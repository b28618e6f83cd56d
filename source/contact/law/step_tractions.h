#ifndef nmm_source_contact_law_step_tractions_h
#define nmm_source_contact_law_step_tractions_h

#include <contact/law/tractions.h>
#include <contact/surface/step_states.h>

namespace NMM
{
  namespace internal
  {
    /**
     * Pressure and shear of a contact point in a time step that conserves energy, see
     * ContactTimeStep::assemble(). They follow from gap and shear at the beginning of the step, the gap at
     * its end, and the motion of both faces in between.
     *
     * Order of calls: find_end() with the surface at the end of the step; then, with the surface
     * in the middle of the step, find() and, for a tangent, differentiate(). All references must
     * outlive this object.
     */
    class StepTractions
    {
    public:
      StepTractions(const ContactSurface &surface,
                    const StepStates     &states,
                    const PointProjector &projector,
                    const Tractions      &tractions);

      /// A point at the end of a step: whether it touches there or at the beginning, and whether
      /// it has been closed until now and does not.
      struct PointEnd
      {
        bool is_near = false, has_opened = false;
      };

      /// Find master, gap and dilation of a point at the end of a step. A point that is not near is
      /// set open.
      PointEnd
      find_end(ContactPoint &point, PointData &fixed) const;

      /// Mean traction of a point with this projection in the middle of the step.
      ContactTraction
      find(const ContactProjection &projection,
           ContactPoint            &point,
           PointData               &fixed) const;

      /// The spring at the end of the step as find_end() has found it, by which the pressure in the
      /// step is measured. Where corners of two bodies coincide, another projection of the same state
      /// may find another face, since rounding decides which is nearest.
      static Tractions::NormalSpring
      spring_at_end(const PointData &fixed)
      {
        return {fixed.dilation, fixed.offset_end - fixed.gap_end};
      }

      /// Derivatives by the displacements of slave and master in the middle of the step: of the mean
      /// pressure, times the weight [N/m^2], and of half of the slip [-].
      struct Changes
      {
        double pressure[ContactKinematics::max],
          half_slip[ContactKinematics::max];
      };

      /// Set the derivatives of a traction, which refers to @p changes.
      void
      differentiate(const PointData         &fixed,
                    const ContactProjection &projection,
                    const ContactKinematics &kinematics,
                    Changes                 &changes,
                    ContactTraction         &traction) const;

    private:
      /// Gaps between which the spring of a point moves in a step, without dilation.
      struct Gaps;

      Gaps
      find_gaps(double motion, double opening, PointData &fixed) const;

      void
      find_pressure(double           opening,
                    ContactPoint    &point,
                    PointData       &fixed,
                    ContactTraction &traction) const;

      void
      find_shear(const ContactProjection &projection,
                 bool                     was_slipping,
                 ContactPoint            &point,
                 PointData               &fixed,
                 ContactTraction         &traction) const;

      /// Normal motions of a step that are much less than this say nothing about whether the faces
      /// turn [m].
      double
      least_motion() const
      {
        return 1e-4 * projector->search_reach();
      }

      const ContactSurface *surface;
      const StepStates     *states;
      const PointProjector *projector;
      const Tractions      *tractions;
    };
  } // namespace internal
} // namespace NMM

#endif
