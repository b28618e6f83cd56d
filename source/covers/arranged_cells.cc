#include "arranged_cells.h"

#include <nmm/base/exceptions.h>

#include "cutting.h"
#include "divided_cells.h"
#include "exact_curves.h"
#include <algorithm>
#include <tuple>
#include <unordered_map>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    struct ArrangedCells::Implementation
    {
      using Halfedge = Arrangement::Halfedge_handle;
      using Face     = Arrangement::Face_handle;

      Implementation(const PartToCut                  &part,
                     const std::vector<unsigned char> &state,
                     const DividedCells               &divided,
                     Cutting                          &result)
        : mesh(*part.mesh)
        , physical_pieces(part.physical_mesh->pieces())
        , physical_edges(*part.physical_edges)
        , region_to_part(*part.region_to_part)
        , part(part)
        , state(state)
        , divided(divided)
        , result(result)
      {
        arrange();
        label_regions();
        label_cells();
        spread_cells();
        number_elements();
        if (!divided.empty())
        {
          match_corners();
          match_sides();
        }
      }

      void
      arrange();
      void
      label_regions();
      void
      label_cells();
      void
      spread_cells();
      void
      number_elements();
      void
      match_corners();
      void
      match_sides();
      void
      read_edges_and_links();

      void
      read_loop(const Arrangement::Ccb_halfedge_circulator &start);
      void
      read_edge(const Halfedge &halfedge);

      /// Pieces of a side between an arranged cell and a divided one, sorted from left to right.
      void
      match_side(unsigned int mesh_edge, const std::vector<Halfedge> &pieces);

      /// Walk from the faces in @p stack across edges for which @p is_crossed(halfedge) holds; @p
      /// visit(from, to) returns whether to continue from the new face.
      template <typename IsCrossed, typename Visit>
      void
      spread(std::vector<Face> stack,
             const IsCrossed  &is_crossed,
             const Visit      &visit);

      /// Mesh edge on which a halfedge lies, or invalid_index.
      static unsigned int
      mesh_edge(const Halfedge &halfedge);

      /// Edge of the physical mesh on which a halfedge lies, or invalid_index.
      static unsigned int
      physical_edge(const Halfedge &halfedge);

      bool
      is_arranged(const unsigned int cell) const
      {
        return cell != invalid_index && state[cell] == CellState::arranged;
      }

      /// Whether the vertex with the lower number is the left end of a mathematical edge.
      bool
      runs_right(unsigned int mesh_edge) const;

      /// Cell to the left of a halfedge that lies on @p mesh_edge.
      unsigned int
      left_cell(const Halfedge &halfedge, unsigned int mesh_edge) const;

      /// Code of the element to the left of a halfedge, see Cutting.
      unsigned int
      left_element(const Halfedge &halfedge);

      /// Number of a vertex. Its coordinates are converted to doubles only once, because a second
      /// conversion of a lazy number can differ in the last place, and loops must close exactly.
      unsigned int
      vertex(const Arrangement::Vertex_handle &vertex);

      const MathematicalMesh           &mesh;
      const std::vector<CurvePiece>    &physical_pieces;
      const PhysicalEdges              &physical_edges;
      const std::vector<unsigned int>  &region_to_part;
      const PartToCut                  &part;
      const std::vector<unsigned char> &state;
      const DividedCells               &divided;
      Cutting                          &result;
      Arrangement                       arrangement;

      std::unordered_map<const Arrangement::Vertex *, unsigned int>
        vertex_to_index;
      /// For each mathematical edge between an arranged and a divided cell, the codes of the
      /// arranged cell's elements at its pieces, from the lower vertex on.
      std::unordered_map<unsigned int, std::vector<unsigned int>>
        side_to_elements;
      /// Code of the divided cell's element at a halfedge.
      std::unordered_map<const Arrangement::Halfedge *, unsigned int>
        beyond_halfedge;
    };


    void
    ArrangedCells::Implementation::arrange()
    {
      std::vector<unsigned int> wanted;
      for (unsigned int c = part.cells.first; c < part.cells.second; ++c)
        if (is_arranged(c))
          wanted.insert(wanted.end(),
                        mesh.cell_edges(c).begin(),
                        mesh.cell_edges(c).end());
      std::sort(wanted.begin(), wanted.end());
      wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());

      std::unordered_map<unsigned int, Kernel::Point_2> exact_vertex;
      const auto exact = [&](const unsigned int v) {
        const auto [position, is_new] =
          exact_vertex.emplace(v, Kernel::Point_2());
        if (is_new)
          position->second =
            Kernel::Point_2(mesh.vertices()[v][0], mesh.vertices()[v][1]);
        return position->second;
      };

      std::vector<Traits::X_monotone_curve_2> curves;
      curves.reserve(part.edges.size() + wanted.size());
      for (const unsigned int e : part.edges)
        curves.push_back(physical_edges.exact_curves().curves[e]);
      for (const unsigned int e : wanted)
      {
        const auto &v = mesh.edges()[e].vertices;
        curves.emplace_back(BaseTraits::X_monotone_curve_2(exact(v[0]),
                                                           exact(v[1])),
                            mesh_edge_flag + e);
      }
      CGAL::insert(arrangement, curves.begin(), curves.end());
    }


    template <typename IsCrossed, typename Visit>
    void
    ArrangedCells::Implementation::spread(std::vector<Face> stack,
                                          const IsCrossed  &is_crossed,
                                          const Visit      &visit)
    {
      const auto visit_loop = [&](Arrangement::Ccb_halfedge_circulator start,
                                  const Face                          &face) {
        auto he = start;
        do
        {
          const Face other = he->twin()->face();
          if (other != face && is_crossed(he) && visit(face, other))
            stack.push_back(other);
        } while (++he != start);
      };
      while (!stack.empty())
      {
        const Face face = stack.back();
        stack.pop_back();
        for (auto loop = face->outer_ccbs_begin();
             loop != face->outer_ccbs_end();
             ++loop)
          visit_loop(*loop, face);
        for (auto loop = face->inner_ccbs_begin();
             loop != face->inner_ccbs_end();
             ++loop)
          visit_loop(*loop, face);
      }
    }


    /// Set the regions of faces on this part: first beside physical edges, and from there across
    /// mathematical edges. Faces in regions of other parts get none.
    void
    ArrangedCells::Implementation::label_regions()
    {
      std::vector<Face> stack;
      for (auto he = arrangement.halfedges_begin();
           he != arrangement.halfedges_end();
           ++he)
      {
        const unsigned int e = physical_edge(he);
        if (e == invalid_index)
          continue;
        const bool         is_left = he->direction() == CGAL::ARR_LEFT_TO_RIGHT;
        const unsigned int region =
          physical_edges.edges()[e].regions[is_left ? 0 : 1];
        FaceData data = he->face()->data();
        if (region == invalid_index || data.region != invalid_index ||
            (!region_to_part.empty() && region_to_part[region] != part.part))
          continue;
        data.region = region;
        he->face()->set_data(data);
        stack.push_back(he->face());
      }
      spread(
        std::move(stack),
        [](const Halfedge &he) { return physical_edge(he) == invalid_index; },
        [](const Face &from, const Face &to) {
          FaceData data = to->data();
          if (data.region != invalid_index)
            return false;
          data.region = from->data().region;
          to->set_data(data);
          return true;
        });
    }


    unsigned int
    ArrangedCells::Implementation::mesh_edge(const Halfedge &halfedge)
    {
      for (const Label label : halfedge->curve().data())
        if (label >= mesh_edge_flag)
          return label - mesh_edge_flag;
      return invalid_index;
    }


    unsigned int
    ArrangedCells::Implementation::physical_edge(const Halfedge &halfedge)
    {
      for (const Label label : halfedge->curve().data())
        if (is_physical_edge(label))
          return label - physical_edge_flag;
      return invalid_index;
    }


    bool
    ArrangedCells::Implementation::runs_right(const unsigned int e) const
    {
      const auto     &v = mesh.edges()[e].vertices;
      const Point<2> &a = mesh.vertices()[v[0]], &b = mesh.vertices()[v[1]];
      return std::tie(a[0], a[1]) < std::tie(b[0], b[1]);
    }


    unsigned int
    ArrangedCells::Implementation::left_cell(const Halfedge    &halfedge,
                                             const unsigned int e) const
    {
      const bool halfedge_goes_right =
        halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT;
      return mesh.edges()[e]
        .cells[runs_right(e) == halfedge_goes_right ? 0 : 1];
    }


    void
    ArrangedCells::Implementation::label_cells()
    {
      for (auto he = arrangement.halfedges_begin();
           he != arrangement.halfedges_end();
           ++he)
      {
        const unsigned int e = mesh_edge(he);
        if (e == invalid_index)
          continue;
        FaceData           data = he->face()->data();
        const unsigned int c    = left_cell(he, e);
        if (c == invalid_index)
        {
          AssertThrow(data.region == invalid_index,
                      InputError("the solid sticks out of the "
                                 "mathematical mesh",
                                 to_string(to_double(he->source()->point())),
                                 "give a mesh that covers it"));
        }
        else
        {
          data.cell = c;
          he->face()->set_data(data);
          if (state[c] == CellState::untouched)
            result.cell_region[c] = data.region;
        }
      }
    }


    /// Faces without a mathematical edge lie in the same cell as a neighbouring face.
    void
    ArrangedCells::Implementation::spread_cells()
    {
      std::vector<Face> stack;
      for (auto face = arrangement.faces_begin();
           face != arrangement.faces_end();
           ++face)
        if (is_arranged(face->data().cell))
          stack.push_back(face);

      spread(
        std::move(stack),
        [](const Halfedge &he) { return mesh_edge(he) == invalid_index; },
        [](const Face &from, const Face &to) {
          FaceData data = to->data();
          if (data.cell != invalid_index)
            return false;
          data.cell = from->data().cell;
          to->set_data(data);
          return true;
        });
    }


    void
    ArrangedCells::Implementation::number_elements()
    {
      for (auto face = arrangement.faces_begin();
           face != arrangement.faces_end();
           ++face)
      {
        FaceData data = face->data();
        if (data.region == invalid_index || !is_arranged(data.cell))
          continue;
        data.element = result.elements.size();
        face->set_data(data);
        result.elements.push_back({data.cell, data.region, false, 0, 0});
      }
    }


    unsigned int
    ArrangedCells::Implementation::left_element(const Halfedge &halfedge)
    {
      const FaceData data = halfedge->face()->data();
      if (data.element != invalid_index)
        return data.element;
      const unsigned int e = mesh_edge(halfedge);
      if (e == invalid_index || data.region == invalid_index)
        return invalid_index;
      const unsigned int c = left_cell(halfedge, e);
      if (c == invalid_index)
        return invalid_index;
      if (state[c] == CellState::untouched)
        return whole_cell_flag + c;
      const auto beyond = beyond_halfedge.find(&*halfedge);
      return beyond == beyond_halfedge.end() ? invalid_index : beyond->second;
    }


    unsigned int
    ArrangedCells::Implementation::vertex(
      const Arrangement::Vertex_handle &vertex)
    {
      const auto [position, is_new] =
        vertex_to_index.emplace(&*vertex, result.vertices.size());
      if (is_new)
        result.vertices.push_back(to_double(vertex->point()));
      return position->second;
    }


    void
    ArrangedCells::Implementation::read_edge(const Halfedge &halfedge)
    {
      const Cutting::EdgeOrigin origin = {vertex(halfedge->source()),
                                          vertex(halfedge->target()),
                                          physical_edge(halfedge)};
      ElementEdge               edge;
      edge.start = result.vertices[origin.start];
      edge.end   = result.vertices[origin.end];
      if (origin.physical_edge != invalid_index)
      {
        edge.curve_set = physical_edges.edges()[origin.physical_edge].curve_set;
        result.is_met[origin.physical_edge] = 1;
      }
      edge.neighbor  = left_element(halfedge->twin());
      edge.mesh_edge = mesh_edge(halfedge);
      if (origin.physical_edge != invalid_index &&
          physical_edges.edges()[origin.physical_edge].shape.is_arc())
        set_circle(halfedge->curve(),
                   halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT,
                   physical_pieces,
                   edge);
      result.edges.push_back(edge);
      result.origins.push_back(origin);
    }


    void
    ArrangedCells::Implementation::read_loop(
      const Arrangement::Ccb_halfedge_circulator &start)
    {
      auto he = start;
      do
        read_edge(he);
      while (++he != start);
    }


    void
    ArrangedCells::Implementation::read_edges_and_links()
    {
      for (auto face = arrangement.faces_begin();
           face != arrangement.faces_end();
           ++face)
      {
        if (face->data().element == invalid_index)
          continue;
        Cutting::Element &element = result.elements[face->data().element];
        element.first_edge        = result.edges.size();
        for (auto loop = face->outer_ccbs_begin();
             loop != face->outer_ccbs_end();
             ++loop)
          read_loop(*loop);
        for (auto loop = face->inner_ccbs_begin();
             loop != face->inner_ccbs_end();
             ++loop)
          read_loop(*loop);
        element.end_edge = result.edges.size();
        element.is_whole =
          std::all_of(result.edges.begin() + element.first_edge,
                      result.edges.end(),
                      [](const ElementEdge &edge) {
                        return edge.mesh_edge != invalid_index;
                      });
      }

      for (auto edge = arrangement.edges_begin();
           edge != arrangement.edges_end();
           ++edge)
      {
        const unsigned int e = mesh_edge(edge);
        if (e == invalid_index || physical_edge(edge) != invalid_index)
          continue;
        const unsigned int a = left_element(edge),
                           b = left_element(edge->twin());
        if (a != invalid_index && b != invalid_index)
          result.links.push_back({e, {{a, b}}});
      }
    }


    /// Takes the vertices of divided cells at corners that these have in common with arranged
    /// cells.
    void
    ArrangedCells::Implementation::match_corners()
    {
      if (!divided.has_vertices())
        return;
      for (auto v = arrangement.vertices_begin();
           v != arrangement.vertices_end();
           ++v)
      {
        // Mathematical edges meet at corners only.
        unsigned int first = invalid_index;
        auto         he    = v->incident_halfedges();
        const auto   start = he;
        do
        {
          const unsigned int e = mesh_edge(he);
          if (e == invalid_index)
            continue;
          if (first == invalid_index)
            first = e;
          if (e == first)
            continue;
          const auto &a = mesh.edges()[first].vertices,
                     &b = mesh.edges()[e].vertices;
          const unsigned int corner =
            a[0] == b[0] || a[0] == b[1] ? a[0] : a[1];
          if (result.corner_to_vertex[corner] != invalid_index)
            vertex_to_index[&*v] = result.corner_to_vertex[corner];
          break;
        } while (++he != start);
      }
    }


    void
    ArrangedCells::Implementation::match_sides()
    {
      std::unordered_map<unsigned int, std::vector<Halfedge>> side_to_pieces;
      for (auto edge = arrangement.edges_begin();
           edge != arrangement.edges_end();
           ++edge)
      {
        const unsigned int e = mesh_edge(edge);
        if (e == invalid_index)
          continue;
        const auto &cells = mesh.edges()[e].cells;
        for (unsigned int i = 0; i < 2; ++i)
          if (cells[i] != invalid_index &&
              state[cells[i]] == CellState::divided)
            side_to_pieces[e].push_back(
              edge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? Halfedge(edge)
                                                           : edge->twin());
      }
      const auto compare = arrangement.geometry_traits()->compare_xy_2_object();
      for (auto &[e, pieces] : side_to_pieces)
      {
        std::sort(pieces.begin(),
                  pieces.end(),
                  [&](const Halfedge &a, const Halfedge &b) {
                    return compare(a->source()->point(),
                                   b->source()->point()) == CGAL::SMALLER;
                  });
        match_side(e, pieces);
      }
    }


    void
    ArrangedCells::Implementation::match_side(
      const unsigned int           e,
      const std::vector<Halfedge> &pieces)
    {
      const auto        &edge = mesh.edges()[e];
      const unsigned int i    = is_arranged(edge.cells[0]) ? 1 : 0;
      const unsigned int c = edge.cells[i], n = pieces.size();
      const auto        &sides = mesh.cell_edges(c);
      const unsigned int side  = sides[0] == e ? 0 : (sides[1] == e ? 1 : 2);
      Assert(divided.n_pieces(c, side) == n, ExcInternalError());
      const bool is_rightward = runs_right(e);
      auto      &elements     = side_to_elements[e];
      elements.resize(n);
      for (unsigned int k = 0; k < n; ++k)
      {
        // Pieces are numbered from the lower vertex on, which is the direction of the cell on the
        // left.
        const Halfedge right = pieces[is_rightward ? k : n - 1 - k];
        const Halfedge along = is_rightward ? right : Halfedge(right->twin());
        const unsigned int piece  = i == 0 ? k : n - 1 - k;
        const Halfedge in_divided = i == 0 ? along : Halfedge(along->twin());
        beyond_halfedge[&*in_divided] = divided.element(c, side, piece);
        elements[k] = in_divided->twin()->face()->data().element;
        // Use the same vertices or coordinates on both sides.
        if (divided.has_vertices())
        {
          vertex_to_index[&*in_divided->source()] =
            divided.vertex(c, side, piece);
          continue;
        }
        result.vertices[vertex(in_divided->source())] =
          divided.start(c, side, piece);
        if (piece + 1 == n)
          result.vertices[vertex(in_divided->target())] =
            divided.start(c, (side + 1) % 3, 0);
      }
    }


    ArrangedCells::ArrangedCells(const PartToCut                  &part,
                                 const std::vector<unsigned char> &state,
                                 const DividedCells               &divided,
                                 Cutting                          &cutting)
      : implementation(
          std::make_unique<Implementation>(part, state, divided, cutting))
    {
    }


    ArrangedCells::~ArrangedCells() = default;


    unsigned int
    ArrangedCells::element(const unsigned int mesh_edge,
                           const unsigned int piece) const
    {
      const auto &elements = implementation->side_to_elements.at(mesh_edge);
      AssertIndexRange(piece, elements.size());
      return elements[piece];
    }


    void
    ArrangedCells::append_edges()
    {
      implementation->read_edges_and_links();
    }
  } // namespace internal
} // namespace NMM
