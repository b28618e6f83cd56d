#ifndef nmm_solution_load_stepping_h
#define nmm_solution_load_stepping_h

#include <nmm/solution/newton_solver.h>
#include <nmm/solution/step_sequence.h>

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
  struct LoadStep : LostSteps
  {
    /// Load factor at the end of the step [-].
    double load_factor = 0.;
    /// Whether load_factor is one of LoadSteps::load_factors. Other steps are intermediate ones,
    /// made because a longer step failed.
    bool is_asked = false;
    /// Iterations of Newton's method in this step.
    unsigned int n_iterations = 0;
    /// Residual over the force scale after the last iteration [-].
    double relative_residual = 0.;
    /// Report on the last system that was solved in the step.
    NewtonReport newton;
  };


  /**
   * Steps (StepSequence) from @p begin to each of the requested load factors in turn, see
   * LoadSteps::leaves_out_reached. The first step tries to reach the first of them. After an
   * accepted step the next one may be StepVerdict::ratio times as long.
   *
   * @p attempt is called with a step whose load factor and cuts are set. It computes the solution
   * there, fills in the rest of the step, and keeps the new state if it accepts the step.
   *
   * @throws InputError if all load factors are left out.
   * @throws NumericalFailure as StepSequence::advance(); @p step is then the last one that was
   * tried.
   */
  void
  take_load_steps(const LoadSteps                              &steps,
                  double                                        begin,
                  const std::function<StepVerdict(LoadStep &)> &attempt,
                  LoadStep                                     &step);
} // namespace NMM

#endif
