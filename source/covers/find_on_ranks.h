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
    /// The element is another rank's.
    constexpr unsigned int elsewhere = invalid_index - 1;

    /**
     * ManifoldMesh::find_element() of a mesh that may be distributed: then the lowest
     * rank that owns an element with the point gets it, and the others `elsewhere`;
     * invalid_index on all if there is none. Collective.
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
