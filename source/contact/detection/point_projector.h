#ifndef nmm_source_contact_detection_point_projector_h
#define nmm_source_contact_detection_point_projector_h

#include <contact/detection/point_maker.h>
#include <contact/state/memory.h>
#include <contact/state/point_data.h>
#include <contact/surface/rounded_corners.h>
#include <limits>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Whether one of the edges continues smoothly into the other within @p n_edges edges.
    bool
    goes_on(const ContactSurface &surface,
            unsigned int          edge,
            unsigned int          other,
            unsigned int          n_edges = 4);


    /**
     * Finds the face that a contact point touches, and the gap. Along a face that is the nearest
     * place; where faces end, the rules of corner_rules.h decide. Projecting writes nothing, so that
     * points are projected on several threads.
     *
     * Order of calls: begin_step() when points have been made; bound_new_contact() when faces have
     * moved; then points are projected. All references must outlive this object.
     */
    class PointProjector
    {
    public:
      PointProjector(const ContactSurface    &surface,
                     const ContactSearch     &search,
                     const PointMaker        &maker,
                     const ContactMemory     &memory,
                     const ContactParameters &parameters);

      /// Begin a step in which faces are searched for within @p reach [m], with the points @p set,
      /// which must stay where it is.
      void
      begin_step(double reach, const PointSet &set);

      /// New contact may be as deep as it likes from now on. For steps that conserve energy: contact
      /// that is found deep inside brings no energy, and would be lost for good if it were missed
      /// once.
      void
      admit_any_depth();

      /// Otherwise new contact may be as deep as faces have moved since the beginning of the step; in
      /// the first step that is the reference configuration, in which blocks do not overlap.
      void
      bound_new_contact();

      /// Whether new contact may be as deep as it likes.
      bool
      admits_any_depth() const
      {
        return admitted_depth == std::numeric_limits<double>::max();
      }

      /// Distance within which faces are searched for in this step [m].
      double
      search_reach() const
      {
        return reach;
      }

      /// The positions for which points are projected.
      enum class Positions
      {
        /// Of a static state: gaps are those of displacements.
        of_statics,
        /// At one time of a motion.
        of_motion,
        /// In the middle of a conserving step, at whose ends gaps and masters are known.
        between
      };

      /// The face that a point at @p slave touches, on which it stays if it was there before
      /// (ContactPoint::master, stick_edge) and another one is as good.
      ContactProjection
      project(const ContactPoint          &point,
              const PointData             &fixed,
              const ContactSurface::Place &slave,
              Positions                    positions) const;

      /// The same at the end of a conserving step. A piece ends where two edges of the master meet. Its
      /// end point stays with the edge that it has, because their normals differ slightly: the iteration
      /// would not converge, and the gap at the end of a step would not be that at the beginning of the
      /// next one.
      ContactProjection
      project_end(const ContactPoint          &point,
                  const PointData             &fixed,
                  const ContactSurface::Place &slave) const;

      /// Fraction of its weight that a point has in the contact with a face of this normal, see
      /// ContactSearch.
      double
      share(const ContactPoint         &point,
            const PointData            &fixed,
            const dealii::Tensor<1, 2> &slave_normal,
            const dealii::Tensor<1, 2> &master_normal) const;

      /**
       * Gap of a projection in statics, computed from displacements. With reference positions X and
       * the normal N there,
       * @f[ g = (u_s - u_m)\cdot n + (X_s - X_m)\cdot(n - N) + (X_s - X_m)\cdot N. @f]
       * This equals the gap between positions, but has the precision of displacements: under small
       * loads stiff springs are compressed by less than the rounding of positions. The last term is
       * 0 where faces are drawn as touching, so that they touch under any load.
       */
      double
      gap_of_displacements(const ContactPoint      &point,
                           const ContactProjection &projection) const;

    private:
      AdmittedContact
      find_admitted(const ContactPoint &point, const PointData &fixed) const;

      /// If a corner lies beyond the concave end of a face, the face that begins there, else
      /// invalid_index. If the body lies along the first face, its corner has no share in the contact
      /// with that face, and the full share in the contact with the second one, whatever the angle
      /// is.
      unsigned int
      face_beyond_concave_end(const ContactProjection &projection) const;

      /// The face by NarrowPhase alone, for a point along an edge or a corner.
      ContactProjection
      find_master(const ContactPoint          &point,
                  const PointData             &fixed,
                  const ContactSurface::Place &slave) const;

      /// The projection on one edge, for a point along an edge.
      ContactProjection
      project_on(unsigned int                 edge,
                 const ContactPoint          &point,
                 const PointData             &fixed,
                 const ContactSurface::Place &slave) const;

      /// Let a corner that is in contact only at one end of a step be in contact with the face of
      /// that end. At a corner of the master the nearest face in the middle of the step jumps, and
      /// the force would jump with it.
      void
      stay_with_face_of_end(const ContactPoint          &point,
                            const PointData             &fixed,
                            const ContactSurface::Place &slave,
                            ContactProjection           &projection) const;

      /// Unit normal of the other edge that meets in a corner; zero if there is none.
      dealii::Tensor<1, 2>
      normal_of_other_edge(const ContactPoint &point,
                           const PointData    &fixed) const;

      const ContactSurface *surface;
      const ContactSearch  *search;
      NarrowPhase           narrow;
      const PointMaker     *maker;
      const ContactMemory  *memory;
      ContactIntegration    integration;
      RoundedCorners        rounded;
      double                reach = 0.;
      /// With its faces_beside, which do not change in a step.
      const PointSet *set = nullptr;
      /// Largest depth of new contact of an edge that has not moved, see AdmittedContact [m].
      double admitted_depth = 0.;
      /// Way of each edge since the last accepted state [m], where it bounds the depth of new contact.
      std::vector<double> edge_motions;
    };
  } // namespace internal
} // namespace NMM

#endif
