#ifndef nmm_quadrature_element_rule_builder_h
#define nmm_quadrature_element_rule_builder_h

#include <nmm/quadrature/element_quadrature.h>

#include <memory>

namespace NMM
{
  /**
   * Makes the rules of many elements one after the other with the same scratch
   * memory; what make_element_rule() does for one. Not thread-safe: one
   * builder per thread.
   *
   * A well-shaped triangle takes the ordinary rule of triangles, a well-shaped convex
   * quadrilateral two of them: half a microsecond. For all else, in the order of the work:
   *
   * 1. *Frame.* Affine coordinates @f$s=A(x-c)\in[-1,1]^2@f$ along the longest
   *    distance in the element. A and c are doubles by definition and s is
   *    computed in double-double, so that a sliver of any aspect is a
   *    well-shaped piece with exact coordinates. The frame is attached to real space: the area
   *    of a sliver along the axes is known to its own last digits there, and not
   *    after a rounded map to the reference cell.
   * 2. *Moments* of @f$P_i(s_1)P_j(s_2)@f$, i + j <= m, by Green's theorem over
   *    straight edges and arcs.
   * 3. *Candidates*: slabs between the vertices, tensor Gauss rules in the
   *    trapezoids of every slab. The points are rounded to the reference coordinates of the
   *    result before anything is fitted to them: the rounding of points then
   *    costs nothing, while it would cost eps times aspect afterwards.
   * 4. *Reduction* to at most dim P_m points by Caratheodory's theorem; then
   *    the weights left are solved for once more.
   *
   * If the weights cannot be made positive or the moments do not come out to
   * round-off, steps 3 and 4 are repeated with more candidates (three times);
   * after that the positive rule nearest to the moments is returned and
   * last_was_fallback() is true.
   *
   * Cost: O(edges m^2 + candidates (dim P_m)^2): 5 to 20 microseconds for
   * m = 4 and three to six edges.
   * References: Shi, Manifold method of material analysis (1991), for what is
   * integrated; Tchakaloff, Bull. Sci. Math. 81 (1957) for the number of
   * points; Sommariva & Vianello, Numer. Algorithms 69 (2015), for Green
   * moments and compression of rules, who use non-negative least squares
   * where we exchange points.
   */
  class ElementRuleBuilder
  {
  public:
    /// @throws InputError if @p degree exceeds max_degree.
    explicit ElementRuleBuilder(unsigned int degree);
    ~ElementRuleBuilder();
    ElementRuleBuilder(ElementRuleBuilder &&) noexcept;

    /// Beyond this, Gauss rules of that many points are not worth having.
    static constexpr unsigned int max_degree = 20;

    /// The rule of make_element_rule().
    dealii::Quadrature<2>
    build(const dealii::ArrayView<const ElementEdge> &edges,
          const CellFrame                            &frame);

    /// The last rule misses a moment by more than 1e-13 of the monomial's integral
    /// of absolute value over the element's box.
    bool
    last_was_fallback() const;

    /// Sets of candidates the last rule took: 1 usually, 0 for no points.
    unsigned int
    n_attempts() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
