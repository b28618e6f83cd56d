#ifndef nmm_quadrature_element_rule_builder_h
#define nmm_quadrature_element_rule_builder_h

#include <nmm/quadrature/element_quadrature.h>

#include <memory>

namespace NMM
{
  /**
   * Makes the rules of many elements, one after the other, with the same scratch
   * memory; make_element_rule() does the same for one element. The class is not thread-safe: each
   * thread needs a builder of its own.
   *
   * A well-shaped triangle takes a mapped rule of the reference triangle, and a well-shaped convex
   * quadrilateral takes two of them, which costs half a microsecond. All other elements take the
   * following steps:
   *
   * 1. *Frame.* Affine coordinates @f$s=A(x-c)\in[-1,1]^2@f$, whose first axis runs along the
   *    longest distance in the element. A and c are doubles by definition, and s is
   *    computed in double-double arithmetic, so that a sliver of any aspect ratio becomes a
   *    well-shaped piece with exact coordinates. The frame is attached to real space, since the
   *    area of a sliver along the axes is known to its own last digits there, but not
   *    after a rounded map to the reference cell.
   * 2. *Moments.* The integrals of @f$P_i(s_1)P_j(s_2)@f$, i + j <= m, are computed by Green's
   *    theorem over straight edges and arcs.
   * 3. *Candidates.* The element is cut into slabs between its vertices, and the trapezoids of
   *    every slab get tensor products of Gauss rules. The points are rounded to the reference
   *    coordinates of the result before weights are fitted to them. The rounding of points then
   *    causes no error; afterwards it would cause one of eps times the aspect ratio.
   * 4. *Reduction.* Caratheodory's theorem reduces the rule to at most dim P_m points; then
   *    the weights that are left are solved for once more.
   *
   * If the weights cannot be made positive, or the moments are not met to
   * round-off, steps 3 and 4 are repeated with more candidates, up to three times.
   * After that the positive rule with the smallest error of the moments is returned, and
   * last_was_fallback() is true.
   *
   * Cost: O(edges m^2 + candidates (dim P_m)^2): 5 to 20 microseconds for
   * m = 4 and three to six edges.
   *
   * References: Shi, Manifold method of material analysis (1991), for the integrals;
   * Tchakaloff, Bull. Sci. Math. 81 (1957), for the number of
   * points; Sommariva & Vianello, Numer. Algorithms 69 (2015), for Green's
   * moments and the compression of rules. They use non-negative least squares
   * where this class exchanges points.
   */
  class ElementRuleBuilder
  {
  public:
    /// A builder of rules that are exact for polynomials of degree @p degree.
    /// @throws InputError if @p degree exceeds max_degree.
    explicit ElementRuleBuilder(unsigned int degree);
    ~ElementRuleBuilder();
    /// Moves the scratch memory; the moved-from builder can only be destroyed.
    ElementRuleBuilder(ElementRuleBuilder &&) noexcept;

    /// Largest degree that is supported.
    static constexpr unsigned int max_degree = 20;

    /// The rule of the element with the edges @p edges on the cell @p frame, as of
    /// make_element_rule(). @throws NumericalFailure if a coordinate is not finite.
    dealii::Quadrature<2>
    build(const dealii::ArrayView<const ElementEdge> &edges,
          const CellFrame                            &frame);

    /// Whether the last rule misses a moment by more than 1e-13 of the integral of the
    /// polynomial's absolute value over the box of the element.
    bool
    last_was_fallback() const;

    /// Number of sets of candidates that the last rule took: usually 1, and 0 for a rule without
    /// points.
    unsigned int
    n_attempts() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };


  /**
   * A quadrature rule on one manifold element E of the cell with @p frame.
   * @f[ \int_E q\,dA = |\det J| \sum_k w_k\,q(x_k) \quad\forall q\in P_m @f]
   * with m = @p degree, all w_k > 0, all x_k in E and at most dim P_m = (m+1)(m+2)/2 points.
   * Points are in reference-cell coordinates [-]. Weights sum to the area of E
   * over |det J| (twice the area of the cell) [-], as deal.II's FEValues expects.
   * An element whose area rounds to zero gets a rule without points.
   * @throws InputError if @p degree exceeds ElementRuleBuilder::max_degree.
   */
  dealii::Quadrature<2>
  make_element_rule(dealii::ArrayView<const ElementEdge> edges,
                    const CellFrame                     &frame,
                    unsigned int                         degree);
} // namespace NMM

#endif
