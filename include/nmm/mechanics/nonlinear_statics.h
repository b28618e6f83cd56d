#ifndef nmm_mechanics_nonlinear_statics_h
#define nmm_mechanics_nonlinear_statics_h

#include <nmm/mechanics/static_system.h>
#include <nmm/solution/load_stepping.h>

#include <functional>
#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The interface by which NonlinearStatics finds equilibrium in a step: by Newton's method for
   * the system alone, or with contact (ContactStatics). Order of calls: find(), then accept() or
   * reject().
   */
  class EquilibriumSearch
  {
  public:
    /// See NonlinearSystem::Vector.
    using Vector = NonlinearSystem::Vector;

    virtual ~EquilibriumSearch() = default;

    /**
     * Find the equilibrium at the load factor of @p step, starting from @p u, and report the
     * iterations in @p step. @p change, or null, is the change by which @p u was extrapolated from
     * the last solution. Returns why no equilibrium was found, without a reason if it was.
     */
    virtual StepFault
    find(LoadStep &step, Vector &u, const Vector *change) = 0;

    /// Accept the equilibrium at @p u.
    virtual void
    accept(const Vector & /*u*/)
    {
    }

    /// Give up the result of the last find(), whether it found an equilibrium or not.
    virtual void
    reject()
    {
    }
  };


  /**
   * Static equilibrium of a solid and further force terms under growing load, step by step
   * (take_load_steps()). A solution that violates displacement conditions or ties by a considerable part of the size of an element
   * (LoadSteps::max_jump) is rejected. Between steps, material states are accepted and
   * penalties adapted, see FiniteElasticity::adapt_penalties().
   *
   * Lifetime: the arguments must outlive this object.
   */
  class NonlinearStatics
  {
  public:
    /// See NonlinearSystem::Vector.
    using Vector = NonlinearSystem::Vector;

    /// Statics of @p elasticity in finite kinematics, by Newton's method.
    explicit NonlinearStatics(FiniteElasticity       &elasticity,
                              const NewtonParameters &parameters = {});

    /// Statics of @p solid and @p others, such as springs, by Newton's method.
    explicit NonlinearStatics(SolidTerm                      &solid,
                              const NewtonParameters         &parameters = {},
                              const std::vector<ForceTerm *> &others     = {});

    /// Statics of @p system, with equilibria found by @p search.
    NonlinearStatics(StaticSystem &system, EquilibriumSearch &search);
    ~NonlinearStatics();

    /// Continue from the displacements @p u of owned unknowns [m], which were an equilibrium at
    /// @p load_factor before the solid was cut further. They need not be one now, and they need not
    /// satisfy the constraints of covers that are aggregated only since. For elastic materials.
    void
    continue_from(double load_factor, const Vector &u);

    /**
     * Take the given steps from the unloaded state, or from the last solution of an earlier call
     * if its load factor is below the first one requested. With an EquilibriumSearch of the
     * caller's, always continue from the last solution. @p after_step, if given, is called with
     * each converged step and its solution. Returns all converged steps.
     * @throws NumericalFailure if a step would be smaller than allowed, with
     * the load factor, the reason and the residuals of the last iterations; the solution
     * is then the last converged one.
     */
    std::vector<LoadStep>
    run(const LoadSteps &steps,
        const std::function<void(const LoadStep &, const Vector &)>
          &after_step = {});

    /// Begin a stage at the last solution: run() takes the next steps with @p change, which is complete
    /// at the load factor @p end. See StaticSystem::begin_stage() for errors.
    void
    begin_stage(const StageChange &change, double end);

    /// Displacements of the last converged step on locally relevant unknowns [m].
    const Vector &
    solution() const;

    /// Load factor of solution(); 0 before the first step [-].
    double
    load_factor() const;

    /// The step that was tried last. After a failure it tells how often the step was cut and
    /// the number of iterations lost.
    const LoadStep &
    last_attempt() const;

    /// Displacements at which the last rejected step ended, on locally relevant unknowns [m].
    /// The parts that have moved furthest from solution() are those that fail.
    const Vector &
    last_iterate() const;

    /// Energy dissipated by materials and all other terms in the last accepted step [J/m].
    double
    dissipated() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
