#ifndef nmm_covers_aggregation_h
#define nmm_covers_aggregation_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <utility>
#include <vector>

namespace NMM
{
  /// Treatment of covers whose support within the solid is too small.
  enum class Stabilization
  {
    /// No treatment: the plain method of the paper.
    none,
    /// Constrain them to the polynomial of a well-supported element nearby, see Aggregation.
    aggregation,
    /// Penalize the difference between polynomials of neighbours, see GhostPenalty.
    ghost_penalty
  };


  /**
   * Least element_support() [-] of an element that can be a root. Measured on a disk at 200
   * positions relative to the mesh, with the thresholds 0.002, 0.005, 0.01, 0.02, 0.05, 0.1: the
   * largest condition number is 31, 9, 4.9, 2.7, 2.8, 3.0 times the uncut one, the largest L2
   * error 1.07, 1.09, 1.15, 1.15, 1.22, 1.33 times.
   */
  constexpr double default_aggregation_threshold = 0.02;

  /**
   * The *root* of each element: the element itself if its element_support() is at least the
   * threshold, else the nearest such element of the same connected set (breadth-first search over
   * ManifoldMesh::joined(), three layers of elements at most, ten for slivers). Where there is none,
   * as in long thin arms of a region, the element with the largest support becomes a root, and so
   * on, because a polynomial that is extended far is worse than one with little support. Ties up to
   * rounding are decided by position, so that the result does not depend on the numbering.
   */
  struct ElementRoots
  {
    /// Root of each element; itself for roots.
    std::vector<unsigned int> element_to_root;
    /// The neighbour through which an element found its root; itself for roots.
    std::vector<unsigned int> element_to_parent;
  };

  /// Find the roots of all elements; @p threshold: least element_support() of a root [-].
  ElementRoots
  find_roots(const ManifoldMesh &mesh, double threshold);


  /**
   * Cover aggregation (Badia, Verdugo & Martin, arXiv 1709.09122, for physical
   * covers instead of cells).
   *
   * A cover that no root element uses is constrained to the polynomial of one root, evaluated at
   * the cover's node. That root is the one of the cover's largest element, see find_roots():
   * @f[ u_k = \sum_j w_j^{root}(x_k)\,u_{root,j} @f]
   * On a sliver the displacement is thus the polynomial of its root, however small the sliver is.
   * Polynomials of the element's degree are reproduced exactly, no unknowns are coupled across a
   * joint, and the covers of roots are never constrained themselves.
   *
   * Order of calls: aggregate(), then make_constraints() for the unknowns of a system.
   */
  struct Aggregation
  {
    /// Root element of each element; itself for roots.
    std::vector<unsigned int> element_to_root;
    /// Constrained covers, ascending, each with its root element.
    std::vector<std::pair<unsigned int, unsigned int>> cover_to_root;
    /// For each cover, whether it is free, that is, not constrained.
    std::vector<bool> is_free;
  };

  /**
   * Find the roots and the constrained covers. The relevant covers of @p covers are extended by
   * those of the roots that this rank needs.
   */
  Aggregation
  aggregate(CoverSystem &covers,
            double       threshold = default_aggregation_threshold);

  /// The aggregation as closed constraints on the unknowns, @p n_components per cover.
  dealii::AffineConstraints<double>
  make_constraints(const CoverSystem &covers,
                   const Aggregation &aggregation,
                   unsigned int       n_components);


  /**
   * Ghost penalty (Burman 2010), the alternative to aggregation. All covers stay unknowns, and for
   * elements with too little support an energy is added to the system: that of the difference
   * between the polynomials of the element and its neighbour, both extended over both cells. This
   * is the "direct" form of Preuss 2018 and Lehrenfeld & Olshanskii, arXiv 1803.05817. It has the
   * strain energy instead of the L2 norm, so that no length has to be chosen and stretched cells
   * need no special treatment:
   * @f[ s(u,v) = \gamma \sum_{(E,F)} \int_{T_E\cup T_F}
   *     C\,\varepsilon(u_E-u_F):\varepsilon(v_E-v_F)\,dA @f]
   * Polynomials of the element's degree are reproduced exactly, because their extensions are
   * equal. E and F are joined, so no unknowns are coupled across a joint.
   */
  struct GhostPenalty
  {
    /// Pairs (E, F), E < F: every element that is not a root with its parent.
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    /// Root of each element, see find_roots().
    std::vector<unsigned int> element_to_root;
  };

  /// Find the pairs and the roots.
  GhostPenalty
  make_ghost_penalty(const ManifoldMesh &mesh,
                     double threshold = default_aggregation_threshold);
} // namespace NMM

#endif
