#ifndef nmm_solution_load_stepping_h
#define nmm_solution_load_stepping_h

#include <nmm/solution/newton_solver.h>

#include <functional>
#include <string>
#include <vector>

namespace NMM
{
  /// The load factors to reach, and bounds on the steps towards them; see take_load_steps().
  struct LoadSteps
  {
    /// Load factors at which a solution is requested, in this order, none below 0; the first one is
    /// positive, and none is the same as the one before [-]. Where they descend, loads are taken
    /// away.
    std::vector<double> load_factors = {1.};
    /// Smallest step as a fraction of the largest load factor [-].
    double min_step = 1e-4;
    /// Largest violation of displacement conditions and ties that is accepted, in the measure of
    /// the system that is solved (for example FiniteElasticity::largest_jump()) [-]. A solution
    /// with a larger one is rejected, and the step is divided.
    double max_jump = 0.5;
    /**
     * Degree of the polynomial through previous solutions whose extrapolation is the initial
     * guess of a step; 0: the last solution. Degree 0 needs fewest iterations with
     * NewtonParameters::use_increment (20 instead of 23 or more in step-nmm-2), degree 2
     * without it (27 instead of 31).
     */
    unsigned int extrapolation_degree = 0;
    /// Whether the load factors up to the first one above the present one are left out, which lets
    /// steps continue after those taken before. Otherwise all of them are reached in turn, be they
    /// above or below the present one.
    bool leaves_out_reached = true;

    /// @p n equal steps up to the load factor @p last.
    static LoadSteps
    equal(unsigned int n, double last = 1.);

    /// The largest of load_factors [-].
    double
    largest() const;

    /// Whether load_factors only ascend.
    bool
    are_ascending() const;

    /// @throws InputError naming the value.
    void
    check() const;
  };


  /// A load step that is tried, or was accepted.
  struct LoadStep
  {
    /// Load factor at the end of the step [-].
    double load_factor = 0.;
    /// Whether load_factor is one of LoadSteps::load_factors. Other steps are intermediate ones,
    /// made because a longer step failed.
    bool is_asked = false;
    /// @{
    /// Steps that were tried and given up since the last accepted one, and their iterations.
    unsigned int n_cuts = 0, n_lost_iterations = 0;
    /// @}
    /// Iterations of Newton's method in this step.
    unsigned int n_iterations = 0;
    /// Residual over the force scale after the last iteration [-].
    double relative_residual = 0.;
    /// Report on the last system that was solved in the step.
    NewtonReport newton;
  };


  /// Result of a step that was tried.
  struct StepVerdict
  {
    /// Whether the step is accepted, so that the next one starts at its end.
    bool is_accepted = false;
    /// @{
    /// For a step that was not accepted: why, as part of a message, and what the user can do.
    std::string reason, remedy;
    /// @}
    /// Length of the next step divided by the length of this one, if the attempt can tell. 0: half
    /// the length after a rejected step, at least twice the length after an accepted one.
    double ratio = 0.;
  };


  /**
   * The one loop over load steps: from @p begin to each of the requested load factors in turn,
   * see LoadSteps::leaves_out_reached. The first step tries to reach the first of them. A step that
   * @p attempt rejects is divided, and after an accepted step the next one may be longer.
   * Intermediate steps divide the remaining way to the next requested load factor into equal parts.
   *
   * @p attempt is called with a step whose load factor and cuts are set. It computes the solution
   * there, fills in the rest of the step, and keeps the new state if it accepts the step.
   *
   * @throws InputError if all load factors are left out.
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
