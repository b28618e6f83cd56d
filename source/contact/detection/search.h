#ifndef nmm_source_contact_detection_search_h
#define nmm_source_contact_detection_search_h

#include <nmm/contact/surface/surface.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The broad phase: finds candidate pairs. The bounding boxes of all edges in an R-tree
     * (Boost.Geometry, packed) are queried with the boxes of slave edges, enlarged by the reach.
     *
     * Of two edges the *slave* carries the contact points. Obstacles are always masters; of two
     * blocks the one with the lower rank is the slave; within a block the edge that looks more into
     * a fixed direction is, so that all edges of a face are the same.
     *
     * Faces that are nearly parallel touch along their length; a corner that points at a face
     * touches in a point, whichever body it belongs to. So convex corners of both sides are contact
     * points, too, one for each of the two edges that end there. They have the fraction 1 -
     * NarrowPhase::along_face() of a fixed weight, and points along slave edges have that fraction.
     *
     * Order of calls: update() at the beginning of a step, then slaves() and masters().
     */
    class ContactSearch
    {
    public:
      /// @p slave_priority: see ContactParameters. @p only_vertices: whether only corners are slaves,
      /// the ends of arcs among them.
      ContactSearch(const ContactSurface     &surface,
                    std::vector<unsigned int> slave_priority,
                    bool                      only_vertices = false);

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

      /// The largest distance within which faces of two bodies are candidates [m].
      double
      largest_reach() const
      {
        return reach;
      }

      /// The distance within which faces of the bodies of two edges are candidates [m].
      double
      reach_of(unsigned int edge, unsigned int other) const
      {
        return reaches[surface->edges()[edge].body] +
               reaches[surface->edges()[other].body];
      }

    private:
      bool
      may_touch(unsigned int edge, unsigned int other) const;

      void
      set_reaches(const std::vector<double> &given);

      void
      append(unsigned int                     edge,
             unsigned int                     corner,
             const std::vector<unsigned int> &masters);

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
