#ifndef nmm_contact_assembly_statics_h
#define nmm_contact_assembly_statics_h

#include <nmm/contact/assembly/term.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <functional>
#include <memory>
#include <vector>

namespace NMM
{
  /// A load step with contact that converged.
  struct ContactStep : public LoadStep
  {
    /// Number of updates of the multipliers in the step; 0 for the penalty method.
    unsigned int n_augmentations = 0;
    /// Report of the contact at the end of the step.
    ContactReport contact;
    /// Energy dissipated in the step by friction and breaking bonds [J/m].
    double dissipated = 0.;
    /// Energy dissipated in the step by all other terms, such as inelastic materials [J/m].
    double dissipated_by_material = 0.;
  };


  /**
   * Static equilibrium of elastic bodies in contact under growing load. The load factor is also
   * the time at which the positions of obstacles are taken.
   *
   * In each step a semi-smooth Newton method solves for displacements and contact states (open,
   * stick, slip) together. Then candidate pairs and contact points are updated at the solution
   * and, with a penetration tolerance, multipliers, too. This is repeated until residual and
   * penetration are below their tolerances. All loops are bounded: a step converges, or it is
   * halved, with the reason.
   *
   * An initial stress of joints that is out of balance without loads is released with the load
   * factor, see StaticSystem.
   *
   * Order of calls: the constructor, run(), then solution().
   * Lifetime: the solid, the contact and all other terms must outlive this object.
   */
  class ContactStatics
  {
  public:
    /// Displacements, see NonlinearSystem.
    using Vector = NonlinearSystem::Vector;

    /// Solver for @p solid with the forces of @p contact, both on the same covers, and of @p others,
    /// such as springs.
    ContactStatics(SolidTerm              &solid,
                   Contact                &contact,
                   const NewtonParameters &newton = default_newton_parameters(),
                   const std::vector<ForceTerm *> &others = {});
    ~ContactStatics();

    /// Newton parameters for contact: up to 25 iterations, always with a line search, and no
    /// criterion on the energy.
    static NewtonParameters
    default_newton_parameters();

    /// Continue from the displacements @p u of owned unknowns [m] and the history of contact that a
    /// solid had at @p load_factor before it was cut further, see NonlinearStatics::continue_from()
    /// and carry_history(). The load factor must be positive.
    void
    continue_from(double                load_factor,
                  const Vector         &u,
                  const ContactHistory &history);

    /// Apply the load in @p steps, see NonlinearStatics::run(), and call @p after_step after each
    /// one that converged. @throws InputError for blocks that overlap an obstacle before the first
    /// step.
    std::vector<ContactStep>
    run(const LoadSteps &steps,
        const std::function<void(const ContactStep &, const Vector &)>
          &after_step = {});

    /// Begin a stage at the last solution, see NonlinearStatics::begin_stage(). Contact between removed
    /// blocks and others ends.
    void
    begin_stage(const StageChange &change, double end);

    /// Displacements after the last step that converged [m], locally relevant.
    const Vector &
    solution() const;

    /// Forces out of balance in the undeformed state with all loads [N/m], on owned unknowns. Empty
    /// before run(), and if no faces begin with an initial stress.
    const Vector &
    initial_forces() const;

    /// The load step that was tried last, see NonlinearStatics::last_attempt().
    const LoadStep &
    last_attempt() const;

    /// Displacements at which the last search for an equilibrium failed [m], locally relevant, see
    /// NonlinearStatics::last_iterate().
    const Vector &
    last_iterate() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
