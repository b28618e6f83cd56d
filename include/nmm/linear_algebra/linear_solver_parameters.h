#ifndef nmm_linear_algebra_linear_solver_parameters_h
#define nmm_linear_algebra_linear_solver_parameters_h

namespace NMM
{
  /**
   * How the linear system of a static analysis with small displacements is solved.
   *
   * Processor time of a solution of second order, set-up included [s], and memory above
   * that of the assembled system [MB]. "Jointed" is rock of 290 blocks that are tied to
   * each other, the beam is 40 times as long as high, the disk 50,000 times as soft as
   * the box around it:
   *
   * |         | unknowns | direct | iterative | direct | iterative |
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
   * Whole bodies are solved faster by iterations from some 20,000 unknowns on, rock whose
   * joints are as close as its cells from some 500,000 on. The limit is between these.
   */
  struct LinearSolverParameters
  {
    enum class Type
    {
      /// Direct up to `direct_limit` unknowns, iterative above. If iterations do
      /// not converge, direct.
      automatic,
      /// MUMPS, symmetric factorization.
      direct,
      /// Conjugate gradients, preconditioned by TwoLevelPreconditioner for second and
      /// by ML (smoothed aggregation with rigid-body modes) for first order.
      iterative
    };
    Type type = Type::automatic;
    /// Unknowns up to which `automatic` is direct; see the table.
    unsigned int direct_limit = 100000;
    /// Relative residual |b - A x| / |b| at which iterations end [-].
    double tolerance = 1e-11;
    /// Iterations after which they count as not converging.
    unsigned int max_iterations = 1000;
    /// For programs: whether to call estimate_condition_number(), and the value [-]
    /// above which they warn. With double precision about 16 minus the
    /// number's exponent digits are left in the solution.
    bool   estimate_condition = false;
    double condition_limit    = 1e10;
  };

  /// What a solution took.
  struct LinearSolverReport
  {
    /// The direct solver found the solution. If `n_iterations` is not 0, iterations
    /// had been tried before and did not converge.
    bool         direct       = true;
    unsigned int n_iterations = 0;
    /// |b - A x| / |b| [-].
    double relative_residual = 0.;
    /// Entries of the factors, of all ranks; 0: iterative.
    double n_factor_entries = 0.;
    /// Wall times of ordering and symbolic factorization, of factorization or of making
    /// the preconditioner, and of substitution or iterations [s].
    double analysis_time = 0., factorization_time = 0., solution_time = 0.;
  };
} // namespace NMM

#endif
