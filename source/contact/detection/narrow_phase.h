#ifndef nmm_source_contact_detection_narrow_phase_h
#define nmm_source_contact_detection_narrow_phase_h

#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <base/cross.h>
#include <contact/detection/corner_rules.h>
#include <contact/detection/search.h>
#include <limits>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Projection of a point of a slave edge onto a master edge.
    struct ContactProjection
    {
      unsigned int master = invalid_index;
      double       t      = 0.;
      /// Gap, positive outside of the master [m].
      double                gap = 0.;
      dealii::Tensor<1, 2>  normal;
      ContactSurface::Place place;
    };


    /**
     * Whether a convex corner, between edges with the unit normals @p normal and @p other_normal,
     * is the furthest place of its body against the normal n of a face, that is, whether -n is
     * between both normals. Only such pairs of a corner and a face bound the entrance block of two
     * convex bodies, the Minkowski sum of one and the mirrored other one (Shi, Sci. China Technol.
     * Sci. 58 (2015) 1450), and show whether the bodies overlap. The result is true if
     * @p other_normal is zero, that is, not known.
     */
    inline bool
    can_separate(const dealii::Tensor<1, 2> &face_normal,
                 const dealii::Tensor<1, 2> &normal,
                 const dealii::Tensor<1, 2> &other_normal)
    {
      const double turn = cross(normal, other_normal);
      if (turn == 0.)
        return true;
      const double sign = turn > 0. ? 1. : -1.;
      return sign * cross(face_normal, normal) >=
               -CornerRules::entrance_border &&
             sign * cross(other_normal, face_normal) >=
               -CornerRules::entrance_border;
    }


    /// Restrictions on the contact of a point.
    struct AdmittedContact
    {
      /// Largest depth of new contact [m], without the motion of the face. A face that is further
      /// from the point has not been reached from outside.
      double depth = std::numeric_limits<double>::max();
      /// Way of each face since the last accepted state [m], or empty.
      dealii::ArrayView<const double> motions;
      /// Faces that the edge of the point has penetrated at the last accepted state, and how deep the
      /// point may be behind them [m].
      dealii::ArrayView<const unsigned int> touching;
      double touching_depth = std::numeric_limits<double>::max();
      /// Faces that the point is beside, see append_faces_beside(); they are
      /// excluded.
      dealii::ArrayView<const unsigned int> beside;
      /// Faces that the point does not touch, see RoundedCorners.
      dealii::ArrayView<const unsigned int> rounded;
      /// Least value of minus the product of both unit normals; faces that are less parallel do not
      /// touch.
      double least_facing = CornerRules::least_facing;

      /// Whether the depth of new contact is limited.
      bool
      is_bound() const
      {
        return depth < std::numeric_limits<double>::max();
      }

      bool
      holds(const ContactProjection &projection) const
      {
        const auto is_in = [&](const auto &faces) {
          return std::find(faces.begin(), faces.end(), projection.master) !=
                 faces.end();
        };
        const double way =
          motions.size() == 0 ? 0. : motions[projection.master];
        return (projection.gap >= -depth - way ||
                (projection.gap >= -touching_depth - way && is_in(touching))) &&
               !is_in(beside) && !is_in(rounded);
      }
    };


    /// The narrow phase: the nearest face of a point among its candidates, and the parts into which
    /// slaves are divided. Everything is that of the current positions. All references must
    /// outlive this object.
    class NarrowPhase
    {
    public:
      NarrowPhase(const ContactSurface &surface, const ContactSearch &search)
        : surface(&surface)
        , search(&search)
      {
      }

      /// Fraction of the contact of two faces that is along their length: 1 if they are nearly
      /// parallel, 0 if they meet at an angle. @p facing is minus the product of their normals.
      static double
      along_face(double facing);

      /// Value of the home of project() that stands for all masters.
      static constexpr unsigned int any_edge = invalid_index - 1;

      /// A division of a slave: its parameter, and the master and its end that lie there if that
      /// end is a corner.
      struct Division
      {
        double       s      = 0.;
        unsigned int master = invalid_index, end = 0;
        /// Whether it only divides a curved contact into equal parts, see divisions().
        bool is_of_parts = false;
      };

      /**
       * Divisions of the slave at a position, ascending from 0 to 1: its ends, and the places
       * nearest to the ends of its masters. On the pieces in between, the displacements of both
       * sides are polynomials.
       *
       * With @p n_parts > 1 the slave is divided into that many equal parts and at corners of
       * masters, but not where masters continue smoothly. Points of bodies that roll on each other
       * then stay where they are, and the parts are so short that polynomials need not end at
       * their ends. Parts without a master within the reach are left whole, since nothing touches
       * there in this step.
       */
      std::vector<Division>
      divisions(unsigned int position, unsigned int n_parts = 1) const;

      /// Curvature of the gap between two edges that touch [1/m]: the sum of both curvatures, which
      /// are positive where a body is convex. It is 0 if one lies on the other, as straight faces
      /// and both faces of an arc do.
      double
      relative_curvature(unsigned int edge, unsigned int other) const;

      /// Largest relative curvature of the slave at a position and those masters that it can touch
      /// along its length [1/m]; 0 if none is positive.
      double
      largest_curvature(unsigned int position) const;

      /**
       * The nearest of the masters that face the normal of @p slave_place (product of unit normals
       * below -0.01) within the reach; master is invalid_index if there is none. An edge with the
       * nearest point between its ends comes before one with a nearest point beyond them. Of two
       * edges that meet in a convex corner, the one that faces the normal more is taken, whichever
       * is nearer (Shi's entrance edge: a corner in the other body penetrates both). The same holds
       * for two edges at equal distance; then the lower number is taken.
       *
       * There is no master either if a face of the same body that looks the same way as the slave
       * is nearer. The point is then beyond the far side of a thin body.
       *
       * Edges are continued beyond smooth joints and concave corners, but not beyond convex corners
       * and open ends. @p slack is the fraction of an edge by which the edge @p home is continued
       * there, too; other bodies than that of the home are then left out. If the slack is negative,
       * all edges are shortened by it, see end_slack().
       */
      ContactProjection
      project(const ContactSurface::Place          &slave_place,
              dealii::ArrayView<const unsigned int> masters,
              double                                slack = 0.,
              unsigned int                          home  = invalid_index,
              const AdmittedContact &admitted = AdmittedContact()) const;

      /**
       * The master of a corner. The corner is inside a body if it is behind a face, and, if two
       * faces meet in a convex corner, behind both. It is pushed out through the face by which it
       * came in, @p entrance, as long as it is behind that face. At first this is the face that it
       * is least behind (Shi's entrance edge), at equal depths the one with the lower number.
       *
       * A face keeps the corner out only if nothing of the corner's own body reaches further
       * against the face's normal, that is, if the reversed normal is between those of both edges
       * that meet in the corner (the faces of the Minkowski sum of one convex body and the mirrored
       * other one). Otherwise the tip of a wedge beside a corner would be in front of one of its
       * faces although the wedge is inside.
       *
       * If only the corner's other edge, with the unit normal @p other_normal (zero if it is not
       * known), faces the master, the point of that edge is pushed out. The master of a corner that
       * is in no body is the nearest face.
       */
      ContactProjection
      project_corner(const ContactSurface::Place          &slave_place,
                     const dealii::Tensor<1, 2>           &other_normal,
                     dealii::ArrayView<const unsigned int> masters,
                     unsigned int                          entrance,
                     const AdmittedContact &admitted = AdmittedContact()) const;

      /// The nearest face along which the slave touches at @p s, within twice the reach; invalid_index
      /// if there is none.
      unsigned int
      face_at(unsigned int position, double s) const;

      /**
       * Slack for the division at which a piece of a slave begins or ends. A master's corner lies
       * there, and neither rounding nor small motions may decide whether the point has a master.
       * The result is positive if the piece, which goes on to @p s_inside, has a master next to its
       * end, else negative. @p master is set to that master. Faces that are too steep to touch
       * along the slave, see along_face(), are left out: where corners of two bodies are side by
       * side, one may be nearer than the face above the piece.
       */
      double
      end_slack(unsigned int    position,
                const Division &division,
                double          s_inside,
                unsigned int   &master) const;

      /// The edge of the body of @p master that ends within a hundredth of a cell of the parameter
      /// @p s of the slave at a position, or continues there; invalid_index if there is none.
      unsigned int
      find_home(unsigned int position, double s, unsigned int master) const;

      /**
       * Append those masters that a point of an edge is beside of. The point is deeper behind such
       * a face than @p depth [m], but the overlap of the edge with that body ends at the next face
       * round a convex corner, and is much shorter than deep. This occurs where corners pass each
       * other by the side: the faces at the side touch, not the ones that the point is far behind.
       * Depths are measured from the tangent in the middle of a master; arcs are treated as
       * straight.
       */
      void
      append_faces_beside(unsigned int                          edge,
                          const ContactPosition                &x,
                          dealii::ArrayView<const unsigned int> masters,
                          double                                depth,
                          std::vector<unsigned int>            &faces) const;

      /// Distance of @p x from the nearest candidate at @p position that belongs to the body [m],
      /// if @p x is inside of the body; else 0.
      double
      depth_inside(unsigned int           position,
                   unsigned int           body,
                   const ContactPosition &x) const;

    private:
      /// Whether a master of the slave at a position is within the reach of @p x.
      bool
      is_in_reach(unsigned int position, const ContactPosition &x) const;

      /// The edge of the corner at a division that goes on above the slave's piece towards @p
      /// s_inside and faces it; invalid_index if there is none.
      unsigned int
      edge_beside(unsigned int    position,
                  const Division &division,
                  double          s_inside) const;

      /// By how much masters are continued beyond their ends, see project(), and the body whose
      /// masters alone count; invalid_index: those of all bodies.
      struct Masters
      {
        double       slack = 0.;
        unsigned int home = invalid_index, body = invalid_index;
      };

      ContactProjection
      project_within(const ContactSurface::Place          &slave_place,
                     dealii::ArrayView<const unsigned int> masters,
                     const Masters                        &which,
                     double                                largest_gap,
                     const AdmittedContact                &admitted) const;

      /// Distance of a corner at @p x from the body [m], if it is behind a face but in front of
      /// another face that meets this one in a convex corner; negative if there is no such face.
      /// Both normals are those of the corner's edges, see can_separate().
      double
      gap_beyond_corner(unsigned int                edge,
                        const ContactPosition      &x,
                        const dealii::Tensor<1, 2> &normal,
                        const dealii::Tensor<1, 2> &other_normal) const;

      /// Whether the point is beside a master, see append_faces_beside(); @p depth is its depth
      /// behind that master [m].
      bool
      is_beside(unsigned int           edge,
                const ContactPosition &x,
                unsigned int           master,
                double                 depth) const;

      bool
      find_nearest(unsigned int           edge,
                   const ContactPosition &x,
                   double                &t,
                   ContactSurface::Place &place) const;

      /// The largest distance within which faces are candidates [m].
      double
      reach() const
      {
        return search->largest_reach();
      }

      const ContactSurface *surface;
      const ContactSearch  *search;
    };
  } // namespace internal
} // namespace NMM

#endif
