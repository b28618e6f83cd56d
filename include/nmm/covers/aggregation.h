#ifndef nmm_covers_aggregation_h
#define nmm_covers_aggregation_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <utility>
#include <vector>

namespace NMM
{
  /// What is done about covers with too little support.
  enum class Stabilization
  {
    /// Nothing: the plain method of the paper.
    none,
    /// Express them through a well-supported neighbour by polynomial extension.
    aggregation
  };


  /**
   * Cover aggregation (Badia, Verdugo & Martin, arXiv 1709.09122, for physical
   * covers instead of cells).
   *
   * An element is *good* if its area is at least `threshold` times its cell's.
   * A cover that no good element uses is constrained to the polynomial of a
   * *root* element, the nearest good one of the same connected set of elements
   * (breadth-first search over ManifoldMesh::joined()), evaluated at the
   * cover's node:
   * @f[ u_k = \sum_j w_j^{root}(x_k)\,u_{root,j} @f]
   * Polynomials of the element's degree are kept exactly, nothing couples
   * across a joint, and the covers of roots are never constrained themselves. A
   * connected set without any good element takes its largest element as root.
   */
  struct Aggregation
  {
    /// Root element of each element (itself if good).
    std::vector<unsigned int> element_to_root;
    /// Constrained covers, ascending, each with its root element.
    std::vector<std::pair<unsigned int, unsigned int>> cover_to_root;
    /// Is the cover free, i.e. not constrained?
    std::vector<bool> is_free;
  };

  /// Least share of its cell's area [-] that makes an element good.
  constexpr double default_aggregation_threshold = 0.25;

  /**
   * Find roots. Extends the relevant covers of @p covers by those of the roots
   * this rank needs.
   */
  Aggregation
  aggregate(CoverSystem &covers,
            double       threshold = default_aggregation_threshold);

  /// The aggregation as constraints on the unknowns, closed.
  dealii::AffineConstraints<double>
  make_constraints(const CoverSystem &covers,
                   const Aggregation &aggregation,
                   unsigned int       n_components);
} // namespace NMM

#endif
