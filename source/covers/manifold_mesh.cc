#include <nmm/base/exceptions.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/point_location.h>
#include <nmm/covers/rank_cells.h>

#include "cutting.h"
#include "element_exchange.h"
#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <mutex>
#include <numeric>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    namespace bg     = boost::geometry;
    using BoostPoint = bg::model::point<double, 2, bg::cs::cartesian>;
    using BoostBox   = bg::model::box<BoostPoint>;
    using CellTree =
      bg::index::rtree<std::pair<BoostBox, unsigned int>, bg::index::rstar<16>>;

    /**
     * Cells that hold elements, in the order of a breadth-first walk over the
     * cells that starts at a cell far from the middle: neighbours get near
     * numbers (Cuthill & McKee 1969; all cells have at most three neighbours,
     * so sorting them by degree, as the full algorithm does, changes nothing).
     */
    std::vector<unsigned int>
    order_cells(const MathematicalMesh           &mesh,
                const std::vector<unsigned char> &holds_elements)
    {
      std::vector<unsigned int>  order;
      std::vector<unsigned char> is_seen(mesh.n_cells(), 0);
      order.reserve(mesh.n_cells());
      const auto walk = [&](const unsigned int          start,
                            std::vector<unsigned char> &seen,
                            std::vector<unsigned int>  &result) {
        unsigned int next = result.size();
        seen[start]       = 1;
        result.push_back(start);
        for (; next < result.size(); ++next)
          for (const unsigned int e : mesh.cell_edges(result[next]))
            for (const unsigned int c : mesh.edges()[e].cells)
              if (c != invalid_index && holds_elements[c] && !seen[c])
              {
                seen[c] = 1;
                result.push_back(c);
              }
      };

      std::vector<unsigned char> is_probed(mesh.n_cells(), 0);
      std::vector<unsigned int>  probe;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (holds_elements[c] && !is_seen[c])
        {
          // the last cell of a first walk is (nearly) peripheral
          probe.clear();
          walk(c, is_probed, probe);
          walk(probe.back(), is_seen, order);
        }
      return order;
    }


    /// The same of a distributed mesh: ghost cells of lower ranks, own ones, ghost
    /// cells of higher ranks.
    std::vector<unsigned int>
    order_cells_of_rank(const MathematicalMesh           &mesh,
                        const RankCells                  &rank_cells,
                        const std::vector<unsigned char> &holds_elements)
    {
      std::vector<unsigned int>  lower, higher;
      std::vector<unsigned char> holds_owned(holds_elements);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (holds_elements[c] && rank_cells.cell_to_owner[c] != rank_cells.rank)
        {
          holds_owned[c] = 0;
          (rank_cells.cell_to_owner[c] < rank_cells.rank ? lower : higher)
            .push_back(c);
        }
      std::vector<unsigned int>       order = std::move(lower);
      const std::vector<unsigned int> owned = order_cells(mesh, holds_owned);
      order.insert(order.end(), owned.begin(), owned.end());
      order.insert(order.end(), higher.begin(), higher.end());
      return order;
    }


    unsigned int
    local_edge(const MathematicalMesh &mesh,
               const unsigned int      cell,
               const unsigned int      mesh_edge)
    {
      const auto &edges = mesh.cell_edges(cell);
      for (unsigned int i = 0; i < 3; ++i)
        if (edges[i] == mesh_edge)
          return i;
      Assert(false, ExcInternalError());
      return invalid_index;
    }
  } // namespace


  struct ManifoldMesh::Data
  {
    const MathematicalMesh *mathematical_mesh;
    const PhysicalMesh     *physical_mesh;

    std::vector<unsigned int>  element_to_cell;
    std::vector<unsigned int>  element_to_region;
    std::vector<unsigned char> element_is_whole;
    /// Elements that the exact cutter made: their range of edges.
    std::vector<std::pair<unsigned int, unsigned int>> element_to_edges;
    std::vector<ElementEdge>                           edges;
    std::vector<std::vector<unsigned int>>             curve_sets;

    std::vector<unsigned int> first_link;
    std::vector<Link>         links;

    std::vector<unsigned int> elements_of_cells;
    std::vector<unsigned int> cell_first_element;
    std::vector<unsigned int> cell_n_elements;
    unsigned int              n_cells_cut_exactly = 0;

    std::pair<unsigned int, unsigned int>            owned_elements;
    std::unique_ptr<const internal::ElementExchange> exchange;

    mutable std::once_flag            tree_made;
    mutable std::unique_ptr<CellTree> cell_tree;

    /// Numbers elements; returns the map from codes of the cutter.
    void
    number_elements(const internal::Cutting          &cutting,
                    const std::vector<unsigned char> &touched,
                    std::vector<unsigned int>        &exact_to_element);

    void
    copy_edges(const internal::Cutting         &cutting,
               const std::vector<unsigned int> &exact_to_element);

    void
    make_links(const internal::Cutting          &cutting,
               const std::vector<unsigned char> &touched,
               const std::vector<unsigned int>  &exact_to_element);

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


  void
  ManifoldMesh::Data::number_elements(
    const internal::Cutting          &cutting,
    const std::vector<unsigned char> &touched,
    std::vector<unsigned int>        &exact_to_element)
  {
    const unsigned int        n_cells = mathematical_mesh->n_cells();
    std::vector<unsigned int> n_in_cell(n_cells, 0);
    for (const auto &element : cutting.elements)
      ++n_in_cell[element.cell];
    std::vector<unsigned char> holds(n_cells, 0);
    for (unsigned int c = 0; c < n_cells; ++c)
    {
      if (!touched[c] && cutting.cell_region[c] != invalid_index)
        n_in_cell[c] = 1;
      holds[c] = (n_in_cell[c] > 0);
    }

    cell_first_element.assign(n_cells, invalid_index);
    cell_n_elements             = std::move(n_in_cell);
    const RankCells *rank_cells = mathematical_mesh->rank_cells();
    for (const unsigned int c :
         rank_cells == nullptr
           ? order_cells(*mathematical_mesh, holds)
           : order_cells_of_rank(*mathematical_mesh, *rank_cells, holds))
    {
      cell_first_element[c] = element_to_cell.size();
      element_to_cell.insert(element_to_cell.end(), cell_n_elements[c], c);
      element_to_region.insert(element_to_region.end(),
                               cell_n_elements[c],
                               cutting.cell_region[c]);
    }
    owned_elements = {0, element_to_cell.size()};
    if (rank_cells != nullptr)
    {
      const auto end_of = [&](const auto &comes_before) {
        return std::partition_point(element_to_cell.begin(),
                                    element_to_cell.end(),
                                    [&](const unsigned int c) {
                                      return comes_before(
                                        rank_cells->cell_to_owner[c],
                                        rank_cells->rank);
                                    }) -
               element_to_cell.begin();
      };
      owned_elements = {end_of(std::less<unsigned int>()),
                        end_of(std::less_equal<unsigned int>())};
    }
    elements_of_cells.resize(element_to_cell.size());
    std::iota(elements_of_cells.begin(), elements_of_cells.end(), 0u);

    element_is_whole.assign(element_to_cell.size(), 1);
    std::vector<unsigned int> next(cell_first_element);
    exact_to_element.resize(cutting.elements.size());
    for (unsigned int i = 0; i < cutting.elements.size(); ++i)
    {
      const auto        &exact   = cutting.elements[i];
      const unsigned int element = next[exact.cell]++;
      exact_to_element[i]        = element;
      element_to_region[element] = exact.region;
      element_is_whole[element]  = exact.is_whole;
    }
  }


  void
  ManifoldMesh::Data::copy_edges(
    const internal::Cutting         &cutting,
    const std::vector<unsigned int> &exact_to_element)
  {
    element_to_edges.assign(element_to_cell.size(), {0, 0});
    edges.reserve(cutting.edges.size());
    for (unsigned int i = 0; i < cutting.elements.size(); ++i)
    {
      const auto &exact = cutting.elements[i];
      const auto  first = cutting.edges.begin() + exact.first_edge,
                 last   = cutting.edges.begin() + exact.end_edge;
      // a whole element nothing touches needs no edges
      if (exact.is_whole &&
          std::all_of(first, last, [](const ElementEdge &edge) {
            return edge.curve_set == invalid_index;
          }))
        continue;
      auto &range  = element_to_edges[exact_to_element[i]];
      range.first  = edges.size();
      range.second = range.first + (exact.end_edge - exact.first_edge);
      edges.insert(edges.end(), first, last);
    }
    for (ElementEdge &edge : edges)
      edge.neighbor = decode(edge.neighbor, exact_to_element);
    curve_sets = cutting.curve_sets;
  }


  void
  ManifoldMesh::Data::make_links(
    const internal::Cutting          &cutting,
    const std::vector<unsigned char> &touched,
    const std::vector<unsigned int>  &exact_to_element)
  {
    struct Pair
    {
      unsigned int a, b, mesh_edge;
    };
    std::vector<Pair> pairs;
    pairs.reserve(mathematical_mesh->edges().size());
    for (unsigned int e = 0; e < mathematical_mesh->edges().size(); ++e)
    {
      const auto &c = mathematical_mesh->edges()[e].cells;
      if (c[0] != invalid_index && c[1] != invalid_index && !touched[c[0]] &&
          !touched[c[1]] && cell_n_elements[c[0]] > 0 &&
          cell_n_elements[c[1]] > 0)
        pairs.push_back(
          {cell_first_element[c[0]], cell_first_element[c[1]], e});
    }
    const std::size_t n_whole = pairs.size();
    for (const auto &link : cutting.links)
    {
      const unsigned int a = decode(link.elements[0], exact_to_element),
                         b = decode(link.elements[1], exact_to_element);
      pairs.push_back({std::min(a, b), std::max(a, b), link.mesh_edge});
    }
    // an edge that curves cross several times can join a pair several times
    const auto key = [](const Pair &p) {
      return std::tie(p.a, p.b, p.mesh_edge);
    };
    std::sort(pairs.begin() + n_whole,
              pairs.end(),
              [&](const Pair &p, const Pair &q) { return key(p) < key(q); });
    pairs.erase(std::unique(pairs.begin() + n_whole,
                            pairs.end(),
                            [&](const Pair &p, const Pair &q) {
                              return key(p) == key(q);
                            }),
                pairs.end());

    first_link.assign(element_to_cell.size() + 1, 0);
    for (const Pair &p : pairs)
    {
      ++first_link[p.a + 1];
      ++first_link[p.b + 1];
    }
    std::partial_sum(first_link.begin(), first_link.end(), first_link.begin());
    links.resize(first_link.back());
    std::vector<unsigned int> next(first_link.begin(), first_link.end() - 1);
    for (const Pair &p : pairs)
    {
      const unsigned int edge_a = local_edge(*mathematical_mesh,
                                             element_to_cell[p.a],
                                             p.mesh_edge),
                         edge_b = local_edge(*mathematical_mesh,
                                             element_to_cell[p.b],
                                             p.mesh_edge);
      links[next[p.a]++]        = {p.b, edge_a, edge_b};
      links[next[p.b]++]        = {p.a, edge_b, edge_a};
    }
  }


  namespace
  {
    /// The parts that have regions, each with its physical edges.
    std::vector<internal::PartToCut>
    find_parts(const MathematicalMesh          &mesh,
               const internal::PhysicalEdges   &physical_edges,
               const std::vector<unsigned int> &region_to_part,
               const unsigned int               n_regions)
    {
      const auto part_of = [&](const unsigned int region) {
        return region_to_part.empty() ? 0u : region_to_part[region];
      };
      std::vector<internal::PartToCut> parts(mesh.n_parts());
      for (unsigned int p = 0; p < parts.size(); ++p)
      {
        parts[p].part  = p;
        parts[p].cells = mesh.part_cells(p);
      }
      for (unsigned int r = 0; r < n_regions; ++r)
        for (const unsigned int e : physical_edges.region_edges(r))
        {
          // an edge between two regions of a part is taken once
          const unsigned int left = physical_edges.edges()[e].regions[0];
          if (left == r || left == invalid_index || part_of(left) != part_of(r))
            parts[part_of(r)].edges.push_back(e);
        }
      parts.erase(std::remove_if(parts.begin(),
                                 parts.end(),
                                 [](const internal::PartToCut &part) {
                                   return part.edges.empty();
                                 }),
                  parts.end());
      return parts;
    }


    double
    largest_coordinate(const BoundingBox<2> &box)
    {
      double largest = 0.;
      for (unsigned int d = 0; d < 2; ++d)
        largest = std::max({largest,
                            std::abs(box.lower_bound(d)),
                            std::abs(box.upper_bound(d))});
      return largest;
    }


    /// Lowest and highest coordinates.
    std::pair<Point<2>, Point<2>>
    extent(const MathematicalMesh &mesh)
    {
      std::pair<Point<2>, Point<2>> box(mesh.vertices()[0], mesh.vertices()[0]);
      for (const Point<2> &x : mesh.vertices())
        for (unsigned int d = 0; d < 2; ++d)
        {
          box.first[d]  = std::min(box.first[d], x[d]);
          box.second[d] = std::max(box.second[d], x[d]);
        }
      return box;
    }


    /// May the edge have points in the box? With a margin of its size.
    bool
    comes_near(const ElementEdge                   &edge,
               const std::pair<Point<2>, Point<2>> &box)
    {
      // an arc lies within a radius of its ends, as it is at most a half circle
      const double reach = std::abs(edge.radius);
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double margin = reach + 1e-6 * (box.second[d] - box.first[d]);
        if (std::max(edge.start[d], edge.end[d]) + margin < box.first[d] ||
            std::min(edge.start[d], edge.end[d]) - margin > box.second[d])
          return false;
      }
      return true;
    }


    /**
     * Untouched cells of a distributed mesh have a region if a touched cell is
     * among those they are connected with, or is known to be there: elsewhere no
     * curve runs through any cell of the connected set, and one point decides.
     */
    void
    label_far_cells(const MathematicalMesh           &mesh,
                    const internal::PhysicalEdges    &physical_edges,
                    const unsigned int                n_regions,
                    const std::vector<unsigned char> &touched,
                    std::vector<unsigned int>        &cell_region)
    {
      std::vector<unsigned char> seen(touched);
      std::vector<unsigned int>  set;
      for (unsigned int start = 0; start < mesh.n_cells(); ++start)
      {
        if (seen[start])
          continue;
        set.assign(1, start);
        seen[start]     = 1;
        bool is_decided = false;
        for (unsigned int i = 0; i < set.size(); ++i)
          for (const unsigned int e : mesh.cell_edges(set[i]))
            for (const unsigned int c : mesh.edges()[e].cells)
              if (c == invalid_index)
                continue;
              else if (touched[c])
                is_decided = true;
              else if (!seen[c])
              {
                seen[c] = 1;
                set.push_back(c);
              }
        if (is_decided)
          continue;
        const Point<2> x =
          mesh.reference_to_real(start, Point<2>(1. / 3., 1. / 3.));
        for (unsigned int r = 0; r < n_regions; ++r)
        {
          std::vector<ElementEdge> boundary;
          for (const unsigned int e : physical_edges.region_edges(r))
            if (physical_edges.edges()[e].regions[0] !=
                physical_edges.edges()[e].regions[1])
              boundary.push_back(physical_edges.edges()[e].shape);
          if (is_inside(ArrayView<const ElementEdge>(boundary.data(),
                                                     boundary.size()),
                        x))
          {
            for (const unsigned int c : set)
              cell_region[c] = r;
            break;
          }
        }
      }
    }


    /// The physical edge that comes near each cell of a part, see
    /// find_edges_near_triangles(); flags the cells.
    std::vector<unsigned int>
    mark_touched_cells(const MathematicalMesh        &mesh,
                       const internal::PhysicalEdges &physical_edges,
                       const internal::PartToCut     &part,
                       const double                   scale,
                       std::vector<unsigned char>    &touched)
    {
      std::vector<ElementEdge>  shapes;
      std::vector<unsigned int> shape_to_edge;
      shapes.reserve(part.edges.size());
      const bool is_distributed = mesh.rank_cells() != nullptr;
      const std::pair<Point<2>, Point<2>> box =
        is_distributed ? extent(mesh) : std::pair<Point<2>, Point<2>>();
      for (const unsigned int e : part.edges)
        if (!is_distributed || comes_near(physical_edges.edges()[e].shape, box))
        {
          shapes.push_back(physical_edges.edges()[e].shape);
          shape_to_edge.push_back(e);
        }
      if (shapes.empty())
        return std::vector<unsigned int>(part.cells.second - part.cells.first,
                                         invalid_index);
      const auto [first, end]        = part.cells;
      std::vector<unsigned int> near = internal::find_edges_near_triangles(
        mesh.vertices(),
        ArrayView<const internal::Triangle>(mesh.cells().data() + first,
                                            end - first),
        shapes,
        scale);
      for (unsigned int i = 0; i < near.size(); ++i)
      {
        touched[first + i] = near[i] != invalid_index;
        if (near[i] != invalid_index && near[i] != internal::several_edges)
          near[i] = shape_to_edge[near[i]];
      }
      return near;
    }
  } // namespace


  ManifoldMesh::ManifoldMesh(const MathematicalMesh          &mathematical_mesh,
                             const PhysicalMesh              &physical_mesh,
                             const std::vector<unsigned int> &region_to_part)
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
    const double scale = largest_coordinate(physical_mesh.bounding_box());

    std::vector<unsigned char> touched(mathematical_mesh.n_cells(), 0);
    internal::Cutting          cutting;
    cutting.cell_region.assign(mathematical_mesh.n_cells(), invalid_index);
    for (const internal::PartToCut &part : find_parts(
           mathematical_mesh, physical_edges, region_to_part, n_regions))
    {
      const std::vector<unsigned int> near = mark_touched_cells(
        mathematical_mesh, physical_edges, part, scale, touched);
      // Edges on both sides of a curve between parts are matched by the vertices of
      // the arrangements.
      std::vector<internal::SimpleCut> simple_cuts;
      if (mathematical_mesh.n_parts() == 1)
        simple_cuts = internal::find_simple_cuts(mathematical_mesh,
                                                 physical_edges,
                                                 physical_mesh.pieces(),
                                                 near,
                                                 scale);
      internal::cut(mathematical_mesh,
                    physical_mesh,
                    physical_edges,
                    region_to_part,
                    part,
                    touched,
                    simple_cuts,
                    cutting);
    }
    if (mathematical_mesh.rank_cells() != nullptr)
      label_far_cells(mathematical_mesh,
                      physical_edges,
                      n_regions,
                      touched,
                      cutting.cell_region);
    if (mathematical_mesh.n_parts() > 1 && !region_to_part.empty())
      internal::match_parts(physical_edges, region_to_part, cutting);
    const RankCells *rank_cells = mathematical_mesh.rank_cells();
    for (unsigned int c = 0; c < touched.size(); ++c)
      data->n_cells_cut_exactly +=
        touched[c] == 1 && (rank_cells == nullptr ||
                            rank_cells->cell_to_owner[c] == rank_cells->rank);

    std::vector<unsigned int> exact_to_element;
    data->number_elements(cutting, touched, exact_to_element);
    data->copy_edges(cutting, exact_to_element);
    data->make_links(cutting, touched, exact_to_element);
    if (mathematical_mesh.rank_cells() != nullptr)
      data->exchange = std::make_unique<internal::ElementExchange>(
        *this, *mathematical_mesh.rank_cells());
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
    return data->element_is_whole[element] != 0;
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
    // Green's theorem about the first corner: triangles, plus the circular
    // segments between arcs and their chords
    const Point<2> origin = edges[0].start;
    double         sum    = 0.;
    for (const ElementEdge &edge : edges)
    {
      const Tensor<1, 2> a = edge.start - origin, b = edge.end - origin;
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      if (edge.is_arc())
      {
        const double sweep = swept_angle(edge);
        sum += 0.5 * edge.radius * edge.radius * (sweep - std::sin(sweep));
      }
    }
    return std::max(sum, 0.);
  }


  ArrayView<const ElementEdge>
  ManifoldMesh::edges(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    const auto [first, last] = data->element_to_edges[element];
    return ArrayView<const ElementEdge>(data->edges.data() + first,
                                        last - first);
  }


  ArrayView<const ManifoldMesh::Link>
  ManifoldMesh::joined(const unsigned int element) const
  {
    AssertIndexRange(element, n_elements());
    const unsigned int first = data->first_link[element];
    return ArrayView<const Link>(data->links.data() + first,
                                 data->first_link[element + 1] - first);
  }


  std::pair<unsigned int, unsigned int>
  ManifoldMesh::owned_elements() const
  {
    return data->owned_elements;
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
    for (const ElementEdge &edge : edges(element))
      sum += edge.start;
    return Point<2>(sum / static_cast<double>(edges(element).size()));
  }


  const internal::ElementExchange *
  ManifoldMesh::exchange() const
  {
    return data->exchange.get();
  }


  ArrayView<const unsigned int>
  ManifoldMesh::cell_elements(const unsigned int cell) const
  {
    AssertIndexRange(cell, data->cell_n_elements.size());
    if (data->cell_n_elements[cell] == 0)
      return ArrayView<const unsigned int>(nullptr, 0);
    return ArrayView<const unsigned int>(data->elements_of_cells.data() +
                                           data->cell_first_element[cell],
                                         data->cell_n_elements[cell]);
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
    return find_element(x, {0, n_elements()});
  }


  unsigned int
  ManifoldMesh::find_owned_element(const Point<2> &x) const
  {
    return find_element(x, data->owned_elements);
  }


  unsigned int
  ManifoldMesh::find_element(
    const Point<2>                              &x,
    const std::pair<unsigned int, unsigned int> &elements) const
  {
    const MathematicalMesh &mesh = *data->mathematical_mesh;
    std::call_once(data->tree_made, [&]() {
      std::vector<std::pair<BoostBox, unsigned int>> boxes;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (data->cell_n_elements[c] > 0)
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

    // on a boundary, rounding decides: accept the nearest element within it
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
      // the tolerance over the cell's smallest height
      const double slack =
        tolerance * mesh.cell_diameter(c) / mesh.cell_area(c);
      if (xi[0] < -slack || xi[1] < -slack || xi[0] + xi[1] > 1. + slack)
        continue;
      for (const unsigned int e : cell_elements(c))
      {
        if (e < elements.first || e >= elements.second)
          continue;
        if (is_whole(e) || is_inside(edges(e), x))
          return e;
        for (const ElementEdge &edge : edges(e))
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
