#ifndef nmm_quadrature_joint_values_h
#define nmm_quadrature_joint_values_h

#include <nmm/quadrature/edge_values.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <array>
#include <vector>

namespace NMM
{
  /**
   * The sparsity pattern of a weak form with integrals over this rank's elements, and over
   * @p pieces if these have jumps or averages, for @p n_components unknowns per cover; like
   * dealii::DoFTools::make_flux_sparsity_pattern(). Rows of constrained unknowns have a
   * diagonal entry only.
   */
  dealii::DynamicSparsityPattern
  make_sparsity_pattern(const CoverSystem                       &covers,
                        unsigned int                             n_components,
                        const dealii::AffineConstraints<double> &constraints,
                        const std::vector<EdgePiece>            &pieces = {});


  /**
   * Shape functions on both sides of a piece of a joint or interface, for integrals of jumps and
   * averages; like dealii::FEInterfaceValues, whose words it has. Side 0 is the element of
   * the piece, side 1 its neighbor:
   * @f[ [\![\phi]\!] = \phi_0-\phi_1,\qquad \{\phi\}=\tfrac12(\phi_0+\phi_1), @f]
   * and the normal points from side 0 to side 1. Indices i are those of interface unknowns: the
   * unknowns of both elements, each once. Near the tip of a crack some covers belong to both
   * sides; their functions do not jump there, and their gradients do only if the crack runs along
   * an edge of the mesh.
   *
   * A resistance R against the flux through joints, k du/dn = -(u_0 - u_1) / R:
   * @code
   * JointValues joint(covers, 4, fe, update_values | update_JxW_values);
   * for (const EdgePiece &piece : joint_pieces(covers))
   *   {
   *     joint.reinit(piece);
   *     FullMatrix<double> joint_matrix(joint.n_current_interface_dofs());
   *     for (const unsigned int q : joint.quadrature_point_indices())
   *       for (const unsigned int i : joint.dof_indices())
   *         for (const unsigned int j : joint.dof_indices())
   *           joint_matrix(i, j) += joint.jump_in_shape_values(i, q) *
   *                                 joint.jump_in_shape_values(j, q) / R * joint.JxW(q);
   *     constraints.distribute_local_to_global(
   *       joint_matrix, joint.get_interface_dof_indices(), system_matrix);
   *   }
   * @endcode
   */
  class JointValues
  {
  public:
    template <typename SideView>
    class View;

    /// Values of @p fe at the points of make_edge_rule() for polynomials of degree @p degree.
    /// @throws InputError if the finite element does not fit, see ShapeValues.
    JointValues(const CoverSystem              &covers,
                unsigned int                    degree,
                const dealii::FiniteElement<2> &fe,
                dealii::UpdateFlags             flags);

    /// Go to @p piece, which must have a neighbor.
    void
    reinit(const EdgePiece &piece);

    /// Values of one side: 0 for the element of the piece, 1 for its neighbor. The normals of both
    /// are those of side 0.
    const EdgeValues &
    side(const unsigned int s) const
    {
      AssertIndexRange(s, 2);
      return sides[s];
    }

    /// Number of points.
    unsigned int
    n_quadrature_points() const
    {
      return sides[0].n_quadrature_points();
    }

    /// 0, ..., n_quadrature_points() - 1.
    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    quadrature_point_indices() const
    {
      return sides[0].quadrature_point_indices();
    }

    /// Weight of a point [m].
    double
    JxW(const unsigned int q) const
    {
      return sides[0].JxW(q);
    }

    /// Position of a point [m].
    const dealii::Point<2> &
    quadrature_point(const unsigned int q) const
    {
      return sides[0].quadrature_point(q);
    }

    /// Unit normal from side 0 to side 1 [-].
    const dealii::Tensor<1, 2> &
    normal(const unsigned int q) const
    {
      return sides[0].normal(q);
    }

    /// Number of unknowns of both sides together.
    unsigned int
    n_current_interface_dofs() const
    {
      return global_indices.size();
    }

    /// 0, ..., n_current_interface_dofs() - 1.
    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    dof_indices() const
    {
      return {0U, n_current_interface_dofs()};
    }

    /// Global unknowns of both sides, each once.
    const std::vector<dealii::types::global_dof_index> &
    get_interface_dof_indices() const
    {
      return global_indices;
    }

    /// Jump of component @p component of an interface shape function [-].
    double
    jump_in_shape_values(unsigned int i,
                         unsigned int q,
                         unsigned int component = 0) const;

    /// Average of component @p component of an interface shape function [-].
    double
    average_of_shape_values(unsigned int i,
                            unsigned int q,
                            unsigned int component = 0) const;

    /// Average of the gradient of component @p component of an interface shape function [1/m].
    dealii::Tensor<1, 2>
    average_of_shape_gradients(unsigned int i,
                               unsigned int q,
                               unsigned int component = 0) const;

    /// Jumps and averages of the components that an extractor names.
    View<ShapeValues::ScalarView>
    operator[](const dealii::FEValuesExtractors::Scalar &scalar) const;

    /// Jumps and averages of the components that an extractor names, as a vector.
    View<ShapeValues::VectorView>
    operator[](const dealii::FEValuesExtractors::Vector &vector) const;

  private:
    std::array<EdgeValues, 2>                    sides;
    std::vector<dealii::types::global_dof_index> global_indices;
    /// For each interface unknown, its number on both sides; invalid_index where it is none.
    std::vector<std::array<unsigned int, 2>> interface_to_side;
  };


  /// Jumps and averages of the components of a view, for interface unknowns and for fields.
  template <typename SideView>
  class JointValues::View
  {
  public:
    /// The same components on both sides of @p joint, which must outlive this object.
    View(const JointValues &joint, const SideView &here, const SideView &there)
      : joint(&joint)
      , sides{{here, there}}
    {
    }

    /// Jump of shape function @p i [-].
    auto
    jump_in_values(const unsigned int i, const unsigned int q) const
    {
      return combine(i,
                     1.,
                     -1.,
                     [q](const SideView &side, const unsigned int k) {
                       return side.value(k, q);
                     });
    }

    /// Average of shape function @p i [-].
    auto
    average_of_values(const unsigned int i, const unsigned int q) const
    {
      return combine(i,
                     0.5,
                     0.5,
                     [q](const SideView &side, const unsigned int k) {
                       return side.value(k, q);
                     });
    }

    /// Jump of the gradient of shape function @p i [1/m].
    auto
    jump_in_gradients(const unsigned int i, const unsigned int q) const
    {
      return combine(i,
                     1.,
                     -1.,
                     [q](const SideView &side, const unsigned int k) {
                       return side.gradient(k, q);
                     });
    }

    /// Average of the gradient of shape function @p i [1/m].
    auto
    average_of_gradients(const unsigned int i, const unsigned int q) const
    {
      return combine(i,
                     0.5,
                     0.5,
                     [q](const SideView &side, const unsigned int k) {
                       return side.gradient(k, q);
                     });
    }

    /// Jumps of the field with the unknowns @p solution at all points; sets the size of @p result.
    template <typename VectorType, typename Value>
    void
    get_jump_in_function_values(const VectorType   &solution,
                                std::vector<Value> &result) const
    {
      internal::sum_up(
        solution,
        joint->get_interface_dof_indices(),
        joint->n_quadrature_points(),
        [this](const unsigned int i, const unsigned int q) {
          return jump_in_values(i, q);
        },
        result);
    }

  private:
    /// @p of_here times a quantity on side 0 plus @p of_there times that on side 1.
    template <typename Quantity>
    auto
    combine(const unsigned int i,
            const double       of_here,
            const double       of_there,
            const Quantity    &quantity) const
    {
      const std::array<unsigned int, 2> &k = joint->interface_to_side[i];
      decltype(quantity(sides[0], 0U))   result{};
      if (k[0] != invalid_index)
        result += of_here * quantity(sides[0], k[0]);
      if (k[1] != invalid_index)
        result += of_there * quantity(sides[1], k[1]);
      return result;
    }

    const JointValues      *joint;
    std::array<SideView, 2> sides;
  };


  inline JointValues::View<ShapeValues::ScalarView>
  JointValues::operator[](
    const dealii::FEValuesExtractors::Scalar &scalar) const
  {
    return {*this, sides[0][scalar], sides[1][scalar]};
  }


  inline JointValues::View<ShapeValues::VectorView>
  JointValues::operator[](
    const dealii::FEValuesExtractors::Vector &vector) const
  {
    return {*this, sides[0][vector], sides[1][vector]};
  }


  inline double
  JointValues::jump_in_shape_values(const unsigned int i,
                                    const unsigned int q,
                                    const unsigned int component) const
  {
    return (*this)[dealii::FEValuesExtractors::Scalar(component)]
      .jump_in_values(i, q);
  }


  inline double
  JointValues::average_of_shape_values(const unsigned int i,
                                       const unsigned int q,
                                       const unsigned int component) const
  {
    return (*this)[dealii::FEValuesExtractors::Scalar(component)]
      .average_of_values(i, q);
  }


  inline dealii::Tensor<1, 2>
  JointValues::average_of_shape_gradients(const unsigned int i,
                                          const unsigned int q,
                                          const unsigned int component) const
  {
    return (*this)[dealii::FEValuesExtractors::Scalar(component)]
      .average_of_gradients(i, q);
  }
} // namespace NMM

#endif
