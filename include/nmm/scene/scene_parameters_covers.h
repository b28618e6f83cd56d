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
    /// Name of the subsection, for messages.
    std::string name;
    /// A point inside the block [m].
    dealii::Point<2> block;
    /// Whether the block has a mathematical mesh of its own, and the number of cells across it.
    RegionMesh mesh = {RegionMesh::Kind::automatic, 0};

    /// Declares or reads the entries of the subsection. @throws InputError without a point.
    void
    list_entries(internal::Entries &entries);
  };


  /// The section `Covers`.
  struct CoverParameters
  {
    /// The treatment of physical covers with little support.
    Stabilization stabilization = Stabilization::aggregation;
    /// Least element_support() of a well-supported element [-].
    double threshold = default_aggregation_threshold;
    /// The mesh of all regions that `blocks` does not name, see make_own_meshes().
    RegionMesh mesh;
    /// The meshes of single blocks.
    std::vector<BlockMeshParameters> blocks;

    /// Declares or reads the entries of the section, with a subsection for each of @p block_names.
    void
    list_entries(internal::Entries              &entries,
                 const std::vector<std::string> &block_names);
    /// Checks the numbers of elements across blocks. @throws InputError for a number that is
    /// missing or not used.
    void
    check() const;

    /// Whether the cell size of the main mesh need not be given, since all blocks choose theirs by
    /// the number of cells across them.
    bool
    may_choose_cell_size() const;
  };
} // namespace NMM

#endif
