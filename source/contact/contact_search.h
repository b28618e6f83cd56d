#ifndef nmm_source_contact_contact_search_h
#define nmm_source_contact_contact_search_h

#include <nmm/contact/contact_surface.h>

#include <algorithm>
#include <contact/corner_rules.h>
#include <limits>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Where a point of a slave edge meets a master edge.
    struct ContactProjection
    {
      unsigned int master = invalid_index;
      double       t      = 0.;
      /// Positive outside [m].
      double                gap = 0.;
      dealii::Tensor<1, 2>  normal;
      ContactSurface::Place place;
    };


    /**
     * Is a convex corner, between edges with these unit normals, the furthest place of its
     * body against the normal n of a face, that is, is -n between both? Only such pairs of a corner
     * and a face bound the entrance block of two convex bodies, the Minkowski sum of one and the
     * mirrored other one (Shi, Sci. China Technol. Sci. 58 (2015) 1450), and tell whether they
     * overlap. @p other_normal: zero if it is not known; then it may.
     */
    inline bool
    can_separate(const dealii::Tensor<1, 2> &face_normal,
                 const dealii::Tensor<1, 2> &normal,
                 const dealii::Tensor<1, 2> &other_normal)
    {
      const auto cross = [](const auto &a, const auto &b) {
        return a[0] * b[1] - a[1] * b[0];
      };
      const double turn = cross(normal, other_normal);
      if (turn == 0.)
        return true;
      const double sign = turn > 0. ? 1. : -1.;
      return sign * cross(face_normal, normal) >=
               -CornerRules::entrance_border &&
             sign * cross(other_normal, face_normal) >=
               -CornerRules::entrance_border;
    }


    /// What a point may be in contact with.
    struct AdmittedContact
    {
      /// New contact begins at the surface: no face that a point lies further
      /// behind than this [m] has been reached from outside.
      double depth = std::numeric_limits<double>::max();
      /// Faces that the point was behind before, however deep.
      dealii::ArrayView<const unsigned int> touching;
      /// Faces that the point is beside, see ContactSearch::append_faces_beside().
      dealii::ArrayView<const unsigned int> beside;
      /// Faces that are less parallel do not touch: minus the product of both unit
      /// normals.
      double least_facing = CornerRules::least_facing;

      /// What is found far inside of a body may have got there.
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
        return (projection.gap >= -depth || is_in(touching)) && !is_in(beside);
      }
    };


    /**
     * Finds what may touch. Broad phase: the boxes of all edges in an R-tree
     * (Boost.Geometry, packed), queried by the boxes of slave edges inflated by a
     * reach. Narrow phase: the closest point.
     *
     * Of two edges the *slave* carries the contact points: obstacles are always
     * masters, of blocks the one with the lower rank is the slave, within a
     * block the one that looks more to one side: all of a face's edges are the same.
     *
     * Faces that are nearly parallel touch along their length; a corner that points at a
     * face touches in a point, whichever body it belongs to. So convex corners of
     * both sides are points, too, one for each of the two edges that end there, with
     * the share 1 - along_face() of a fixed weight, and points along slave edges have
     * the share along_face().
     */
    class ContactSearch
    {
    public:
      /// @p body_ranks: see ContactParameters; empty: the body's number.
      /// @p only_vertices: there are no slaves but corners, and ends of arcs are some,
      /// too.
      ContactSearch(const ContactSurface     &surface,
                    std::vector<unsigned int> body_ranks,
                    bool                      only_vertices = false);
      ~ContactSearch();

      /**
       * Have the masters of this rank's edges within @p reach [m] at the
       * surface's current positions. They are looked for within half as much again,
       * and kept as long as no face has moved by more than what that leaves over.
       * Returns whether they have been looked for.
       */
      bool
      update(double reach);

      /// Bodies have come or gone: the next update() looks for masters anew.
      void
      forget()
      {
        broad_reach = 0.;
      }

      /// Look for them now, within one and a half times @p reach.
      void
      search(double reach);

      /// Edges that this rank looks after and that have masters: first slaves
      /// with all of their length, then those of which one end is a corner;
      /// ascending in both parts. Corners of obstacles are with the first rank.
      const std::vector<unsigned int> &
      slaves() const;

      /// The end of a slave that is a corner: 0 or 1; all of its length: 2.
      unsigned int
      corner(unsigned int position) const
      {
        return corners[position];
      }

      /// Is this end of an edge a corner that can touch as such?
      bool
      is_corner(unsigned int edge, unsigned int end) const;

      /// Is it the first of two edges that is the slave along their length?
      bool
      comes_first(unsigned int edge, unsigned int other) const;

      /// Share of the contact of two faces that is along their length: 1 if they are
      /// nearly parallel, 0 if they meet at an angle. @p facing: minus the product of
      /// their normals.
      static double
      along_face(double facing);

      /// What the search has done on this rank since it was made; times of machines
      /// say less.
      struct Statistics
      {
        /// Edges whose boxes meet that of a slave or corner, and those of them that may
        /// touch it.
        std::size_t n_boxes = 0, n_candidates = 0;
      };

      const Statistics &
      statistics() const
      {
        return counts;
      }

      /// Of the slave at a position of slaves(), ascending.
      dealii::ArrayView<const unsigned int>
      masters(unsigned int position) const;

      /// Largest way [m] that an end or the middle of an edge has moved since
      /// update(), on this rank's knowledge, which is that of all ranks.
      double
      motion() const
      {
        return largest_distance(begin_positions);
      }

      /// At update(): start, middle and end of all edges.
      const std::vector<dealii::Point<2>> &
      step_begin() const
      {
        return begin_positions;
      }

      /// Where a step begins: where faces are now, or in the reference configuration;
      /// unchanged, or here if it is not known.
      enum class Begin
      {
        here,
        reference,
        unchanged,
        unknown
      };

      void
      begin(Begin where);

      /// As motion(), since the begin of the step.
      double
      motion_since_begin() const
      {
        return largest_distance(accepted_positions);
      }

      /// As the home of project(): all of the masters.
      static constexpr unsigned int any_edge = invalid_index - 1;

      /// Where a slave is divided: parameter, and the master and its end that lie
      /// there if that is a corner.
      struct Division
      {
        double       s      = 0.;
        unsigned int master = invalid_index, end = 0;
      };

      /**
       * Where the slave at a position is to be divided, ascending from 0 to 1:
       * its ends, and where ends of its masters lie nearest. On
       * the pieces between, both displacements are polynomials.
       */
      std::vector<Division>
      divisions(unsigned int position) const;

      /**
       * The nearest of the masters that face the normal of @p slave_place (unit
       * normals' product below -0.01), within the reach; master is invalid_index
       * if there is none. An edge that has the nearest point within its ends comes
       * before one that has it beyond them, by however little. Of two that meet in a convex corner: the one that faces
       * it more, whichever is nearer (Shi's entrance edge: with a corner in the other
       * body, both are penetrated); the same for two at equal distance, then the lower
       * number. There is none, either, if a face of the master's body that looks the
       * point's own way is nearer, the far side of a thin body: it is not by the master that
       * the point is inside, if it is. Beyond a
       * convex corner or an open end there is no master, beyond a smooth joint or a concave
       * corner an edge goes on. @p slack: part of an edge by which the edge @p home goes on at convex corners
       * and open ends, other bodies than its own being left out; negative: by which all end earlier, see end_slack().
       */
      ContactProjection
      project(const ContactSurface::Place          &slave_place,
              dealii::ArrayView<const unsigned int> masters,
              double                                slack = 0.,
              unsigned int                          home  = invalid_index,
              const AdmittedContact &admitted = AdmittedContact()) const;

      /**
       * The master of a corner. The corner is in a body if it is behind a face, and of
       * two faces that meet in a convex corner behind both. It is then pushed out
       * through the face by which it came in, @p entrance, as long as it is behind
       * that one; at first through the one that it is least behind (Shi's entrance
       * edge), at equal depths through the one with the lower number. A face keeps the corner
       * out only if nothing of the corner's own body reaches further against that face's normal, that
       * is, if the reversed normal is between those of both edges that meet in the corner (the
       * faces of the Minkowski sum of one convex body and the mirrored other one): the tip of a wedge
       * that is beside a corner is in front of one of its faces, and yet the wedge is in it. Where that is a face
       * that only the corner's other edge faces, whose unit normal is @p other_normal
       * (zero: none is known), the point of that other edge is pushed out. A corner that is
       * in no body has the nearest face for master.
       */
      ContactProjection
      project_corner(const ContactSurface::Place          &slave_place,
                     const dealii::Tensor<1, 2>           &other_normal,
                     dealii::ArrayView<const unsigned int> masters,
                     unsigned int                          entrance,
                     const AdmittedContact &admitted = AdmittedContact()) const;

      /**
       * How far a point at @p x is, at least, from where it would be behind one of
       * the masters as project() finds it with @p slack and @p home, project_corner() with
       * CornerRules::beyond_rounding and any_edge: the distance from the strips behind all of
       * them that are as deep as the reach [m]. 0 if one of them is an arc.
       */
      double
      clearance(const dealii::Point<2>               &x,
                dealii::ArrayView<const unsigned int> masters,
                double                                slack,
                unsigned int                          home) const;

      /**
       * For the division at which a piece of a slave begins or ends: it lies
       * where a master's corner lies, and rounding and small motions must not
       * decide whether it has a master. The piece does: if there is a master
       * next to the end of the piece, which goes on to @p s_inside, the result is
       * positive, else negative. @p master: that one. Faces so steep on the slave
       * that they bear nothing along it, see along_face(), are none: where corners of two
       * bodies are side by side, one may be nearer than the face that goes on above the piece.
       */
      double
      end_slack(unsigned int    position,
                const Division &division,
                double          s_inside,
                unsigned int   &master) const;

      /// The edge of the body of @p master that ends, within a hundredth of a
      /// cell, where the slave at a position has the parameter @p s, or goes on there.
      unsigned int
      find_home(unsigned int position, double s, unsigned int master) const;

      /**
       * Which of some masters a point of an edge is beside of: it lies deeper behind them
       * than @p depth [m], but the overlap of the edge with their body ends at the next face
       * round a convex corner, and is much less long than deep. Corners that pass each other
       * by the side overlap so; the faces there touch, not the ones that the point is
       * far behind. Depths are from the tangent in the middle of a master: arcs are taken for
       * straight.
       */
      void
      append_faces_beside(unsigned int                          edge,
                          const dealii::Point<2>               &x,
                          dealii::ArrayView<const unsigned int> masters,
                          double                                depth,
                          std::vector<unsigned int>            &faces) const;

      /// How far @p x is inside of a body: from the nearest of the candidates at
      /// @p position that belong to it [m]; 0 outside.
      double
      depth_inside(unsigned int            position,
                   unsigned int            body,
                   const dealii::Point<2> &x) const;

    private:
      /// The edge of the corner at a division that goes on above the slave's piece
      /// towards @p s_inside and faces it; invalid_index: none.
      unsigned int
      edge_beside(unsigned int    position,
                  const Division &division,
                  double          s_inside) const;

      /// Part of an edge by which it may go on beyond an end.
      static double
      extension(ContactSurface::Corner corner, double slack);

      /// Of a master in project().
      static double
      slack_of(unsigned int master, double slack, unsigned int home);

      bool
      may_touch(unsigned int edge, unsigned int other) const;

      void
      append(unsigned int                     edge,
             unsigned int                     corner,
             const std::vector<unsigned int> &masters);

      ContactProjection
      project_within(const ContactSurface::Place          &slave_place,
                     dealii::ArrayView<const unsigned int> masters,
                     double                                slack,
                     unsigned int                          home,
                     unsigned int                          body,
                     double                                largest_gap,
                     const AdmittedContact                &admitted) const;

      double
      largest_distance(const std::vector<dealii::Point<2>> &positions) const;

      /// How far a corner at @p x, behind a face, is outside of the body because of a face
      /// that meets this one in a convex corner [m]; negative: it is not. Both normals are
      /// those of the corner's edges, see can_separate().
      double
      gap_beyond_corner(unsigned int                edge,
                        const dealii::Point<2>     &x,
                        const dealii::Tensor<1, 2> &normal,
                        const dealii::Tensor<1, 2> &other_normal) const;

      bool
      meet_in_convex_corner(unsigned int edge, unsigned int other) const;

      /// How long the part of an edge is that lies behind a face and ends at a corner
      /// of the edge [m]; infinite where the edge goes on behind it.
      double
      length_behind(unsigned int edge, const ContactSurface::Place &face) const;

      /// See append_faces_beside(); @p depth: behind this master.
      bool
      is_beside(unsigned int            edge,
                const dealii::Point<2> &x,
                unsigned int            master,
                double                  depth) const;

      bool
      find_nearest(unsigned int            edge,
                   const dealii::Point<2> &x,
                   double                 &t,
                   ContactSurface::Place  &place) const;

      const ContactSurface     *surface;
      std::vector<unsigned int> ranks;
      /// See comes_first().
      std::vector<double>       edge_to_side;
      bool                      only_vertices;
      Statistics                counts;
      double                    reach = 0., broad_reach = 0.;
      std::vector<unsigned int> slave_edges, masters_begin, master_edges;
      std::vector<unsigned int> corners;
      /// At search(), at update() and where begin() says.
      std::vector<dealii::Point<2>> known_positions, begin_positions;
      std::vector<dealii::Point<2>> accepted_positions;
    };
  } // namespace internal
} // namespace NMM

#endif
