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
   * What a rank knows of the others if it holds a part of the mathematical mesh
   * only: the cells it *owns* and, around them, *ghost* cells of other ranks, as
   * many layers as covers and constraints look at. All is by local cell, in
   * ascending order of the global numbers.
   */
  struct RankCells
  {
    /// Cells of other ranks with two ranks in common and the same order on both.
    struct Neighbor
    {
      unsigned int rank;
      /// Cells this rank owns and the other one holds as ghosts.
      std::vector<unsigned int> sent;
      /// Cells the other one owns.
      std::vector<unsigned int> received;
    };

    /**
     * Layers of cells, by common corners, around the owned ones. A cover of an
     * owned element's neighbour (1) has elements around it (2), whose roots lie
     * at most three elements away (5); recovery of stresses looks at four.
     */
    static constexpr unsigned int n_layers = 5;

    MPI_Comm     communicator = MPI_COMM_NULL;
    unsigned int rank         = 0;
    /// Cells of all ranks.
    std::uint64_t              n_global_cells = 0;
    std::vector<unsigned int>  cell_to_owner;
    std::vector<std::uint64_t> cell_to_global;
    /// Is the cell owned, or has it a corner in common with an owned one?
    std::vector<unsigned char> is_near;
    std::vector<Neighbor>      neighbors;
  };


  /**
   * The same mathematical mesh as make_regular_mesh(), of which this rank holds its
   * part and RankCells::n_layers layers of ghost cells, as a
   * parallel::fullydistributed::Triangulation: own cells, one layer of deal.II's ghost
   * cells, and further cells that are artificial to deal.II. MathematicalMesh's tables
   * are those of the local cells; only dof_handler() numbers through all ranks.
   *
   * The lattice is shared out by recursive bisection along its directions, so that the
   * ranks have about as many cells each. What grows on a rank with the whole mesh: the number of
   * cells in each row and column of the lattice while it is bisected, and a few numbers
   * per rank. All ranks know all curves.
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
