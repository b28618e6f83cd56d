#include <nmm/covers/aggregation.h>
#include <nmm/covers/element_support.h>

#include "element_order.h"
#include <algorithm>
#include <cmath>
#include <functional>

// Roots of elements with little support.
namespace NMM
{
  using namespace dealii;

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


    /// Set the root of an element: the nearest root of its @p parents, which are ascending.
    void
    choose_root(const ManifoldMesh                  &mesh,
                const unsigned int                   e,
                const ArrayView<const unsigned int> &parents,
                ElementRoots                        &roots)
    {
      std::vector<unsigned int> &element_to_root = roots.element_to_root;
      // Ties are decided as in ElementPlace: to a millionth of a cell, which is more than what
      // rounding leaves of coordinates far from the origin.
      const double tie =
        1e-6 * mesh.mathematical_mesh().cell_diameter(mesh.cell(e));
      const Point<2> here   = internal::cell_centroid(mesh, e);
      double         best   = 1e300;
      unsigned int   parent = invalid_index;
      for (const unsigned int candidate : parents)
      {
        if (candidate == parent)
          continue;
        const unsigned int root = element_to_root[candidate];
        const double d = here.distance(internal::cell_centroid(mesh, root));
        bool         is_better = d < best - tie;
        if (!is_better && d <= best + tie)
          is_better =
            root != element_to_root[parent]
              ? internal::comes_first(mesh, root, element_to_root[parent])
              : internal::comes_first(mesh, candidate, parent);
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
    std::vector<unsigned int>
    spread_roots(const ManifoldMesh                      &mesh,
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
          for (const ManifoldMesh::Link &link : mesh.joined(e))
            if (roots.element_to_root[link.neighbor] == invalid_index &&
                (!may_follow || may_follow(link.neighbor)))
              found.emplace_back(link.neighbor, e);
        std::sort(found.begin(), found.end());

        layer.clear();
        for (std::size_t i = 0; i < found.size();)
        {
          const unsigned int e = found[i].first;
          parents.clear();
          for (; i < found.size() && found[i].first == e; ++i)
            parents.push_back(found[i].second);
          choose_root(mesh,
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
    void
    root_the_rest(const ManifoldMesh                          &mesh,
                  std::vector<std::pair<double, unsigned int>> left,
                  ElementRoots                                &roots)
    {
      for (auto &[support, e] : left)
        support = std::round(1e9 * support);
      std::sort(left.begin(), left.end(), [&](const auto &a, const auto &b) {
        if (a.first != b.first)
          return a.first > b.first;
        if (internal::comes_first(mesh, a.second, b.second))
          return true;
        return !internal::comes_first(mesh, b.second, a.second) &&
               a.second < b.second;
      });
      for (const auto &[support, e] : left)
        if (roots.element_to_root[e] == invalid_index)
        {
          roots.element_to_root[e] = roots.element_to_parent[e] = e;
          spread_roots(mesh, {e}, max_layers, roots);
        }
    }
  } // namespace


  ElementRoots
  find_roots(const ManifoldMesh &mesh, const double threshold)
  {
    const unsigned int n_elements = mesh.n_elements();
    ElementRoots       result;
    result.element_to_root.assign(n_elements, invalid_index);
    std::vector<unsigned int> &element_to_root = result.element_to_root;

    // Only elements with little support and their good neighbours take part in the search.
    std::vector<unsigned int> bad;
    for (unsigned int e = 0; e < n_elements; ++e)
      if (mesh.is_whole(e) || has_support(mesh, e, threshold))
        element_to_root[e] = e;
      else
        bad.push_back(e);
    result.element_to_parent = element_to_root;

    // The first layer are the elements with good neighbours.
    std::vector<unsigned int> layer, parents;
    for (const unsigned int e : bad)
    {
      parents.clear();
      for (const ManifoldMesh::Link &link : mesh.joined(e))
        if (element_to_root[link.neighbor] == link.neighbor)
          parents.push_back(link.neighbor);
      if (parents.empty())
        continue;
      std::sort(parents.begin(), parents.end());
      choose_root(mesh,
                  e,
                  ArrayView<const unsigned int>(parents.data(), parents.size()),
                  result);
      layer.push_back(e);
    }
    layer = spread_roots(mesh, std::move(layer), max_layers - 1, result);

    spread_roots(mesh,
                 std::move(layer),
                 max_sliver_layers - max_layers,
                 result,
                 [&](const unsigned int e) {
                   return mesh.area(e) <=
                          sliver_share *
                            mesh.mathematical_mesh().cell_area(mesh.cell(e));
                 });
    std::vector<std::pair<double, unsigned int>> left;
    for (const unsigned int e : bad)
      if (element_to_root[e] == invalid_index)
        left.emplace_back(element_support(mesh, e), e);
    root_the_rest(mesh, std::move(left), result);
    return result;
  }
} // namespace NMM
