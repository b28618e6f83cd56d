#ifndef nmm_mechanics_incremental_statics_h
#define nmm_mechanics_incremental_statics_h

#include <nmm/mechanics/incremental_elasticity.h>
#include <nmm/solution/load_stepping.h>

#include <functional>
#include <limits>
#include <vector>

namespace NMM
{
  struct IncrementalSteps : public LoadSteps
  {
    /// No cover moves by more in a step [m]; the paper's control of the error of
    /// a step, which grows with the square of its rotation.
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
   * further is not taken but made smaller; the next one is chosen so that it
   * reaches nine tenths of the bound, at most up to the next load factor asked
   * for. Cost: a linear problem for each step tried.
   *
   * Lifetime: the elasticity must outlive this object.
   */
  class IncrementalStatics
  {
  public:
    using Vector = IncrementalElasticity::Vector;

    explicit IncrementalStatics(IncrementalElasticity &elasticity);

    /**
     * From the unloaded state, or from the last step of an earlier call if its load
     * factor is below the first one asked for. @p after_step is called with each
     * step and the displacements after it.
     * @throws NumericalFailure if a step would be smaller than allowed, or from
     * IncrementalElasticity::step(); the state is then that of the last step.
     */
    std::vector<IncrementalStep>
    run(const IncrementalSteps &steps,
        const std::function<void(const IncrementalStep &, const Vector &)>
          &after_step = {});

    double
    load_factor() const;

  private:
    IncrementalElasticity *elasticity;
    double                 reached = 0.;
  };
} // namespace NMM

#endif
