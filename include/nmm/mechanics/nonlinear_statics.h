#ifndef nmm_mechanics_nonlinear_statics_h
#define nmm_mechanics_nonlinear_statics_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/solution/newton_solver.h>

#include <functional>
#include <vector>

namespace NMM
{
  struct LoadSteps
  {
    /// Load factors at which an answer is wanted, ascending from above 0 [-].
    std::vector<double> load_factors = {1.};
    /// No step is smaller than this part of the last load factor [-].
    double min_step = 1e-4;
    /// A solution with a larger FiniteElasticity::largest_jump() is none: the
    /// step is divided.
    double max_jump = 0.5;
    /**
     * Degree of the polynomial through previous solutions that a step starts
     * from; 0: the last solution. With NewtonParameters::use_increment
     * 0 is best (20 iterations instead of 23 or more in step-nmm-2), without
     * it 2 (27 instead of 31).
     */
    unsigned int extrapolation_degree = 0;

    /// @p n equal steps up to @p last.
    static LoadSteps
    equal(unsigned int n, double last = 1.);

    /// @throws InputError naming the value.
    void
    check() const;
  };


  /// A load step that converged.
  struct LoadStep
  {
    double load_factor = 0.;
    /// Was an answer wanted here? Else it was put in between.
    bool         is_asked = false;
    NewtonReport newton;
    /// Steps tried and given up before this one, and their iterations.
    unsigned int n_cuts = 0, n_lost_iterations = 0;
  };


  /**
   * Static equilibrium of a FiniteElasticity under growing load. Each step tries
   * the next load factor that is asked for; where Newton's method
   * fails, the step is halved, and after a success it is doubled again, up to
   * the next factor asked for.
   *
   * Lifetime: the elasticity must outlive this object.
   */
  class NonlinearStatics
  {
  public:
    using Vector = FiniteElasticity::Vector;

    explicit NonlinearStatics(FiniteElasticity       &elasticity,
                              const NewtonParameters &parameters = {});

    /**
     * From the unloaded state (or the last solution of an earlier call, if
     * its load factor is below the first one asked for). @p after_step is called with
     * each converged step and its solution.
     * @throws NumericalFailure if a step would be smaller than allowed, with
     * the load factor, the reason and the history of the last iteration; the solution
     * is then the last converged one.
     */
    std::vector<LoadStep>
    run(const LoadSteps &steps,
        const std::function<void(const LoadStep &, const Vector &)>
          &after_step = {});

    /// Displacements [m], locally relevant.
    const Vector &
    solution() const;

    double
    load_factor() const;

    /// The step that was tried last: after a failure, how often it was cut and
    /// the iterations lost.
    const LoadStep &
    last_attempt() const;

  private:
    struct State
    {
      double load_factor;
      Vector solution;
    };

    /// Where the step to @p load_factor starts.
    Vector
    predict(double load_factor, unsigned int degree) const;

    FiniteElasticity  *elasticity;
    NewtonSolver       newton;
    std::vector<State> states;
    LoadStep           current;
  };
} // namespace NMM

#endif
