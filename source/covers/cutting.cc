#include "cutting.h"

#include <nmm/base/exceptions.h>

#include <CGAL/Arr_observer.h>

#include "../geometry/arrangement.h"
#include <algorithm>
#include <map>
#include <unordered_map>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      /// A face that a mesh edge splits stays in its region on both sides.
      class RegionKeeper : public CGAL::Arr_observer<Arrangement>
      {
      public:
        RegionKeeper(Arrangement &arrangement)
          : CGAL::Arr_observer<Arrangement>(arrangement)
        {
        }

        void
        after_split_face(Arrangement::Face_handle old_face,
                         Arrangement::Face_handle new_face,
                         bool) override
        {
          new_face->set_data(old_face->data());
        }
      };


      class Cutter
      {
      public:
        Cutter(const MathematicalMesh           &mathematical_mesh,
               const PhysicalMesh               &physical_mesh,
               const std::vector<unsigned char> &touched)
          : mesh(mathematical_mesh)
          , physical_pieces(physical_mesh.pieces())
          , touched(touched)
          , arrangement(physical_mesh.arrangement().arrangement)
        {
          insert_mesh_edges();
          label_cells();
          spread_cells();
          flood_untouched_cells();
          number_elements();
          read_edges_and_links();
        }

        Cutting result;

      private:
        using Halfedge = Arrangement::Halfedge_handle;
        using Face     = Arrangement::Face_handle;

        void
        insert_mesh_edges();
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
        void
        read_loop(const Arrangement::Ccb_halfedge_circulator &start);
        void
        read_edge(const Halfedge &halfedge);

        /// Mesh edge a halfedge lies on, or invalid_index.
        static unsigned int
        mesh_edge(const Halfedge &halfedge);

        /// Has it a physical curve on it?
        static bool
        is_physical(const Halfedge &halfedge);

        /// Cell to the left of a halfedge that lies on @p mesh_edge.
        unsigned int
        left_cell(const Halfedge &halfedge, unsigned int mesh_edge) const;

        /// Code of the element on the left, see Cutting.
        unsigned int
        left_element(const Halfedge &halfedge) const;

        unsigned int
        curve_set_index(const Halfedge &halfedge);

        /// An arc or circle that a circular halfedge lies on.
        const CurvePiece &
        circular_piece(const Halfedge &halfedge) const;

        const MathematicalMesh           &mesh;
        const std::vector<CurvePiece>    &physical_pieces;
        const std::vector<unsigned char> &touched;
        Arrangement                       arrangement;

        /// A vertex as doubles, converted once: a second conversion of a lazy
        /// number can differ in the last place, and loops must close exactly.
        Point<2>
        point(const Arrangement::Vertex_handle &vertex);

        std::map<std::vector<unsigned int>, unsigned int> curve_set_to_index;
        std::unordered_map<const Arrangement::Vertex *, Point<2>>
          vertex_to_point;
      };


      void
      Cutter::insert_mesh_edges()
      {
        std::vector<unsigned char> wanted(mesh.edges().size(), 0);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (touched[c])
            for (const unsigned int e : mesh.cell_edges(c))
              wanted[e] = 1;

        std::vector<Kernel::Point_2> exact_vertex(mesh.vertices().size());
        std::vector<unsigned char>   is_made(mesh.vertices().size(), 0);
        const auto                   exact = [&](const unsigned int v) {
          if (!is_made[v])
          {
            exact_vertex[v] =
              Kernel::Point_2(mesh.vertices()[v][0], mesh.vertices()[v][1]);
            is_made[v] = 1;
          }
          return exact_vertex[v];
        };

        std::vector<Traits::X_monotone_curve_2> curves;
        for (unsigned int e = 0; e < wanted.size(); ++e)
          if (wanted[e])
          {
            const auto &v = mesh.edges()[e].vertices;
            curves.emplace_back(BaseTraits::X_monotone_curve_2(exact(v[0]),
                                                               exact(v[1])),
                                mesh_edge_flag + e);
          }
        const RegionKeeper keeper(arrangement);
        CGAL::insert(arrangement, curves.begin(), curves.end());
      }


      unsigned int
      Cutter::mesh_edge(const Halfedge &halfedge)
      {
        for (const Label label : halfedge->curve().data())
          if (label >= mesh_edge_flag)
            return label - mesh_edge_flag;
        return invalid_index;
      }


      bool
      Cutter::is_physical(const Halfedge &halfedge)
      {
        for (const Label label : halfedge->curve().data())
          if (label < mesh_edge_flag)
            return true;
        return false;
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
        result.cell_region.assign(mesh.n_cells(), invalid_index);
        for (auto face = arrangement.faces_begin();
             face != arrangement.faces_end();
             ++face)
        {
          FaceData data = face->data();
          data.cell = data.element = invalid_index;
          face->set_data(data);
        }

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
          if (face->data().cell != invalid_index && touched[face->data().cell])
            stack.push_back(face);

        const auto visit_loop = [&](Arrangement::Ccb_halfedge_circulator start,
                                    const unsigned int                   c) {
          auto he = start;
          do
          {
            const Face other = he->twin()->face();
            FaceData   data  = other->data();
            if (data.cell == invalid_index && mesh_edge(he) == invalid_index)
            {
              data.cell = c;
              other->set_data(data);
              stack.push_back(other);
            }
          } while (++he != start);
        };
        while (!stack.empty())
        {
          const Face face = stack.back();
          stack.pop_back();
          const unsigned int c = face->data().cell;
          for (auto loop = face->outer_ccbs_begin();
               loop != face->outer_ccbs_end();
               ++loop)
            visit_loop(*loop, c);
          for (auto loop = face->inner_ccbs_begin();
               loop != face->inner_ccbs_end();
               ++loop)
            visit_loop(*loop, c);
        }

        for (auto face = arrangement.faces_begin();
             face != arrangement.faces_end();
             ++face)
          AssertThrow(
            face->data().cell != invalid_index ||
              face->data().region == invalid_index,
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
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
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
              !touched[data.cell])
            continue;
          data.element = result.elements.size();
          face->set_data(data);
          result.elements.push_back({data.cell, data.region, false, 0, 0});
        }
      }


      unsigned int
      Cutter::left_element(const Halfedge &halfedge) const
      {
        const FaceData data = halfedge->face()->data();
        if (data.element != invalid_index)
          return data.element;
        const unsigned int e = mesh_edge(halfedge);
        if (e == invalid_index || data.region == invalid_index)
          return invalid_index;
        return whole_cell_flag + left_cell(halfedge, e);
      }


      Point<2>
      Cutter::point(const Arrangement::Vertex_handle &vertex)
      {
        const auto [position, is_new] =
          vertex_to_point.emplace(&*vertex, Point<2>());
        if (is_new)
          position->second = to_double(vertex->point());
        return position->second;
      }


      unsigned int
      Cutter::curve_set_index(const Halfedge &halfedge)
      {
        std::vector<unsigned int> set;
        for (const Label label : halfedge->curve().data())
          if (label < mesh_edge_flag)
            set.push_back(label);
        if (set.empty())
          return invalid_index;
        std::sort(set.begin(), set.end());
        const auto [position, is_new] =
          curve_set_to_index.emplace(set, result.curve_sets.size());
        if (is_new)
          result.curve_sets.push_back(set);
        return position->second;
      }
      const CurvePiece &
      Cutter::circular_piece(const Halfedge &halfedge) const
      {
        for (const Label label : halfedge->curve().data())
          if (label < mesh_edge_flag)
            return physical_pieces[label];
        Assert(false, ExcInternalError());
        return physical_pieces[0];
      }



      void
      Cutter::read_edge(const Halfedge &halfedge)
      {
        ElementEdge edge;
        edge.start     = point(halfedge->source());
        edge.end       = point(halfedge->target());
        edge.curve_set = curve_set_index(halfedge);
        edge.neighbor  = left_element(halfedge->twin());
        edge.mesh_edge = mesh_edge(halfedge);

        const auto &curve = halfedge->curve();
        if (curve.is_circular())
        {
          const CurvePiece &circle = circular_piece(halfedge);
          edge.center              = circle.center;
          edge.radius              = circle.radius;
          const bool with_curve =
            curve.is_directed_right() ==
            (halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT);
          const bool curve_is_ccw =
            curve.orientation() == CGAL::COUNTERCLOCKWISE;
          if (with_curve != curve_is_ccw)
            edge.radius = -edge.radius;
        }
        result.edges.push_back(edge);
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
          if (e == invalid_index || is_physical(edge))
            continue;
          const unsigned int a = left_element(edge),
                             b = left_element(edge->twin());
          if (a != invalid_index && b != invalid_index)
            result.links.push_back({e, {{a, b}}});
        }
      }
    } // namespace


    Cutting
    cut(const MathematicalMesh           &mathematical_mesh,
        const PhysicalMesh               &physical_mesh,
        const std::vector<unsigned char> &touched)
    {
      return Cutter(mathematical_mesh, physical_mesh, touched).result;
    }
  } // namespace internal
} // namespace NMM
