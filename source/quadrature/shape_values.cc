#include <nmm/base/exceptions.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/quadrature/shape_values.h>

#include <deal.II/fe/component_mask.h>

#include <string>

namespace NMM
{
  namespace
  {
    /// Whether shape function i of @p fe is component i % n of weight function i / n.
    bool
    is_system_of(const dealii::FiniteElement<2> &fe,
                 const dealii::FiniteElement<2> &weight_functions)
    {
      const unsigned int n = fe.n_components();
      if (!fe.is_primitive() ||
          fe.n_dofs_per_cell() != n * weight_functions.n_dofs_per_cell())
        return false;
      for (unsigned int c = 0; c < n; ++c)
        if (fe.get_sub_fe(c, 1).get_name() != weight_functions.get_name())
          return false;
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        if (fe.system_to_component_index(i) != std::make_pair(i % n, i / n))
          return false;
      return true;
    }
  } // namespace


  ShapeValues::ShapeValues(const CoverSystem              &covers,
                           const dealii::FiniteElement<2> &fe,
                           const dealii::UpdateFlags       flags)
    : covers(&covers)
    , flags(flags)
    , n_components(fe.n_components())
    , n_functions(fe.n_dofs_per_cell() / fe.n_components())
    , degree(covers.manifold_mesh().mathematical_mesh().degree())
    , current_element(invalid_index)
  {
    using namespace dealii;
    const FiniteElement<2> &weight_functions =
      covers.manifold_mesh().mathematical_mesh().fe();
    AssertThrow(is_system_of(fe, weight_functions),
                InputError("the finite element is not made of those of the "
                           "mathematical mesh, " +
                             weight_functions.get_name(),
                           fe.get_name(),
                           "make an FESystem of MathematicalMesh::fe()"));
    const UpdateFlags possible = update_values | update_gradients |
                                 update_quadrature_points | update_JxW_values |
                                 update_normal_vectors;
    AssertThrow((flags | possible) == possible,
                InputError("a manifold element has values, gradients, points, "
                           "JxW values and normal vectors only",
                           "update flags",
                           "leave out the others"));
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      dof_to_function.push_back(i / n_components);
      dof_to_component.push_back(i % n_components);
    }
  }


  void
  ShapeValues::tabulate(Table &new_table) const
  {
    const unsigned int n_points = new_table.points.size();
    if ((flags & dealii::update_values) != 0)
    {
      new_table.values.resize(n_points * n_functions);
      for (unsigned int q = 0; q < n_points; ++q)
        WeightFunctions::values(degree,
                                new_table.points[q],
                                new_table.values.data() + q * n_functions);
    }
    if ((flags & dealii::update_gradients) != 0)
    {
      new_table.gradients.resize(n_points * n_functions);
      double g[WeightFunctions::max_per_cell][2];
      for (unsigned int q = 0; q < n_points; ++q)
      {
        WeightFunctions::gradients(degree, new_table.points[q], g);
        for (unsigned int k = 0; k < n_functions; ++k)
          new_table.gradients[q * n_functions + k] = {{g[k][0], g[k][1]}};
      }
    }
  }


  void
  ShapeValues::reinit(const unsigned int element, const Table &new_table)
  {
    const ManifoldMesh     &mesh  = covers->manifold_mesh();
    const MathematicalMesh &cells = mesh.mathematical_mesh();
    const unsigned int      cell  = mesh.cell(element);
    current_element               = element;
    table                         = &new_table;
    covers->get_dof_indices(element, n_components, global_indices);
    if ((flags & dealii::update_quadrature_points) != 0)
    {
      points.resize(table->points.size());
      for (unsigned int q = 0; q < points.size(); ++q)
        points[q] = cells.reference_to_real(cell, table->points[q]);
    }
    if ((flags & dealii::update_gradients) != 0)
    {
      // the physical gradient is J^-T times the reference gradient
      const dealii::Tensor<2, 2> T = dealii::invert(cells.jacobian(cell));
      gradients.resize(table->gradients.size());
      for (std::size_t k = 0; k < gradients.size(); ++k)
      {
        const std::array<double, 2> &g = table->gradients[k];
        gradients[k][0]                = T[0][0] * g[0] + T[1][0] * g[1];
        gradients[k][1]                = T[0][1] * g[0] + T[1][1] * g[1];
      }
    }
  }
} // namespace NMM
