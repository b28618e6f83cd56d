#ifndef nmm_linear_algebra_linear_solver_parameters_h
#define nmm_linear_algebra_linear_solver_parameters_h

namespace NMM
{
  /// How the linear system is solved.
  struct LinearSolverParameters
  {
    enum class Type
    {
      /// direct below `direct_limit` unknowns, else iterative.
      automatic,
      /// MUMPS, symmetric factorization.
      direct,
      /// Conjugate gradients with ML, rigid-body modes as near-null space.
      iterative
    };
    Type type = Type::automatic;
    /// MUMPS solves what is hard to precondition, too, as long as its factors fit
    /// into memory, about 2 kB per unknown. Of second order iterations take no
    /// longer from about 100,000 unknowns on, and less memory: 3.1 s and 530 MB
    /// instead of 3.9 s and 940 MB at 401,000 unknowns of the ring.
    unsigned int direct_limit = 1000000;
    /// Relative residual of the iterative solver.
    double       tolerance      = 1e-11;
    unsigned int max_iterations = 1000;
    /// For programs: is estimate_condition_number() wanted, and from which
    /// value [-] on should they warn? With double precision about 16 minus the
    /// number's exponent digits are left in the solution.
    bool   estimate_condition = false;
    double condition_limit    = 1e10;
  };

  struct LinearSolverReport
  {
    bool         direct            = true;
    unsigned int n_iterations      = 0;
    double       relative_residual = 0.;
    /// Entries of the factors, of all ranks; 0: iterative.
    double n_factor_entries = 0.;
    /// Wall times of ordering and symbolic factorization, of factorization or making the
    /// preconditioner, and of substitution or iterations [s].
    double analysis_time = 0., factorization_time = 0., solution_time = 0.;
  };
} // namespace NMM

#endif
