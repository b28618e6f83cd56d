#include "manifold_mesh_data.h"
#include <algorithm>
#include <numeric>
#include <tuple>

// Edges of elements and links between them.
namespace NMM
{
  using namespace dealii;

  namespace
  {
    unsigned char
    local_edge(const MathematicalMesh &mesh,
               const unsigned int      cell,
               const unsigned int      mesh_edge)
    {
      const auto &edges = mesh.cell_edges(cell);
      for (unsigned int i = 0; i < 3; ++i)
        if (edges[i] == mesh_edge)
          return i;
      Assert(false, ExcInternalError());
      return 3;
    }
  } // namespace


  unsigned int
  ManifoldMesh::Data::make_special(const unsigned int element)
  {
    if (element_to_special[element] == invalid_index)
    {
      element_to_special[element] = special_is_whole.size();
      special_is_whole.push_back(1);
    }
    return element_to_special[element];
  }


  void
  ManifoldMesh::Data::take_edges(
    internal::Cutting               &cutting,
    const std::vector<unsigned int> &exact_to_element)
  {
    const std::size_t n = cutting.elements.size();
    element_to_special.assign(element_to_cell.size(), invalid_index);
    special_is_whole.resize(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      element_to_special[exact_to_element[i]] = i;
      special_is_whole[i]                     = cutting.elements[i].is_whole;
    }

    packed_edges = std::move(cutting.packed_edges);
    first_packed_edge.reserve(cutting.n_packed + 1);
    for (unsigned int i = 0; i < cutting.n_packed; ++i)
      first_packed_edge.push_back(cutting.elements[i].first_edge);
    first_packed_edge.push_back(packed_edges.starts.size());
    for (auto &edge : packed_edges.beyond)
      edge.neighbor = decode(edge.neighbor, exact_to_element);

    first_edge.reserve(n - cutting.n_packed + 1);
    first_edge.push_back(0);
    unsigned int end = 0;
    for (unsigned int i = cutting.n_packed; i < n; ++i)
    {
      const auto &exact = cutting.elements[i];
      const auto  first = cutting.edges.begin() + exact.first_edge,
                 last   = cutting.edges.begin() + exact.end_edge;
      // A whole element that no curve touches needs no edges.
      if (!exact.is_whole ||
          std::any_of(first, last, [](const ElementEdge &edge) {
            return edge.curve_set != invalid_index;
          }))
      {
        // The edges are in the order of the elements.
        Assert(end <= exact.first_edge, ExcInternalError());
        for (auto edge = first; edge != last; ++edge, ++end)
        {
          cutting.edges[end] = *edge;
          cutting.edges[end].neighbor =
            decode(edge->neighbor, exact_to_element);
        }
      }
      first_edge.push_back(end);
    }
    edges = std::move(cutting.edges);
    edges.resize(end);
    edges.shrink_to_fit();
  }


  ManifoldMesh::Link
  ManifoldMesh::Data::link_across(const unsigned int cell,
                                  const unsigned int side) const
  {
    const unsigned int e     = mathematical_mesh->cell_edges(cell)[side];
    const auto        &both  = mathematical_mesh->edges()[e].cells;
    const unsigned int other = both[both[0] == cell ? 1 : 0];
    if (other == invalid_index || cell_first_element[other] == invalid_index)
      return {invalid_index, 0, 0};
    return {cell_first_element[other],
            static_cast<unsigned char>(side),
            local_edge(*mathematical_mesh, other, e)};
  }


  void
  ManifoldMesh::Data::make_links(
    internal::Cutting                &cutting,
    const std::vector<unsigned char> &state,
    const std::vector<unsigned int>  &exact_to_element)
  {
    const unsigned int n_cut = cutting.elements.size();
    for (auto &link : cutting.links)
      for (unsigned int &element : link.elements)
      {
        element = decode(element, exact_to_element);
        make_special(element);
      }
    const unsigned int n = special_is_whole.size();

    // Whole elements beside cut ones, and the elements across their other sides.
    const auto for_each_whole_link = [&](const auto &action) {
      std::vector<unsigned int> special_to_element(n - n_cut);
      for (const auto &link : cutting.links)
        for (const unsigned int element : link.elements)
          if (element_to_special[element] >= n_cut)
            special_to_element[element_to_special[element] - n_cut] = element;
      for (unsigned int i = n_cut; i < n; ++i)
      {
        const unsigned int c = element_to_cell[special_to_element[i - n_cut]];
        for (unsigned int side = 0; side < 3; ++side)
        {
          const Link link = link_across(c, side);
          if (link.neighbor != invalid_index &&
              state[element_to_cell[link.neighbor]] ==
                internal::CellState::untouched)
            action(i, link);
        }
      }
    };
    first_link.assign(n + 1, 0);
    for (const auto &link : cutting.links)
      for (const unsigned int element : link.elements)
        ++first_link[element_to_special[element] + 1];
    for_each_whole_link(
      [&](const unsigned int i, const Link &) { ++first_link[i + 1]; });
    std::partial_sum(first_link.begin(), first_link.end(), first_link.begin());
    links.resize(first_link.back());
    std::vector<unsigned int> next(first_link.begin(), first_link.end() - 1);
    for (const auto &link : cutting.links)
    {
      const auto [a, b]                    = link.elements;
      const unsigned char side_a           = local_edge(*mathematical_mesh,
                                              element_to_cell[a],
                                              link.mesh_edge),
                          side_b           = local_edge(*mathematical_mesh,
                                              element_to_cell[b],
                                              link.mesh_edge);
      links[next[element_to_special[a]]++] = {b, side_a, side_b};
      links[next[element_to_special[b]]++] = {a, side_b, side_a};
    }
    for_each_whole_link(
      [&](const unsigned int i, const Link &link) { links[next[i]++] = link; });

    // An edge that curves cross several times can join the same pair several times.
    const auto key = [](const Link &link) {
      return std::make_tuple(link.neighbor, link.edge_here, link.edge_there);
    };
    unsigned int end = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto begin = links.begin() + first_link[i];
      std::sort(begin,
                links.begin() + next[i],
                [&](const Link &a, const Link &b) { return key(a) < key(b); });
      const auto last = std::unique(begin,
                                    links.begin() + next[i],
                                    [&](const Link &a, const Link &b) {
                                      return key(a) == key(b);
                                    });
      first_link[i]   = end;
      end = std::copy(begin, last, links.begin() + end) - links.begin();
    }
    first_link[n] = end;
    links.resize(end);
    links.shrink_to_fit();
    special_is_whole.shrink_to_fit();
  }
} // namespace NMM
