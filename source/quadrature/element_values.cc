#include <nmm/quadrature/element_values.h>

namespace NMM
{
  ElementValues::ElementValues(const CoverSystem              &covers,
                               const QuadratureCollection     &quadrature,
                               const dealii::FiniteElement<2> &fe,
                               const dealii::UpdateFlags       flags)
    : ShapeValues(covers, fe, flags)
    , quadrature(&quadrature)
  {
  }


  void
  ElementValues::reinit(const unsigned int element)
  {
    const ManifoldMesh &mesh     = covers->manifold_mesh();
    const ElementRule   rule     = quadrature->rule(element);
    const bool          is_whole = mesh.is_whole(element);
    Table              &table    = is_whole ? whole_table : own_table;
    if (!is_whole || table.points.empty())
    {
      table.points.resize(rule.size());
      for (unsigned int q = 0; q < rule.size(); ++q)
        table.points[q] = rule.point(q);
      tabulate(table);
    }
    const double determinant =
      2. * mesh.mathematical_mesh().cell_area(mesh.cell(element));
    weights.resize(rule.size());
    for (unsigned int q = 0; q < rule.size(); ++q)
      weights[q] = determinant * rule.weight(q);
    ShapeValues::reinit(element, table);
  }
} // namespace NMM
