#ifndef nmm_source_contact_contact_points_h
#define nmm_source_contact_contact_points_h

#include <nmm/contact/contact.h>

#include <algorithm>
#include <array>
#include <contact/contact_search.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// What a contact point is: an end of its edge as a corner that touches in a point, a place
    /// along a slave, or such a place where a corner of the master lies: that corner is then
    /// the point, and the slave its master, since the corner slides along the slave.
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


    /// Number of the places along an edge, or of a corner: what points remember is stored by it.
    inline unsigned int
    place_key(const ContactSurface &surface,
              const unsigned int    edge,
              const unsigned int    kind)
    {
      return kind == PointKind::along
               ? edge
               : edge + (kind + 1) * surface.edges().size();
    }


    /// Gauss-Lobatto rule of @p n points on [0, 1].
    void
    lobatto_rule(unsigned int         n,
                 std::vector<double> &points,
                 std::vector<double> &weights);


    /**
     * Multipliers of the augmented Lagrangian: continuous and linear along
     * the boundary, on stretches that are about as long as the cells, whatever the
     * cuts: a multiplier per cut edge would be more than the displacements can
     * follow, and pressures would oscillate. At corners they may jump.
     */
    class MultiplierSpace
    {
    public:
      explicit MultiplierSpace(const ContactSurface &surface);

      /// Two functions per edge: their numbers, and the second one's values
      /// at the edge's ends (linear in between; the first one is the rest).
      struct OnEdge
      {
        unsigned int first = invalid_index, second = invalid_index;
        double       at_start = 0., at_end = 0.;

        double
        share(const double s) const
        {
          return (1. - s) * at_start + s * at_end;
        }
      };

      const OnEdge &
      operator[](const unsigned int edge) const
      {
        return on_edges[edge];
      }

      unsigned int
      size() const
      {
        return n_functions;
      }

      double
      value(const std::vector<double> &coefficients,
            const unsigned int         edge,
            const double               s) const
      {
        const OnEdge &f = on_edges[edge];
        return (1. - f.share(s)) * coefficients[f.first] +
               f.share(s) * coefficients[f.second];
      }

    private:
      void
      add_stretch(const ContactSurface            &surface,
                  const std::vector<unsigned int> &edges);

      std::vector<OnEdge> on_edges;
      unsigned int        n_functions = 0;
    };


    /// The law of each pair of edges.
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

      bool
      has_dilation() const
      {
        return std::any_of(laws.begin(), laws.end(), [](const auto &law) {
          return law->dilation > 0.;
        });
      }

    private:
      std::vector<std::shared_ptr<const ContactLaw>> laws;
      std::vector<unsigned int>                      edge_names, law_of_names;
      unsigned int                                   n_names = 0;
    };


    /**
     * What a corner stands for as a contact point [m], two for each edge: the cell's
     * size, or the distance to the next corner if that is shorter; of obstacles with
     * the mean size of cells.
     */
    std::vector<double>
    corner_sizes(const ContactSurface &surface);


    /// Where the points of a slave edge stick, ascending in s.
    struct StickPlace
    {
      double       s;
      unsigned int edge;
      double       t;
      bool         is_bonded = false;
      /// Way that has been slid, as far as it dilates [m].
      double slip = 0.;
    };

    /**
     * Those of all edges and corners, by a number each. They are noted anew in every
     * step, and so what they need is kept: a table that allots each entry by itself takes
     * more time for that than for all else.
     */
    class StickPlaces
    {
    public:
      /// Null: there are none.
      const std::vector<StickPlace> *
      find(const unsigned int key) const
      {
        return key < places_of.size() && !places_of[key].empty()
                 ? &places_of[key]
                 : nullptr;
      }

      /// To which @p place is added, after the others.
      void
      append(const unsigned int key, const StickPlace &place)
      {
        open(key).push_back(place);
      }

      /// Before what lies behind it, or instead of what lies there.
      void
      insert(unsigned int key, const StickPlace &place);

      /// Call action(key, places), in the order in which they came.
      template <typename Action>
      void
      for_each(const Action &action) const
      {
        for (const unsigned int key : keys)
          action(key, places_of[key]);
      }

      /// Remove those for which is_dropped(key, place) is true.
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

      /// Those of each edge or corner ascend in s.
      void
      sort();

    private:
      std::vector<StickPlace> &
      open(unsigned int key);

      std::vector<std::vector<StickPlace>> places_of;
      /// Of which there are any.
      std::vector<unsigned int> keys;
    };

    /// The place for @p s: linear in s on the master of the nearer place that has
    /// two, beyond its last place as well; slip linear between two places; false if
    /// there are none.
    bool
    find_stick_place(const std::vector<StickPlace> &places,
                     double                         s,
                     StickPlace                    &result);
  } // namespace internal
} // namespace NMM

#endif
