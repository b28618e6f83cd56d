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

    /// Another number whenever tangent() has another pattern. Its values then are right
    /// in rows that were assembled last, and nowhere else.
    virtual unsigned int
    pattern_version() const
    {
      return 0;
    }

    /// @name Blocks: what no force couples unless it touches
    /// @{

    /// Block of each owned unknown, from 0 on; of a constrained one any of those
    /// that it follows. Empty, as on more than one rank: they are not told apart.
    virtual const std::vector<unsigned int> &
    blocks_of_unknowns() const;

    /// Blocks that do not move, whatever acts on them; empty: none.
    virtual const std::vector<bool> &
    held_blocks() const;

    /// From now on assemble() has to be right in the rows of these blocks and
    /// nowhere else, also not in force_scale(); tangent() stays regular. Empty: all.
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

    /// Which blocks the last assembly of tangent() has coupled in rows of active ones,
    /// some perhaps several times; null: values other than zero tell.
    virtual const std::vector<BlockPair> *
    coupled_blocks() const
    {
      return nullptr;
    }

    /// Tangents to come are of another state: rows that have been assembled before need
    /// not be kept.
    virtual void
    forget_tangent()
    {
    }

    /// The last tangent as a body matrix, those of blocks_of_unknowns(): what is not
    /// coupled is not in it. tangent() is not asked for then. Null: it is tangent().
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
    /// Least share of a correction that the line search tries.
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
      /// |r| / force_scale() before the correction, of what was being solved for [-].
      double relative_residual = 0.;
      /// |r . du| before the correction du [J/m].
      double energy = 0.;
      /// Share of the correction that was taken, the least of all groups.
      double line_search = 1.;
      /// Share of the unknowns that were corrected [-].
      double active_share = 1.;
    };

    bool converged = false;
    /// Why not, for people.
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
   * Points of contact that stick and slip, or open and close, by turns can make it go
   * round several states for ever. Once three iterations in a row have not brought
   * |r| below 0.7 of what it was before (not within the first six), eta is halved
   * until |r| goes down by a quarter of eta and more, or the best of five is taken:
   * where r is linear piece by piece, that follows the path on which |r| falls
   * from piece to piece (Katzenelson, Bell Syst. Tech. J. 44 (1965) 1605). The first
   * 0.3 s of the slide of step-nmm-4 take 36 steps and one cut, and took 92 and 23.
   *
   * Blocks that do not touch are systems of their own: groups, told from values of K
   * other than zero. Each group has its own eta and its own end, its part of
   * both tolerances being that of its unknowns, so that all of them together
   * are below; what has converged is neither assembled nor factorized any more until
   * something presses on it. In the end all is assembled once more to see that
   * it is so. So what many blocks cost does not depend on the one that needs
   * most iterations.
   *
   * In a large group few blocks keep it from its end, one that begins to slip, say. An
   * iteration corrects those whose |r| is above a tenth of their part of the
   * tolerance, and two rings of neighbours around them; what is further away stays, and
   * is corrected in the next iteration if it feels that (nonlinear elimination: Lanzkron,
   * Rose & Wilkes, SIAM J. Sci. Comput. 17 (1996) 538). Corrections that reach
   * further than neighbours, as in a tower at rest, would need many such iterations: where
   * what is felt outside is above a tenth of the |r| before, the number of rings
   * doubles, and in each iteration of a group in which |r| goes round. In a heap of 2,000
   * blocks a block takes part in 5.8 of 13.6 iterations of a step.
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
