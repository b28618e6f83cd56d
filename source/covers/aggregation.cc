#include <nmm/base/compat.h>
#include <nmm/base/exceptions.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/element_support.h>

#include <algorithm>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    Point<2>
    centroid(const MathematicalMesh &mesh, const unsigned int cell)
    {
      Point<2> sum;
      for (const unsigned int v : mesh.cell_vertices(cell))
        sum += mesh.vertices()[v];
      return Point<2>(sum / 3.);
    }


    /// Polynomials are continued over so many layers of elements at most: their
    /// values grow with the square of the distance, and energies with its
    /// fourth power.
    constexpr unsigned int max_layers = 3;


    /// Gives elements that are joined to a rooted one a root, layer by layer;
    /// among the roots of the previous layer the nearest.
    void
    spread_roots(const ManifoldMesh       &manifold_mesh,
                 std::vector<unsigned int> layer,
                 ElementRoots             &roots)
    {
      std::vector<unsigned int> &element_to_root = roots.element_to_root;
      const MathematicalMesh    &mesh = manifold_mesh.mathematical_mesh();
      for (unsigned int i = 0; i < max_layers && !layer.empty(); ++i)
      {
        // (element, parent)
        std::vector<std::pair<unsigned int, unsigned int>> found;
        for (const unsigned int e : layer)
          for (const ManifoldMesh::Link &link : manifold_mesh.joined(e))
            if (element_to_root[link.neighbor] == invalid_index)
              found.emplace_back(link.neighbor, e);
        std::sort(found.begin(), found.end());

        layer.clear();
        for (std::size_t i = 0; i < found.size();)
        {
          const unsigned int e    = found[i].first;
          const Point<2>     here = centroid(mesh, manifold_mesh.cell(e));
          double             best = 1e300;
          for (; i < found.size() && found[i].first == e; ++i)
          {
            const unsigned int root = element_to_root[found[i].second];
            const double       d =
              here.distance(centroid(mesh, manifold_mesh.cell(root)));
            // candidates are sorted: ties go to the lower number
            if (d < best * (1. - 1e-10))
            {
              best                       = d;
              element_to_root[e]         = root;
              roots.element_to_parent[e] = found[i].second;
            }
          }
          layer.push_back(e);
        }
      }
    }
  } // namespace


  ElementRoots
  find_roots(const ManifoldMesh &manifold_mesh, const double threshold)
  {
    const unsigned int n_elements = manifold_mesh.n_elements();
    ElementRoots       result;
    result.element_to_root.assign(n_elements, invalid_index);
    std::vector<unsigned int> &element_to_root = result.element_to_root;

    // only bad elements and their good neighbours take part in the search
    std::vector<std::pair<double, unsigned int>> bad;
    for (unsigned int e = 0; e < n_elements; ++e)
    {
      const double support =
        manifold_mesh.is_whole(e)
          ? 1.
          : element_support_below(manifold_mesh, e, threshold);
      if (support >= threshold)
        element_to_root[e] = e;
      else
        bad.emplace_back(-support, e);
    }
    result.element_to_parent = element_to_root;
    std::vector<unsigned int> first_layer;
    for (const auto &[support, e] : bad)
      for (const ManifoldMesh::Link &link : manifold_mesh.joined(e))
        if (element_to_root[link.neighbor] == link.neighbor)
          first_layer.push_back(link.neighbor);
    spread_roots(manifold_mesh, first_layer, result);

    // what is left is far from any good element: the best of it first
    std::sort(bad.begin(), bad.end());
    for (const auto &[support, e] : bad)
      if (element_to_root[e] == invalid_index)
      {
        element_to_root[e] = result.element_to_parent[e] = e;
        spread_roots(manifold_mesh, {e}, result);
      }
    return result;
  }


  GhostPenalty
  make_ghost_penalty(const ManifoldMesh &mesh, const double threshold)
  {
    ElementRoots roots = find_roots(mesh, threshold);
    GhostPenalty result;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
    {
      const unsigned int parent = roots.element_to_parent[e];
      if (parent != e)
        result.pairs.emplace_back(std::min(e, parent), std::max(e, parent));
    }
    std::sort(result.pairs.begin(), result.pairs.end());
    result.element_to_root = std::move(roots.element_to_root);
    return result;
  }


  Aggregation
  aggregate(CoverSystem &covers, const double threshold)
  {
    const ManifoldMesh     &manifold_mesh = covers.manifold_mesh();
    const MathematicalMesh &mesh          = manifold_mesh.mathematical_mesh();
    const unsigned int      n_elements    = manifold_mesh.n_elements();

    Aggregation result;
    result.element_to_root =
      find_roots(manifold_mesh, threshold).element_to_root;

    // covers
    result.is_free.assign(covers.n_covers(), false);
    for (unsigned int e = 0; e < n_elements; ++e)
      if (result.element_to_root[e] == e)
        for (const unsigned int k : covers.covers(e))
          result.is_free[k] = true;

    // the root of a cover's largest element, or of the one whose root is nearer
    struct Candidate
    {
      unsigned int cover, root;
      double       area, distance;
    };
    std::vector<Candidate> candidates;
    for (unsigned int e = 0; e < n_elements; ++e)
      if (result.element_to_root[e] != e)
      {
        const unsigned int root   = result.element_to_root[e];
        const double       area   = manifold_mesh.area(e);
        const Point<2>     middle = centroid(mesh, manifold_mesh.cell(root));
        for (const unsigned int k : covers.covers(e))
          if (!result.is_free[k])
            candidates.push_back(
              {k, root, area, covers.node(k).distance(middle)});
      }
    // elements ascend within a cover: what is equal to rounding goes to the
    // lower number
    std::stable_sort(candidates.begin(),
                     candidates.end(),
                     [](const Candidate &a, const Candidate &b) {
                       return a.cover < b.cover;
                     });
    const auto is_better = [](const Candidate &a, const Candidate &b) {
      constexpr double more = 1. + 1e-10;
      if (a.area > more * b.area || b.area > more * a.area)
        return a.area > b.area;
      return more * a.distance < b.distance;
    };
    for (std::size_t i = 0; i < candidates.size();)
    {
      Candidate best = candidates[i];
      for (; i < candidates.size() && candidates[i].cover == best.cover; ++i)
        if (is_better(candidates[i], best))
          best = candidates[i];
      result.cover_to_root.emplace_back(best.cover, best.root);
    }

    // values this rank needs
    std::vector<types::global_dof_index> relevant;
    for (const auto &[k, root] : result.cover_to_root)
      if (covers.locally_relevant_covers().is_element(k))
        for (const unsigned int r : covers.covers(root))
          relevant.push_back(r);
    covers.make_relevant(std::move(relevant));
    return result;
  }


  AffineConstraints<double>
  make_constraints(const CoverSystem &covers,
                   const Aggregation &aggregation,
                   const unsigned int n_components)
  {
    const MathematicalMesh &mesh = covers.manifold_mesh().mathematical_mesh();
    auto                    constraints =
      Compat::make_affine_constraints(covers.locally_owned_dofs(n_components),
                                      covers.locally_relevant_dofs(
                                        n_components));
    std::vector<double> weights(mesh.n_covers_per_cell());
    std::vector<std::pair<types::global_dof_index, double>> entries;
    for (const auto &[k, root] : aggregation.cover_to_root)
    {
      if (!covers.locally_relevant_covers().is_element(k))
        continue;
      const Point<2> xi =
        mesh.real_to_reference(covers.manifold_mesh().cell(root),
                               covers.node(k));
      const auto root_covers = covers.covers(root);
      for (unsigned int j = 0; j < root_covers.size(); ++j)
        weights[j] = mesh.fe().shape_value(j, xi);
      for (unsigned int c = 0; c < n_components; ++c)
      {
        entries.clear();
        // nodes of regular meshes often lie on each other's lattice
        for (unsigned int j = 0; j < root_covers.size(); ++j)
          if (std::abs(weights[j]) > 1e-14)
            entries.emplace_back(n_components * root_covers[j] + c, weights[j]);
        const types::global_dof_index line = n_components * k + c;
        constraints.add_line(line);
        constraints.add_entries(line, entries);
      }
    }
    constraints.close();
    return constraints;
  }
} // namespace NMM
