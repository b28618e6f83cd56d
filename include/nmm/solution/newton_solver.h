#ifndef nmm_solution_newton_solver_h
#define nmm_solution_newton_solver_h

#include <nmm/base/assembly.h>
#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

/**
 * @defgroup solution Solution
 *
 * Newton's method and steps for an abstract system of equations. This module does not
 * know mechanics or contact.
 *
 * **In**: a NonlinearSystem, which assembles residual and tangent and tells which blocks its
 * unknowns belong to. **Out**: the solution, and a NewtonReport; expected failures are results.
 *
 * | file (those without a folder: source/solution) | job |
 * |---|---|
 * | nmm/solution/newton_solver.h | interface of systems, and Newton's method |
 * | newton_groups.h | groups of blocks that Newton's method solves separately |
 * | line_search.h | step length of a correction |
 * | nmm/solution/step_sequence.h | the one loop that steps, with cuts and growth |
 * | nmm/solution/load_stepping.h | steps from one requested load factor to the next |
 *
 * Order of calls:
 * @code
 * NewtonSolver solver;                                  // once
 * const auto attempt = [&](LoadStep &step) {
 *   system.set_load_factor(step.load_factor);
 *   step.newton = solver.solve(system, constraints, u);
 *   if (step.newton.converged)
 *     return StepVerdict::accepted();                   // keep u
 *   return StepVerdict::rejected({step.newton.reason}); // restore u
 * };
 * LoadStep step;
 * take_load_steps(LoadSteps::equal(10), 0., attempt, step);
 * @endcode
 */

namespace NMM
{
  /// Equations r(u) = 0 as they were last assembled. Vectors and matrices belong to the system.
  struct AssembledSystem
  {
    /// r(u) on owned unknowns, 0 for constrained ones [N/m].
    const dealii::TrilinosWrappers::MPI::Vector *residual = nullptr;
    /// Magnitude of the forces that balance each other, to which |r| is compared [N/m].
    double force_scale = 0.;
    /// Estimated norm of the rounding of the residual [N/m]: no solution has a smaller residual.
    /// 0: it is not known.
    double force_rounding = 0.;

    /// @name The last assembly with a tangent
    /// @{

    /// K(u) = dr/du [N/m^2].
    const dealii::TrilinosWrappers::SparseMatrix *tangent = nullptr;
    /// The same as a body matrix of the blocks, without entries for blocks that are not coupled;
    /// `tangent` is not used then. Null: `tangent` is the matrix.
    const BodyMatrix *body_tangent = nullptr;
    /// Whether K is symmetric, so that a symmetric factorization may be used.
    bool is_symmetric = false;
    /// A number that changes whenever K has a new sparsity pattern. Only the rows that were
    /// assembled last have valid values.
    unsigned int pattern_version = 0;
    /// @}
  };


  /// The interface of equations r(u) = 0 that NewtonSolver solves: static equilibrium at one load
  /// factor, or a time step.
  class NonlinearSystem
  {
  public:
    /// Distributed vector of the unknowns [m] or of forces [N/m].
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    virtual ~NonlinearSystem() = default;

    /**
     * Assemble the residual r(u) and, unless @p tangent is Tangent::none, K(u) = dr/du, in the rows
     * of @p blocks. @p u has the locally relevant unknowns. @p increment, if given, is the change of u
     * in the last iteration: the tangent may use it to converge faster, as long as it is dr/du where
     * the increment vanishes. A system without blocks_of_unknowns() is asked for all rows only.
     */
    virtual Deformation
    assemble(const Vector         &u,
             Tangent               tangent,
             const Vector         *increment,
             const BlockSelection &blocks) = 0;

    /// The result of the last assembly.
    const AssembledSystem &
    assembled() const
    {
      return result;
    }

    /// AssembledSystem::residual.
    const Vector &
    residual() const
    {
      return *result.residual;
    }

    /// AssembledSystem::tangent.
    const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const
    {
      return *result.tangent;
    }

    /// @name Blocks, which are coupled by forces only where they touch
    /// @{

    /// Block of each owned unknown, numbered from 0. A constrained unknown may have the block of
    /// any of the unknowns it depends on. Empty if all unknowns are solved together, as on several
    /// ranks.
    virtual const std::vector<unsigned int> &
    blocks_of_unknowns() const;

    /// For each block, whether it sleeps: it does not move, whatever acts on it. Empty: none does.
    const std::vector<bool> &
    sleepers() const
    {
      return sleeping_blocks;
    }
    /// @}

  protected:
    /// See assembled(); set by assemble().
    AssembledSystem result;
    /// See sleepers().
    std::vector<bool> sleeping_blocks;
  };


  struct NewtonReport;


  /// Tolerances and strategy of NewtonSolver.
  struct NewtonParameters
  {
    /// Convergence requires |r| <= residual_tolerance times the force scale [-], or |r| <= the rounding of forces.
    double residual_tolerance = 1e-9;
    /// Convergence also requires |r . du| <= energy_tolerance * the largest |r . du| of all
    /// iterations so far, du being the last correction [-].
    double energy_tolerance = 1e-12;
    /// Number of iterations after which the solution is given up.
    unsigned int max_iterations = 12;
    /// Smallest step length that the line search tries [-].
    double min_line_search = 1. / 64.;
    /// Whether to search from the first iteration on, for forces that are stiff on one side only,
    /// such as contact. Otherwise the search begins with the fifth iteration, if |r . du| grows.
    bool always_search = false;
    /// Whether |r| has to fall once states seem to cycle (see NewtonSolver). It must not where
    /// faces that touch open one after the other.
    bool stops_cycles = true;
    /// Whether the last increment is passed to NonlinearSystem::assemble(). Five steps of
    /// step-nmm-2 then take 20 iterations instead of 31 (34 with a follower load).
    bool use_increment = true;
    /// Whether groups of blocks that do not touch each other are solved at their own pace (see
    /// NewtonSolver). Otherwise all blocks are one group, as on several ranks, which only takes
    /// longer (a heap of 200 blocks 1.3 times): the results are the same to the tolerances above.
    bool solves_groups_separately = true;
    /// Number of iterations at the beginning whose tangent is Tangent::robust.
    unsigned int n_robust_iterations = 3;
    /// Number of corrections with the last factorization after convergence. Each reduces the
    /// residual, down to rounding, for the cost of a residual and a substitution.
    unsigned int n_refinements = 0;
    /// Called after each iteration, if given, to show that a long solution is alive.
    std::function<void(const NewtonReport &)> after_iteration;
  };


  /// Result and history of a solution by NewtonSolver.
  struct NewtonReport
  {
    /// An entry of the history.
    struct Iteration
    {
      /// |r| / force scale of the unknowns that are still solved for, before the correction [-].
      double relative_residual = 0.;
      /// Sum over all groups that are still solved of |r . du|, r being the residual before the correction du
      /// [J/m].
      double energy = 0.;
      /// Step length of the correction, the smallest one of all groups [-].
      double line_search = 1.;
      /// Number of unknowns that were solved for, divided by that of all unknowns [-].
      double solved_share = 1.;
    };

    /// Whether both tolerances were met, or the residual is at the floor that rounding leaves.
    bool converged = false;
    /// Whether a part of the solution is at that floor, above the tolerance.
    bool is_at_floor = false;
    /// Why the solution did not converge, as part of a message.
    std::string reason;
    /// One entry per iteration; a failed one is the last.
    std::vector<Iteration> iterations;
    /// |r| / force scale after the last iteration [-].
    double relative_residual = 0.;
    /// Step lengths that line searches tried and did not take, of all iterations and groups.
    unsigned int n_line_search_cuts = 0;
    /// @{
    /// Wall times [s] of all assemblies (also those of residuals alone), of factorizations and
    /// of substitutions.
    double assembly_time = 0., factorization_time = 0., substitution_time = 0.;
    /// @}
  };


  /**
   * Newton's method with line search. One *iteration* is one tangent, one
   * factorization and one correction
   * @f[ K\,\delta = r(u), \qquad u \leftarrow u - \eta\,\delta. @f]
   *
   * A full step (eta = 1) that bends a thin body raises |r| and the energy by orders of magnitude,
   * because linearized rotations stretch the body, and yet the full step is the best one; a test
   * for decrease would forbid it. So eta is reduced where the deformation is not admissible, and
   * otherwise only once |r . delta| has begun to rise late in the iteration. Then eta is halved
   * until |r(u - eta delta) . delta| has decreased (Crisfield, Non-linear Finite Element
   * Analysis 1, section 9.4), which needs no potential. From then on the last increment is no
   * longer passed to the assembly of the tangent.
   *
   * The state of a contact point may alternate between stick and slip, or between open and closed,
   * so that the iteration cycles and never converges. A group counts as cycling if |r| is the same
   * as two or three iterations ago, or if three iterations in a row (not within the first six)
   * have not brought |r| below 0.7 of its smallest value before. From then on eta is halved until
   * |r| decreases by at least the fraction eta / 4, or the best of five step lengths is taken.
   * Where r is piecewise linear, this follows the path along which |r| falls from piece to piece
   * (Katzenelson, Bell Syst. Tech. J. 44 (1965) 1605). It reduces the first 0.3 s of the slide of
   * step-nmm-4 from 92 steps and 23 cuts to 36 steps and one cut.
   *
   * Groups of blocks that do not touch each other are separate systems. Each group has its own
   * eta and converges by itself. Its share of both tolerances is its share of the unknowns, so
   * that all groups together meet them. A group that has converged is neither assembled nor
   * factorized until the tangent of another group couples with it. Finally everything is assembled
   * once more to verify the solution. So a block that needs many iterations does not add to the cost
   * of the others.
   *
   * A residual is a sum of forces that have been rounded. Its floor is estimated from
   * AssembledSystem::force_rounding, for example of stiff springs that multiply the rounding of gaps,
   * from that of sums, @f$ \epsilon @f$ times the force scale,
   * and from the rounding of the unknowns, @f$ \epsilon\,(\sum_{ij} (K_{ij} u_j)^2)^{1/2} @f$, for example
   * in cells that are much thinner than the displacements are large. A residual below this floor, but
   * at most ten times the tolerance, counts as converged once an iteration has not halved it.
   *
   * Expected failures (no convergence, an inadmissible deformation, a singular tangent) are
   * results with a reason; the caller decides whether to try a smaller step. The direct solver
   * analyses the sparsity pattern anew only if size, symmetry or pattern have changed.
   *
   * Usage: solve() may be called any number of times, also for different systems.
   */
  class NewtonSolver
  {
  public:
    /// See NonlinearSystem::Vector.
    using Vector = NonlinearSystem::Vector;

    /// The parameters are the same for all solutions by this object.
    explicit NewtonSolver(const NewtonParameters &parameters = {});
    ~NewtonSolver();

    /**
     * Solve r(u) = 0, starting from @p u, which has the locally relevant unknowns and satisfies
     * the constraints. Without convergence u is undefined. Corrections satisfy @p constraints
     * without their inhomogeneities. @p increment, or null, is the change by which the initial u
     * was extrapolated; it is passed to the first assembly of the tangent. The tolerance is the larger
     * one of NewtonParameters::residual_tolerance and @p residual_tolerance.
     */
    NewtonReport
    solve(NonlinearSystem                         &system,
          const dealii::AffineConstraints<double> &constraints,
          Vector                                  &u,
          const Vector                            *increment          = nullptr,
          double                                   residual_tolerance = 0.);

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
