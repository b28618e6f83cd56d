#ifndef nmm_source_contact_detection_point_maker_h
#define nmm_source_contact_detection_point_maker_h

#include <contact/detection/narrow_phase.h>
#include <contact/state/memory.h>
#include <contact/state/multipliers.h>
#include <contact/state/point_data.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Candidate masters of a point.
    inline dealii::ArrayView<const unsigned int>
    masters_of(const ContactSearch &search, const PointData &fixed)
    {
      return fixed.corner <= PointKind::along
               ? search.masters(fixed.slave)
               : dealii::ArrayView<const unsigned int>(
                   &search.slaves()[fixed.slave], 1);
    }


    /**
     * Makes the contact points of a step: those along the pieces of the slaves, and the corners.
     * Anchors, bonds, slip and multipliers are those of the last accepted state; pressure and shear
     * of the initial stress are known from the place.
     *
     * Order of calls: make() after each ContactSearch::update(). All references must outlive this
     * object.
     */
    class PointMaker
    {
    public:
      PointMaker(const ContactSurface    &surface,
                 const ContactSearch     &search,
                 const ContactParameters &parameters,
                 const ContactMemory     &memory,
                 const Multipliers       &multipliers);

      /// Replace @p result by the points of all slaves of this rank, first those along edges, n_rule()
      /// for each piece. Its memory is used again.
      void
      make(bool with_faces_beside, PointSet &result) const;

      /// Number of points on each piece of a slave.
      unsigned int
      n_rule() const
      {
        return rule_points.size();
      }

      /// Weight of a point of the rule on a piece of length 1 [-].
      double
      rule_weight(const unsigned int q) const
      {
        return rule_weights[q];
      }

      /// Size of the cell at the slave of a point, or length of the face if that is shorter [m].
      double
      size_at(const PointData &fixed) const
      {
        return corner_size[2 * search->slaves()[fixed.slave]];
      }

    private:
      void
      find_faces_beside(PointSet &made) const;

      void
      add_points_of(unsigned int slave, PointSet &made) const;

      unsigned int
      n_parts_of(unsigned int slave) const;

      void
      add_corner(unsigned int slave, PointSet &made) const;

      ContactSurface::WeightValues
      weights_at(const ContactPoint &point) const;

      /// Restore the history of a point: its anchor, bond and slip, and its multiplier on @p slave.
      void
      restore(ContactPoint &point, PointData &fixed, unsigned int slave) const;

      void
      take_over_place(ContactPoint &point,
                      PointData    &fixed,
                      unsigned int  slave) const;

      /// Set the pressure and shear of the initial stress at a point that has its place.
      void
      set_initial_traction(PointData &fixed) const;

      /// Whether @p face ends near @p s of an edge, compared with the piece of the edge that ends at
      /// @p s and @p other_s.
      bool
      ends_near(unsigned int face,
                unsigned int edge,
                double       s,
                double       other_s) const;

      /// Whether at a division of a slave, at the end of its piece to @p other_s, @p face is in front
      /// of the face @p other, which the division belongs to: it ends there as well, or it is straight
      /// and of another body, and the corner lies on or behind it in the drawing, or behind it by more
      /// than springs are compressed. False if there is no other face. The slave is a position in
      /// ContactSearch::slaves().
      bool
      is_in_front(unsigned int                 face,
                  unsigned int                 other,
                  unsigned int                 slave,
                  const NarrowPhase::Division &division,
                  double                       other_s) const;

      const ContactSurface    *surface;
      const ContactSearch     *search;
      NarrowPhase              narrow;
      const ContactParameters *parameters;
      const ContactMemory     *memory;
      const Multipliers       *multipliers;
      /// See corner_sizes().
      std::vector<double> corner_size;
      /// Gauss-Lobatto rule on [0, 1].
      std::vector<double> rule_points, rule_weights;
    };
  } // namespace internal
} // namespace NMM

#endif
