#ifndef nmm_source_contact_assembly_point_sums_h
#define nmm_source_contact_assembly_point_sums_h

#include <nmm/contact/assembly/report.h>

#include <cmath>
#include <contact/assembly/point_terms.h>
#include <contact/detection/point_maker.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    /// What a contact point adds to forces, tangent and report. Points are evaluated on several
    /// threads: each evaluation writes to its point and to one of these, and the sums are made in the
    /// order of the points.
    struct PointForces
    {
      // The arrays of the local system stay uninitialized.
      PointForces() {}

      /// Begin with a point that adds nothing.
      void
      clear()
      {
        has_changed = is_near = has_forces = false;
        energy = rounding_square = 0.;
      }

      /// Whether the state of the point differs from the one before, whether its depth counts for
      /// the largest penetration, and whether it exerts forces.
      bool has_changed = false, is_near = false, has_forces = false;
      ContactProjection projection;
      /// Energy of its springs [J/m], and square of the estimated rounding of its force [N^2/m^2].
      double energy = 0., rounding_square = 0.;
      /// Gap at which its spring is at rest, without what opens it [m].
      double offset = 0.;
      /// Force on the slave [N/m]; set if there are forces, and so is the local system.
      dealii::Tensor<1, 2> force;
      ContactLocalSystem   local;
    };


    /**
     * Sums of an assembly over its contact points: the report, the depths and the rounding.
     * Order of calls: begin(), add() and add_changes() in the order of the points, end(). All
     * references must outlive this object.
     */
    class PointSums
    {
    public:
      PointSums(const ContactSurface &surface,
                const ContactSearch  &search,
                const PointMaker     &maker);

      void
      begin();

      void
      add(const ContactPoint &point,
          const PointData    &fixed,
          const PointForces  &forces);

      void
      add_changes(const unsigned int n)
      {
        of_points.n_changes += n;
      }

      /// Complete the sums of all ranks. @p n_points: number of points of this rank; @p is_between:
      /// whether they are those of a conserving step.
      void
      end(unsigned int n_points, bool is_between);

      const ContactReport &
      report() const
      {
        return of_points;
      }

      /// Largest penetration of springs, without what they were found behind a face [m].
      double
      deepest() const
      {
        return largest_depth;
      }

      /// See Contact::force_rounding() [N/m].
      double
      rounding() const
      {
        return std::sqrt(rounding_square);
      }

    private:
      /// Include the penetration at a point in the report, or at the deepest place beside it.
      void
      note_depth(const ContactPoint      &point,
                 const PointData         &fixed,
                 const ContactProjection &projection);

      /// Distance along the slave from a point to the place between it and the next points where a
      /// curved contact is deepest [m], and how much deeper it is there [m]; 0 if there is none.
      std::pair<double, double>
      deepest_beside(const ContactPoint      &point,
                     const PointData         &fixed,
                     const ContactProjection &projection) const;

      const ContactSurface *surface;
      NarrowPhase           narrow;
      const PointMaker     *maker;
      ContactReport         of_points;
      double                largest_depth = 0., rounding_square = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
