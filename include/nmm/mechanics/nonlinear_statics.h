#ifndef nmm_mechanics_nonlinear_statics_h
#define nmm_mechanics_nonlinear_statics_h

#include <nmm/mechanics/elastic_system.h>
#include <nmm/solution/load_stepping.h>

#include <functional>
#include <memory>
#include <vector>

namespace NMM
{
  /**
   * How NonlinearStatics finds equilibrium in a step: by Newton's method for the system alone,
   * or with contact (ContactStatics).
   */
  class EquilibriumSearch
  {
  public:
    using Vector = NonlinearSystem::Vector;

    virtual ~EquilibriumSearch() = default;

    /**
     * From @p u to the equilibrium at the load factor of @p step, with the iterations into
     * @p step. @p change: how @p u was extrapolated, or null. Returns why there is none; empty:
     * it was found.
     */
    virtual std::string
    find(LoadStep &step, Vector &u, const Vector *change) = 0;

    /// The equilibrium at @p u is accepted.
    virtual void
    accept(const Vector & /*u*/)
    {
    }

    /// The equilibrium that was found, or was not, is given up.
    virtual void
    reject()
    {
    }

    /// What the user can do if there is no equilibrium.
    virtual std::string
    remedy() const = 0;
  };


  /**
   * Static equilibrium under growing load, step by step (take_load_steps()). A solution whose
   * displacement conditions or ties are missed by a good part of an element
   * (LoadSteps::max_jump) is none. Between steps, states of the material are accepted and
   * penalties adapted, see FiniteElasticity::adapt_penalties().
   *
   * Lifetime: the arguments must outlive this object.
   */
  class NonlinearStatics
  {
  public:
    using Vector = NonlinearSystem::Vector;

    /// Statics of a body in finite kinematics.
    explicit NonlinearStatics(FiniteElasticity       &elasticity,
                              const NewtonParameters &parameters = {});

    /// Statics of @p elasticity, in small or finite kinematics.
    explicit NonlinearStatics(ElasticSystem          &elasticity,
                              const NewtonParameters &parameters = {});

    /// Statics of @p elasticity, whose equilibria @p search finds.
    NonlinearStatics(ElasticSystem &elasticity, EquilibriumSearch &search);
    ~NonlinearStatics();

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

    /// Where the search for the last equilibrium that was not found ended [m], locally relevant:
    /// what moved furthest on the way there gives way.
    const Vector &
    last_iterate() const;

    /// Dissipated by the material in the step accepted last [J/m].
    double
    dissipated() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
