#ifndef nmm_linear_algebra_linear_solver_parameters_h
#define nmm_linear_algebra_linear_solver_parameters_h

namespace NMM
{
  /**
   * How the linear system of a static analysis with small displacements is solved.
   *
   * Measured processor times of a solution of second order, set-up included, and memory beyond
   * that of the assembled system. "Jointed" is rock of 290 blocks that are tied to
   * each other, the beam is 40 times as long as high, the disk 50,000 times as soft as
   * the box around it:
   *
   * |         | unknowns | direct [s] | iterative [s] | direct [MB] | iterative [MB] |
   * |---------|---------:|-------:|----------:|-------:|----------:|
   * | ring    |   91,020 |   0.57 |      0.36 |     99 |        22 |
   * | ring    |  177,772 |   1.41 |      0.98 |    205 |        39 |
   * | ring    |  393,284 |   3.06 |      1.99 |    408 |        80 |
   * | beam    |  111,634 |   0.32 |      0.57 |     78 |        28 |
   * | disk    |  123,470 |   0.84 |      0.65 |    145 |           |
   * | disk    |  235,442 |   1.86 |      1.36 |    284 |           |
   * | jointed |   72,160 |   0.48 |      1.30 |     65 |           |
   * | jointed |  135,174 |   1.04 |      2.87 |    135 |        32 |
   * | jointed |  297,242 |   2.76 |      4.35 |    339 |           |
   *
   * Iterative solution is faster from some 20,000 unknowns on for bodies without joints, and from
   * some 500,000 on for rock whose joint spacing is about the size of the cells.
   * The default limit lies between these.
   */
  struct LinearSolverParameters
  {
    /// The kinds of solvers.
    enum class Type
    {
      /// Direct up to `direct_limit` unknowns, iterative above. If iterations do
      /// not converge, or if all right-hand sides together would take more than
      /// `max_iterations` of them, direct.
      automatic,
      /// Symmetric factorization, see DirectSolver.
      direct,
      /// Conjugate gradients, preconditioned by TwoLevelPreconditioner for second and
      /// by ML (smoothed aggregation with rigid-body modes) for first order.
      iterative
    };
    /// Which solver is used.
    Type type = Type::automatic;
    /// Largest number of unknowns for which `automatic` is direct; see the table. Covers that are
    /// aggregated have none.
    unsigned int direct_limit = 100000;
    /// Relative residual |b - A x| / |b| at which iterations end [-].
    double tolerance = 1e-11;
    /// Number of iterations after which the iterative solver counts as not converging.
    unsigned int max_iterations = 1000;
    /// Whether the program shall call estimate_condition_number(); the solver itself does not.
    bool estimate_condition = false;
    /// Condition number above which the program warns [-]. A condition number of 10^k costs about
    /// k of the 16 digits of double precision.
    double condition_limit = 1e10;
  };

  /// Effort and accuracy of a linear solution.
  struct LinearSolverReport
  {
    /// Whether the direct solver found the solution. If `n_iterations` is not 0, iterations
    /// had been tried before and did not converge, or would have taken too long. Also true if the right-hand side is zero, so
    /// that nothing was solved.
    bool direct = true;
    /// Iterations of conjugate gradients; 0 if they were not tried.
    unsigned int n_iterations = 0;
    /// |b - A x| / |b| [-].
    double relative_residual = 0.;
    /// Estimate of how much rounding changes the displacement, in the L2 norm and relative to it
    /// [-]. Up to 1e-8 it is rather too large. 0 with the iterative solver.
    double rounding_effect = 0.;
    /// Number of entries of the factors, summed over ranks; 0 for the iterative solver.
    double n_factor_entries = 0.;
    /// @{
    /// Wall times [s] of analysis (ordering and symbolic factorization), of factorization or
    /// set-up of the preconditioner, and of substitution or iterations.
    double analysis_time = 0., factorization_time = 0., solution_time = 0.;
    /// @}
  };
} // namespace NMM

#endif
