#ifndef nmm_source_contact_detection_points_h
#define nmm_source_contact_detection_points_h

#include <nmm/contact/parameters.h>
#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <array>
#include <contact/detection/search.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Kind of a contact point. It is an end of its edge, as a corner that touches in a point; or a
    /// place along a slave; or a corner of the master that lies on the slave. In the last case the
    /// slave is the point's master, because the corner slides along the slave.
    struct PointKind
    {
      enum Value : unsigned int
      {
        first_end   = 0,
        last_end    = 1,
        along       = 2,
        master_ends = 3
      };
    };


    /// Number of the places along an edge, or of a corner; the history of points is stored by it.
    inline unsigned int
    place_key(const ContactSurface &surface,
              const unsigned int    edge,
              const unsigned int    kind)
    {
      return kind == PointKind::along
               ? edge
               : edge + (kind + 1) * surface.edges().size();
    }


    /// Parameter in [0, 1] of the place of an edge, a segment or an arc in the reference
    /// configuration, that is nearest to @p x.
    double
    nearest_parameter(const ContactSurface::Edge &edge,
                      const dealii::Point<2>     &x);


    /// Gauss-Lobatto rule of @p n points on [0, 1].
    void
    lobatto_rule(unsigned int         n,
                 std::vector<double> &points,
                 std::vector<double> &weights);


    /// The contact law of each pair of edges.
    class ContactLaws
    {
    public:
      ContactLaws(const ContactSurface    &surface,
                  const ContactParameters &parameters);

      const ContactLaw &
      operator()(const unsigned int slave, const unsigned int master) const
      {
        return *laws[laws.size() == 1
                       ? 0
                       : law_of_names[edge_names[slave] * n_names +
                                      edge_names[master]]];
      }

    private:
      std::vector<std::shared_ptr<const ContactLaw>> laws;
      std::vector<unsigned int>                      edge_names, law_of_names;
      unsigned int                                   n_names = 0;
    };


    /// Size of the edge's cell: the square root of its Jacobian determinant [m].
    double
    cell_size(const ContactSurface::Edge &edge);


    /**
     * Length for which a corner stands as a contact point [m], two for each edge: the size of the
     * cell, or the distance to the next corner if that is shorter. For obstacles the mean size of
     * all cells at faces replaces that of the cell.
     */
    std::vector<double>
    corner_sizes(const ContactSurface &surface);


    /// Anchor, bond and slip of a contact point, by the parameter s on its edge.
    struct StickPlace
    {
      double       s;
      unsigned int edge;
      double       t;
      bool         is_bonded = false;
      /// Slip that causes dilation or weakening [m].
      double slip = 0.;
    };

    /**
     * The anchors of all edges and corners, by place_key(). They are replaced in every step, so
     * that the memory for them is kept: allocation would dominate the cost otherwise.
     */
    class StickPlaces
    {
    public:
      /// Anchors of a key, or null if there are none.
      const std::vector<StickPlace> *
      find(const unsigned int key) const
      {
        return key < places_of.size() && !places_of[key].empty()
                 ? &places_of[key]
                 : nullptr;
      }

      /// Append an anchor after the others of its key.
      void
      append(const unsigned int key, const StickPlace &place)
      {
        open(key).push_back(place);
      }

      /// Insert an anchor at its parameter s, and replace the one with the same s.
      void
      insert(unsigned int key, const StickPlace &place);

      /// Call action(key, places) for all keys, in the order in which these were first used.
      template <typename Action>
      void
      for_each(const Action &action) const
      {
        for (const unsigned int key : keys)
          action(key, places_of[key]);
      }

      /// Remove the anchors for which is_dropped(key, place) is true.
      template <typename Predicate>
      void
      remove_if(const Predicate &is_dropped)
      {
        for (const unsigned int key : keys)
        {
          auto &places = places_of[key];
          places.erase(std::remove_if(places.begin(),
                                      places.end(),
                                      [&](const StickPlace &place) {
                                        return is_dropped(key, place);
                                      }),
                       places.end());
        }
        keys.erase(std::remove_if(keys.begin(),
                                  keys.end(),
                                  [this](const unsigned int key) {
                                    return places_of[key].empty();
                                  }),
                   keys.end());
      }

      void
      clear();

      /// Sort the anchors of each key by s.
      void
      sort();

    private:
      std::vector<StickPlace> &
      open(unsigned int key);

      std::vector<std::vector<StickPlace>> places_of;
      /// Keys that have anchors.
      std::vector<unsigned int> keys;
    };

    /// Compute the anchor for the parameter @p s. It is linear in s on the master of the nearer
    /// anchor that has two, also beyond its last one; the slip is linear between two anchors.
    /// Returns false if there are no anchors.
    bool
    find_stick_place(const std::vector<StickPlace> &places,
                     double                         s,
                     StickPlace                    &result);
  } // namespace internal
} // namespace NMM

#endif
