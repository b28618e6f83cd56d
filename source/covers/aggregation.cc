#include <nmm/base/compat.h>
#include <nmm/base/exceptions.h>
#include <nmm/covers/aggregation.h>

#include "element_order.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace NMM
{
  using namespace dealii;

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
    const ManifoldMesh &manifold_mesh = covers.manifold_mesh();
    const unsigned int  n_elements    = manifold_mesh.n_elements();

    Aggregation result;
    result.element_to_root =
      find_roots(manifold_mesh, threshold).element_to_root;

    // Covers that roots use.
    std::vector<unsigned char> is_used(covers.n_covers(), 0);
    for (unsigned int e = 0; e < n_elements; ++e)
      if (result.element_to_root[e] == e)
        for (const unsigned int k : covers.covers(e))
          is_used[k] = 1;
    result.is_free.assign(is_used.begin(), is_used.end());

    // The root of a cover's largest element; of equal elements, the one whose root is nearer.
    struct Candidate
    {
      unsigned int cover, root;
      double       area, distance;
    };
    // Ties are decided by position. As in ElementPlace they are taken to a millionth, since
    // coordinates far from the origin are rounded to some 1e-9 of a cell.
    const auto is_better = [&](const Candidate &a, const Candidate &b) {
      constexpr double more = 1. + 1e-6;
      if (a.area > more * b.area || b.area > more * a.area)
        return a.area > b.area;
      if (a.distance > more * b.distance || b.distance > more * a.distance)
        return a.distance < b.distance;
      return internal::comes_first(manifold_mesh, a.root, b.root);
    };
    std::vector<Candidate>    best;
    std::vector<unsigned int> cover_to_best(covers.n_covers(), invalid_index);
    for (unsigned int e = 0; e < n_elements; ++e)
      if (result.element_to_root[e] != e)
      {
        const unsigned int root = result.element_to_root[e];
        const double       area = manifold_mesh.area(e);
        const Point<2> middle   = internal::cell_centroid(manifold_mesh, root);
        for (const unsigned int k : covers.covers(e))
          if (!result.is_free[k])
          {
            const Candidate candidate = {k,
                                         root,
                                         area,
                                         covers.node(k).distance(middle)};
            unsigned int   &index     = cover_to_best[k];
            if (index == invalid_index)
            {
              index = best.size();
              best.push_back(candidate);
            }
            else if (is_better(candidate, best[index]))
              best[index] = candidate;
          }
      }
    result.cover_to_root.reserve(best.size());
    for (unsigned int k = 0; k < cover_to_best.size(); ++k)
      if (cover_to_best[k] != invalid_index)
        result.cover_to_root.emplace_back(k, best[cover_to_best[k]].root);

    // Values of other ranks that this rank needs.
    std::vector<types::global_dof_index> relevant;
    for (const auto &[k, root] : result.cover_to_root)
      if (covers.locally_relevant_covers().is_element(k))
        for (const unsigned int r : covers.covers(root))
          if (!covers.locally_relevant_covers().is_element(r))
            relevant.push_back(r);
    covers.make_relevant(std::move(relevant));
    return result;
  }


  namespace
  {
    /// Weight functions at a point given in reference coordinates, which may be outside of the
    /// cell.
    void
    evaluate_weights(const unsigned int   degree,
                     const Point<2>      &xi,
                     std::vector<double> &weights)
    {
      const std::array<double, 3> l = {{1. - xi[0] - xi[1], xi[0], xi[1]}};
      for (unsigned int i = 0; i < 3; ++i)
      {
        weights[i] = degree == 1 ? l[i] : l[i] * (2. * l[i] - 1.);
        if (degree == 2)
          weights[3 + i] = 4. * l[i] * l[(i + 1) % 3];
      }
    }
  } // namespace


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
      evaluate_weights(mesh.degree(), xi, weights);
      for (unsigned int c = 0; c < n_components; ++c)
      {
        entries.clear();
        // Nodes of regular meshes often are nodes of the root's cell lattice, so that many weights
        // vanish.
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
