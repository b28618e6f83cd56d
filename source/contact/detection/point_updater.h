#ifndef nmm_source_contact_detection_point_updater_h
#define nmm_source_contact_detection_point_updater_h

#include <contact/detection/point_projector.h>
#include <contact/detection/points.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Moves contact points with the faces: each takes its master, gap, normal and law from its
     * projection. A point that first has a master also takes its weight and its bond, and an anchor
     * if it has none there. With frozen geometry (Contact::freeze_geometry()) a projection is that of
     * the first update, and only its gap follows the displacements.
     *
     * Order of calls: begin_step() when points have been made, then update(). Different points are
     * updated on several threads. All references must outlive this object.
     */
    class PointUpdater
    {
    public:
      using Positions = PointProjector::Positions;

      PointUpdater(const ContactSurface    &surface,
                   const ContactParameters &parameters,
                   const ContactMemory     &memory,
                   const PointProjector    &projector,
                   PointSet                &set);

      void
      begin_step();

      /// Set the kind of the positions of the next updates; see PointProjector.
      void
      set_positions(const Positions new_positions)
      {
        positions = new_positions;
      }

      bool
      is_moving() const
      {
        return positions != Positions::of_statics;
      }

      /// Whether points are those of a conserving step or of its end.
      bool
      is_between() const
      {
        return positions == Positions::between;
      }

      void
      freeze(const bool freeze)
      {
        frozen = freeze;
      }

      bool
      is_frozen() const
      {
        return frozen;
      }

      /// Move the point @p q to @p slave, its current place. Returns its projection, without a
      /// master if the point has no share in any contact.
      ContactProjection
      update(unsigned int q, const ContactSurface::Place &slave);

      /// Vector from the anchor of a point to the point [m]; in statics computed from displacements
      /// as PointProjector::gap_of_displacements().
      dealii::Tensor<1, 2>
      way_from_anchor(const ContactPoint          &point,
                      const ContactSurface::Place &slave) const;

      /// Size of the numbers that a gap is the difference of [m].
      double
      size_of_terms(const ContactPoint      &point,
                    const ContactProjection &projection) const;

    private:
      ContactProjection
      update_exactly(unsigned int q, const ContactSurface::Place &slave);

      /// The share of a point that first has a master in the contact with it, and its bond. Returns
      /// whether it has any share.
      bool
      take_share(const ContactSurface::Place &slave,
                 const ContactProjection     &projection,
                 ContactPoint                &point,
                 PointData                   &fixed) const;

      /// Parameter of the anchor of a point that has none. Where the point lies on its master in the
      /// reference configuration it is that place, at which the point has the initial shear; elsewhere
      /// the point begins without shear.
      double
      new_anchor(const ContactPoint      &point,
                 const PointData         &fixed,
                 const ContactProjection &projection) const;

      /// A point of frozen geometry: its projection, and the difference between its gap and that of
      /// the displacements [m].
      struct FrozenPoint
      {
        ContactProjection projection;
        double            gap      = 0.;
        bool              is_known = false;
      };

      const ContactSurface    *surface;
      const ContactMemory     *memory;
      const PointProjector    *projector;
      PointSet                *set;
      ContactLaws              laws;
      bool                     has_anchors;
      Positions                positions = Positions::of_statics;
      bool                     frozen    = false;
      std::vector<FrozenPoint> frozen_points;
    };
  } // namespace internal
} // namespace NMM

#endif
