#include "physical_edges.h"

#include <nmm/covers/manifold_mesh.h>

#include "exact_curves.h"
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    void
    set_circle(const Traits::X_monotone_curve_2 &curve,
               const bool                        left_to_right,
               const std::vector<CurvePiece>    &pieces,
               ElementEdge                      &edge)
    {
      if (!curve.is_circular())
        return;
      const CurvePiece *circle = nullptr;
      for (const Label label : curve.data())
        if (is_piece(label))
          circle = &pieces[label];
      Assert(circle != nullptr, ExcInternalError());
      const bool with_curve = curve.is_directed_right() == left_to_right;
      const bool curve_is_counter_clockwise =
        curve.orientation() == CGAL::COUNTERCLOCKWISE;
      edge.center = circle->center;
      edge.radius = with_curve == curve_is_counter_clockwise ? circle->radius
                                                             : -circle->radius;
    }


    std::vector<ElementEdge>
    solid_edges(const PhysicalMesh &physical_mesh)
    {
      const auto              &edges = physical_mesh.arrangement().solid_edges;
      std::vector<ElementEdge> result(edges.size());
      for (std::size_t e = 0; e < edges.size(); ++e)
      {
        result[e].start  = edges[e].start;
        result[e].end    = edges[e].end;
        result[e].center = edges[e].center;
        result[e].radius = edges[e].bulge * edges[e].radius;
      }
      return result;
    }


    PhysicalEdges::PhysicalEdges(const PhysicalMesh &physical_mesh)
      : curves(std::make_unique<ExactCurves>())
    {
      const Arrangement &arrangement = physical_mesh.arrangement().arrangement;
      const std::size_t  n_edges     = arrangement.number_of_edges();
      Assert(physical_mesh.pieces().size() < physical_edge_flag &&
               n_edges < physical_edge_flag,
             ExcInternalError());
      all_edges.reserve(n_edges);
      curves->curves.reserve(n_edges);

      // An end that several edges share is converted once, so that it is the same double
      // everywhere.
      std::unordered_map<const void *, unsigned int> vertex_to_index;
      const auto number = [&](const Arrangement::Vertex_const_handle &vertex) {
        const auto [position, is_new] =
          vertex_to_index.emplace(&*vertex, all_vertices.size());
        if (is_new)
        {
          all_vertices.push_back(to_double(vertex->point()));
          curves->points.push_back(vertex->point());
        }
        return position->second;
      };
      std::map<std::vector<unsigned int>, unsigned int> curve_set_to_index;
      std::vector<unsigned int>                         curve_set;

      for (auto e = arrangement.edges_begin(); e != arrangement.edges_end();
           ++e)
      {
        Arrangement::Halfedge_const_handle halfedge = e;
        if (halfedge->direction() != CGAL::ARR_LEFT_TO_RIGHT)
          halfedge = halfedge->twin();
        Edge edge;
        edge.regions = {{halfedge->face()->data().region,
                         halfedge->twin()->face()->data().region}};
        if (edge.regions[0] == invalid_index &&
            edge.regions[1] == invalid_index)
          continue;
        edge.vertices = {
          {number(halfedge->source()), number(halfedge->target())}};
        edge.shape.start                 = all_vertices[edge.vertices[0]];
        edge.shape.end                   = all_vertices[edge.vertices[1]];
        Traits::X_monotone_curve_2 curve = halfedge->curve();
        curve_set.clear();
        for (const Label label : curve.data())
          if (is_piece(label))
          {
            edge.piece = label;
            curve_set.push_back(label);
          }
        const CurvePiece &piece = physical_mesh.pieces()[edge.piece];
        edge.is_linear          = halfedge->curve().is_linear();
        if (!is_nearly_straight(edge.shape.start, edge.shape.end, piece.radius))
          set_circle(halfedge->curve(),
                     true,
                     physical_mesh.pieces(),
                     edge.shape);
        else if (!edge.is_linear)
          edge.sagitta =
            std::min(0.25 * edge.shape.start.distance_square(edge.shape.end) /
                       piece.radius,
                     piece.radius);
        edge.line = {{piece.start, piece.end}};
        if (std::tie(piece.end[0], piece.end[1]) <
            std::tie(piece.start[0], piece.start[1]))
          std::swap(edge.line[0], edge.line[1]);
        std::sort(curve_set.begin(), curve_set.end());
        const auto [position, is_new] =
          curve_set_to_index.emplace(curve_set, all_curve_sets.size());
        if (is_new)
          all_curve_sets.push_back(curve_set);
        edge.curve_set = position->second;
        curve.data().insert(physical_edge_flag +
                            static_cast<Label>(all_edges.size()));
        curves->curves.push_back(std::move(curve));
        all_edges.push_back(edge);
      }

      const auto for_each_side = [&](const auto &action) {
        for (unsigned int e = 0; e < all_edges.size(); ++e)
        {
          const auto [left, right] = all_edges[e].regions;
          if (left != invalid_index)
            action(left, e);
          if (right != invalid_index && right != left)
            action(right, e);
        }
      };
      first_of_region.assign(physical_mesh.regions().size() + 1, 0);
      for_each_side([&](const unsigned int region, const unsigned int) {
        ++first_of_region[region + 1];
      });
      std::partial_sum(first_of_region.begin(),
                       first_of_region.end(),
                       first_of_region.begin());
      edges_of_regions.resize(first_of_region.back());
      std::vector<unsigned int> next(first_of_region.begin(),
                                     first_of_region.end() - 1);
      for_each_side([&](const unsigned int region, const unsigned int e) {
        edges_of_regions[next[region]++] = e;
      });
    }


    PhysicalEdges::~PhysicalEdges() = default;


    const std::vector<PhysicalEdges::Edge> &
    PhysicalEdges::edges() const
    {
      return all_edges;
    }


    const std::vector<Point<2>> &
    PhysicalEdges::vertices() const
    {
      return all_vertices;
    }


    const std::vector<std::vector<unsigned int>> &
    PhysicalEdges::curve_sets() const
    {
      return all_curve_sets;
    }


    ArrayView<const unsigned int>
    PhysicalEdges::region_edges(const unsigned int region) const
    {
      AssertIndexRange(region + 1, first_of_region.size());
      return ArrayView<const unsigned int>(edges_of_regions.data() +
                                             first_of_region[region],
                                           first_of_region[region + 1] -
                                             first_of_region[region]);
    }


    const ExactCurves &
    PhysicalEdges::exact_curves() const
    {
      return *curves;
    }
  } // namespace internal
} // namespace NMM
