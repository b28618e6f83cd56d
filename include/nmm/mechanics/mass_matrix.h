#ifndef nmm_mechanics_mass_matrix_h
#define nmm_mechanics_mass_matrix_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace NMM
{
  /**
   * Assemble the consistent mass matrix (8),
   * @f[ M_{ij} = \int \rho\,w_i w_j\,dA\;I @f]
   * [kg per unit thickness], two unknowns per cover, with the density of each
   * region's material. Covers with a small support are treated as in the
   * stiffness matrix: constrained unknowns are eliminated (their rows keep a
   * diagonal entry), and @p ghost_penalty, if not null, adds
   * gamma rho int (u_E - u_F) . (v_E - v_F). Otherwise thin slivers would make the matrix
   * ill-conditioned, and both explicit and implicit steps would divide by their small masses.
   *
   * @p quadrature must be exact for degree 2p.
   */
  void
  assemble_mass_matrix(const CoverSystem                       &covers,
                       const QuadratureCollection              &quadrature,
                       const dealii::AffineConstraints<double> &constraints,
                       const ElasticityProblem                 &problem,
                       const GhostPenalty                      *ghost_penalty,
                       dealii::TrilinosWrappers::SparseMatrix  &matrix);


  /// The consistent mass matrix of the covers, constraints and densities of @p elasticity, for its
  /// motion; @p quadrature must be exact for degree 2p, and @p ghost_penalty may be null.
  /// @throws InputError for a material without density.
  std::shared_ptr<const dealii::TrilinosWrappers::SparseMatrix>
  make_mass_matrix(const FiniteElasticity     &elasticity,
                   const QuadratureCollection &quadrature,
                   const GhostPenalty         *ghost_penalty = nullptr);
} // namespace NMM

#endif
