#include <nmm/covers/aggregation.h>
#include <nmm/covers/element_support.h>

#include "element_exchange.h"
#include "element_order.h"
#include <algorithm>
#include <cmath>
#include <functional>

// Roots of elements with little support.
namespace NMM
{
  using namespace dealii;
  using internal::ElementExchange;

  namespace
  {
    /// Largest number of layers of elements over which polynomials are extended: their values grow
    /// with the square of the distance, and energies with its fourth power.
    constexpr unsigned int max_layers = 3;

    /**
     * Elements whose fraction a of their cell's area is at most this are extended over more layers
     * d. The energy of the extended values is a d^4 times that of a cell, and at most 1. Without a
     * root, a sliver of the relative width a determines its unknowns only to epsilon / a^2, because
     * the energy of a field that is quadratic across it is a^2 times that of one along it.
     */
    constexpr double       sliver_share      = 1e-4;
    constexpr unsigned int max_sliver_layers = 10;

    /// Value for a root that another rank holds, during the search.
    constexpr unsigned int remote = invalid_index - 1;


    /// Elements of a mesh and their neighbours as a graph.
    class MeshGraph
    {
    public:
      explicit MeshGraph(const ManifoldMesh &mesh)
        : mesh(mesh)
      {
      }

      template <typename Action>
      void
      for_each_neighbor(const unsigned int e, const Action &action) const
      {
        for (const ManifoldMesh::Link &link : mesh.joined(e))
          action(link.neighbor);
      }

      Point<2>
      centroid(const unsigned int e) const
      {
        return internal::cell_centroid(mesh, e);
      }

      double
      cell_size(const unsigned int e) const
      {
        return mesh.mathematical_mesh().cell_diameter(mesh.cell(e));
      }

      bool
      comes_first(const unsigned int a, const unsigned int b) const
      {
        return internal::comes_first(mesh, a, b);
      }

    private:
      const ManifoldMesh &mesh;
    };


    /// Set the root of an element: the nearest root of its @p parents, which are ascending.
    template <typename Graph>
    void
    choose_root(const Graph                         &graph,
                const unsigned int                   e,
                const ArrayView<const unsigned int> &parents,
                ElementRoots                        &roots)
    {
      std::vector<unsigned int> &element_to_root = roots.element_to_root;
      // Ties are decided as in ElementPlace: to a millionth of a cell, which is more than what
      // rounding leaves of coordinates far from the origin.
      const double   tie    = 1e-6 * graph.cell_size(e);
      const Point<2> here   = graph.centroid(e);
      double         best   = 1e300;
      unsigned int   parent = invalid_index;
      for (const unsigned int candidate : parents)
      {
        if (candidate == parent)
          continue;
        const unsigned int root      = element_to_root[candidate];
        const double       d         = here.distance(graph.centroid(root));
        bool               is_better = d < best - tie;
        if (!is_better && d <= best + tie)
          is_better = root != element_to_root[parent]
                        ? graph.comes_first(root, element_to_root[parent])
                        : graph.comes_first(candidate, parent);
        if (is_better)
        {
          best   = d;
          parent = candidate;
        }
      }
      element_to_root[e]         = element_to_root[parent];
      roots.element_to_parent[e] = parent;
    }


    /// Set the roots of elements that are joined to elements with a root, layer by layer: the
    /// nearest root in the previous layer. If @p may_follow is given, only elements for which it is
    /// true are considered. Returns the last layer.
    template <typename Graph>
    std::vector<unsigned int>
    spread_roots(const Graph                             &graph,
                 std::vector<unsigned int>                layer,
                 const unsigned int                       n_layers,
                 ElementRoots                            &roots,
                 const std::function<bool(unsigned int)> &may_follow = {})
    {
      // Pairs (element, parent).
      std::vector<std::pair<unsigned int, unsigned int>> found;
      std::vector<unsigned int>                          parents;
      for (unsigned int l = 0; l < n_layers && !layer.empty(); ++l)
      {
        found.clear();
        for (const unsigned int e : layer)
          graph.for_each_neighbor(e, [&](const unsigned int neighbor) {
            if (roots.element_to_root[neighbor] == invalid_index &&
                (!may_follow || may_follow(neighbor)))
              found.emplace_back(neighbor, e);
          });
        std::sort(found.begin(), found.end());

        layer.clear();
        for (std::size_t i = 0; i < found.size();)
        {
          const unsigned int e = found[i].first;
          parents.clear();
          for (; i < found.size() && found[i].first == e; ++i)
            parents.push_back(found[i].second);
          choose_root(graph,
                      e,
                      ArrayView<const unsigned int>(parents.data(),
                                                    parents.size()),
                      roots);
          layer.push_back(e);
        }
      }
      return layer;
    }


    /// Make roots of the remaining elements, which are far from any good one: the element with the
    /// largest support becomes a root, and so on. @p left: pairs (support, element).
    template <typename Graph>
    void
    root_the_rest(const Graph                                 &graph,
                  std::vector<std::pair<double, unsigned int>> left,
                  ElementRoots                                &roots)
    {
      for (auto &[support, e] : left)
        support = std::round(1e9 * support);
      std::sort(left.begin(), left.end(), [&](const auto &a, const auto &b) {
        if (a.first != b.first)
          return a.first > b.first;
        if (graph.comes_first(a.second, b.second))
          return true;
        return !graph.comes_first(b.second, a.second) && a.second < b.second;
      });
      for (const auto &[support, e] : left)
        if (roots.element_to_root[e] == invalid_index)
        {
          roots.element_to_root[e] = roots.element_to_parent[e] = e;
          spread_roots(graph, {e}, max_layers, roots);
        }
    }


    /// Graph of the elements without a root in connected sets that are spread over several ranks,
    /// the same on all ranks.
    class SharedGraph
    {
    public:
      SharedGraph(const ManifoldMesh                                 &mesh,
                  const std::vector<std::pair<double, unsigned int>> &owned,
                  const std::vector<unsigned int> &element_to_root)
      {
        const ElementExchange &exchange = *mesh.exchange();
        std::vector<double>    message;
        for (const auto &[support, e] : owned)
        {
          const auto                   name = exchange.global(e);
          const internal::ElementPlace place(mesh, e);
          const Point<2>               x = internal::cell_centroid(mesh, e);
          message.insert(message.end(),
                         {static_cast<double>(name.rank),
                          static_cast<double>(name.element),
                          support,
                          x[0],
                          x[1],
                          place.cell_size});
          message.insert(message.end(),
                         place.values.begin(),
                         place.values.end());
          std::vector<double> neighbors;
          for (const ManifoldMesh::Link &link : mesh.joined(e))
            if (element_to_root[link.neighbor] == invalid_index)
            {
              const auto other = exchange.global(link.neighbor);
              neighbors.push_back(other.rank);
              neighbors.push_back(other.element);
            }
          message.push_back(neighbors.size());
          message.insert(message.end(), neighbors.begin(), neighbors.end());
        }
        std::vector<std::vector<ElementExchange::GlobalElement>> links;
        for (const std::vector<double> &part :
             Utilities::MPI::all_gather(exchange.communicator(), message))
          for (auto it = part.begin(); it != part.end();)
          {
            const auto next = [&it]() { return *it++; };
            const auto name = [&]() {
              const auto rank = static_cast<unsigned int>(next());
              return ElementExchange::GlobalElement{
                rank, static_cast<unsigned int>(next())};
            };
            names.push_back(name());
            supports.push_back(next());
            const double x = next();
            centroids.emplace_back(x, next());
            places.emplace_back();
            places.back().cell_size = next();
            for (double &value : places.back().values)
              value = next();
            links.emplace_back(static_cast<std::size_t>(next()) / 2);
            for (auto &link : links.back())
              link = name();
          }
        std::map<ElementExchange::GlobalElement, unsigned int> name_to_index;
        for (unsigned int i = 0; i < names.size(); ++i)
          name_to_index[names[i]] = i;
        for (const auto &of_element : links)
        {
          neighbors.emplace_back();
          for (const auto &name : of_element)
            neighbors.back().push_back(name_to_index.at(name));
        }
      }

      template <typename Action>
      void
      for_each_neighbor(const unsigned int e, const Action &action) const
      {
        for (const unsigned int neighbor : neighbors[e])
          action(neighbor);
      }

      Point<2>
      centroid(const unsigned int e) const
      {
        return centroids[e];
      }

      double
      cell_size(const unsigned int e) const
      {
        return places[e].cell_size;
      }

      bool
      comes_first(const unsigned int a, const unsigned int b) const
      {
        return a != b && places[a] < places[b];
      }

      std::vector<ElementExchange::GlobalElement> names;
      std::vector<double>                         supports;

    private:
      std::vector<Point<2>>                  centroids;
      std::vector<internal::ElementPlace>    places;
      std::vector<std::vector<unsigned int>> neighbors;
    };


    /// Get the roots and parents of ghost elements from their owners.
    void
    update_ghost_roots(const ManifoldMesh &mesh, ElementRoots &roots)
    {
      const ElementExchange    &exchange = *mesh.exchange();
      const unsigned int        n        = mesh.n_elements();
      std::vector<unsigned int> names(4 * n, invalid_index);
      for (unsigned int e = 0; e < n; ++e)
        for (unsigned int i = 0; i < 2; ++i)
        {
          const unsigned int other =
            i == 0 ? roots.element_to_root[e] : roots.element_to_parent[e];
          if (other >= remote)
            continue;
          const auto name          = exchange.global(other);
          names[4 * e + 2 * i]     = name.rank;
          names[4 * e + 2 * i + 1] = name.element;
        }
      exchange.update_ghosts(names, 4);
      const auto [first, end] = mesh.owned_elements();
      for (unsigned int e = 0; e < n; ++e)
        if (e < first || e >= end)
          for (unsigned int i = 0; i < 2; ++i)
          {
            unsigned int &other =
              i == 0 ? roots.element_to_root[e] : roots.element_to_parent[e];
            other = invalid_index;
            if (names[4 * e + 2 * i] == invalid_index)
              continue;
            other =
              exchange.local({names[4 * e + 2 * i], names[4 * e + 2 * i + 1]});
            if (other == invalid_index)
              other = remote;
          }
    }


    /// For each element, whether it has no root and is connected, by others without a root, with an
    /// element that two ranks hold.
    std::vector<unsigned char>
    find_shared_sets(const ManifoldMesh              &mesh,
                     const std::vector<unsigned int> &element_to_root)
    {
      std::vector<unsigned char> is_shared(mesh.n_elements(), 0);
      std::vector<unsigned int>  stack;
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        if (element_to_root[e] == invalid_index &&
            mesh.exchange()->is_shared(e) && !is_shared[e])
        {
          is_shared[e] = 1;
          stack.assign(1, e);
          while (!stack.empty())
          {
            const unsigned int here = stack.back();
            stack.pop_back();
            for (const ManifoldMesh::Link &link : mesh.joined(here))
              if (element_to_root[link.neighbor] == invalid_index &&
                  !is_shared[link.neighbor])
              {
                is_shared[link.neighbor] = 1;
                stack.push_back(link.neighbor);
              }
          }
        }
      return is_shared;
    }


    /**
     * Find the remaining roots of a distributed mesh. Connected sets on a single rank are treated
     * as on one rank; all ranks treat the others, of which there are few.
     */
    void
    root_the_rest_on_ranks(const ManifoldMesh              &mesh,
                           const std::vector<unsigned int> &bad,
                           ElementRoots                    &roots)
    {
      const ElementExchange &exchange = *mesh.exchange();
      update_ghost_roots(mesh, roots);
      const std::vector<unsigned char> is_shared =
        find_shared_sets(mesh, roots.element_to_root);
      std::vector<std::pair<double, unsigned int>> own, common;
      const auto [first, end] = mesh.owned_elements();
      for (const unsigned int e : bad)
        if (roots.element_to_root[e] == invalid_index && e >= first && e < end)
          (is_shared[e] ? common : own)
            .emplace_back(element_support(mesh, e), e);
      const SharedGraph graph(mesh, common, roots.element_to_root);
      root_the_rest(MeshGraph(mesh), own, roots);

      ElementRoots shared_roots;
      shared_roots.element_to_root.assign(graph.names.size(), invalid_index);
      shared_roots.element_to_parent = shared_roots.element_to_root;
      std::vector<std::pair<double, unsigned int>> left;
      for (unsigned int i = 0; i < graph.names.size(); ++i)
        left.emplace_back(graph.supports[i], i);
      root_the_rest(graph, left, shared_roots);
      const auto local = [&](const unsigned int i) {
        const unsigned int e = exchange.local(graph.names[i]);
        return e == invalid_index ? remote : e;
      };
      for (unsigned int i = 0; i < graph.names.size(); ++i)
        if (local(i) != remote)
        {
          roots.element_to_root[local(i)] =
            local(shared_roots.element_to_root[i]);
          roots.element_to_parent[local(i)] =
            local(shared_roots.element_to_parent[i]);
        }
      for (std::vector<unsigned int> *list :
           {&roots.element_to_root, &roots.element_to_parent})
        std::replace(list->begin(), list->end(), remote, invalid_index);
    }
  } // namespace


  ElementRoots
  find_roots(const ManifoldMesh &manifold_mesh, const double threshold)
  {
    const unsigned int n_elements = manifold_mesh.n_elements();
    ElementRoots       result;
    result.element_to_root.assign(n_elements, invalid_index);
    std::vector<unsigned int> &element_to_root = result.element_to_root;

    // Only elements with little support and their good neighbours take part in the search.
    std::vector<unsigned int> bad;
    for (unsigned int e = 0; e < n_elements; ++e)
      if (manifold_mesh.is_whole(e) || has_support(manifold_mesh, e, threshold))
        element_to_root[e] = e;
      else
        bad.push_back(e);
    result.element_to_parent = element_to_root;

    // The first layer are the elements with good neighbours.
    const MeshGraph           graph(manifold_mesh);
    std::vector<unsigned int> layer, parents;
    for (const unsigned int e : bad)
    {
      parents.clear();
      graph.for_each_neighbor(e, [&](const unsigned int neighbor) {
        if (element_to_root[neighbor] == neighbor)
          parents.push_back(neighbor);
      });
      if (parents.empty())
        continue;
      std::sort(parents.begin(), parents.end());
      choose_root(graph,
                  e,
                  ArrayView<const unsigned int>(parents.data(), parents.size()),
                  result);
      layer.push_back(e);
    }
    layer = spread_roots(graph, std::move(layer), max_layers - 1, result);

    if (manifold_mesh.exchange() != nullptr)
    {
      root_the_rest_on_ranks(manifold_mesh, bad, result);
      return result;
    }
    spread_roots(graph,
                 std::move(layer),
                 max_sliver_layers - max_layers,
                 result,
                 [&](const unsigned int e) {
                   return manifold_mesh.area(e) <=
                          sliver_share *
                            manifold_mesh.mathematical_mesh().cell_area(
                              manifold_mesh.cell(e));
                 });
    std::vector<std::pair<double, unsigned int>> left;
    for (const unsigned int e : bad)
      if (element_to_root[e] == invalid_index)
        left.emplace_back(element_support(manifold_mesh, e), e);
    root_the_rest(graph, std::move(left), result);
    return result;
  }
} // namespace NMM
