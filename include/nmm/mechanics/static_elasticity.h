#ifndef nmm_mechanics_static_elasticity_h
#define nmm_mechanics_static_elasticity_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/linear_algebra/linear_solver_parameters.h>
#include <nmm/mechanics/disk_cover.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class DiskSystem;
  }

  /**
   * Linear static elasticity on a cover system: stiffness (7), initial stress
   * (9), body force (10), point force (11), fixed point (12), and loads and displacements on
   * boundary pieces, assembled into Trilinos objects.
   *
   * Displacement conditions are imposed weakly by Nitsche's method,
   * @f[ -\int_\Gamma (B\sigma(u)n)\cdot v -\int_\Gamma (B\sigma(v)n)\cdot(u-g)
   *     +\int_\Gamma \frac{\gamma}{h}\,B(u-g)\cdot v @f]
   * with B the projection onto the prescribed component(s) or n n^T. The method is consistent
   * and hence of full order. sigma includes the initial stress where it stands for
   * the traction. The penalty gamma / h is four times the constant of a discrete
   * trace inequality, which is computed for each element. So there is no parameter to choose, and
   * the form is coercive however the element is cut. Material interfaces and closed joints
   * are tied in the same way, with averages weighted by stiffness and size. No forces act across
   * open joints and boundaries shared by two domains.
   *
   * A condition on a curve holds on all elements along it that belong to the domain it bounds. If
   * the boundaries of two domains coincide, each has conditions of its own
   * (PhysicalMesh::is_face_of()).
   *
   * All terms are per unit thickness. Constrained unknowns (aggregated covers)
   * are eliminated; their rows keep a diagonal entry. If there is a ghost penalty, its
   * terms are added.
   *
   * Disk covers add functions to the displacement, see DiskCover. The circle of each of them must
   * be an interface of the physical mesh.
   *
   * Order of calls: assemble(), solve(), solution().
   *
   * Lifetime: all arguments of the constructor must outlive this object.
   */
  class StaticElasticity
  {
  public:
    /// @p ghost_penalty may be null, and there may be no @p disks.
    /// @throws InputError if the problem does not fit the mesh, see
    /// ElasticityProblem::check(), or a point lies outside the solid.
    StaticElasticity(const CoverSystem                       &covers,
                     const QuadratureCollection              &quadrature,
                     const dealii::AffineConstraints<double> &constraints,
                     const ElasticityProblem                 &problem,
                     const GhostPenalty *ghost_penalty           = nullptr,
                     const std::vector<const DiskCover *> &disks = {});

    ~StaticElasticity();

    /**
     * Make the sparsity pattern and assemble matrix and right-hand side. @p timer, if not null,
     * records the sections "sparsity" and "assembly".
     * @throws InputError for inelastic materials.
     * @throws NumericalFailure, naming the block, for a block whose displacement conditions and
     * fixed points permit a rigid motion.
     */
    void
    assemble(dealii::TimerOutput *timer = nullptr);

    /// Solve the assembled system.
    /// @throws NumericalFailure for a singular system, also if rounding changes the displacements
    /// by more than a hundredth of them, or if the iteration does not converge.
    LinearSolverReport
    solve(const LinearSolverParameters &parameters);

    /// Displacements of covers on locally relevant unknowns, with constraints distributed [m].
    const dealii::TrilinosWrappers::MPI::Vector &
    solution() const;

    /// The coefficients of the functions of each disk cover, after solve().
    const std::vector<dealii::Vector<double>> &
    disk_coefficients() const;

    /// The part of the strain energy [J per metre of thickness] that depends on these coefficients,
    /// without the energy of the other covers' displacement on its own.
    double
    disk_energy() const;

    /// The assembled matrix [N/m^2] of the unknowns of covers, with constraints eliminated.
    const dealii::TrilinosWrappers::SparseMatrix &
    system_matrix() const;

    /// The assembled right-hand side on owned unknowns [N/m], with constraints eliminated.
    const dealii::TrilinosWrappers::MPI::Vector &
    system_rhs() const;

  private:
    double
    largest_share(
      const std::vector<dealii::TrilinosWrappers::MPI::Vector> &changes) const;

    const CoverSystem                       *covers;
    const QuadratureCollection              *quadrature;
    const dealii::AffineConstraints<double> *constraints;
    const ElasticityProblem                 *problem;
    const GhostPenalty                      *ghost_penalty;
    bool                                     has_disks;
    std::unique_ptr<internal::DiskSystem>    disks;
    double                                   disk_energy_value = 0.;

    /// The forces of the solid; null before assemble().
    std::unique_ptr<FiniteElasticity>     forces;
    dealii::TrilinosWrappers::MPI::Vector rhs;
    dealii::TrilinosWrappers::MPI::Vector relevant_solution;
  };
} // namespace NMM

#endif
