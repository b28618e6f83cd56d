#ifndef nmm_quadrature_element_quadrature_h
#define nmm_quadrature_element_quadrature_h

#include <nmm/covers/manifold_mesh.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/non_matching/immersed_surface_quadrature.h>

#include <utility>
#include <vector>

namespace NMM
{
  /**
   * A triangle's affine frame: x = origin + J xi. What the quadrature needs to
   * know of the cell, so that rules can be made without a triangulation.
   */
  struct CellFrame
  {
    dealii::Point<2>     origin;
    dealii::Tensor<2, 2> jacobian;
  };

  /**
   * A quadrature rule on one manifold element E of the cell with @p frame.
   * @f[ \int_E q\,dA = |\det J| \sum_k w_k\,q(x_k) \quad\forall q\in P_m @f]
   * with all w_k > 0, all x_k in E and at most dim P_m = (m+1)(m+2)/2 points.
   * Points are in reference-cell coordinates [-], weights sum to the area of E
   * over |det J| (twice the cell's area) [-], as deal.II's FEValues expects.
   * An element whose area rounds to zero gets a rule with no points.
   */
  dealii::Quadrature<2>
  make_element_rule(dealii::ArrayView<const ElementEdge> edges,
                    const CellFrame                     &frame,
                    unsigned int                         degree);

  /**
   * Gauss rule on one boundary piece; @p degree as above for the product of
   * traction and weight function, on straight edges; arcs get enough extra
   * points to be exact to round-off for that degree. Normals are unit vectors in *real* space pointing
   * out of the element; weights are lengths [m] in real space; points in reference coordinates [-].
   */
  struct EdgeRule
  {
    std::vector<dealii::Point<2>>     points;
    std::vector<dealii::Tensor<1, 2>> normals;
    std::vector<double>               weights;
  };

  EdgeRule
  make_edge_rule(const ElementEdge &edge,
                 const CellFrame   &frame,
                 unsigned int       degree);

  /// The same as deal.II's type, normals and weights in reference space, for
  /// use with NonMatching tools.
  dealii::NonMatching::ImmersedSurfaceQuadrature<2>
  make_surface_rule(const ElementEdge &edge,
                    const CellFrame   &frame,
                    unsigned int       degree);

  /**
   * deal.II's rule of fewest points on the whole reference triangle that is
   * exact for P_degree and has positive weights and points inside: 1, 3, 4, 6,
   * 7, 12, 15, 16 points for degrees 1 to 8.
   * @throws InputError if degree > 14.
   */
  dealii::Quadrature<2>
  make_triangle_rule(unsigned int degree);

  /**
   * The rules of a manifold mesh: one shared ordinary rule for whole elements,
   * one each for cut elements, built once, on as many threads as deal.II may use
   * (dealii::MultithreadInfo).
   */
  class QuadratureCollection
  {
  public:
    /**
     * @p degree_whole for whole triangles, @p degree_cut for cut ones (both
     * polynomial degrees to be integrated exactly). Only elements in
     * [first, last) are made.
     */
    QuadratureCollection(const ManifoldMesh                   &mesh,
                         unsigned int                          degree_whole,
                         unsigned int                          degree_cut,
                         std::pair<unsigned int, unsigned int> elements);

    const dealii::Quadrature<2> &
    rule(unsigned int element) const;

    /// Area of the element over the area of its cell, in [0, 1].
    double
    area_fraction(unsigned int element) const;

    /// Elements whose rule has more points than dim P_m or a lower degree than asked for
    /// because no positive rule was found: a fallback that costs accuracy. 0 expected.
    unsigned int
    n_fallbacks() const;

  private:
    /// Those of elements [first_element + begin, first_element + end); returns the
    /// number of fallbacks.
    unsigned int
    make_cut_rules(const ManifoldMesh &mesh,
                   unsigned int        degree,
                   unsigned int        begin,
                   unsigned int        end);

    dealii::Quadrature<2>              whole_rule;
    std::vector<unsigned int>          element_to_rule;
    std::vector<dealii::Quadrature<2>> cut_rules;
    std::vector<double>                area_fractions;
    unsigned int                       first_element = 0;
    unsigned int                       fallbacks     = 0;
  };
} // namespace NMM

#endif
