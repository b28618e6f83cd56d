#include "manifold_mesh_data.h"
#include <algorithm>

// Numbering of elements.
namespace NMM
{
  using namespace dealii;

  namespace
  {
    /**
     * Cells with elements, in the order of a breadth-first search that starts at a cell far from
     * the middle, so that neighbours get near numbers (Cuthill & McKee 1969). The full algorithm
     * also sorts by degree, which changes nothing here, because all cells have at most three
     * neighbours.
     */
    std::vector<unsigned int>
    order_cells(const internal::CellNeighbors    &neighbors,
                const std::vector<unsigned char> &holds_elements)
    {
      std::vector<unsigned int> order;
      order.reserve(neighbors.size());
      const auto walk = [&](const unsigned int          start,
                            std::vector<unsigned char> &is_left,
                            std::vector<unsigned int>  &result) {
        unsigned int next = result.size();
        is_left[start]    = 0;
        result.push_back(start);
        for (; next < result.size(); ++next)
          for (const unsigned int c : neighbors[result[next]])
            if (c != invalid_index && is_left[c])
            {
              is_left[c] = 0;
              result.push_back(c);
            }
      };

      std::vector<unsigned char> is_to_probe(holds_elements),
        is_to_number(holds_elements);
      std::vector<unsigned int> probe;
      for (unsigned int c = 0; c < neighbors.size(); ++c)
        if (is_to_number[c])
        {
          // The last cell of a first search is nearly peripheral.
          probe.clear();
          walk(c, is_to_probe, probe);
          walk(probe.back(), is_to_number, order);
        }
      return order;
    }

  } // namespace


  void
  ManifoldMesh::Data::number_elements(
    const internal::Cutting          &cutting,
    const internal::CellNeighbors    &neighbors,
    const std::vector<unsigned char> &state,
    std::vector<unsigned int>        &exact_to_element)
  {
    const unsigned int        n_cells = mathematical_mesh->n_cells();
    std::vector<unsigned int> n_in_cell(n_cells, 0);
    for (const auto &element : cutting.elements)
      ++n_in_cell[element.cell];
    std::vector<unsigned char> holds(n_cells, 0);
    for (unsigned int c = 0; c < n_cells; ++c)
    {
      if (state[c] == internal::CellState::untouched &&
          cutting.cell_region[c] != invalid_index)
        n_in_cell[c] = 1;
      holds[c] = (n_in_cell[c] > 0);
    }

    unsigned int n_elements = 0;
    for (const unsigned int n : n_in_cell)
      n_elements += n;
    element_to_cell.reserve(n_elements);
    element_to_region.reserve(n_elements);
    cell_first_element.assign(n_cells, invalid_index);
    for (const unsigned int c : order_cells(neighbors, holds))
    {
      cell_first_element[c] = element_to_cell.size();
      for (unsigned int i = 0; i < n_in_cell[c]; ++i)
      {
        element_to_cell.push_back(c);
        element_to_region.push_back(cutting.cell_region[c]);
      }
    }
    std::vector<unsigned int> next(cell_first_element);
    exact_to_element.resize(cutting.elements.size());
    for (unsigned int i = 0; i < cutting.elements.size(); ++i)
    {
      const auto        &exact   = cutting.elements[i];
      const unsigned int element = next[exact.cell]++;
      exact_to_element[i]        = element;
      element_to_region[element] = exact.region;
    }
  }
} // namespace NMM
