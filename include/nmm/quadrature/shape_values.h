#ifndef nmm_quadrature_shape_values_h
#define nmm_quadrature_shape_values_h

#include <nmm/covers/cover_system.h>

#include <deal.II/base/std_cxx20/iota_view.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_update_flags.h>
#include <deal.II/fe/fe_values_extractors.h>

#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Set value[q], for all q below @p n_points, to the sum over i of function(i, q) times the
    /// unknown dofs[i] of @p solution.
    template <typename VectorType, typename Value, typename Function>
    void
    sum_up(const VectorType                                   &solution,
           const std::vector<dealii::types::global_dof_index> &dofs,
           const unsigned int                                  n_points,
           const Function                                     &function,
           std::vector<Value>                                 &value)
    {
      value.assign(n_points, Value());
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const double u = solution(dofs[i]);
        for (unsigned int q = 0; q < n_points; ++q)
          value[q] += u * function(i, q);
      }
    }
  } // namespace internal


  /**
   * Shape functions of one manifold element at some points: what ElementValues, EdgeValues and
   * JointValues have in common. It is used like dealii::FEValuesBase, whose words it has.
   *
   * Shape function i belongs to component c = i % n and weight function k = i / n of the element,
   * where n is the number of components of the finite element: @f$\phi_i = w_k e_c@f$. This is
   * the order of the FESystem and of CoverSystem::get_dof_indices(). The finite element may be
   * any FESystem of equal elements, each of them the one of the mathematical mesh, also in
   * several groups: `FESystem<2>(fe, 2, fe, 1)` for a displacement and a pressure.
   *
   * Functions and unknowns are those of the physical covers, so both sides of a crack within a cell
   * have unknowns of their own. reinit() of the derived classes allocates no memory, except when
   * an element has more points than all before. What was not asked for by the update flags must not
   * be read.
   *
   * Lifetime: the cover system must outlive this object, and the finite element need not.
   */
  class ShapeValues
  {
  public:
    class ScalarView;
    class VectorView;

    ShapeValues(const ShapeValues &) = delete;
    ShapeValues &
    operator=(const ShapeValues &) = delete;

    /// The manifold element of the last reinit().
    unsigned int
    element() const
    {
      return current_element;
    }

    /// Number of points; 0 for an element whose area, or an edge whose length, rounds to zero.
    unsigned int
    n_quadrature_points() const
    {
      return weights.size();
    }

    /// Number of unknowns of an element.
    unsigned int
    dofs_per_element() const
    {
      return n_components * n_functions;
    }

    /// 0, ..., n_quadrature_points() - 1.
    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    quadrature_point_indices() const
    {
      return {0U, n_quadrature_points()};
    }

    /// 0, ..., dofs_per_element() - 1.
    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    dof_indices() const
    {
      return {0U, dofs_per_element()};
    }

    /// Global unknowns of the element's shape functions.
    const std::vector<dealii::types::global_dof_index> &
    get_dof_indices() const
    {
      return global_indices;
    }

    /// Weight of a point in real space [m^2 in an element, m on an edge].
    double
    JxW(const unsigned int q) const
    {
      check(dealii::update_JxW_values, q);
      return weights[q];
    }

    /// Position of a point in the reference configuration [m].
    const dealii::Point<2> &
    quadrature_point(const unsigned int q) const
    {
      check(dealii::update_quadrature_points, q);
      return points[q];
    }

    /// Value [-] of the only component of shape function @p i that is not zero.
    double
    shape_value(const unsigned int i, const unsigned int q) const
    {
      check(dealii::update_values, q);
      return table->values[q * n_functions + dof_to_function[i]];
    }

    /// Gradient [1/m] of the only component of shape function @p i that is not zero.
    const dealii::Tensor<1, 2> &
    shape_grad(const unsigned int i, const unsigned int q) const
    {
      check(dealii::update_gradients, q);
      return gradients[q * n_functions + dof_to_function[i]];
    }

    /// Value [-] of component @p c of shape function @p i.
    double
    shape_value_component(const unsigned int i,
                          const unsigned int q,
                          const unsigned int c) const
    {
      return c == dof_to_component[i] ? shape_value(i, q) : 0.;
    }

    /// Gradient [1/m] of component @p c of shape function @p i.
    dealii::Tensor<1, 2>
    shape_grad_component(const unsigned int i,
                         const unsigned int q,
                         const unsigned int c) const
    {
      return c == dof_to_component[i] ? shape_grad(i, q)
                                      : dealii::Tensor<1, 2>();
    }

    /// The component that an extractor names.
    ScalarView
    operator[](const dealii::FEValuesExtractors::Scalar &scalar) const;

    /// The two components that an extractor names, as a vector.
    VectorView
    operator[](const dealii::FEValuesExtractors::Vector &vector) const;

  protected:
    /// Weight functions and their derivatives at points in reference coordinates of a cell.
    struct Table
    {
      std::vector<dealii::Point<2>>      points;
      std::vector<double>                values;
      std::vector<std::array<double, 2>> gradients;
    };

    /// @throws InputError if the finite element is not one that the class comment describes, or
    /// if there are flags other than values, gradients, quadrature points, JxW values and normal
    /// vectors.
    ShapeValues(const CoverSystem              &covers,
                const dealii::FiniteElement<2> &fe,
                dealii::UpdateFlags             flags);

    /// Compute values and gradients of a table for its points, as far as they are asked for.
    void
    tabulate(Table &new_table) const;

    /// Set element and unknowns, and map @p new_table, which must stay, to the element's cell.
    /// The derived class sets the weights.
    void
    reinit(unsigned int element, const Table &new_table);

    /// Assert that a quantity was asked for and that there is a point @p q.
    void
    check([[maybe_unused]] const dealii::UpdateFlags flag,
          [[maybe_unused]] const unsigned int        q) const
    {
      Assert((flags & flag) == flag,
             dealii::ExcMessage("Add the update flag of what is read to those "
                                "of the constructor."));
      AssertIndexRange(q, n_quadrature_points());
    }

    const CoverSystem        *covers;
    const dealii::UpdateFlags flags;
    /// Weights in real space, and the table of the last element if it is not shared.
    std::vector<double> weights;
    Table               own_table;

  private:
    unsigned int n_components, n_functions, degree, current_element;
    std::vector<unsigned int>         dof_to_function, dof_to_component;
    const Table                      *table = nullptr;
    std::vector<dealii::Point<2>>     points;
    std::vector<dealii::Tensor<1, 2>> gradients;
    std::vector<dealii::types::global_dof_index> global_indices;
  };


  namespace internal
  {
    /// What views of shape functions have in common: the values and gradients of fields, by value()
    /// and gradient() of the derived class.
    template <typename View, typename Value, typename Gradient>
    class FieldView
    {
    public:
      /// Values of the field with the unknowns @p solution at all points; sets the size of @p result.
      template <typename VectorType>
      void
      get_function_values(const VectorType   &solution,
                          std::vector<Value> &result) const
      {
        sum_up(
          solution,
          values->get_dof_indices(),
          values->n_quadrature_points(),
          [this](const unsigned int i, const unsigned int q) {
            return static_cast<const View *>(this)->value(i, q);
          },
          result);
      }

      /// Gradients of that field [1/m].
      template <typename VectorType>
      void
      get_function_gradients(const VectorType      &solution,
                             std::vector<Gradient> &result) const
      {
        sum_up(
          solution,
          values->get_dof_indices(),
          values->n_quadrature_points(),
          [this](const unsigned int i, const unsigned int q) {
            return static_cast<const View *>(this)->gradient(i, q);
          },
          result);
      }

    protected:
      explicit FieldView(const ShapeValues &values)
        : values(&values)
      {
      }

      const ShapeValues *values;
    };
  } // namespace internal


  /// One component of shape functions and fields.
  class ShapeValues::ScalarView
    : public internal::
        FieldView<ShapeValues::ScalarView, double, dealii::Tensor<1, 2>>
  {
  public:
    /// Component @p component of @p values, which must outlive this object.
    ScalarView(const ShapeValues &values, const unsigned int component)
      : FieldView(values)
      , component(component)
    {
    }

    /// Value of shape function @p i [-].
    double
    value(const unsigned int i, const unsigned int q) const
    {
      return values->shape_value_component(i, q, component);
    }

    /// Gradient of shape function @p i [1/m].
    dealii::Tensor<1, 2>
    gradient(const unsigned int i, const unsigned int q) const
    {
      return values->shape_grad_component(i, q, component);
    }

  private:
    unsigned int component;
  };


  /// Two components of shape functions and fields, as a vector.
  class ShapeValues::VectorView
    : public internal::FieldView<ShapeValues::VectorView,
                                 dealii::Tensor<1, 2>,
                                 dealii::Tensor<2, 2>>
  {
  public:
    /// Components @p first and @p first + 1 of @p values, which must outlive this object.
    VectorView(const ShapeValues &values, const unsigned int first)
      : FieldView(values)
      , first(first)
    {
    }

    /// Value of shape function @p i [-].
    dealii::Tensor<1, 2>
    value(const unsigned int i, const unsigned int q) const
    {
      dealii::Tensor<1, 2> result;
      if (const unsigned int c = component(i); c < 2)
        result[c] = values->shape_value(i, q);
      return result;
    }

    /// Gradient of shape function @p i [1/m], entry [c][j] being that of component c to x_j.
    dealii::Tensor<2, 2>
    gradient(const unsigned int i, const unsigned int q) const
    {
      dealii::Tensor<2, 2> result;
      if (const unsigned int c = component(i); c < 2)
        result[c] = values->shape_grad(i, q);
      return result;
    }

    /// Symmetric part of the gradient of shape function @p i [1/m].
    dealii::SymmetricTensor<2, 2>
    symmetric_gradient(const unsigned int i, const unsigned int q) const
    {
      dealii::SymmetricTensor<2, 2> result;
      if (const unsigned int c = component(i); c < 2)
      {
        const dealii::Tensor<1, 2> &g = values->shape_grad(i, q);
        result[c][c]                  = g[c];
        result[0][1]                  = 0.5 * g[1 - c];
      }
      return result;
    }

    /// Divergence of shape function @p i [1/m].
    double
    divergence(const unsigned int i, const unsigned int q) const
    {
      const unsigned int c = component(i);
      return c < 2 ? values->shape_grad(i, q)[c] : 0.;
    }

  private:
    /// 0 or 1, or a larger number for shape functions of other components.
    unsigned int
    component(const unsigned int i) const
    {
      return values->dof_to_component[i] - first;
    }

    unsigned int first;
  };


  inline ShapeValues::ScalarView
  ShapeValues::operator[](
    const dealii::FEValuesExtractors::Scalar &scalar) const
  {
    AssertIndexRange(scalar.component, n_components);
    return {*this, scalar.component};
  }


  inline ShapeValues::VectorView
  ShapeValues::operator[](
    const dealii::FEValuesExtractors::Vector &vector) const
  {
    AssertIndexRange(vector.first_vector_component + 1, n_components);
    return {*this, vector.first_vector_component};
  }

} // namespace NMM

#endif
