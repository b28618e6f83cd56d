#ifndef nmm_mechanics_material_vector_h
#define nmm_mechanics_material_vector_h

#include <nmm/covers/cover_system.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * A vector that is a linear function of the free unknowns of a solid,
   * @f[ d = d_0 + \sum_i w_i u_i, \qquad w_i = \partial d/\partial u_i, @f]
   * for example the current position of a material point, or the vector from one such point to
   * another: `end - start`. It is the same on all ranks.
   */
  struct MaterialVector
  {
    /// Its value d_0 where all free unknowns are zero [m].
    dealii::Tensor<1, 2> constant;
    /// Free unknowns (global numbers), in pairs 2k and 2k + 1, in ascending order and each once.
    std::vector<dealii::types::global_dof_index> unknowns;
    /// Derivative w_i by each of them [-].
    std::vector<dealii::Tensor<1, 2>> weights;
    /// Blocks (ManifoldMesh::block()) whose motion the vector depends on, ascending.
    std::vector<unsigned int> blocks;

    /// Subtract another vector.
    MaterialVector &
    operator-=(const MaterialVector &other);
  };


  /// The vector from the end of @p b to that of @p a.
  inline MaterialVector
  operator-(MaterialVector a, const MaterialVector &b)
  {
    a -= b;
    return a;
  }


  /**
   * The position X + u(X) of the material point that has the position @p x in the reference
   * configuration [m]. Constrained unknowns are replaced by those they follow from. Of a point on a
   * joint, the side is arbitrary. Collective.
   * @throws InputError that begins with @p what, such as "The end of a spring", for a point outside
   * the solid.
   */
  MaterialVector
  material_point(const CoverSystem                       &covers,
                 const dealii::AffineConstraints<double> &constraints,
                 const dealii::Point<2>                  &x,
                 const std::string                       &what);


  /// Values of @p vectors at the displacements @p u, of which owned unknowns suffice [m].
  /// Collective.
  std::vector<dealii::Tensor<1, 2>>
  evaluate(const std::vector<MaterialVector>           &vectors,
           const dealii::TrilinosWrappers::MPI::Vector &u);
} // namespace NMM

#endif
