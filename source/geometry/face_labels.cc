#include "geometry/face_labels.h"

#include "geometry/curve.h"
#include <algorithm>
#include <deque>
#include <iterator>
#include <map>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      std::vector<unsigned int>
      symmetric_difference(const std::vector<unsigned int> &a,
                           const std::vector<unsigned int> &b)
      {
        std::vector<unsigned int> result;
        std::set_symmetric_difference(
          a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
        return result;
      }
    } // namespace


    LabelledFaces::LabelledFaces(
      Arrangement                     &arrangement,
      const std::vector<Curve>        &curves,
      const std::vector<CurvePiece>   &pieces,
      const std::vector<unsigned int> &piece_to_curve,
      const Loops                     &loops)
      : curves(curves)
      , pieces(pieces)
      , piece_to_curve(piece_to_curve)
      , loops(loops)
    {
      vertex_locations.reserve(arrangement.number_of_vertices());
      for (auto v = arrangement.vertices_begin();
           v != arrangement.vertices_end();
           ++v)
        vertex_locations[&*v] = to_double(v->point());

      number_faces(arrangement);
      collect_edges(arrangement);
      check_loops_are_simple(arrangement);
      find_enclosing_loops();
      measure_faces();
      classify_faces();
      for (const Face &face : all_faces)
        face.handle->data().element = invalid_index;
    }


    const std::vector<LabelledFaces::Face> &
    LabelledFaces::faces() const
    {
      return all_faces;
    }


    const std::vector<LabelledFaces::Edge> &
    LabelledFaces::edges() const
    {
      return all_edges;
    }


    DirectedEdge
    LabelledFaces::geometry(const Edge &edge) const
    {
      return directed(edge.halfedge);
    }


    bool
    LabelledFaces::is_solid(const unsigned int face) const
    {
      return all_faces[face].is_solid;
    }


    void
    LabelledFaces::number_faces(Arrangement &arrangement)
    {
      all_faces.reserve(arrangement.number_of_faces());
      const auto append = [&](const Arrangement::Face_handle &handle) {
        handle->data().element = all_faces.size();
        all_faces.emplace_back();
        all_faces.back().handle = handle;
      };
      append(arrangement.unbounded_face());
      for (auto f = arrangement.faces_begin(); f != arrangement.faces_end();
           ++f)
        if (!f->is_unbounded())
          append(f);
    }


    void
    LabelledFaces::collect_edges(Arrangement &arrangement)
    {
      all_edges.reserve(arrangement.number_of_edges());
      for (auto e = arrangement.edges_begin(); e != arrangement.edges_end();
           ++e)
      {
        Edge edge;
        edge.halfedge = e;
        edge.left     = e->face()->data().element;
        edge.right    = e->twin()->face()->data().element;
        for (const Label label : e->curve().data())
          edge.curves.push_back(piece_to_curve[label]);
        std::sort(edge.curves.begin(), edge.curves.end());
        const auto repeated =
          std::adjacent_find(edge.curves.begin(), edge.curves.end());
        if (repeated != edge.curves.end())
          edge.repeated_curve = *repeated;
        edge.curves.erase(std::unique(edge.curves.begin(), edge.curves.end()),
                          edge.curves.end());

        // Find a curve that runs along itself, or two sides of one loop.
        std::map<unsigned int, unsigned int> loop_to_curve;
        for (const unsigned int c : edge.curves)
        {
          const unsigned int loop = loops.curve_to_loop[c];
          if (loop == invalid_index)
            continue;
          const auto [it, is_new] = loop_to_curve.insert({loop, c});
          AssertThrow(
            is_new && edge.repeated_curve != c,
            InputError(describe(curves[c]) +
                         (is_new ? " overlaps itself"
                                 : " overlaps " + describe(curves[it->second]) +
                                     " of the same closed chain"),
                       describe_place(curves[c],
                                      vertex_locations.at(&*e->source())),
                       "remove what is drawn twice"));
        }
        all_edges.push_back(std::move(edge));
      }
    }


    std::vector<unsigned int>
    LabelledFaces::loops_on(const Edge &edge) const
    {
      std::vector<unsigned int> result;
      for (const unsigned int c : edge.curves)
        if (loops.curve_to_loop[c] != invalid_index)
          result.push_back(loops.curve_to_loop[c]);
      std::sort(result.begin(), result.end());
      return result;
    }


    void
    LabelledFaces::check_loops_are_simple(Arrangement &arrangement) const
    {
      std::vector<std::pair<unsigned int, unsigned int>> loops_and_curves;
      for (auto v = arrangement.vertices_begin();
           v != arrangement.vertices_end();
           ++v)
      {
        if (v->degree() <= 2)
          continue;
        loops_and_curves.clear();
        auto       e     = v->incident_halfedges();
        const auto first = e;
        do
        {
          for (const Label label : e->curve().data())
          {
            const unsigned int c    = piece_to_curve[label];
            const unsigned int loop = loops.curve_to_loop[c];
            if (loop != invalid_index && curves[c].role != CurveRole::interface)
              loops_and_curves.emplace_back(loop, c);
          }
        } while (++e != first);
        std::sort(loops_and_curves.begin(), loops_and_curves.end());
        for (unsigned int i = 2; i < loops_and_curves.size(); ++i)
        {
          const auto &[loop, c] = loops_and_curves[i];
          if (loops_and_curves[i - 2].first != loop)
            continue;
          const Curve &a = curves[loops_and_curves[i - 2].second];
          const Curve &b = curves[c];
          AssertThrow(
            false,
            InputError(describe(a) + (&a == &b
                                        ? " crosses or touches itself"
                                        : " crosses or touches " + describe(b) +
                                            " of the same closed chain"),
                       describe_place(a, vertex_locations.at(&*v)),
                       "correct the order of the points there or, if the "
                       "parts touch on purpose, make each a closed curve "
                       "of its own"));
        }
      }
    }


    void
    LabelledFaces::find_enclosing_loops()
    {
      std::vector<std::vector<unsigned int>> face_to_edges(all_faces.size());
      for (unsigned int e = 0; e < all_edges.size(); ++e)
        if (all_edges[e].left != all_edges[e].right)
        {
          face_to_edges[all_edges[e].left].push_back(e);
          face_to_edges[all_edges[e].right].push_back(e);
        }

      std::vector<bool>        reached(all_faces.size(), false);
      std::deque<unsigned int> front = {0};
      reached[0]                     = true;
      while (!front.empty())
      {
        const unsigned int f = front.front();
        front.pop_front();
        for (const unsigned int e : face_to_edges[f])
        {
          const Edge        &edge  = all_edges[e];
          const unsigned int other = edge.left == f ? edge.right : edge.left;
          if (reached[other])
            continue;
          all_faces[other].loops =
            symmetric_difference(all_faces[f].loops, loops_on(edge));
          reached[other] = true;
          front.push_back(other);
        }
      }
    }


    DirectedEdge
    LabelledFaces::directed(
      const Arrangement::Halfedge_const_handle halfedge) const
    {
      DirectedEdge edge;
      edge.start = vertex_locations.at(&*halfedge->source());
      edge.end   = vertex_locations.at(&*halfedge->target());

      const auto       &curve = halfedge->curve();
      const CurvePiece &piece = pieces[*curve.data().begin()];
      if (!curve.is_linear() &&
          !is_nearly_straight(edge.start, edge.end, piece.radius))
      {
        const bool is_along_curve =
          curve.is_directed_right() ==
          (halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT);
        const bool is_counterclockwise =
          (curve.orientation() == CGAL::COUNTERCLOCKWISE) == is_along_curve;
        edge.bulge  = is_counterclockwise ? 1 : -1;
        edge.center = piece.center;
        edge.radius = piece.radius;
      }
      return edge;
    }


    void
    LabelledFaces::measure_faces()
    {
      for (Face &face : all_faces)
      {
        const auto append =
          [&](const Arrangement::Ccb_halfedge_const_circulator first) {
            auto e = first;
            do
              face.boundary.push_back(directed(e));
            while (++e != first);
          };
        if (face.handle->is_unbounded())
          continue;
        for (auto c = face.handle->outer_ccbs_begin();
             c != face.handle->outer_ccbs_end();
             ++c)
          append(*c);
        for (auto c = face.handle->inner_ccbs_begin();
             c != face.handle->inner_ccbs_end();
             ++c)
          append(*c);

        face.area   = enclosed_area(face.boundary);
        face.inside = inside_point(face.boundary);
        face.corner = face.boundary.front().start;
        for (const DirectedEdge &edge : face.boundary)
          if (std::make_pair(edge.start[0], edge.start[1]) <
              std::make_pair(face.corner[0], face.corner[1]))
            face.corner = edge.start;
      }
    }


    void
    LabelledFaces::classify_faces()
    {
      for (Face &face : all_faces)
      {
        std::vector<unsigned int> boundaries, holes;
        bool                      is_excavated = false;
        for (const unsigned int loop : face.loops)
        {
          const unsigned int curve = loops.loops[loop].curves.front();
          if (loops.loops[loop].role == CurveRole::boundary)
            boundaries.push_back(curve);
          else if (loops.loops[loop].role != CurveRole::hole)
            continue;
          else if (curves[curve].is_clipped)
            is_excavated = true;
          else
            holes.push_back(curve);
        }

        const unsigned int n_boundaries = boundaries.size();
        const unsigned int n_holes      = holes.size();
        face.is_solid = n_boundaries == n_holes + 1 && !is_excavated;
        if (n_boundaries > n_holes + 1)
        {
          const Curve &first  = curves[boundaries[0]];
          const Curve &second = curves[boundaries[1]];
          AssertThrow(false,
                      InputError("the domains of " + describe(first) + " and " +
                                   describe(second) + " overlap",
                                 describe_place(second, face.inside),
                                 "make the inner one a hole or an "
                                 "interface, or move it"));
        }
        if (n_boundaries < n_holes)
        {
          const Curve &hole = curves[holes.back()];
          AssertThrow(n_boundaries > 0,
                      InputError(describe(hole) + " reaches outside its domain",
                                 describe_place(hole, face.inside),
                                 "move it inside or draw the outer "
                                 "boundary around it"));
          AssertThrow(false,
                      InputError(describe(curves[holes[0]]) + " and " +
                                   describe(curves[holes[1]]) + " overlap",
                                 describe_place(hole, face.inside),
                                 "merge them to one hole; an island in a "
                                 "hole is a boundary"));
        }
      }
    }
  } // namespace internal
} // namespace NMM
