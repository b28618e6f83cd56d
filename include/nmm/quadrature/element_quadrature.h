#ifndef nmm_quadrature_element_quadrature_h
#define nmm_quadrature_element_quadrature_h

#include <nmm/covers/manifold_mesh.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/non_matching/immersed_surface_quadrature.h>

#include <array>
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

  /// The frame of a cell of the mathematical mesh.
  CellFrame
  cell_frame(const MathematicalMesh &mesh, unsigned int cell);

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
   * The rule of one element, see make_element_rule(): points in reference-cell
   * coordinates [-] and weights [-] as of a dealii::Quadrature<2>, into which it converts.
   * Either points that its collection keeps, or those of an ordinary rule in one or two
   * triangles, made when they are asked for. The collection must outlive it.
   */
  class ElementRule
  {
  public:
    unsigned int
    size() const
    {
      return n_triangles == 0 ? n_points : n_triangles * n_points;
    }

    dealii::Point<2>
    point(const unsigned int q) const
    {
      AssertIndexRange(q, size());
      if (n_triangles == 0)
        return points[q];
      const Triangle         &triangle = triangles[q < n_points ? 0 : 1];
      const dealii::Point<2> &xi = points[q < n_points ? q : q - n_points];
      return triangle.origin + xi[0] * triangle.sides[0] +
             xi[1] * triangle.sides[1];
    }

    double
    weight(const unsigned int q) const
    {
      AssertIndexRange(q, size());
      return n_triangles == 0 ? weights[q]
             : q < n_points
               ? triangles[0].twice_the_area * weights[q]
               : triangles[1].twice_the_area * weights[q - n_points];
    }

    std::vector<dealii::Point<2>>
    get_points() const;

    std::vector<double>
    get_weights() const;

    operator dealii::Quadrature<2>() const;

    /// What the points of an ordinary rule are mapped to.
    struct Triangle
    {
      dealii::Point<2>                    origin;
      std::array<dealii::Tensor<1, 2>, 2> sides;
      /// Twice the area in coordinates of the reference cell [-].
      double twice_the_area;
    };

  private:
    friend class QuadratureCollection;

    unsigned int            n_triangles = 0, n_points = 0;
    const dealii::Point<2> *points  = nullptr;
    const double           *weights = nullptr;
    Triangle                triangles[2];
  };


  /**
   * The rules of a manifold mesh, made on as many threads as deal.II may use
   * (dealii::MultithreadInfo). Whole elements share an ordinary rule; well-shaped
   * triangles and quadrilaterals share another one, in one or two triangles each, of which
   * nothing is kept but which they are; all other cut elements have rules of their own.
   *
   * Lifetime: the mesh must outlive this object.
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

    ElementRule
    rule(unsigned int element) const;

    /// Area of the element over the area of its cell, in [0, 1].
    double
    area_fraction(unsigned int element) const;

    /// Elements whose rule has more points than dim P_m or a lower degree than asked for
    /// because no positive rule was found: a fallback that costs accuracy. 0 expected.
    unsigned int
    n_fallbacks() const;

  private:
    /// Finds which elements take the ordinary rule in triangles.
    void
    divide(unsigned int degree, unsigned int begin, unsigned int end);

    /// The rules of all others.
    void
    make_own_rules(unsigned int degree);

    const ManifoldMesh   *mesh;
    dealii::Quadrature<2> whole_rule, triangle_rule;
    /// For each element from first_element on, how it is divided, or the number of the
    /// rule, or invalid_index if it is whole.
    std::vector<unsigned int> element_to_rule;
    /// Points of rule i: from first_point[i] on.
    std::vector<unsigned int>     first_point;
    std::vector<dealii::Point<2>> own_points;
    std::vector<double>           own_weights;
    unsigned int                  first_element = 0;
    unsigned int                  fallbacks     = 0;
  };
} // namespace NMM

#endif
