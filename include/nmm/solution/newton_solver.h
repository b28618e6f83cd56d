#ifndef nmm_solution_newton_solver_h
#define nmm_solution_newton_solver_h

#include <nmm/base/assembly.h>
#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// Equations r(u) = 0 as NewtonSolver sees them; statics at one load factor,
  /// or a time step.
  class NonlinearSystem
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    virtual ~NonlinearSystem() = default;

    /**
     * Residual r(u) and K(u) = dr/du as @p tangent asks. @p u has the locally
     * relevant unknowns. @p increment, if given, is the change of u in the last
     * iteration: the tangent may use it to converge faster, as long as it is
     * dr/du where the increment vanishes.
     */
    virtual Deformation
    assemble(const Vector &u, Tangent tangent, const Vector *increment) = 0;

    /// r(u) on owned unknowns, 0 for constrained ones.
    virtual const Vector &
    residual() const = 0;

    virtual const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const = 0;

    virtual bool
    tangent_is_symmetric() const = 0;

    /// Size of the forces that are in balance, what |r| is compared with [N/m].
    virtual double
    force_scale() const = 0;

    /// A number that changes whenever tangent() has a new sparsity pattern. Only the rows that
    /// were assembled last have valid values then.
    virtual unsigned int
    pattern_version() const
    {
      return 0;
    }

    /// @name Blocks, which forces couple only where they touch
    /// @{

    /// Block of each owned unknown, from 0 on; of a constrained unknown any block of those that
    /// it follows. Empty if all unknowns are solved for together, as on several ranks.
    virtual const std::vector<unsigned int> &
    blocks_of_unknowns() const;

    /// Blocks that do not move, whatever acts on them; empty: none.
    virtual const std::vector<bool> &
    held_blocks() const;

    /// From now on assemble() needs to be right in the rows of these blocks only (empty: all);
    /// rows of inactive blocks and force_scale() are undefined, but tangent() stays regular.
    virtual void
    set_active_blocks(const std::vector<bool> & /*is_active*/)
    {
    }

    /// Blocks that are neither active nor held and on which an active one has
    /// pressed since the last call.
    virtual std::vector<unsigned int>
    take_touched_blocks()
    {
      return {};
    }

    /// Pairs of blocks that the last assembly of tangent() has coupled in rows of active blocks;
    /// a pair may occur several times. Null: values other than zero tell which they are.
    virtual const std::vector<BlockPair> *
    coupled_blocks() const
    {
      return nullptr;
    }

    /// The next tangents belong to another state: rows assembled before need not be kept.
    virtual void
    forget_tangent()
    {
    }

    /// The last tangent as a body matrix of blocks_of_unknowns(), without entries for blocks that
    /// are not coupled; tangent() is not used then. Null: tangent() is the matrix.
    virtual const BodyMatrix *
    body_tangent() const
    {
      return nullptr;
    }
    /// @}
  };


  struct NewtonParameters
  {
    /// |r| <= residual_tolerance * force_scale() ...
    double residual_tolerance = 1e-9;
    /// ... and |r . du| <= energy_tolerance * the largest |r . du| so far, du
    /// being the last correction.
    double       energy_tolerance = 1e-12;
    unsigned int max_iterations   = 12;
    /// Least step length that the line search tries [-].
    double min_line_search = 1. / 64.;
    /// Search from the first iteration on, for what is stiff on one side only, such as
    /// contact; otherwise from the fifth, when r . du grows.
    bool always_search = false;
    /// Pass the last increment to NonlinearSystem::assemble(): 20 instead of
    /// 31 (follower load: 34) iterations for five steps of step-nmm-2.
    bool use_increment = true;
    /// Iterations that take Tangent::robust.
    unsigned int n_robust_iterations = 3;
    /// Corrections with the last factorization after convergence: what is left
    /// comes down to rounding for the price of a residual and a substitution.
    unsigned int n_refinements = 0;
  };


  struct NewtonReport
  {
    struct Iteration
    {
      /// |r| / force_scale() of the active unknowns before the correction [-].
      double relative_residual = 0.;
      /// |r . du| before the correction du [J/m].
      double energy = 0.;
      /// Step length of the correction, the least of all groups [-].
      double line_search = 1.;
      /// Part of the unknowns that was corrected [-].
      double active_share = 1.;
    };

    bool converged = false;
    /// Why it did not converge, as part of a message.
    std::string            reason;
    std::vector<Iteration> iterations;
    /// |r| / force_scale() in the end.
    double       relative_residual  = 0.;
    unsigned int n_line_search_cuts = 0;
    /// Wall times [s]; assembly includes residuals alone.
    double assembly_time = 0., factorization_time = 0., substitution_time = 0.;
  };


  /**
   * Newton's method with line search. One *iteration* is one tangent, one
   * factorization and one correction
   * @f[ K\,\delta = r(u), \qquad u \leftarrow u - \eta\,\delta. @f]
   *
   * A full step (eta = 1) that bends a thin body raises |r| and the energy by
   * orders of magnitude, because it stretches what it turns, and is still the
   * best one; a test for decrease would forbid it. So eta is cut where
   * the deformation is not admissible, and otherwise only once
   * |r . delta| has begun to rise late in the iteration: then by halves until
   * |r(u - eta delta) . delta| has decreased (Crisfield, Non-linear Finite Element
   * Analysis 1, section 9.4), for which no potential is needed. From then on the tangent
   * is the plain one.
   *
   * The state of a contact point may alternate between stick and slip, or between open and closed,
   * so that the iteration cycles and never converges. Once three iterations in a row have not brought
   * |r| below 0.7 of what it was before (not within the first six), eta is halved
   * until |r| goes down by a quarter of eta and more, or the best of five is taken:
   * where r is linear piece by piece, that follows the path on which |r| falls
   * from piece to piece (Katzenelson, Bell Syst. Tech. J. 44 (1965) 1605). The first
   * 0.3 s of the slide of step-nmm-4 take 36 steps and one cut, and took 92 and 23.
   *
   * Groups of blocks that do not touch each other are separate systems. Each group has its own
   * eta and converges by itself; its part of both tolerances is its part of the unknowns, so that
   * all groups together are below them. A group that has converged is neither assembled nor
   * factorized until an active one presses on it. In the end everything is assembled once more to
   * verify the solution. So the cost of many blocks does not depend on the block that needs most
   * iterations.
   *
   * In a large group few blocks, such as one that begins to slip, delay convergence. An iteration
   * corrects the blocks whose |r| is above a tenth of their part of the tolerance, and two rings
   * of neighbours around them. Blocks further away stay where they are, and are corrected in the
   * next iteration if their |r| has grown (nonlinear elimination: Lanzkron, Rose & Wilkes, SIAM J.
   * Sci. Comput. 17 (1996) 538). Corrections that reach further than neighbours, as in a tower at
   * rest, would need many such iterations. So the number of rings doubles where the |r| just
   * outside exceeds a tenth of the |r| before, and in each iteration of a group that cycles. In a
   * heap of 2,000 blocks a block takes part in 5.8 of 13.6 iterations of a step.
   *
   * Expected failures (no convergence, inadmissible, singular) are results, with
   * a reason; who calls cuts the step. The direct solver analyses the
   * pattern once per object.
   */
  class NewtonSolver
  {
  public:
    using Vector = NonlinearSystem::Vector;

    explicit NewtonSolver(const NewtonParameters &parameters = {});
    ~NewtonSolver();

    /**
     * From @p u, which has the locally relevant unknowns and satisfies the
     * constraints, to the solution; without convergence u is undefined.
     * Constraints of increments are those of @p constraints without
     * inhomogeneities. @p increment is what the last assembly of the tangent
     * may be told about how u was reached, or null.
     */
    NewtonReport
    solve(NonlinearSystem                         &system,
          const dealii::AffineConstraints<double> &constraints,
          Vector                                  &u,
          const Vector                            *increment = nullptr);

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
