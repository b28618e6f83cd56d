#include <nmm/covers/cover_system.h>

#include <algorithm>
#include <base/disjoint_sets.h>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    /**
     * Mathematical covers that may be divided, because a physical curve runs near a cell of their
     * support. Every other one is one physical cover, because its elements are whole cells that are
     * all joined.
     */
    std::vector<unsigned char>
    find_divided_covers(const ManifoldMesh &manifold_mesh)
    {
      const MathematicalMesh    &mesh = manifold_mesh.mathematical_mesh();
      std::vector<unsigned char> divided(mesh.n_mathematical_covers(), 0);
      for (unsigned int e = 0; e < manifold_mesh.n_elements(); ++e)
        if (manifold_mesh.n_edges(e) > 0)
        {
          const unsigned int *covers = mesh.cell_covers(manifold_mesh.cell(e));
          for (unsigned int i = 0; i < mesh.n_covers_per_cell(); ++i)
            divided[covers[i]] = 1;
        }
      return divided;
    }
  } // namespace


  CoverSystem::CoverSystem(const ManifoldMesh &manifold_mesh,
                           MPI_Comm            communicator)
    : mesh(&manifold_mesh)
    , mpi_communicator(communicator)
    , n_per_element(manifold_mesh.mathematical_mesh().n_covers_per_cell())
  {
    number_covers();
    distribute();
  }


  void
  CoverSystem::number_covers()
  {
    const MathematicalMesh &mathematical_mesh = mesh->mathematical_mesh();
    const unsigned int      n_elements        = mesh->n_elements();
    const std::vector<unsigned char> divided  = find_divided_covers(*mesh);

    // One slot for each undivided mathematical cover, then one for each (element, weight function)
    // of the divided ones.
    const unsigned int n_mathematical =
      mathematical_mesh.n_mathematical_covers();
    element_to_covers.resize(n_elements * n_per_element);
    std::vector<unsigned int> slot_to_mathematical, divided_elements;
    for (unsigned int e = 0; e < n_elements; ++e)
    {
      const unsigned int *covers = mathematical_mesh.cell_covers(mesh->cell(e));
      unsigned int       *slots  = element_to_covers.data() + e * n_per_element;
      const std::size_t   n_before = slot_to_mathematical.size();
      for (unsigned int i = 0; i < n_per_element; ++i)
      {
        slots[i] = covers[i];
        if (divided[covers[i]])
        {
          slots[i] = n_mathematical + slot_to_mathematical.size();
          slot_to_mathematical.push_back(covers[i]);
        }
      }
      if (slot_to_mathematical.size() > n_before)
        divided_elements.push_back(e);
    }

    // Join slots of one mathematical cover across edges without a physical curve.
    internal::DisjointSets divided_slots(slot_to_mathematical.size());
    const auto            &on_edge   = mathematical_mesh.edge_to_local_covers();
    const unsigned int     n_on_edge = mathematical_mesh.degree() + 1;
    for (const unsigned int e : divided_elements)
    {
      const unsigned int *slots = element_to_covers.data() + e * n_per_element;
      for (const ManifoldMesh::Link &link : mesh->joined(e))
        if (e < link.neighbor)
          for (unsigned int k = 0; k < n_on_edge; ++k)
          {
            // Neighbours run along their common edge in opposite directions.
            const unsigned int i = on_edge[link.edge_here][k],
                               j = on_edge[link.edge_there][k < 2 ? 1 - k : k];
            const unsigned int
              a = slots[i],
              b = element_to_covers[link.neighbor * n_per_element + j];
            Assert((a < n_mathematical) == (b < n_mathematical),
                   ExcInternalError());
            if (a >= n_mathematical)
              divided_slots.join(a - n_mathematical, b - n_mathematical);
          }
    }

    // Number the covers by their first appearance.
    std::vector<unsigned int> slot_to_cover(n_mathematical +
                                              slot_to_mathematical.size(),
                                            invalid_index);
    std::vector<unsigned int> to_mathematical;
    to_mathematical.reserve(slot_to_cover.size());
    for (unsigned int &slot : element_to_covers)
    {
      const unsigned int root =
        slot < n_mathematical
          ? slot
          : n_mathematical + divided_slots.find(slot - n_mathematical);
      if (slot_to_cover[root] == invalid_index)
      {
        slot_to_cover[root] = to_mathematical.size();
        to_mathematical.push_back(
          root < n_mathematical ? root
                                : slot_to_mathematical[root - n_mathematical]);
      }
      slot = slot_to_cover[root];
    }
    cover_to_mathematical.assign(to_mathematical.begin(),
                                 to_mathematical.end());
  }


  void
  CoverSystem::distribute()
  {
    const unsigned int n_ranks =
                         Utilities::MPI::n_mpi_processes(mpi_communicator),
                       rank =
                         Utilities::MPI::this_mpi_process(mpi_communicator);
    const unsigned int n_elements = mesh->n_elements();

    // The range of a rank never ends inside a cell.
    const auto begin_of = [&](const unsigned int r) {
      unsigned int e = static_cast<unsigned int>(
        static_cast<std::uint64_t>(n_elements) * r / n_ranks);
      while (e > 0 && e < n_elements && mesh->cell(e) == mesh->cell(e - 1))
        ++e;
      return e;
    };
    owned_elements = {begin_of(rank), begin_of(rank + 1)};

    // A rank owns the covers that first appear in its elements; these have consecutive numbers.
    const auto first_new_cover = [&](const unsigned int element) {
      unsigned int n = 0;
      for (unsigned int i = 0; i < element * n_per_element; ++i)
        n = std::max(n, element_to_covers[i] + 1);
      return n;
    };
    owned_covers.set_size(n_covers());
    owned_covers.add_range(first_new_cover(owned_elements.first),
                           first_new_cover(owned_elements.second));
    owned_covers.compress();

    relevant_covers = owned_covers;
    if (n_ranks > 1)
      add_relevant_elements(halo_width);
  }


  void
  CoverSystem::add_relevant_elements(const unsigned int n_layers)
  {
    std::vector<unsigned char> seen(mesh->n_elements(), 0);
    std::vector<unsigned int>  layer;
    for (unsigned int e = owned_elements.first; e < owned_elements.second; ++e)
    {
      seen[e] = 1;
      layer.push_back(e);
    }
    std::vector<types::global_dof_index> relevant;
    for (unsigned int l = 0; l <= n_layers; ++l)
    {
      std::vector<unsigned int> next;
      for (const unsigned int e : layer)
      {
        for (const unsigned int k : covers(e))
          relevant.push_back(k);
        for (const ManifoldMesh::Link &link : mesh->joined(e))
          if (!seen[link.neighbor])
          {
            seen[link.neighbor] = 1;
            next.push_back(link.neighbor);
          }
        for (const ElementEdge &edge : mesh->edges(e))
          if (edge.neighbor != invalid_index && !seen[edge.neighbor])
          {
            seen[edge.neighbor] = 1;
            next.push_back(edge.neighbor);
          }
      }
      layer.swap(next);
    }
    make_relevant(relevant);
  }


  void
  CoverSystem::make_relevant(std::vector<types::global_dof_index> covers)
  {
    std::sort(covers.begin(), covers.end());
    covers.erase(std::unique(covers.begin(), covers.end()), covers.end());
    relevant_covers.add_indices(covers.begin(), covers.end());
    relevant_covers.compress();
  }


  void
  CoverSystem::make_boundary_relevant()
  {
    std::vector<types::global_dof_index> relevant;
    for (unsigned int e = 0; e < mesh->n_elements(); ++e)
    {
      const auto edges = mesh->edges(e);
      if (std::any_of(edges.begin(), edges.end(), [](const ElementEdge &edge) {
            return edge.curve_set != invalid_index;
          }))
        for (const unsigned int cover : covers(e))
          relevant.push_back(cover);
    }
    make_relevant(std::move(relevant));
  }


  const ManifoldMesh &
  CoverSystem::manifold_mesh() const
  {
    return *mesh;
  }


  MPI_Comm
  CoverSystem::communicator() const
  {
    return mpi_communicator;
  }


  unsigned int
  CoverSystem::n_covers() const
  {
    return cover_to_mathematical.size();
  }


  ArrayView<const unsigned int>
  CoverSystem::covers(const unsigned int element) const
  {
    AssertIndexRange(element, mesh->n_elements());
    return ArrayView<const unsigned int>(element_to_covers.data() +
                                           element * n_per_element,
                                         n_per_element);
  }


  void
  CoverSystem::get_dof_indices(
    const unsigned int                    element,
    const unsigned int                    n_components,
    std::vector<types::global_dof_index> &indices) const
  {
    indices.resize(n_components * n_per_element);
    const auto element_covers = covers(element);
    for (unsigned int i = 0; i < n_per_element; ++i)
      for (unsigned int c = 0; c < n_components; ++c)
        indices[n_components * i + c] =
          static_cast<types::global_dof_index>(n_components) *
            element_covers[i] +
          c;
  }


  unsigned int
  CoverSystem::mathematical_cover(const unsigned int cover) const
  {
    AssertIndexRange(cover, n_covers());
    return cover_to_mathematical[cover];
  }


  const Point<2> &
  CoverSystem::node(const unsigned int cover) const
  {
    return mesh->mathematical_mesh().cover_node(mathematical_cover(cover));
  }


  std::pair<unsigned int, unsigned int>
  CoverSystem::locally_owned_elements() const
  {
    return owned_elements;
  }


  const IndexSet &
  CoverSystem::locally_owned_covers() const
  {
    return owned_covers;
  }


  const IndexSet &
  CoverSystem::locally_relevant_covers() const
  {
    return relevant_covers;
  }


  namespace
  {
    IndexSet
    covers_to_dofs(const IndexSet &covers, const unsigned int n_components)
    {
      IndexSet dofs(covers.size() * n_components);
      for (auto interval = covers.begin_intervals();
           interval != covers.end_intervals();
           ++interval)
        dofs.add_range(*interval->begin() * n_components,
                       (interval->last() + 1) * n_components);
      dofs.compress();
      return dofs;
    }
  } // namespace


  IndexSet
  CoverSystem::locally_owned_dofs(const unsigned int n_components) const
  {
    return covers_to_dofs(owned_covers, n_components);
  }


  IndexSet
  CoverSystem::locally_relevant_dofs(const unsigned int n_components) const
  {
    return covers_to_dofs(relevant_covers, n_components);
  }
} // namespace NMM
