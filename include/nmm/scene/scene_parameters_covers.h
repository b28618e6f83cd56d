#ifndef nmm_scene_scene_parameters_covers_h
#define nmm_scene_scene_parameters_covers_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/own_meshes.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// The mathematical mesh of one block: a subsection of `Covers`.
  struct BlockMeshParameters
  {
    std::string name;
    /// A point inside of the block [m].
    dealii::Point<2> block;
    RegionMesh       mesh = {RegionMesh::Kind::automatic, 0};

    void
    list_entries(internal::Entries &entries);
  };


  /// The section `Covers`.
  struct CoverParameters
  {
    Stabilization stabilization = Stabilization::aggregation;
    /// Least element_support() that makes an element good [-].
    double threshold = default_aggregation_threshold;
    /// The mesh of all regions that `blocks` does not name, see make_own_meshes().
    RegionMesh                       mesh;
    std::vector<BlockMeshParameters> blocks;
    /// Does each rank hold a part of the mathematical mesh only, see
    /// make_distributed_mesh()?
    bool is_distributed = false;

    void
    list_entries(internal::Entries              &entries,
                 const std::vector<std::string> &block_names);
    /// @throws InputError for a number of elements that is missing or not used.
    void
    check() const;

    /// Is the size of the main mesh's cells of no consequence, so that it need not
    /// be given?
    bool
    may_choose_cell_size() const;
  };
} // namespace NMM

#endif
