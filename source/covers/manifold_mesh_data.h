#ifndef nmm_source_covers_manifold_mesh_data_h
#define nmm_source_covers_manifold_mesh_data_h

// Private: data of a ManifoldMesh, and how it is made from the result of the cutting.

#include <nmm/covers/manifold_mesh.h>

#include "cutting.h"
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    using BoostPoint =
      boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
    using BoostBox = boost::geometry::model::box<BoostPoint>;
    using CellTree =
      boost::geometry::index::rtree<std::pair<BoostBox, unsigned int>,
                                    boost::geometry::index::rstar<16>>;
  } // namespace internal


  struct ManifoldMesh::Data
  {
    const MathematicalMesh *mathematical_mesh;
    const PhysicalMesh     *physical_mesh;

    std::vector<unsigned int> element_to_cell;
    std::vector<unsigned int> element_to_region;
    /// First element of each cell; invalid_index if it has none.
    std::vector<unsigned int> cell_first_element;

    /**
     * Number of each *special* element among all of these, or invalid_index. Special elements do
     * not follow from the mathematical mesh alone: those that cutting made, in its order, and whole
     * ones beside them.
     */
    std::vector<unsigned int> element_to_special;
    /// First edge and first link of each special element; they end where those of the next one
    /// begin. The first special elements, with straight edges in one loop, have their edges in
    /// packed_edges, the next ones in edges.
    std::vector<unsigned int>  first_packed_edge, first_edge, first_link;
    std::vector<unsigned char> special_is_whole;

    internal::PackedEdges                  packed_edges;
    std::vector<ElementEdge>               edges;
    std::vector<Link>                      links;
    std::vector<std::vector<unsigned int>> curve_sets;
    unsigned int                           n_cells_cut_exactly = 0;

    mutable std::once_flag                      tree_made;
    mutable std::unique_ptr<internal::CellTree> cell_tree;

    /// Number the elements. @p exact_to_element is set to the number of each element of the
    /// cutting.
    void
    number_elements(const internal::Cutting          &cutting,
                    const internal::CellNeighbors    &neighbors,
                    const std::vector<unsigned char> &state,
                    std::vector<unsigned int>        &exact_to_element);

    /// Take over the edges from the cutting.
    void
    take_edges(internal::Cutting               &cutting,
               const std::vector<unsigned int> &exact_to_element);

    void
    make_links(internal::Cutting                &cutting,
               const std::vector<unsigned char> &state,
               const std::vector<unsigned int>  &exact_to_element);

    /// Make an element special, and return its number among the special ones.
    unsigned int
    make_special(unsigned int element);

    /// The whole element beyond a side of an untouched cell, with no curve in between; neighbor is
    /// invalid_index if there is none.
    Link
    link_across(unsigned int cell, unsigned int side) const;

    /// Element for a code of the cutting, or invalid_index.
    unsigned int
    decode(const unsigned int               code,
           const std::vector<unsigned int> &exact_to_element) const
    {
      if (code == invalid_index)
        return invalid_index;
      return code >= internal::whole_cell_flag
               ? cell_first_element[code - internal::whole_cell_flag]
               : exact_to_element[code];
    }
  };
} // namespace NMM

#endif
