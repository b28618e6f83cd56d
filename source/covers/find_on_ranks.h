#ifndef nmm_source_covers_find_on_ranks_h
#define nmm_source_covers_find_on_ranks_h

// Private: points of a distributed mesh.

#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/rank_cells.h>

#include <deal.II/base/mpi.h>

namespace NMM
{
  namespace internal
  {
    /// Value for an element of another rank.
    constexpr unsigned int elsewhere = invalid_index - 1;

    /**
     * ManifoldMesh::find_element() for a mesh that may be distributed. On a distributed mesh the
     * lowest rank that owns an element with the point returns that element, and the others return
     * `elsewhere`. If there is no such element, all return invalid_index. Collective.
     */
    inline unsigned int
    find_on_ranks(const ManifoldMesh &mesh, const dealii::Point<2> &x)
    {
      const RankCells *rank_cells = mesh.mathematical_mesh().rank_cells();
      if (rank_cells == nullptr)
        return mesh.find_element(x);
      const unsigned int element = mesh.find_owned_element(x);
      const unsigned int owner =
        dealii::Utilities::MPI::min(element == invalid_index ? invalid_index
                                                             : rank_cells->rank,
                                    rank_cells->communicator);
      if (owner == invalid_index)
        return invalid_index;
      return owner == rank_cells->rank ? element : elsewhere;
    }
  } // namespace internal
} // namespace NMM

#endif
