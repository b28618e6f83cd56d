#ifndef nmm_source_contact_detection_search_h
#define nmm_source_contact_detection_search_h

#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <base/cross.h>
#include <contact/detection/corner_rules.h>
#include <limits>
#include <memory>
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
      /// Faces that the point is beside, see ContactSearch::append_faces_beside(); they are
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


    /**
     * Finds candidate pairs and the nearest faces. Broad phase: the bounding boxes of all edges in
     * an R-tree (Boost.Geometry, packed) are queried with the boxes of slave edges, enlarged by the
     * reach. Narrow phase: the closest point.
     *
     * Of two edges the *slave* carries the contact points. Obstacles are always masters; of two
     * blocks the one with the lower rank is the slave; within a block the edge that looks more into
     * a fixed direction is, so that all edges of a face are the same.
     *
     * Faces that are nearly parallel touch along their length; a corner that points at a face
     * touches in a point, whichever body it belongs to. So convex corners of both sides are contact
     * points, too, one for each of the two edges that end there. They have the fraction 1 -
     * along_face() of a fixed weight, and points along slave edges have the fraction along_face().
     *
     * Order of calls: update() at the beginning of a step, then slaves(), masters() and the
     * functions that project.
     */
    class ContactSearch
    {
    public:
      /// @p slave_priority: see ContactParameters. @p only_vertices: whether only corners are slaves,
      /// the ends of arcs among them.
      ContactSearch(const ContactSurface     &surface,
                    std::vector<unsigned int> slave_priority,
                    bool                      only_vertices = false);
      ~ContactSearch();

      /**
       * Update the masters of this rank's edges at the current positions of the surface. Each body
       * has a reach [m], and faces of two bodies are candidates if they are nearer to each other
       * than the sum of both, so that a body that flies off makes no candidates among those at
       * rest. Masters are searched for within 1.5 times the @p reaches, one for each body, and kept
       * until a face has moved further than the difference allows. Returns whether they have been
       * searched for.
       */
      bool
      update(const std::vector<double> &reaches);

      /// Let the next update() search for masters, because bodies have appeared or disappeared.
      void
      forget()
      {
        broad_reaches.clear();
      }

      /// Search for masters now, within 1.5 times the @p reaches of the bodies [m].
      void
      search(const std::vector<double> &reaches);

      /// Slave edges of this rank that have masters: first those that touch along their length,
      /// then those with a corner at one end, ascending in both parts. Corners of obstacles belong
      /// to the first rank.
      const std::vector<unsigned int> &
      slaves() const;

      /// The end of a slave that is a corner, 0 or 1; 2 if the slave touches along its length.
      unsigned int
      corner(unsigned int position) const
      {
        return corners[position];
      }

      /// Whether an end of an edge is a corner that can touch as a point.
      bool
      is_corner(unsigned int edge, unsigned int end) const;

      /// Whether the first one of two edges is the slave.
      bool
      comes_first(unsigned int edge, unsigned int other) const;

      /// Fraction of the contact of two faces that is along their length: 1 if they are nearly
      /// parallel, 0 if they meet at an angle. @p facing is minus the product of their normals.
      static double
      along_face(double facing);

      /// Work of the search on this rank since it was made; unlike times, it does not depend on the
      /// machine.
      struct Statistics
      {
        /// Number of edges whose boxes meet that of a slave or corner, and number of those that may
        /// touch it.
        std::size_t n_boxes = 0, n_candidates = 0;
      };

      const Statistics &
      statistics() const
      {
        return counts;
      }

      /// Masters of the slave at a position of slaves(), ascending.
      dealii::ArrayView<const unsigned int>
      masters(unsigned int position) const;

      /// Current positions of start, middle and end of all edges.
      std::vector<ContactPosition>
      positions() const;

      /// The largest distances of these places of each body from earlier ones [m], the same on all
      /// ranks.
      std::vector<double>
      distances(const std::vector<ContactPosition> &from) const;

      /// Those from the positions at update().
      std::vector<double>
      motions() const
      {
        return distances(begin_positions);
      }

      /// Start, middle and end of all edges at update().
      const std::vector<ContactPosition> &
      step_begin() const
      {
        return begin_positions;
      }

      /// Choice of the beginning of a step: the current positions, the reference configuration, the
      /// previous choice (current positions if there is none), or unknown.
      enum class Begin
      {
        here,
        reference,
        unchanged,
        unknown
      };

      void
      begin(Begin where);

      /// Largest distance [m] that an end or the middle of each edge has moved since begin(); empty
      /// if the beginning is unknown.
      void
      find_motions_since_begin(std::vector<double> &motions) const;

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

      /// Fraction of an edge by which it is continued beyond an end with this corner.
      static double
      extension(ContactSurface::Corner corner, double slack);

      /// Slack of a master in project().
      static double
      slack_of(unsigned int master, double slack, unsigned int home);

      bool
      may_touch(unsigned int edge, unsigned int other) const;

      /// The distance within which faces of the bodies of two edges are candidates [m].
      double
      reach_of(unsigned int edge, unsigned int other) const
      {
        return reaches[surface->edges()[edge].body] +
               reaches[surface->edges()[other].body];
      }

      void
      set_reaches(const std::vector<double> &given);

      void
      append(unsigned int                     edge,
             unsigned int                     corner,
             const std::vector<unsigned int> &masters);

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

      bool
      meet_in_convex_corner(unsigned int edge, unsigned int other) const;

      /// The corner past which at most a few edges lead from one edge to the other; smooth if there
      /// is none.
      ContactSurface::Corner
      corner_between(unsigned int edge, unsigned int other) const;

      /// Length of the part of an edge that lies behind a face and ends at a corner of the edge
      /// [m]; infinite if the edge continues behind the face beyond its end.
      double
      length_behind(unsigned int edge, const ContactSurface::Place &face) const;

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

      const ContactSurface     *surface;
      std::vector<unsigned int> ranks;
      /// Order of the edges of a block, see comes_first().
      std::vector<double> edge_to_side;
      bool                only_vertices;
      Statistics          counts;
      /// The reaches of all bodies, and those within which masters have been searched for; empty if
      /// there must be a search [m].
      std::vector<double> reaches, broad_reaches;
      /// The largest sum of two reaches [m].
      double                    reach = 0.;
      std::vector<unsigned int> slave_edges, masters_begin, master_edges;
      std::vector<unsigned int> corners;
      /// Positions of start, middle and end of all edges at search(), at update() and at begin().
      std::vector<ContactPosition> known_positions, begin_positions;
      std::vector<ContactPosition> accepted_positions;
    };
  } // namespace internal
} // namespace NMM

#endif
