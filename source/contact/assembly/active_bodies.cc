#include <contact/assembly/active_bodies.h>

namespace NMM
{
  namespace internal
  {
    void
    ActiveBodies::select(const std::vector<bool> &new_is_active,
                         const std::vector<bool> &new_is_held)
    {
      is_active = new_is_active;
      is_held   = new_is_held;
      is_held.resize(is_active.size(), false);
      points.select(is_active);
      if (!is_active.empty() && covers.empty())
        list_covers_and_edges();
      covers.select(is_active);
      edges.select(is_active);
      rows.select(is_active);
    }


    void
    ActiveBodies::list_covers_and_edges()
    {
      const CoverSystem        &cover_system = surface->cover_system();
      const ManifoldMesh       &mesh         = cover_system.manifold_mesh();
      std::vector<unsigned int> row_to_body(2 * cover_system.n_covers());
      std::vector<unsigned int> cover_to_body(cover_system.n_covers());
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        for (const unsigned int k : cover_system.covers(e))
          cover_to_body[k]                = row_to_body[unknown_of(k, 0)] =
            row_to_body[unknown_of(k, 1)] = mesh.block(e);
      covers.reinit(cover_to_body);
      rows.reinit(row_to_body);
      edges.reinit(surface->edges().size(), [&](const auto &add) {
        for (unsigned int e = 0; e < surface->edges().size(); ++e)
          if (!surface->is_rigid(e))
            add(e, surface->edges()[e].body);
      });
    }
  } // namespace internal
} // namespace NMM
