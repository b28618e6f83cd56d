#ifndef nmm_mechanics_incremental_statics_h
#define nmm_mechanics_incremental_statics_h

#include <nmm/mechanics/incremental_elasticity.h>
#include <nmm/solution/load_stepping.h>

#include <functional>
#include <limits>
#include <vector>

namespace NMM
{
  /// Load steps with a bound on the displacement of a step.
  struct IncrementalSteps : public LoadSteps
  {
    /// Largest displacement of a cover in a step [m]. It controls the error of
    /// a step, which grows with the square of its rotation, as in the paper.
    double max_displacement = std::numeric_limits<double>::infinity();

    /// @throws InputError naming the value.
    void
    check() const;
  };


  /// A load step that was taken.
  struct IncrementalStep : public LoadStep
  {
    /// Largest displacement of a cover in the step [m].
    double largest_displacement = 0.;
  };


  /**
   * Static equilibrium in the step-by-step kinematics of the paper under growing load,
   * with a bound on the displacement of a step. A step that would move a cover
   * further is not taken but made smaller. The next step is chosen so that it
   * reaches nine tenths of the bound, but is at most twice as long and ends at the next requested
   * load factor at the latest. Cost: a linear problem for each step tried.
   *
   * Lifetime: the elasticity must outlive this object.
   */
  class IncrementalStatics
  {
  public:
    /// See IncrementalElasticity::Vector.
    using Vector = IncrementalElasticity::Vector;

    /// @p elasticity must be in its unloaded state.
    explicit IncrementalStatics(IncrementalElasticity &elasticity);

    /**
     * Take the given steps from the unloaded state, or from the last step of an earlier call;
     * load factors that are reached already are skipped. @p after_step, if given, is called with
     * each step and the displacements after it. Returns all steps taken.
     * @throws InputError if the last load factor is reached already.
     * @throws NumericalFailure if a step would be smaller than allowed, or from
     * IncrementalElasticity::step(); the state is then that of the last step.
     */
    std::vector<IncrementalStep>
    run(const IncrementalSteps &steps,
        const std::function<void(const IncrementalStep &, const Vector &)>
          &after_step = {});

    /// Load factor of the last step taken; 0 in the unloaded state [-].
    double
    load_factor() const;

  private:
    IncrementalElasticity *elasticity;
    double                 reached = 0.;
  };
} // namespace NMM

#endif
