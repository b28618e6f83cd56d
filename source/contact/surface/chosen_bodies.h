#ifndef nmm_source_contact_surface_chosen_bodies_h
#define nmm_source_contact_surface_chosen_bodies_h

#include <nmm/contact/surface/surface.h>

#include <linear_algebra/chosen_items.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The contact points, covers, rows and edges that belong to chosen bodies. Points between two
     * other bodies are left out of assemblies. All bodies are chosen until select() is called.
     *
     * Order of calls: select() at any time; clear_points() when contact points are made again, and
     * then list_points() with the new points if has_to_list_points(). The surface must outlive this
     * object.
     */
    class ChosenBodies
    {
    public:
      explicit ChosenBodies(const ContactSurface &surface)
        : surface(&surface)
      {
      }

      /// See ContactTimeStep::restrict_to().
      void
      select(const std::vector<bool> &bodies);

      void
      clear_points()
      {
        points.clear();
      }

      bool
      has_to_list_points() const
      {
        return !bodies.empty() && points.empty();
      }

      /// List the bodies of each point: @p for_each calls its argument with each of the @p n_points
      /// contact points and each block that the point belongs to.
      template <typename ForEach>
      void
      list_points(const unsigned int n_points, const ForEach &for_each)
      {
        points.reinit(n_points, for_each);
        points.select(bodies);
      }

      /// Those of @p n_points points that belong to a chosen body, ascending; valid until the next
      /// call. The memory is kept, because assemblies must not allocate.
      const std::vector<unsigned int> &
      chosen_points(const unsigned int n_points)
      {
        listed_points.clear();
        points.for_each(n_points, [this](const unsigned int q) {
          listed_points.push_back(q);
        });
        return listed_points;
      }

      /// Call action(k) for the covers of chosen bodies, ascending.
      template <typename Action>
      void
      for_each_cover(const unsigned int n_covers, const Action &action) const
      {
        all_covers.for_each(n_covers, action);
      }

      template <typename Action>
      void
      for_each_edge(const Action &action) const
      {
        edges.for_each(surface->edges().size(), action);
      }

      const ChosenItems &
      covers() const
      {
        return all_covers;
      }

      const ChosenItems &
      rows() const
      {
        return all_rows;
      }

    private:
      void
      list_covers_and_edges();

      const ContactSurface *surface;
      std::vector<bool>     bodies;
      ChosenItems           points, all_covers, all_rows, edges;
      /// See chosen_points().
      std::vector<unsigned int> listed_points;
    };
  } // namespace internal
} // namespace NMM

#endif
