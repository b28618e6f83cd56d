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
    aggregation,
    /// Penalize the difference of neighbours' polynomials, see GhostPenalty.
    ghost_penalty
  };


  /**
   * Least element_support() [-] that makes an element *good*. Measured on a disk
   * at 200 places of the mesh, thresholds 0.002, 0.005, 0.01, 0.02, 0.05, 0.1:
   * largest condition number 31, 9, 4.9, 2.7, 2.8, 3.0 times the uncut one,
   * largest L2 error 1.07, 1.09, 1.15, 1.15, 1.22, 1.33 times.
   */
  constexpr double default_aggregation_threshold = 0.02;

  /**
   * The *root* of each element: itself if its element_support() is at least
   * @p threshold, else the nearest such element of the same connected set
   * (breadth-first search over ManifoldMesh::joined(), three layers of elements
   * at most, ten for slivers on a mesh that is not distributed). Where there is none, as in long thin arms of a region, the
   * element with the largest support becomes a root all the same, and so on: a
   * polynomial continued far is worse than one with little support. What is
   * equal to rounding is chosen by place, so that neither the numbering nor
   * the number of ranks counts.
   *
   * On a distributed mesh the numbers are those of this rank's elements, and
   * invalid_index stands for an element that it does not hold; those of owned elements and
   * three layers around them are known.
   */
  struct ElementRoots
  {
    std::vector<unsigned int> element_to_root;
    /// The neighbour through which an element found its root; itself for roots.
    std::vector<unsigned int> element_to_parent;
  };

  /// Collective on a distributed mesh.
  ElementRoots
  find_roots(const ManifoldMesh &mesh, double threshold);


  /**
   * Cover aggregation (Badia, Verdugo & Martin, arXiv 1709.09122, for physical
   * covers instead of cells).
   *
   * A cover that no root element uses is constrained to the polynomial of a
   * root, that of its largest element, see find_roots(), evaluated at the
   * cover's node:
   * @f[ u_k = \sum_j w_j^{root}(x_k)\,u_{root,j} @f]
   * So a sliver that vanishes leaves nothing behind: its polynomial is its
   * root's.
   * Polynomials of the element's degree are kept exactly, nothing couples
   * across a joint, and the covers of roots are never constrained themselves.
   */
  struct Aggregation
  {
    /// Root element of each element (itself if good).
    std::vector<unsigned int> element_to_root;
    /// Constrained covers, ascending, each with its root element. On a distributed mesh
    /// those of owned elements and of their neighbours.
    std::vector<std::pair<unsigned int, unsigned int>> cover_to_root;
    /// Is the cover free, i.e. not constrained?
    std::vector<bool> is_free;
  };

  /**
   * Find roots. Extends the relevant covers of @p covers by those of the roots
   * this rank needs. Collective.
   */
  Aggregation
  aggregate(CoverSystem &covers,
            double       threshold = default_aggregation_threshold);

  /// The aggregation as constraints on the unknowns, closed.
  dealii::AffineConstraints<double>
  make_constraints(const CoverSystem &covers,
                   const Aggregation &aggregation,
                   unsigned int       n_components);


  /**
   * Ghost penalty (Burman 2010), the alternative to aggregation: all covers stay
   * unknowns, and where an element has too little area, the energy of the
   * difference between its polynomial and its neighbour's, each continued over
   * both cells, is added to the system (the "direct" form of Preuss 2018 and
   * Lehrenfeld & Olshanskii, arXiv 1803.05817, with the strain energy instead of
   * the L2 norm, so that there is no length to choose and stretched cells are
   * no special case):
   * @f[ s(u,v) = \gamma \sum_{(E,F)} \int_{T_E\cup T_F}
   *     C\,\varepsilon(u_E-u_F):\varepsilon(v_E-v_F)\,dA @f]
   * Quadratics are kept exactly: their continuations are equal. E and F are
   * joined, so nothing couples across a joint.
   */
  struct GhostPenalty
  {
    /// Pairs (E, F), E < F: every element that is no root with its parent.
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    /// See find_roots().
    std::vector<unsigned int> element_to_root;
  };

  /// Pairs for all ranks; on a distributed mesh those of elements that this rank holds.
  /// Collective there.
  GhostPenalty
  make_ghost_penalty(const ManifoldMesh &mesh,
                     double threshold = default_aggregation_threshold);
} // namespace NMM

#endif
