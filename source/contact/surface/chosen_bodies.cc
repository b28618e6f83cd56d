#include <contact/surface/chosen_bodies.h>

namespace NMM
{
  namespace internal
  {
    void
    ChosenBodies::select(const std::vector<bool> &new_bodies)
    {
      bodies = new_bodies;
      points.select(bodies);
      if (!bodies.empty() && all_covers.empty())
        list_covers_and_edges();
      all_covers.select(bodies);
      edges.select(bodies);
      all_rows.select(bodies);
    }


    void
    ChosenBodies::list_covers_and_edges()
    {
      const CoverSystem        &cover_system = surface->cover_system();
      const ManifoldMesh       &mesh         = cover_system.manifold_mesh();
      std::vector<unsigned int> row_to_body(2 * cover_system.n_covers());
      std::vector<unsigned int> cover_to_body(cover_system.n_covers());
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        for (const unsigned int k : cover_system.covers(e))
          cover_to_body[k]                = row_to_body[unknown_of(k, 0)] =
            row_to_body[unknown_of(k, 1)] = mesh.block(e);
      all_covers.reinit(cover_to_body);
      all_rows.reinit(row_to_body);
      edges.reinit(surface->edges().size(), [&](const auto &add) {
        for (unsigned int e = 0; e < surface->edges().size(); ++e)
          if (!surface->is_rigid(e))
            add(e, surface->edges()[e].body);
      });
    }
  } // namespace internal
} // namespace NMM
