#ifndef nmm_solution_load_stepping_h
#define nmm_solution_load_stepping_h

#include <nmm/solution/newton_solver.h>

#include <functional>
#include <string>
#include <vector>

namespace NMM
{
  struct LoadSteps
  {
    /// Load factors at which an answer is wanted, ascending from above 0 [-].
    std::vector<double> load_factors = {1.};
    /// No step is smaller than this part of the last load factor [-].
    double min_step = 1e-4;
    /// Solutions whose displacement conditions are missed by more are refused, and the step is
    /// divided; in the measure of the system that is solved [-].
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


  /// A load step that is tried, or was accepted.
  struct LoadStep
  {
    double load_factor = 0.;
    /// Whether an answer is wanted here; otherwise the step was put in between.
    bool is_asked = false;
    /// Steps tried and given up before this one, and their iterations.
    unsigned int n_cuts = 0, n_lost_iterations = 0;
    /// Iterations of Newton's method in this step, and the residual that they left [-].
    unsigned int n_iterations      = 0;
    double       relative_residual = 0.;
    /// Report on the last system that was solved in the step.
    NewtonReport newton;
  };


  /// What became of a step that was tried.
  struct StepVerdict
  {
    bool is_accepted = false;
    /// For a step that was not accepted: why, as part of a message, and what the user can do.
    std::string reason, remedy;
    /// Length of the next step over that of this one, where the attempt knows it; 0: a half if
    /// the step was not accepted, twice if it was.
    double ratio = 0.;
  };


  /**
   * The one loop that goes through load steps: from @p begin to each load factor that is wanted.
   * The first step goes as far as is asked for. A step that @p attempt does not accept is
   * divided, and after an accepted one the next may be longer; steps in between divide what is
   * left up to the next factor wanted equally.
   *
   * @p attempt gets the step with its load factor, fills in what it knows of it, and keeps the
   * new state if it accepts it.
   *
   * @throws NumericalFailure if a step would be shorter than allowed, with the load factor and
   * the last reason; @p step is then the last one that was tried.
   */
  void
  take_load_steps(const LoadSteps                              &steps,
                  double                                        begin,
                  const std::function<StepVerdict(LoadStep &)> &attempt,
                  LoadStep                                     &step);
} // namespace NMM

#endif
