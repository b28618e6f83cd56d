#ifndef nmm_analysis_simulation_h
#define nmm_analysis_simulation_h

#include <nmm/analysis/contact_model.h>
#include <nmm/analysis/equilibrium.h>
#include <nmm/analysis/motion.h>
#include <nmm/analysis/strength_reduction.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/dynamics/step_control.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/solid.h>

#include <functional>
#include <memory>
#include <optional>

/**
 * @defgroup analysis Analysis
 *
 * What is done with a solid: equilibrium under growing load, relaxation to rest, motion in time, stages of
 * an excavation, and the search for a factor of safety. Whatever a scene can ask for is an object here.
 *
 * **In**: a Solid, and what acts on it (SimulationParameters). **Out**: displacements and other parts of
 * the state, after each step (Simulation::observe()) and at the end.
 *
 * | file (in nmm/analysis) | job |
 * |---|---|
 * | simulation.h | one solid and its state, through any sequence of analyses |
 * | equilibrium.h | load steps by Newton's method, with contact, in stages |
 * | motion.h | the equations of motion, and their integrator |
 * | strength_reduction.h | the factor of safety |
 * | contact_model.h | the contact of a solid, and the account of its accepted states |
 * | further_terms.h | force terms beside solid and contact |
 *
 * Order of calls:
 * @code
 * const Solid solid(geometry, mesh, MPI_COMM_WORLD);
 * Simulation  simulation(solid, parameters);
 * simulation.observe([&](const Simulation &now) { print(now.load_factor()); });
 * simulation.equilibrate(LoadSteps::equal(10));
 * simulation.apply(excavation);                  // a StageChange
 * simulation.equilibrate();
 * simulation.advance(1., steps);                 // one second of motion
 * @endcode
 */

namespace NMM
{
  /// What acts on a solid, and how its equations are solved.
  struct SimulationParameters
  {
    /// Materials, loads and supports.
    ElasticityProblem problem;
    /// The theory of strains.
    Kinematics kinematics = Kinematics::small;
    /// The contact of faces with each other and with obstacles; empty: they do not touch.
    std::optional<ContactSetup> contact;
    /// Loads and supports as functions of time, in motion.
    Loading loading;
    /// Damping of the motion.
    RayleighDamping damping;
    /// The scheme of the motion; empty: energy_momentum() with contact or finite kinematics, else
    /// newmark().
    std::optional<TimeScheme> scheme;
    /// Force terms beside solid and contact, such as springs. They are made anew for each kind of
    /// analysis, and what they remember is carried over.
    std::vector<TermMaker> further_terms;
    /// Newton's method; what is left at its default depends on the kind of analysis, see
    /// newton_at_rest() and newton_in_motion().
    NewtonParameters newton;
  };


  /**
   * A solid, what acts on it, and its present state, which begins undeformed. Each analysis goes on from
   * the state that the one before has left: displacements and velocities, what contact and materials
   * remember, and the blocks that were removed.
   *
   * All functions are collective. Lifetime: the solid must outlive this object.
   */
  class Simulation
  {
  public:
    /// Displacements and velocities of unknowns, two for each cover.
    using Vector = ForceTerm::Vector;

    /// @throws InputError for a problem that does not fit the solid, and as the constructor of
    /// ContactModel.
    Simulation(const Solid &solid, SimulationParameters parameters);
    ~Simulation();

    /// Call @p observer after each accepted step of all analyses that follow. What it throws ends the
    /// analysis.
    void
    observe(std::function<void(const Simulation &)> observer);

    /**
     * Take load steps to an equilibrium. Before the first one of an undeformed solid, load factors grow
     * from 0; after a StageChange they are those of the stage, from 0 to 1. In a solid that has moved,
     * loads are complete, and one step to the load factor 1 finds the equilibrium next to its state.
     * @throws NumericalFailure if there is no equilibrium, naming the block that moves. @throws
     * InputError after a motion or relaxation of materials that yield, or with removed blocks.
     */
    void
    equilibrate(const LoadSteps &steps = LoadSteps());

    /**
     * Let the solid come to rest by dynamic relaxation, see relax(). Loads, supports and obstacles are those of
     * t = 0. @throws NumericalFailure if it does not come to rest, and InputError if a stage
     * holds a part of the forces on removed blocks.
     */
    RelaxationReport
    relax(const RelaxationParameters &parameters);

    /// Let the solid move for @p duration [s] in steps by @p steps. Velocities begin with 0 after an
    /// equilibrium. @throws NumericalFailure as StepControl::advance(), and InputError as
    /// relax().
    void
    advance(double duration, const StepControlParameters &steps);

    /// Begin a stage: the tractions on removed blocks are released by the load steps that follow. The
    /// state must be that of equilibrate(). @throws as StaticSystem::begin_stage().
    void
    apply(const StageChange &change);

    /**
     * Find the factor of safety, each of whose trials starts from the present state, see
     * StrengthReduction. The state does not change. @p trial holds the steps of a trial, with
     * the displacement above which blocks do not stand.
     */
    SafetyFactor
    find_safety_factor(const RelaxationParameters   &trial,
                       const SafetyFactorParameters &search = {});

    /// The solid given to the constructor.
    const Solid &
    solid() const;

    /// The problem given to the constructor.
    const ElasticityProblem &
    problem() const;

    /// The contact; null if faces do not touch.
    ContactModel *
    contact() const;

    /// Load factor of the last equilibrium [-].
    double
    load_factor() const;

    /// Time that the solid has moved [s].
    double
    time() const;

    /// The present displacements [m], of relevant unknowns.
    Vector
    displacement() const;

    /// The field of the present displacements, which does not change with the state.
    DisplacementField
    field() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
