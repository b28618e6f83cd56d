#include "divided_cells.h"

#include <nmm/base/exceptions.h>

#include "arranged_cells.h"

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// Side of a cell that is a mathematical edge.
      unsigned int
      side_of(const MathematicalMesh &mesh,
              const unsigned int      cell,
              const unsigned int      edge)
      {
        const auto &edges = mesh.cell_edges(cell);
        return edges[0] == edge ? 0 : (edges[1] == edge ? 1 : 2);
      }
    } // namespace


    DividedCells::DividedCells(const PartToCut            &part,
                               const NearEdges            &near,
                               std::vector<unsigned char> &state,
                               Cutting                    &cutting)
      : mesh(*part.mesh)
      , physical_edges(*part.physical_edges)
      , part_cells(part.cells)
      , cell_to_divided(part.cells.second - part.cells.first, invalid_index)
    {
      // Most cells have one edge near them, five pieces of sides and one chord.
      const std::size_t n_expected = near.edges.size();
      cells.reserve(n_expected + 1);
      half_edges.reserve(7 * n_expected);
      loops.reserve(7 * n_expected);
      faces.reserve(2 * n_expected + 1);
      if (has_vertices() && cutting.corner_to_vertex.empty())
        cutting.corner_to_vertex.assign(mesh.vertices().size(), invalid_index);
      CellCutter cutter(mesh, physical_edges, *part.region_to_part, part.part);
      for (unsigned int i = 0; i + 1 < near.first.size(); ++i)
      {
        const ArrayView<const unsigned int> edges = near[i];
        if (edges.size() == 0)
          continue;
        const unsigned int c = part_cells.first + i;
        switch (cutter.divide(c, edges))
        {
          case CellCutter::Result::whole:
            state[c] = CellState::untouched;
            break;
          case CellCutter::Result::divided:
            state[c] = CellState::divided;
            keep(c, cutter);
            if (has_vertices())
              number_vertices(cutter, cutting);
            break;
          case CellCutter::Result::not_divided:
            state[c] = CellState::arranged;
        }
      }
      cells.push_back({invalid_index,
                       static_cast<unsigned int>(half_edges.size()),
                       static_cast<unsigned int>(faces.size()),
                       {}});
      faces.push_back({invalid_index,
                       static_cast<unsigned int>(loops.size()),
                       invalid_index});
    }


    void
    DividedCells::keep(const unsigned int c, const CellCutter &cutter)
    {
      cell_to_divided[c - part_cells.first] = cells.size();
      Cell cell                             = {c,
                                               static_cast<unsigned int>(half_edges.size()),
                                               static_cast<unsigned int>(faces.size()),
                                               {}};
      for (unsigned int i = 0; i < 4; ++i)
        cell.first_of_side[i] = cutter.first_of_side()[i];
      for (const CellCutter::HalfEdge &h : cutter.half_edges())
        half_edges.push_back(
          {h.start, h.physical_edge, cell.first_face + h.face});
      for (const CellCutter::Face &face : cutter.faces())
        faces.push_back({face.region,
                         static_cast<unsigned int>(loops.size()) + face.begin,
                         invalid_index});
      for (const unsigned int h : cutter.loops())
        loops.push_back(cell.first_half_edge + h);
      cells.push_back(cell);
    }


    unsigned int
    DividedCells::vertex_from_beyond(const unsigned int cell,
                                     const unsigned int side,
                                     const unsigned int piece) const
    {
      const unsigned int e     = mesh.cell_edges(cell)[side];
      const auto        &both  = mesh.edges()[e].cells;
      const unsigned int other = both[both[0] == cell ? 1 : 0];
      if (other == invalid_index ||
          cell_to_divided[other - part_cells.first] == invalid_index)
        return invalid_index;
      return vertex(other,
                    side_of(mesh, other, e),
                    n_pieces(cell, side) - piece);
    }


    void
    DividedCells::number_vertices(const CellCutter &cutter, Cutting &cutting)
    {
      const Cell               &cell    = cells.back();
      const auto               &corners = mesh.cell_vertices(cell.cell);
      const unsigned int        n       = cutter.half_edges().size();
      std::vector<unsigned int> node_to_vertex(n, invalid_index);
      for (unsigned int h = 0, side = 0; h < n; ++h)
      {
        while (side < 3 && h >= cell.first_of_side[side + 1])
          ++side;
        const unsigned int node   = cutter.half_edges()[h].node;
        unsigned int      &vertex = node_to_vertex[node];
        if (vertex == invalid_index)
        {
          if (node < 3)
            vertex = cutting.corner_to_vertex[corners[node]];
          else if (side < 3)
            vertex =
              vertex_from_beyond(cell.cell, side, h - cell.first_of_side[side]);
          if (vertex == invalid_index)
          {
            vertex = cutting.vertices.size();
            cutting.vertices.push_back(cutter.half_edges()[h].start);
          }
          if (node < 3)
            cutting.corner_to_vertex[corners[node]] = vertex;
        }
        half_edge_to_vertex.push_back(vertex);
      }
    }


    bool
    DividedCells::empty() const
    {
      return cells.size() == 1;
    }


    bool
    DividedCells::has_vertices() const
    {
      return mesh.n_parts() > 1;
    }


    const DividedCells::Cell &
    DividedCells::divided(const unsigned int cell) const
    {
      AssertIndexRange(cell_to_divided[cell - part_cells.first], cells.size());
      return cells[cell_to_divided[cell - part_cells.first]];
    }


    unsigned int
    DividedCells::n_pieces(const unsigned int cell,
                           const unsigned int side) const
    {
      const Cell &c = divided(cell);
      return c.first_of_side[side + 1] - c.first_of_side[side];
    }


    unsigned int
    DividedCells::element(const unsigned int cell,
                          const unsigned int side,
                          const unsigned int piece) const
    {
      AssertIndexRange(piece, n_pieces(cell, side));
      const Cell        &c = divided(cell);
      const unsigned int h = c.first_half_edge + c.first_of_side[side] + piece;
      return faces[half_edges[h].face].element;
    }


    const Point<2> &
    DividedCells::start(const unsigned int cell,
                        const unsigned int side,
                        const unsigned int piece) const
    {
      AssertIndexRange(piece, n_pieces(cell, side));
      const Cell &c = divided(cell);
      return half_edges[c.first_half_edge + c.first_of_side[side] + piece]
        .start;
    }


    unsigned int
    DividedCells::vertex(const unsigned int cell,
                         const unsigned int side,
                         const unsigned int piece) const
    {
      AssertIndexRange(piece, n_pieces(cell, side));
      const Cell &c = divided(cell);
      return half_edge_to_vertex[c.first_half_edge + c.first_of_side[side] +
                                 piece];
    }


    void
    DividedCells::label_beside(const std::vector<unsigned char> &state,
                               std::vector<unsigned int> &cell_region) const
    {
      for (unsigned int i = 0; i + 1 < cells.size(); ++i)
        for (unsigned int side = 0; side < 3; ++side)
          for (const unsigned int other :
               mesh.edges()[mesh.cell_edges(cells[i].cell)[side]].cells)
            if (other != invalid_index && state[other] == CellState::untouched)
            {
              const unsigned int h =
                cells[i].first_half_edge + cells[i].first_of_side[side];
              cell_region[other] = faces[half_edges[h].face].region;
            }
    }


    void
    DividedCells::number_elements(Cutting &cutting)
    {
      if (empty())
        return;
      Assert(has_vertices() || cutting.elements.empty(), ExcInternalError());
      std::size_t n_edges = 0;
      for (unsigned int i = 0; i + 1 < cells.size(); ++i)
        for (unsigned int f = cells[i].first_face; f < cells[i + 1].first_face;
             ++f)
          if (faces[f].region != invalid_index)
          {
            faces[f].element = cutting.elements.size();
            cutting.elements.push_back(
              {cells[i].cell, faces[f].region, false, 0, 0});
            n_edges += faces[f + 1].begin - faces[f].begin;
          }
      if (has_vertices())
        return;
      cutting.n_packed = cutting.elements.size();
      cutting.packed_edges.starts.reserve(n_edges);
      cutting.packed_edges.beyond.reserve(n_edges);
      // Every other side is shared by two cells.
      cutting.links.reserve(n_edges / 2);
    }


    unsigned int
    DividedCells::element_beyond(const Cell                       &cell,
                                 const unsigned int                side,
                                 const unsigned int                piece,
                                 const std::vector<unsigned char> &state,
                                 const ArrangedCells              *arranged,
                                 const Cutting &cutting) const
    {
      const unsigned int e       = mesh.cell_edges(cell.cell)[side];
      const auto        &edge    = mesh.edges()[e];
      const bool         is_left = edge.cells[0] == cell.cell;
      const unsigned int other   = edge.cells[is_left ? 1 : 0];
      const unsigned int n =
        cell.first_of_side[side + 1] - cell.first_of_side[side];
      if (other == invalid_index)
      {
        // A boundary of the solid may lie on that of the mesh.
        const unsigned int h =
          cell.first_half_edge + cell.first_of_side[side] + piece;
        AssertThrow(half_edges[h].physical_edge != invalid_index,
                    InputError("the solid sticks out of the mathematical mesh",
                               to_string(start(cell.cell, side, piece)),
                               "give a mesh that covers it"));
        return invalid_index;
      }
      switch (state[other])
      {
        case CellState::untouched:
          return cutting.cell_region[other] == invalid_index
                   ? invalid_index
                   : whole_cell_flag + other;
        case CellState::divided: {
          const unsigned int there = side_of(mesh, other, e);
          Assert(n_pieces(other, there) == n, ExcInternalError());
          return element(other, there, n - 1 - piece);
        }
        default:
          // Pieces are numbered from the lower vertex on, which is the direction of the cell on the
          // left.
          return arranged->element(e, is_left ? piece : n - 1 - piece);
      }
    }


    std::size_t
    DividedCells::n_edges(const Cutting &cutting) const
    {
      return has_vertices() ? cutting.edges.size()
                            : cutting.packed_edges.starts.size();
    }


    void
    DividedCells::append_edge(const unsigned int         h,
                              const unsigned int         next,
                              const PackedEdges::Beyond &beyond,
                              Cutting                   &cutting) const
    {
      if (!has_vertices())
      {
        cutting.packed_edges.starts.push_back(half_edges[h].start);
        cutting.packed_edges.beyond.push_back(beyond);
        return;
      }
      cutting.edges.push_back({half_edges[h].start,
                               half_edges[next].start,
                               Point<2>(),
                               0.,
                               beyond.curve_set,
                               beyond.neighbor,
                               beyond.mesh_edge});
      cutting.origins.push_back({half_edge_to_vertex[h],
                                 half_edge_to_vertex[next],
                                 half_edges[h].physical_edge});
    }


    void
    DividedCells::append_edges(const std::vector<unsigned char> &state,
                               const ArrangedCells              *arranged,
                               Cutting                          &cutting) const
    {
      for (unsigned int i = 0; i + 1 < cells.size(); ++i)
      {
        const Cell        &cell    = cells[i];
        const unsigned int n_sides = cell.first_of_side[3];
        for (unsigned int f = cell.first_face; f < cells[i + 1].first_face; ++f)
        {
          const unsigned int here = faces[f].element;
          if (here == invalid_index)
            continue;
          Cutting::Element &element = cutting.elements[here];
          element.first_edge        = n_edges(cutting);
          element.is_whole          = true;
          const unsigned int end    = faces[f + 1].begin;
          for (unsigned int k = faces[f].begin; k < end; ++k)
          {
            const HalfEdge     &half_edge = half_edges[loops[k]];
            PackedEdges::Beyond edge      = {invalid_index,
                                             invalid_index,
                                             invalid_index};
            if (half_edge.physical_edge != invalid_index)
            {
              edge.curve_set =
                physical_edges.edges()[half_edge.physical_edge].curve_set;
              cutting.is_met[half_edge.physical_edge] = 1;
            }
            const unsigned int local = loops[k] - cell.first_half_edge;
            if (local >= n_sides)
            {
              const unsigned int twin =
                cell.first_half_edge + n_sides + ((local - n_sides) ^ 1u);
              edge.neighbor    = faces[half_edges[twin].face].element;
              element.is_whole = false;
            }
            else
            {
              const unsigned int side  = local < cell.first_of_side[1]   ? 0
                                         : local < cell.first_of_side[2] ? 1
                                                                         : 2;
              edge.mesh_edge           = mesh.cell_edges(cell.cell)[side];
              edge.neighbor            = element_beyond(cell,
                                             side,
                                             local - cell.first_of_side[side],
                                             state,
                                             arranged,
                                             cutting);
              const auto        &both  = mesh.edges()[edge.mesh_edge].cells;
              const unsigned int other = both[both[0] == cell.cell ? 1 : 0];
              // The first one of two divided cells appends the link for both.
              if (edge.neighbor != invalid_index &&
                  half_edge.physical_edge == invalid_index &&
                  (state[other] == CellState::untouched ||
                   (state[other] == CellState::divided && cell.cell < other)))
                cutting.links.push_back(
                  {edge.mesh_edge, {{here, edge.neighbor}}});
            }
            append_edge(loops[k],
                        loops[k + 1 < end ? k + 1 : faces[f].begin],
                        edge,
                        cutting);
          }
          element.end_edge = n_edges(cutting);
        }
      }
    }
  } // namespace internal
} // namespace NMM
