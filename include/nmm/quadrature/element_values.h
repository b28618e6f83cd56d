#ifndef nmm_quadrature_element_values_h
#define nmm_quadrature_element_values_h

#include <nmm/quadrature/element_quadrature.h>
#include <nmm/quadrature/shape_values.h>

namespace NMM
{
  /**
   * Shape functions in manifold elements, for integrals over the solid,
   * @f[ \int_E f\,dA \approx \sum_q f(x_q)\,\mathrm{JxW}_q , @f]
   * exact for polynomials of the degree of the element's rule. Whole elements share the table of
   * the reference cell, so that only gradients are mapped; cut elements evaluate the polynomials
   * at their points.
   *
   * The weak form of the Laplace equation:
   * @code
   * ElementValues values(covers, quadrature, fe, update_gradients | update_JxW_values);
   * for (unsigned int element = 0; element < mesh.n_elements(); ++element)
   *   {
   *     values.reinit(element);
   *     element_matrix = 0.;
   *     for (const unsigned int q : values.quadrature_point_indices())
   *       for (const unsigned int i : values.dof_indices())
   *         for (const unsigned int j : values.dof_indices())
   *           element_matrix(i, j) +=
   *             values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
   *     constraints.distribute_local_to_global(
   *       element_matrix, values.get_dof_indices(), system_matrix);
   *   }
   * @endcode
   *
   * Cost of reinit(): about 0.1 us for a whole element and 0.3 us for a cut one with gradients of
   * second order. Lifetime: covers and quadrature must outlive this object.
   */
  class ElementValues : public ShapeValues
  {
  public:
    /// Values of @p fe in the elements of @p covers, at the points of @p quadrature.
    /// @throws InputError if the finite element does not fit, see ShapeValues.
    ElementValues(const CoverSystem              &covers,
                  const QuadratureCollection     &quadrature,
                  const dealii::FiniteElement<2> &fe,
                  dealii::UpdateFlags             flags);

    /// Go to @p element, which must be one of those of the quadrature collection.
    void
    reinit(unsigned int element);

  private:
    const QuadratureCollection *quadrature;
    /// The table of whole elements; without points before the first of them.
    Table whole_table;
  };
} // namespace NMM

#endif
