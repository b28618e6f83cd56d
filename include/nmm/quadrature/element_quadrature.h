#ifndef nmm_quadrature_element_quadrature_h
#define nmm_quadrature_element_quadrature_h

#include <nmm/covers/manifold_mesh.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/non_matching/immersed_surface_quadrature.h>

#include <array>
#include <utility>
#include <vector>

/**
 * @file
 * The room `quadrature`: rules on manifold elements and on the pieces of their boundaries.
 *
 * What comes in: the edges of a manifold element, which ManifoldMesh::edges() gives, and the
 * affine map of its cell. What goes out: points inside the element, positive weights, and unit
 * normals on edges.
 *
 * Order of calls: make a QuadratureCollection of a ManifoldMesh once, and ask it for the rule of
 * each element in assembly. Single elements and edges have make_element_rule() and
 * make_edge_rule(), which need no mesh; ElementRuleBuilder is the algorithm behind the former.
 * Who assembles a weak form needs none of them: ElementValues, EdgeValues and JointValues give
 * shape functions and weights in elements, on pieces of boundaries and on both sides of joints.
 *
 * @code
 *   const MathematicalMesh    &cells = mesh.mathematical_mesh();
 *   const QuadratureCollection rules(mesh, 4, 4, {0, mesh.n_elements()});
 *   for (unsigned int element = 0; element < mesh.n_elements(); ++element)
 *     {
 *       const ElementRule rule        = rules.rule(element);
 *       const double      determinant = 2. * cells.cell_area(mesh.cell(element));
 *       for (unsigned int q = 0; q < rule.size(); ++q)
 *         integral += f(rule.point(q)) * rule.weight(q) * determinant;
 *     }
 * @endcode
 */
namespace NMM
{
  /**
   * The affine map x = origin + J xi of a triangular cell. Quadrature needs no more of
   * the cell, so that rules can be made without a triangulation.
   */
  struct CellFrame
  {
    /// Image of the reference vertex (0, 0) [m].
    dealii::Point<2> origin;
    /// J = dx/dxi [m].
    dealii::Tensor<2, 2> jacobian;
  };

  /// The frame of the cell of a manifold element.
  CellFrame
  cell_frame(const ManifoldMesh &mesh, unsigned int element);

  /// A quadrature rule on one edge of a manifold element. All arrays have an entry per point.
  struct EdgeRule
  {
    /// Points in reference coordinates of the cell [-].
    std::vector<dealii::Point<2>> points;
    /// Unit normals in *real* space that point out of the element [-].
    std::vector<dealii::Tensor<1, 2>> normals;
    /// Weights, which sum to the length of the edge in real space [m].
    std::vector<double> weights;
  };

  /**
   * A Gauss rule on the edge @p edge of a manifold element, for integrals of a traction times a
   * weight function. On a straight edge it is exact for polynomials of degree @p degree; on an
   * arc it has enough extra points to be exact to round-off for that degree. An edge without
   * length gets a rule without points.
   */
  EdgeRule
  make_edge_rule(const ElementEdge &edge,
                 const CellFrame   &frame,
                 unsigned int       degree);

  /// The rule of make_edge_rule() as deal.II's type, for use with its NonMatching tools. Normals
  /// and weights are those of reference space.
  dealii::NonMatching::ImmersedSurfaceQuadrature<2>
  make_surface_rule(const ElementEdge &edge,
                    const CellFrame   &frame,
                    unsigned int       degree);

  /**
   * A rule on the whole reference triangle that is exact for polynomials of degree @p degree. Of
   * deal.II's rules with positive weights and points inside it is the one with the fewest points:
   * 1, 3, 4, 6, 7, 12, 15, 16 points for degrees 1 to 8.
   * @throws InputError if degree > 14.
   */
  dealii::Quadrature<2>
  make_triangle_rule(unsigned int degree);

  /**
   * The rule of one element, see make_element_rule(), with points in reference-cell
   * coordinates [-] and weights [-]. It converts to a dealii::Quadrature<2>.
   * It refers either to points that its collection stores, or to a rule of the reference
   * triangle that is mapped to one or two triangles when a point is asked for.
   *
   * Lifetime: the collection must outlive this object.
   */
  class ElementRule
  {
  public:
    /// Number of points; 0 for an element whose area rounds to zero.
    unsigned int
    size() const
    {
      return n_triangles == 0 ? n_points : n_triangles * n_points;
    }

    /// Point @p q in reference coordinates of the cell [-].
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

    /// Weight of point @p q [-], > 0, to be multiplied by |det J| of the cell.
    double
    weight(const unsigned int q) const
    {
      AssertIndexRange(q, size());
      return n_triangles == 0 ? weights[q]
             : q < n_points
               ? triangles[0].twice_the_area * weights[q]
               : triangles[1].twice_the_area * weights[q - n_points];
    }

    /// A copy of all points in reference coordinates of the cell [-].
    std::vector<dealii::Point<2>>
    get_points() const;

    /// A copy of all weights [-].
    std::vector<double>
    get_weights() const;

    /// Copies points and weights into deal.II's type.
    operator dealii::Quadrature<2>() const;

    /// A triangle in the reference cell to which a rule of the reference triangle is mapped, by
    /// origin + xi_0 sides[0] + xi_1 sides[1].
    struct Triangle
    {
      /// First corner in reference coordinates of the cell [-].
      dealii::Point<2> origin;
      /// Vectors from the first corner to the second and the third one [-].
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
   * The rules of all elements of a manifold mesh, made on as many threads as deal.II may use
   * (dealii::MultithreadInfo). Elements that are whole cells share one rule of the reference
   * triangle. Cut elements that are well-shaped triangles or convex quadrilaterals share another
   * one, which is mapped to one or two triangles each; only the kind of division is stored for
   * them. All other cut elements have rules of their own.
   *
   * Lifetime: the mesh must outlive this object.
   */
  class QuadratureCollection
  {
  public:
    /**
     * Makes the rules of the elements in [elements.first, elements.second).
     * Rules are exact for polynomials of degree @p degree_whole on elements that are whole
     * cells, and of degree @p degree_cut on cut ones.
     * @throws InputError if a degree is larger than make_triangle_rule() or ElementRuleBuilder
     * allow.
     */
    QuadratureCollection(const ManifoldMesh                   &mesh,
                         unsigned int                          degree_whole,
                         unsigned int                          degree_cut,
                         std::pair<unsigned int, unsigned int> elements);

    /// The rule of @p element, which must be in the range given to the constructor.
    ElementRule
    rule(unsigned int element) const;

    /// Area of the element over the area of its cell, in [0, 1].
    double
    area_fraction(unsigned int element) const;

    /// Number of elements for which no positive rule of the degree asked for was found, see
    /// ElementRuleBuilder::last_was_fallback(). Their integrals are less accurate; 0 is expected.
    unsigned int
    n_fallbacks() const;

  private:
    /// Finds the elements with indices first_element + [begin, end) that are one or two
    /// well-shaped triangles.
    void
    divide(unsigned int degree, unsigned int begin, unsigned int end);

    /// Makes the rules of all other cut elements.
    void
    make_own_rules(unsigned int degree);

    const ManifoldMesh   *mesh;
    dealii::Quadrature<2> whole_rule, triangle_rule;
    /// For each element from first_element on: the index of its own rule, or the kind of its
    /// division into triangles, or invalid_index if it is a whole cell.
    std::vector<unsigned int> element_to_rule;
    /// Index of the first point of each own rule, and the number of all points at the end.
    std::vector<unsigned int>     first_point;
    std::vector<dealii::Point<2>> own_points;
    std::vector<double>           own_weights;
    unsigned int                  first_element = 0;
    unsigned int                  fallbacks     = 0;
  };
} // namespace NMM

#endif
