#ifndef nmm_analysis_equilibrium_h
#define nmm_analysis_equilibrium_h

#include <nmm/analysis/contact_model.h>
#include <nmm/analysis/further_terms.h>
#include <nmm/contact/assembly/statics.h>
#include <nmm/mechanics/solid.h>

#include <functional>
#include <memory>

namespace NMM
{
  /// How the equilibrium of a solid is found; see Equilibrium.
  struct EquilibriumParameters
  {
    /// The theory of strains.
    Kinematics kinematics = Kinematics::small;
    /// Amplitudes that loads and prescribed displacements have at the load factor 1; empty: all 1.
    LoadAmplitudes full;
    /// Newton's method. With contact, materials that yield or further terms, values that are left at their defaults
    /// are those of ContactStatics.
    NewtonParameters newton;
    /// Force terms beside solid and contact.
    std::vector<TermMaker> further_terms;
  };


  /**
   * Static equilibrium of a solid under loads that grow with the load factor, by Newton's method, with
   * contact if there is any, and in stages. Loads grow in proportion to the load factor until the
   * first stage begins. From then on they keep their size, unless StageChange::loads changes them.
   *
   * With contact each accepted step is taken into account by ContactModel::take_state().
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class Equilibrium
  {
  public:
    /// See NonlinearSystem::Vector.
    using Vector = NonlinearSystem::Vector;

    /// @p contact is null for a solid whose faces do not touch. @throws NumericalFailure if nothing
    /// holds a block and there is no contact.
    Equilibrium(const Solid                 &solid,
                const ElasticityProblem     &problem,
                const EquilibriumParameters &parameters = {},
                ContactModel                *contact    = nullptr);
    ~Equilibrium();

    /**
     * Take the load @p steps, and call @p after_step with each one that converged and its
     * displacements. @throws NumericalFailure if there is no equilibrium, naming the block that
     * moves, and for a penetration that is too deep.
     */
    void
    run(const LoadSteps &steps,
        const std::function<void(const ContactStep &, const Vector &)>
          &after_step = {});

    /// Begin a stage at the last solution: @p change is complete where the load factor has grown by 1.
    /// @throws as StaticSystem::begin_stage(), and NumericalFailure if a block loses its last support
    /// and there is no contact and no further term.
    void
    begin_stage(const StageChange &change);

    /// Take the load @p steps to the first equilibrium, and in each of @p stages those steps again, whose
    /// load factors follow those of the stage before. @p begin is called with the number of each
    /// stage before it begins. @throws as run() and begin_stage().
    void
    run_stages(LoadSteps                       steps,
               const std::vector<StageChange> &stages,
               const std::function<void(const ContactStep &, const Vector &)>
                                                       &after_step,
               const std::function<void(unsigned int)> &begin = {});

    /// Begin again without loads and without any history.
    void
    begin_anew();

    /// Continue from the displacements @p u of owned unknowns [m], the @p history of contact, and the
    /// work of friction so far [J/m] that a solid had at @p load_factor before it was cut further. For
    /// elastic materials.
    void
    continue_from(double                load_factor,
                  const Vector         &u,
                  const ContactHistory &history       = {},
                  double                friction_work = 0.);

    /// Displacements after the last step that converged [m], locally relevant.
    const Vector &
    solution() const;

    /// Load factor of solution() [-].
    double
    load_factor() const;

    /// The problem with the loads of solution().
    ElasticityProblem
    problem_now() const;

    /// Forces by which the initial stress is out of balance in the undeformed state with all loads
    /// [N/m], on owned unknowns. To be called after run() with contact, where it is empty unless faces
    /// begin with an initial stress, and else before.
    Vector
    initial_forces();

    /// The load step that was tried last, see NonlinearStatics::last_attempt().
    const LoadStep &
    last_attempt() const;

    /// @{
    /// Energy that friction and that materials have dissipated so far [J/m].
    double
    friction_work() const;
    double
    material_work() const;
    /// @}

    /// The forces of the solid.
    SolidTerm &
    solid_term() const;

    /// The further terms.
    FurtherTerms &
    further_terms() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };


  /// The parameters @p given for an equilibrium, with those of ContactStatics instead of defaults if
  /// @p is_rough: with contact, or materials that yield.
  NewtonParameters
  newton_at_rest(const NewtonParameters &given, bool is_rough);
} // namespace NMM

#endif
