#ifndef nmm_covers_rank_cells_h
#define nmm_covers_rank_cells_h

#include <nmm/base/types.h>
#include <nmm/covers/mathematical_mesh.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <vector>

namespace NMM
{
  /**
   * Ownership of cells in a distributed mathematical mesh. A rank holds the cells that it *owns*
   * and, around them, n_layers layers of *ghost* cells, which other ranks own. All tables are by
   * local cell, in ascending order of the global numbers.
   */
  struct RankCells
  {
    /// Cells that this rank and another one exchange, in the same order on both.
    struct Neighbor
    {
      /// The other rank.
      unsigned int rank;
      /// Local cells that this rank owns and the other one holds as ghosts.
      std::vector<unsigned int> sent;
      /// Local cells that the other rank owns and this one holds as ghosts.
      std::vector<unsigned int> received;
    };

    /**
     * Number of layers of ghost cells around the owned ones; cells with a common corner are in
     * adjacent layers. A cover of an owned element's neighbour (layer 1) has elements around it
     * (layer 2), whose roots lie at most three elements away (layer 5). The recovery of stresses
     * needs four layers.
     */
    static constexpr unsigned int n_layers = 5;

    /// Communicator over which the mesh is distributed.
    MPI_Comm communicator = MPI_COMM_NULL;
    /// Number of this rank in the communicator.
    unsigned int rank = 0;
    /// Number of cells of all ranks.
    std::uint64_t n_global_cells = 0;
    /// Rank that owns each local cell.
    std::vector<unsigned int> cell_to_owner;
    /// Global number of each local cell.
    std::vector<std::uint64_t> cell_to_global;
    /// For each local cell, whether it is owned or has a common corner with an owned one.
    std::vector<unsigned char> is_near;
    /// Ranks with which this one has cells in common.
    std::vector<Neighbor> neighbors;
  };


  /**
   * Make the same mathematical mesh as make_regular_mesh(), distributed over all ranks: this rank
   * holds its part and RankCells::n_layers layers of ghost cells. The triangulation is a
   * parallel::fullydistributed::Triangulation with own cells, one layer of ghost cells, and
   * further cells that are artificial to deal.II. The tables of MathematicalMesh are those of the
   * local cells; only dof_handler() has global numbers.
   *
   * The lattice is partitioned by recursive bisection along its directions, so that the ranks have
   * about equal numbers of cells. The memory of a rank that grows with the whole mesh is the number
   * of cells in each row and column of the lattice during the bisection, and a few numbers per
   * rank. All ranks know all curves.
   *
   * Collective.
   * @throws InputError as make_regular_mesh(), or if there are more ranks than
   * cells.
   */
  MathematicalMesh
  make_distributed_mesh(const PhysicalMesh          &physical_mesh,
                        const RegularMeshParameters &parameters,
                        unsigned int                 degree,
                        MPI_Comm                     communicator);
} // namespace NMM

#endif
