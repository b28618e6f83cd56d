#include <nmm/base/exceptions.h>
#include <nmm/covers/manifold_mesh.h>

#include "cutting.h"
#include "manifold_mesh_data.h"
#include "parts_to_cut.h"
#include <algorithm>
#include <base/angle_minus_sine.h>
#include <cmath>
#include <mutex>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    namespace bg = boost::geometry;
    using internal::BoostBox;
    using internal::BoostPoint;
    using internal::CellTree;
  } // namespace


  double
  swept_angle(const ElementEdge &edge)
  {
    if (!edge.is_arc())
      return 0.;
    const Tensor<1, 2> chord  = edge.end - edge.start;
    const double       length = chord.norm();
    if (length == 0.)
      return 0.;
    // Middle of the chord minus the centre; differences are taken first to avoid cancellation.
    const Tensor<1, 2> middle =
      0.5 * ((edge.start - edge.center) + (edge.end - edge.center));
    // For a chord of a few ulp, rounding determines its direction. Its distance from the centre is
    // therefore that of its middle.
    const double half = std::atan2(0.5 * length, middle.norm());
    return std::copysign(2. * half, edge.radius);
  }


  ManifoldMesh::ManifoldMesh(const MathematicalMesh          &mathematical_mesh,
                             const PhysicalMesh              &physical_mesh,
                             const std::vector<unsigned int> &region_to_part,
                             const Cutter                     cutter)
    : data(std::make_unique<Data>())
  {
    const unsigned int n_regions = physical_mesh.regions().size();
    AssertThrow(region_to_part.empty() || region_to_part.size() == n_regions,
                InputError("mesh parts are given for " +
                             std::to_string(region_to_part.size()) + " of " +
                             std::to_string(n_regions) + " regions",
                           "",
                           "give one for each region"));
    for (const unsigned int part : region_to_part)
      AssertThrow(part < mathematical_mesh.n_parts(),
                  InputError("the mathematical mesh has no part " +
                               std::to_string(part),
                             "",
                             "give a number below " +
                               std::to_string(mathematical_mesh.n_parts())));

    data->mathematical_mesh = &mathematical_mesh;
    data->physical_mesh     = &physical_mesh;
    const internal::PhysicalEdges physical_edges(physical_mesh);
    const double                  scale =
      internal::largest_coordinate(physical_mesh.bounding_box());

    std::vector<unsigned char>    state(mathematical_mesh.n_cells(),
                                     internal::CellState::untouched);
    const internal::CellNeighbors neighbors =
      internal::find_neighbors(mathematical_mesh);
    internal::Cutting cutting;
    cutting.is_met.assign(physical_edges.edges().size(), 0);
    cutting.cell_region.assign(mathematical_mesh.n_cells(), invalid_index);
    for (const internal::PartToCut &part :
         internal::find_parts(mathematical_mesh,
                              physical_mesh,
                              physical_edges,
                              region_to_part,
                              cutter))
    {
      const internal::NearEdges near = internal::find_near_edges(part, scale);
      for (unsigned int c = part.cells.first; c < part.cells.second; ++c)
        data->n_cells_cut_exactly += near[c - part.cells.first].size() > 0;
      internal::cut(part, neighbors, near, state, cutting);
    }
    if (mathematical_mesh.n_parts() > 1 && !region_to_part.empty())
      internal::match_parts(physical_edges, region_to_part, cutting);

    std::vector<unsigned int> exact_to_element;
    data->number_elements(cutting, neighbors, state, exact_to_element);
    data->take_edges(cutting, exact_to_element);
    data->curve_sets = physical_edges.curve_sets();
    data->make_links(cutting, state, exact_to_element);
  }


  ManifoldMesh::~ManifoldMesh() = default;

  ManifoldMesh::ManifoldMesh(ManifoldMesh &&) noexcept = default;


  const MathematicalMesh &
  ManifoldMesh::mathematical_mesh() const
  {
    return *data->mathematical_mesh;
  }


  const PhysicalMesh &
  ManifoldMesh::physical_mesh() const
  {
    return *data->physical_mesh;
  }


  unsigned int
  ManifoldMesh::n_elements() const
  {
    return data->element_to_cell.size();
  }


  unsigned int
  ManifoldMesh::cell(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    return data->element_to_cell[element];
  }


  unsigned int
  ManifoldMesh::region(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    return data->element_to_region[element];
  }


  unsigned int
  ManifoldMesh::block(const unsigned int element) const
  {
    return data->physical_mesh->regions()[region(element)].block;
  }


  bool
  ManifoldMesh::is_whole(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    const unsigned int special = data->element_to_special[element];
    return special == invalid_index || data->special_is_whole[special] != 0;
  }


  double
  ManifoldMesh::area(const unsigned int element) const
  {
    if (is_whole(element))
      return data->mathematical_mesh->cell_area(cell(element));
    return internal::enclosed_area(edges(element));
  }


  double
  internal::enclosed_area(const ArrayView<const ElementEdge> edges)
  {
    // Green's theorem about the first corner: sum of triangles, plus the circular segments between
    // arcs and their chords.
    const Point<2> origin = edges[0].start;
    double         sum    = 0.;
    for (const ElementEdge &edge : edges)
    {
      const Tensor<1, 2> a = edge.start - origin, b = edge.end - origin;
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      if (edge.is_arc())
      {
        const double sweep = swept_angle(edge);
        sum +=
          0.5 * edge.radius * edge.radius * internal::angle_minus_sine(sweep);
      }
    }
    return std::max(sum, 0.);
  }


  ElementEdges
  ManifoldMesh::edges(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    const unsigned int special  = data->element_to_special[element],
                       n_packed = data->first_packed_edge.size() - 1;
    ElementEdges result;
    if (special == invalid_index)
      return result;
    if (special >= n_packed)
    {
      const unsigned int i = special - n_packed;
      if (i + 1 < data->first_edge.size())
      {
        result.kept = data->edges.data() + data->first_edge[i];
        result.n    = data->first_edge[i + 1] - data->first_edge[i];
      }
      return result;
    }
    const unsigned int first = data->first_packed_edge[special],
                       n     = data->first_packed_edge[special + 1] - first;
    const Point<2> *start    = &data->packed_edges.starts[first];
    const auto     *beyond   = &data->packed_edges.beyond[first];
    ElementEdge    *edge     = result.make(n);
    for (unsigned int i = 0; i < n; ++i)
      new (edge + i) ElementEdge{start[i],
                                 start[i + 1 < n ? i + 1 : 0],
                                 Point<2>(),
                                 0.,
                                 beyond[i].curve_set,
                                 beyond[i].neighbor,
                                 beyond[i].mesh_edge};
    return result;
  }


  unsigned int
  ManifoldMesh::n_edges(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    const unsigned int special  = data->element_to_special[element],
                       n_packed = data->first_packed_edge.size() - 1;
    if (special == invalid_index ||
        special >= n_packed + data->first_edge.size() - 1)
      return 0;
    return special < n_packed ? data->first_packed_edge[special + 1] -
                                  data->first_packed_edge[special]
                              : data->first_edge[special - n_packed + 1] -
                                  data->first_edge[special - n_packed];
  }


  ManifoldMesh::Links
  ManifoldMesh::joined(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    Links              result;
    const unsigned int special = data->element_to_special[element];
    if (special != invalid_index)
    {
      const unsigned int first = data->first_link[special];
      result.stored            = data->links.data() + first;
      result.n                 = data->first_link[special + 1] - first;
      return result;
    }
    for (unsigned int side = 0; side < 3; ++side)
    {
      const Link link = data->link_across(data->element_to_cell[element], side);
      if (link.neighbor != invalid_index)
        result.made[result.n++] = link;
    }
    return result;
  }


  Point<2>
  ManifoldMesh::reference_point(const unsigned int element) const
  {
    Tensor<1, 2> sum;
    if (is_whole(element))
    {
      const MathematicalMesh &mesh = *data->mathematical_mesh;
      for (const unsigned int v : mesh.cell_vertices(cell(element)))
        sum += mesh.vertices()[v];
      return Point<2>(sum / 3.);
    }
    const ElementEdges boundary = edges(element);
    for (const ElementEdge &edge : boundary)
      sum += edge.start;
    return Point<2>(sum / static_cast<double>(boundary.size()));
  }


  std_cxx20::ranges::iota_view<unsigned int, unsigned int>
  ManifoldMesh::cell_elements(const unsigned int cell) const
  {
    AssertIndexRange(cell, data->cell_first_element.size());
    const unsigned int first = data->cell_first_element[cell];
    if (first == invalid_index)
      return {0u, 0u};
    unsigned int end = first + 1;
    while (end < n_elements() && data->element_to_cell[end] == cell)
      ++end;
    return {first, end};
  }


  const std::vector<unsigned int> &
  ManifoldMesh::curve_set(const unsigned int index) const
  {
    AssertIndexRange(index, data->curve_sets.size());
    return data->curve_sets[index];
  }


  unsigned int
  ManifoldMesh::n_cells_cut_exactly() const
  {
    return data->n_cells_cut_exactly;
  }


  unsigned int
  ManifoldMesh::find_element(const Point<2> &x) const
  {
    const MathematicalMesh &mesh = *data->mathematical_mesh;
    std::call_once(data->tree_made, [&]() {
      std::vector<std::pair<BoostBox, unsigned int>> boxes;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (data->cell_first_element[c] != invalid_index)
        {
          const auto &v = mesh.cell_vertices(c);
          BoostBox    box;
          bg::assign_inverse(box);
          for (const unsigned int i : v)
            bg::expand(box,
                       BoostPoint(mesh.vertices()[i][0],
                                  mesh.vertices()[i][1]));
          boxes.emplace_back(box, c);
        }
      data->cell_tree = std::make_unique<CellTree>(boxes);
    });

    // On a boundary, rounding decides: accept the nearest element within the tolerance.
    double tolerance = 1e-12;
    for (unsigned int d = 0; d < 2; ++d)
      tolerance = std::max(tolerance, 1e-12 * std::abs(x[d]));
    unsigned int   nearest          = invalid_index;
    double         nearest_distance = 1e300;
    const BoostBox around({x[0] - tolerance, x[1] - tolerance},
                          {x[0] + tolerance, x[1] + tolerance});
    for (auto it = data->cell_tree->qbegin(bg::index::intersects(around));
         it != data->cell_tree->qend();
         ++it)
    {
      const unsigned int c  = it->second;
      const Point<2>     xi = mesh.real_to_reference(c, x);
      // Tolerance relative to the cell's smallest height.
      const double slack =
        tolerance * mesh.cell_diameter(c) / mesh.cell_area(c);
      if (xi[0] < -slack || xi[1] < -slack || xi[0] + xi[1] > 1. + slack)
        continue;
      for (const unsigned int e : cell_elements(c))
      {
        const ElementEdges boundary = edges(e);
        if (is_whole(e) || is_inside(boundary, x))
          return e;
        for (const ElementEdge &edge : boundary)
        {
          const double d = distance(edge, x);
          if (d < nearest_distance)
          {
            nearest_distance = d;
            nearest          = e;
          }
        }
      }
    }
    return nearest_distance <= 10. * tolerance ? nearest : invalid_index;
  }
} // namespace NMM
