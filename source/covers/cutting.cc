#include "cutting.h"

#include <nmm/base/exceptions.h>

#include "exact_curves.h"
#include <algorithm>
#include <unordered_map>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// Cuts one part of the mathematical mesh.
      class Cutter
      {
      public:
        Cutter(const MathematicalMesh           &mathematical_mesh,
               const PhysicalMesh               &physical_mesh,
               const PhysicalEdges              &physical_edges,
               const std::vector<unsigned int>  &region_to_part,
               const PartToCut                  &part,
               const std::vector<unsigned char> &touched,
               const std::vector<SimpleCut>     &simple_cuts,
               Cutting                          &result)
          : mesh(mathematical_mesh)
          , physical_pieces(physical_mesh.pieces())
          , physical_edges(physical_edges)
          , region_to_part(region_to_part)
          , part(part)
          , touched(touched)
          , simple_cuts(simple_cuts)
          , result(result)
          , is_part_of_mesh(mathematical_mesh.rank_cells() != nullptr)
          , arranged(touched)
          , cell_to_simple_cut(simple_cuts.empty() ? 0 : touched.size(),
                               invalid_index)
          , physical_edge_to_curve_set(physical_edges.edges().size(),
                                       invalid_index)
        {
          for (unsigned int i = 0; i < simple_cuts.size(); ++i)
          {
            cell_to_simple_cut[simple_cuts[i].cell] = i;
            arranged[simple_cuts[i].cell]           = 0;
          }
          arrange();
          label_regions();
          label_cells();
          spread_cells();
          label_beside_simple_cuts();
          flood_untouched_cells();
          number_elements();
          number_simple_elements();
          read_edges_and_links();
          add_simple_elements();
        }

      private:
        using Halfedge = Arrangement::Halfedge_handle;
        using Face     = Arrangement::Face_handle;

        void
        arrange();
        void
        label_regions();
        void
        label_cells();
        void
        spread_cells();
        void
        flood_untouched_cells();
        void
        number_elements();
        void
        read_edges_and_links();
        /// @name Cells that are cut simply
        /// @{
        void
        label_beside_simple_cuts();
        void
        number_simple_elements();
        void
        add_simple_elements();

        /// Its index, or invalid_index.
        unsigned int
        simple_cut(unsigned int cell) const;

        /// Region at a corner of the mathematical mesh.
        unsigned int
        region_at(const SimpleCut &cut, unsigned int mesh_vertex) const;

        /// Code of the element at a corner.
        unsigned int
        element_at(unsigned int cut, unsigned int mesh_vertex) const;

        /// Code of the element beyond a side of a simply cut cell, next to
        /// @p mesh_vertex.
        unsigned int
        element_beyond(unsigned int cell,
                       unsigned int mesh_edge,
                       unsigned int mesh_vertex) const;

        /// What an arranged cell knows of a side that it shares with a simply cut
        /// one: @p edge is its piece, @p element its code.
        void
        remember_shared_side(const ElementEdge &edge, unsigned int element);

        /// Where the cut crosses a side.
        Point<2>
        crossing_of(const SimpleCut &cut, unsigned int mesh_edge) const;

        /// Which end of a mathematical edge a piece of it is next to, 0 or 1.
        unsigned int
        nearer_end(unsigned int    mesh_edge,
                   const Point<2> &start,
                   const Point<2> &end) const;

        /// A straight edge of an element; @p side: of the cell, or 3 for the cut.
        void
        add_simple_edge(unsigned int    cut,
                        unsigned int    side,
                        unsigned int    mesh_vertex,
                        const Point<2> &start,
                        const Point<2> &end);
        /// @}

        void
        read_loop(const Arrangement::Ccb_halfedge_circulator &start);
        void
        read_edge(const Halfedge &halfedge);

        /// Walk from the faces in @p stack across edges for which
        /// @p is_crossed(halfedge) holds; @p visit(from, to) says whether to go
        /// on from there.
        template <typename IsCrossed, typename Visit>
        void
        spread(std::vector<Face> stack,
               const IsCrossed  &is_crossed,
               const Visit      &visit);

        /// Mesh edge a halfedge lies on, or invalid_index.
        static unsigned int
        mesh_edge(const Halfedge &halfedge);

        /// Edge of the physical mesh a halfedge lies on, or invalid_index.
        static unsigned int
        physical_edge(const Halfedge &halfedge);

        /// Cell to the left of a halfedge that lies on @p mesh_edge.
        unsigned int
        left_cell(const Halfedge &halfedge, unsigned int mesh_edge) const;

        /// Code of the element on the left, see Cutting.
        unsigned int
        left_element(const Halfedge &halfedge);

        /// Of all that lies on a physical edge; invalid_index for none.
        unsigned int
        curve_set_index(unsigned int physical_edge);

        /// Number of a vertex. It is converted to doubles once: a second
        /// conversion of a lazy number can differ in the last place, and loops
        /// must close exactly.
        unsigned int
        vertex(const Arrangement::Vertex_handle &vertex);

        const MathematicalMesh           &mesh;
        const std::vector<CurvePiece>    &physical_pieces;
        const PhysicalEdges              &physical_edges;
        const std::vector<unsigned int>  &region_to_part;
        const PartToCut                  &part;
        const std::vector<unsigned char> &touched;
        const std::vector<SimpleCut>     &simple_cuts;
        Cutting                          &result;
        Arrangement                       arrangement;
        /// Of a distributed mesh, beyond whose rim other ranks' cells may lie.
        bool is_part_of_mesh;

        /// Flags of the cells that are arranged, by cell.
        std::vector<unsigned char> arranged;
        /// Empty without simple cuts.
        std::vector<unsigned int> cell_to_simple_cut;
        /// Code of the element at the corner, and of the other one.
        std::vector<std::array<unsigned int, 2>> simple_elements;
        /// By mathematical edge between an arranged and a simply cut cell.
        struct SharedSide
        {
          /// Codes of the arranged cell's elements at both ends.
          std::array<unsigned int, 2> elements = {
            {invalid_index, invalid_index}};
          bool     is_crossed = false;
          Point<2> crossing;
        };
        std::unordered_map<unsigned int, SharedSide> shared_sides;

        std::unordered_map<const Arrangement::Vertex *, unsigned int>
          vertex_to_index;
        /// invalid_index: not asked for yet.
        std::vector<unsigned int> physical_edge_to_curve_set;
      };


      void
      Cutter::arrange()
      {
        std::vector<unsigned int> wanted;
        for (unsigned int c = part.cells.first; c < part.cells.second; ++c)
          if (arranged[c])
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
      Cutter::spread(std::vector<Face> stack,
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


      /// Regions on this part: those beside physical edges, and from there
      /// across mathematical edges. Faces of other parts' regions keep none.
      void
      Cutter::label_regions()
      {
        std::vector<Face> stack;
        for (auto he = arrangement.halfedges_begin();
             he != arrangement.halfedges_end();
             ++he)
        {
          const unsigned int e = physical_edge(he);
          if (e == invalid_index)
            continue;
          const bool is_left = he->direction() == CGAL::ARR_LEFT_TO_RIGHT;
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
      Cutter::mesh_edge(const Halfedge &halfedge)
      {
        for (const Label label : halfedge->curve().data())
          if (label >= mesh_edge_flag)
            return label - mesh_edge_flag;
        return invalid_index;
      }


      unsigned int
      Cutter::physical_edge(const Halfedge &halfedge)
      {
        for (const Label label : halfedge->curve().data())
          if (is_physical_edge(label))
            return label - physical_edge_flag;
        return invalid_index;
      }


      unsigned int
      Cutter::left_cell(const Halfedge &halfedge, const unsigned int e) const
      {
        const auto     &edge = mesh.edges()[e];
        const Point<2> &v0   = mesh.vertices()[edge.vertices[0]],
                       &v1   = mesh.vertices()[edge.vertices[1]];
        const bool edge_goes_right =
          v0[0] < v1[0] || (v0[0] == v1[0] && v0[1] < v1[1]);
        const bool halfedge_goes_right =
          halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT;
        return edge.cells[edge_goes_right == halfedge_goes_right ? 0 : 1];
      }


      void
      Cutter::label_cells()
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
            AssertThrow(data.region == invalid_index || is_part_of_mesh,
                        InputError("the solid sticks out of the "
                                   "mathematical mesh",
                                   to_string(to_double(he->source()->point())),
                                   "give a mesh that covers it"));
          }
          else
          {
            data.cell = c;
            he->face()->set_data(data);
            if (!touched[c])
              result.cell_region[c] = data.region;
          }
        }
      }


      /// Faces without a mathematical edge lie in the cell of a neighbouring
      /// face.
      void
      Cutter::spread_cells()
      {
        std::vector<Face> stack;
        for (auto face = arrangement.faces_begin();
             face != arrangement.faces_end();
             ++face)
          if (face->data().cell != invalid_index && arranged[face->data().cell])
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

        for (auto face = arrangement.faces_begin();
             face != arrangement.faces_end();
             ++face)
          AssertThrow(
            face->data().cell != invalid_index ||
              face->data().region == invalid_index || is_part_of_mesh,
            InputError("a part of the solid lies outside the "
                       "mathematical mesh",
                       to_string(to_double(
                         (*face->outer_ccbs_begin())->source()->point())),
                       "give a mesh that covers it"));
      }


      /// Untouched cells that share an edge lie in the same region.
      void
      Cutter::flood_untouched_cells()
      {
        std::vector<unsigned int> stack;
        for (unsigned int c = part.cells.first; c < part.cells.second; ++c)
          if (result.cell_region[c] != invalid_index)
            stack.push_back(c);
        while (!stack.empty())
        {
          const unsigned int c = stack.back();
          stack.pop_back();
          for (const unsigned int e : mesh.cell_edges(c))
            for (const unsigned int other : mesh.edges()[e].cells)
              if (other != invalid_index && !touched[other] &&
                  result.cell_region[other] == invalid_index)
              {
                result.cell_region[other] = result.cell_region[c];
                stack.push_back(other);
              }
        }
      }


      void
      Cutter::number_elements()
      {
        for (auto face = arrangement.faces_begin();
             face != arrangement.faces_end();
             ++face)
        {
          FaceData data = face->data();
          if (data.region == invalid_index || data.cell == invalid_index ||
              !arranged[data.cell])
            continue;
          data.element = result.elements.size();
          face->set_data(data);
          result.elements.push_back({data.cell, data.region, false, 0, 0});
        }
      }


      unsigned int
      Cutter::left_element(const Halfedge &halfedge)
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
        const unsigned int cut = simple_cut(c);
        if (cut == invalid_index)
          return whole_cell_flag + c;
        const unsigned int end =
          nearer_end(e,
                     result.vertices[vertex(halfedge->source())],
                     result.vertices[vertex(halfedge->target())]);
        return element_at(cut, mesh.edges()[e].vertices[end]);
      }


      unsigned int
      Cutter::vertex(const Arrangement::Vertex_handle &vertex)
      {
        const auto [position, is_new] =
          vertex_to_index.emplace(&*vertex, result.vertices.size());
        if (is_new)
          result.vertices.push_back(to_double(vertex->point()));
        return position->second;
      }


      unsigned int
      Cutter::curve_set_index(const unsigned int e)
      {
        if (e == invalid_index)
          return invalid_index;
        unsigned int &index = physical_edge_to_curve_set[e];
        if (index != invalid_index)
          return index;
        // parts of an edge carry all its labels
        std::vector<unsigned int> set;
        for (const Label label : physical_edges.exact_curves().curves[e].data())
          if (is_piece(label))
            set.push_back(label);
        std::sort(set.begin(), set.end());
        const auto [position, is_new] =
          result.curve_set_to_index.emplace(set, result.curve_sets.size());
        if (is_new)
          result.curve_sets.push_back(set);
        return index = position->second;
      }


      void
      Cutter::read_edge(const Halfedge &halfedge)
      {
        const Cutting::EdgeOrigin origin = {vertex(halfedge->source()),
                                            vertex(halfedge->target()),
                                            physical_edge(halfedge)};
        ElementEdge               edge;
        edge.start     = result.vertices[origin.start];
        edge.end       = result.vertices[origin.end];
        edge.curve_set = curve_set_index(origin.physical_edge);
        edge.neighbor  = left_element(halfedge->twin());
        edge.mesh_edge = mesh_edge(halfedge);
        set_circle(halfedge->curve(),
                   halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT,
                   physical_pieces,
                   edge);
        result.edges.push_back(edge);
        result.origins.push_back(origin);
        if (edge.mesh_edge != invalid_index &&
            simple_cut(left_cell(halfedge->twin(), edge.mesh_edge)) !=
              invalid_index)
          remember_shared_side(edge, halfedge->face()->data().element);
      }


      void
      Cutter::read_loop(const Arrangement::Ccb_halfedge_circulator &start)
      {
        auto he = start;
        do
          read_edge(he);
        while (++he != start);
      }


      void
      Cutter::read_edges_and_links()
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


      unsigned int
      Cutter::simple_cut(const unsigned int cell) const
      {
        return cell_to_simple_cut.empty() || cell == invalid_index
                 ? invalid_index
                 : cell_to_simple_cut[cell];
      }


      unsigned int
      Cutter::region_at(const SimpleCut   &cut,
                        const unsigned int mesh_vertex) const
      {
        const bool is_corner =
          mesh_vertex == mesh.cell_vertices(cut.cell)[cut.corner];
        return physical_edges.edges()[cut.physical_edge]
          .regions[is_corner == cut.corner_is_left ? 0 : 1];
      }


      unsigned int
      Cutter::element_at(const unsigned int cut,
                         const unsigned int mesh_vertex) const
      {
        const SimpleCut &c = simple_cuts[cut];
        return simple_elements
          [cut][mesh_vertex == mesh.cell_vertices(c.cell)[c.corner] ? 0 : 1];
      }


      /// The side that is not crossed may border on cells that nothing touches.
      void
      Cutter::label_beside_simple_cuts()
      {
        for (const SimpleCut &cut : simple_cuts)
        {
          const unsigned int side = (cut.corner + 1) % 3;
          for (const unsigned int other :
               mesh.edges()[mesh.cell_edges(cut.cell)[side]].cells)
            if (other != invalid_index && !touched[other])
              result.cell_region[other] =
                region_at(cut, mesh.cell_vertices(cut.cell)[side]);
        }
      }


      void
      Cutter::number_simple_elements()
      {
        simple_elements.reserve(simple_cuts.size());
        for (const SimpleCut &cut : simple_cuts)
        {
          simple_elements.push_back({{invalid_index, invalid_index}});
          for (unsigned int i = 0; i < 2; ++i)
          {
            const unsigned int region =
              region_at(cut,
                        mesh.cell_vertices(cut.cell)[(cut.corner + i) % 3]);
            if (region == invalid_index)
              continue;
            simple_elements.back()[i] = result.elements.size();
            result.elements.push_back({cut.cell, region, false, 0, 0});
          }
        }
      }


      unsigned int
      Cutter::nearer_end(const unsigned int e,
                         const Point<2>    &start,
                         const Point<2>    &end) const
      {
        double distance[2];
        for (unsigned int i = 0; i < 2; ++i)
        {
          const Point<2> &v = mesh.vertices()[mesh.edges()[e].vertices[i]];
          distance[i] =
            std::min(start.distance_square(v), end.distance_square(v));
        }
        return distance[0] <= distance[1] ? 0 : 1;
      }


      void
      Cutter::remember_shared_side(const ElementEdge &edge,
                                   const unsigned int element)
      {
        SharedSide        &shared = shared_sides[edge.mesh_edge];
        const auto        &ends   = mesh.edges()[edge.mesh_edge].vertices;
        const unsigned int near =
          nearer_end(edge.mesh_edge, edge.start, edge.end);
        const Point<2> &here  = mesh.vertices()[ends[near]],
                       &there = mesh.vertices()[ends[1 - near]];
        const Point<2> &far =
          edge.start.distance_square(here) > edge.end.distance_square(here)
            ? edge.start
            : edge.end;
        shared.elements[near] = element;
        if (far == there)
          shared.elements[1 - near] = element;
        else
        {
          shared.is_crossed = true;
          shared.crossing   = far;
        }
      }


      Point<2>
      Cutter::crossing_of(const SimpleCut &cut, const unsigned int e) const
      {
        const auto        &cells = mesh.edges()[e].cells;
        const unsigned int other = cells[cells[0] == cut.cell ? 1 : 0];
        if (other != invalid_index && arranged[other])
        {
          const auto shared = shared_sides.find(e);
          if (shared != shared_sides.end() && shared->second.is_crossed)
            return shared->second.crossing;
        }
        const auto &ends = mesh.edges()[e].vertices;
        return crossing(
          physical_pieces[physical_edges.edges()[cut.physical_edge].piece],
          mesh.vertices()[ends[0]],
          mesh.vertices()[ends[1]]);
      }


      unsigned int
      Cutter::element_beyond(const unsigned int cell,
                             const unsigned int e,
                             const unsigned int mesh_vertex) const
      {
        const auto        &cells = mesh.edges()[e].cells;
        const unsigned int other = cells[0] == cell ? cells[1] : cells[0];
        if (other == invalid_index && is_part_of_mesh)
          return invalid_index;
        AssertThrow(other != invalid_index,
                    InputError("the solid sticks out of the mathematical mesh",
                               to_string(mesh.vertices()[mesh_vertex]),
                               "give a mesh that covers it"));
        const unsigned int cut = simple_cut(other);
        if (cut != invalid_index)
          return element_at(cut, mesh_vertex);
        if (!touched[other])
          return result.cell_region[other] == invalid_index
                   ? invalid_index
                   : whole_cell_flag + other;
        const auto shared = shared_sides.find(e);
        return shared == shared_sides.end()
                 ? invalid_index
                 : shared->second
                     .elements[mesh_vertex == mesh.edges()[e].vertices[0] ? 0
                                                                          : 1];
      }


      void
      Cutter::add_simple_edge(const unsigned int cut,
                              const unsigned int side,
                              const unsigned int mesh_vertex,
                              const Point<2>    &start,
                              const Point<2>    &end)
      {
        const SimpleCut   &c       = simple_cuts[cut];
        const auto        &element = simple_elements[cut];
        const unsigned int here    = element_at(cut, mesh_vertex);
        ElementEdge        edge;
        edge.start = start;
        edge.end   = end;
        if (side == 3)
        {
          edge.curve_set = curve_set_index(c.physical_edge);
          edge.neighbor  = element[here == element[0] ? 1 : 0];
        }
        else
        {
          edge.mesh_edge = mesh.cell_edges(c.cell)[side];
          edge.neighbor  = element_beyond(c.cell, edge.mesh_edge, mesh_vertex);
          const auto        &cells = mesh.edges()[edge.mesh_edge].cells;
          const unsigned int other = cells[cells[0] == c.cell ? 1 : 0];
          // the arrangement has joined those that it knows, and the first of two
          // simply cut ones joins both
          if (edge.neighbor != invalid_index && !arranged[other] &&
              (simple_cut(other) == invalid_index || c.cell < other))
            result.links.push_back({edge.mesh_edge, {{here, edge.neighbor}}});
        }
        result.edges.push_back(edge);
        result.origins.push_back({invalid_index,
                                  invalid_index,
                                  side == 3 ? c.physical_edge : invalid_index});
      }


      void
      Cutter::add_simple_elements()
      {
        for (unsigned int i = 0; i < simple_cuts.size(); ++i)
        {
          const SimpleCut   &cut = simple_cuts[i];
          const unsigned int k = cut.corner, l = (k + 1) % 3, m = (k + 2) % 3;
          const auto        &v     = mesh.cell_vertices(cut.cell);
          const auto        &sides = mesh.cell_edges(cut.cell);
          const Point<2>     x     = crossing_of(cut, sides[k]),
                         y         = crossing_of(cut, sides[m]);
          const auto corner        = [&](const unsigned int local) {
            return mesh.vertices()[v[local]];
          };
          if (simple_elements[i][0] != invalid_index)
          {
            Cutting::Element &element = result.elements[simple_elements[i][0]];
            element.first_edge        = result.edges.size();
            add_simple_edge(i, k, v[k], corner(k), x);
            add_simple_edge(i, 3, v[k], x, y);
            add_simple_edge(i, m, v[k], y, corner(k));
            element.end_edge = result.edges.size();
          }
          if (simple_elements[i][1] != invalid_index)
          {
            Cutting::Element &element = result.elements[simple_elements[i][1]];
            element.first_edge        = result.edges.size();
            add_simple_edge(i, k, v[l], x, corner(l));
            add_simple_edge(i, l, v[l], corner(l), corner(m));
            add_simple_edge(i, m, v[m], corner(m), y);
            add_simple_edge(i, 3, v[m], y, x);
            element.end_edge = result.edges.size();
          }
        }
      }
    } // namespace


    void
    cut(const MathematicalMesh           &mathematical_mesh,
        const PhysicalMesh               &physical_mesh,
        const PhysicalEdges              &physical_edges,
        const std::vector<unsigned int>  &region_to_part,
        const PartToCut                  &part,
        const std::vector<unsigned char> &touched,
        const std::vector<SimpleCut>     &simple_cuts,
        Cutting                          &cutting)
    {
      Cutter(mathematical_mesh,
             physical_mesh,
             physical_edges,
             region_to_part,
             part,
             touched,
             simple_cuts,
             cutting);
    }
  } // namespace internal
} // namespace NMM
