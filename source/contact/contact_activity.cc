// Which bodies are being worked on, and what that leaves of points and faces.
#include <nmm/contact/contact.h>

#include <algorithm>
#include <contact/contact_data.h>
#include <utility>

namespace NMM
{
  using namespace internal;

  void
  Contact::set_active_bodies(const std::vector<bool> &is_active,
                             const std::vector<bool> &is_held)
  {
    data->is_active = is_active;
    data->is_held   = is_held;
    data->is_held.resize(is_active.size(), false);
    data->note_activity();
    if (!is_active.empty() && data->active_covers.empty())
      data->list_covers_of_bodies();
    data->active_covers.select(is_active);
    data->active_edges.select(is_active);
    data->active_rows.select(is_active);
    if (data->assembler)
      data->assembler->set_active_rows(is_active);
  }


  void
  Contact::Data::list_points_of_bodies()
  {
    const unsigned int n = surface->n_bodies() - static_cast<unsigned int>(
                                                   surface->obstacles().size());
    const auto &edges = surface->edges();
    active_points.reinit(points.size(), [&](const auto &add) {
      for (unsigned int q = 0; q < points.size(); ++q)
      {
        const unsigned int position = point_data[q].slave;
        const unsigned int slave    = edges[search.slaves()[position]].body;
        if (slave < n)
          add(q, slave);
        unsigned int last = slave;
        for (const unsigned int master : search.masters(position))
          if (edges[master].body < n && edges[master].body != last)
            add(q, last = edges[master].body);
      }
    });
  }


  void
  Contact::Data::list_covers_of_bodies()
  {
    const CoverSystem        &covers = surface->cover_system();
    const ManifoldMesh       &mesh   = covers.manifold_mesh();
    std::vector<unsigned int> row_to_block(2 * covers.n_covers());
    std::vector<unsigned int> cover_to_body(covers.n_covers());
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      for (const unsigned int k : covers.covers(e))
        cover_to_body[k] = row_to_block[2 * k] = row_to_block[2 * k + 1] =
          mesh.block(e);
    active_covers.reinit(cover_to_body);
    active_rows.reinit(row_to_block);
    active_edges.reinit(surface->edges().size(), [&](const auto &add) {
      for (unsigned int e = 0; e < surface->edges().size(); ++e)
        if (!surface->is_rigid(e))
          add(e, surface->edges()[e].body);
    });
  }


  void
  Contact::Data::note_activity()
  {
    if (!is_active.empty() && active_points.empty())
      list_points_of_bodies();
    active_points.select(is_active);
  }


  const std::vector<BlockPair> &
  Contact::coupled_bodies() const
  {
    return data->coupled_bodies;
  }


  std::vector<unsigned int>
  Contact::take_touched()
  {
    return std::exchange(data->touched_bodies, {});
  }
} // namespace NMM
