#ifndef nmm_quadrature_edge_values_h
#define nmm_quadrature_edge_values_h

#include <nmm/quadrature/element_quadrature.h>
#include <nmm/quadrature/shape_values.h>

#include <string>
#include <vector>

namespace NMM
{
  /// A part of a curve that is an edge of a manifold element.
  struct EdgePiece
  {
    /// The element, which lies to the left of the edge.
    unsigned int element;
    /// The edge, a straight line or an arc; its neighbor is the element on the other side.
    ElementEdge edge;
  };

  /**
   * The edges of this rank's elements that lie on a curve called @p name, in the order of the
   * elements. If it is the boundary of a domain, only elements of that domain count
   * (PhysicalMesh::is_face_of()); a joint has pieces on both of its faces.
   * @throws InputError if no curve has the name.
   */
  std::vector<EdgePiece>
  boundary_pieces(const CoverSystem &covers, const std::string &name);

  /**
   * The edges on curves called @p name, or on all joints if it is empty, that have two different
   * elements on their sides, each once: as the edge of the element with the lower number, if that
   * is one of this rank. At the tip of a crack both sides can be the same element, in which
   * nothing jumps; such an edge is no piece.
   * @throws InputError if no curve has the name.
   */
  std::vector<EdgePiece>
  joint_pieces(const CoverSystem &covers, const std::string &name = "");


  /**
   * Shape functions of an element on a piece of a curve at its boundary, for integrals over that
   * piece; like dealii::FEFaceValues, with straight edges and arcs of any part of a side.
   *
   * The load vector of a pressure p on a boundary:
   * @code
   * EdgeValues edge(covers, 4, fe, update_values | update_JxW_values | update_normal_vectors);
   * for (const EdgePiece &piece : boundary_pieces(covers, "bore"))
   *   {
   *     edge.reinit(piece);
   *     for (const unsigned int q : edge.quadrature_point_indices())
   *       for (const unsigned int i : edge.dof_indices())
   *         rhs(edge.get_dof_indices()[i]) -=
   *           p * edge.normal(q) * edge[displacement].value(i, q) * edge.JxW(q);
   *   }
   * @endcode
   */
  class EdgeValues : public ShapeValues
  {
  public:
    /// Values of @p fe at the points of make_edge_rule() for polynomials of degree @p degree.
    /// @throws InputError if the finite element does not fit, see ShapeValues.
    EdgeValues(const CoverSystem              &covers,
               unsigned int                    degree,
               const dealii::FiniteElement<2> &fe,
               dealii::UpdateFlags             flags);

    /// Go to @p piece.
    void
    reinit(const EdgePiece &piece);

    /// Go to the other side of a piece that has been taken by @p other: to the same points, in the
    /// element @p element, with the same weights and normals.
    void
    reinit_opposite(unsigned int element, const EdgeValues &other);

    /// Unit normal in the reference configuration that points out of the element of reinit() [-].
    const dealii::Tensor<1, 2> &
    normal(const unsigned int q) const
    {
      check(dealii::update_normal_vectors, q);
      return rule.normals[q];
    }

  private:
    unsigned int rule_degree;
    EdgeRule     rule;
  };
} // namespace NMM

#endif
