#ifndef nmm_source_contact_law_tractions_h
#define nmm_source_contact_law_tractions_h

#include <contact/assembly/point_terms.h>
#include <contact/detection/point_updater.h>

namespace NMM
{
  namespace internal
  {
    /**
     * Pressure and shear of a contact point at the present positions, by its law and what it remembers
     * of the last accepted state. Results are traction and its derivatives, and in the point its
     * pressure, shear, state and opening; nothing else is changed. All references must outlive
     * this object.
     */
    class Tractions
    {
    public:
      Tractions(const ContactSurface &surface,
                const PointUpdater   &updater,
                const PointProjector &projector,
                const ContactMemory  &memory);

      /// Let slip and dilation be those of the last accepted state as long as @p freeze is true.
      void
      freeze_slip(const bool freeze)
      {
        slip_is_frozen = freeze;
      }

      /// Opening of the faces, and how far the normal spring is closed [m].
      struct NormalSpring
      {
        Dilation dilation;
        double   closure = 0.;
      };

      /// The normal spring at the present positions.
      NormalSpring
      normal_spring(const ContactPoint          &point,
                    PointData                   &fixed,
                    const ContactSurface::Place &slave,
                    const ContactProjection     &projection) const;

      /// Traction of a point at @p slave whose normal spring is known.
      ContactTraction
      find(const NormalSpring          &normal,
           const ContactSurface::Place &slave,
           const ContactProjection     &projection,
           ContactPoint                &point,
           PointData                   &fixed) const;

      /// Opening by dilation at the present positions. Since the last accepted state a closed point
      /// slides as far as its strength does not hold it, and an open one without strength. Sets
      /// PointData::new_slip.
      Dilation
      find_dilation(const ContactPoint          &point,
                    PointData                   &fixed,
                    const ContactSurface::Place &slave,
                    const ContactProjection     &projection) const;

      /// Limit the @p trial shear [Pa] of a spring by the strength, and choose between stick and slip.
      /// @p stiffness is the derivative of the trial shear [Pa/m].
      void
      find_shear(double           trial,
                 double           stiffness,
                 bool             was_slipping,
                 ContactPoint    &point,
                 PointData       &fixed,
                 ContactTraction &traction) const;

    private:
      const ContactSurface *surface;
      const PointUpdater   *updater;
      const PointProjector *projector;
      const ContactMemory  *memory;
      bool                  slip_is_frozen = false;
    };
  } // namespace internal
} // namespace NMM

#endif
