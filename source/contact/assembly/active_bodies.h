#ifndef nmm_source_contact_assembly_active_bodies_h
#define nmm_source_contact_assembly_active_bodies_h

#include <nmm/contact/surface/surface.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <linear_algebra/active_items.h>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Active bodies, and the contact points, covers, rows and edges that belong to them. Points
     * between two inactive bodies are left out of assemblies. All bodies are active until select()
     * is called.
     *
     * Order of calls: select() at any time; clear_points() when contact points are made again, and
     * then list_points() with the new points if has_to_list_points(). The surface must outlive this
     * object.
     */
    class ActiveBodies
    {
    public:
      explicit ActiveBodies(const ContactSurface &surface)
        : surface(&surface)
      {
      }

      /// See ContactTimeStep::set_active_bodies().
      void
      select(const std::vector<bool> &is_active,
             const std::vector<bool> &is_held);

      /// For each body, whether it is active; empty if all are.
      const std::vector<bool> &
      flags() const
      {
        return is_active;
      }

      void
      clear_points()
      {
        points.clear();
      }

      bool
      has_to_list_points() const
      {
        return !is_active.empty() && points.empty();
      }

      /// List the bodies of each point: @p for_each calls its argument with each of the @p n_points
      /// contact points and each block that the point belongs to.
      template <typename ForEach>
      void
      list_points(const unsigned int n_points, const ForEach &for_each)
      {
        points.reinit(n_points, for_each);
        points.select(is_active);
      }

      /// Call action(q) for points that belong to an active body, ascending.
      template <typename Action>
      void
      for_each_point(const unsigned int n_points, const Action &action) const
      {
        points.for_each(n_points, action);
      }

      /// Call action(k) for the covers of active bodies, ascending.
      template <typename Action>
      void
      for_each_cover(const unsigned int n_covers, const Action &action) const
      {
        covers.for_each(n_covers, action);
      }

      template <typename Action>
      void
      for_each_edge(const Action &action) const
      {
        edges.for_each(surface->edges().size(), action);
      }

      const ActiveItems &
      active_covers() const
      {
        return covers;
      }

      const ActiveItems &
      active_rows() const
      {
        return rows;
      }

      /// Record that two edges exert forces on each other. Bodies that are neither active nor held
      /// are stored for take_touched().
      void
      note_pressed(const unsigned int edge, const unsigned int master)
      {
        if (is_active.empty())
          return;
        for (const unsigned int e : {edge, master})
        {
          const unsigned int body = surface->edges()[e].body;
          if (body < is_active.size() && !is_active[body] && !is_held[body])
            touched.push_back(body);
        }
      }

      /// See ContactTimeStep::take_touched().
      std::vector<unsigned int>
      take_touched()
      {
        return std::exchange(touched, {});
      }

      /// Record that two edges couple their bodies in the tangent, unless one of them is an
      /// obstacle.
      void
      note_coupled(const unsigned int edge, const unsigned int master)
      {
        const BlockPair pair{surface->edges()[edge].body,
                             surface->edges()[master].body};
        if (pair.first != pair.second && !surface->is_rigid(edge) &&
            !surface->is_rigid(master) &&
            (coupled_pairs.empty() || coupled_pairs.back() != pair))
          coupled_pairs.push_back(pair);
      }

      void
      clear_coupled()
      {
        coupled_pairs.clear();
      }

      /// See ContactTimeStep::coupled_bodies().
      const std::vector<BlockPair> &
      coupled() const
      {
        return coupled_pairs;
      }

    private:
      void
      list_covers_and_edges();

      const ContactSurface     *surface;
      std::vector<bool>         is_active, is_held;
      ActiveItems               points, covers, rows, edges;
      std::vector<unsigned int> touched;
      std::vector<BlockPair>    coupled_pairs;
    };
  } // namespace internal
} // namespace NMM

#endif
