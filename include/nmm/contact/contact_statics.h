#ifndef nmm_contact_contact_statics_h
#define nmm_contact_contact_statics_h

#include <nmm/contact/contact.h>
#include <nmm/mechanics/elastic_system.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <functional>
#include <memory>
#include <vector>

namespace NMM
{
  /**
   * Elasticity and contact as one system of equations for Newton's method: forces and tangents
   * are added, the tangents in the matrix of the contact. If there are no candidate pairs, the system
   * is the elasticity alone.
   *
   * Lifetime: both must outlive this object.
   */
  class ContactSystem : public NonlinearSystem
  {
  public:
    /// Combine two systems with the same unknowns.
    ContactSystem(NonlinearSystem &elasticity, Contact &contact);

    Deformation
    assemble(const Vector &u,
             Tangent       tangent,
             const Vector *increment) override;

    /// Subtract a share of @p forces from the residual (owned unknowns [N/m]): what still holds an
    /// initial stress that is out of balance.
    void
    hold(const Vector &forces)
    {
      held_forces = forces;
    }

    /// Set that share, from 0 to 1 [-]; 0 initially.
    void
    set_held_share(const double share)
    {
      held_share = share;
    }

  private:
    NonlinearSystem *elasticity;
    Contact         *contact;
    Vector           sum;
    /// See hold(); empty if nothing is held.
    Vector held_forces;
    double held_share = 0.;
  };


  /// A load step with contact that converged.
  struct ContactStep : public LoadStep
  {
    /// Number of updates of the multipliers in the step; 0 for the penalty method.
    unsigned int n_augmentations = 0;
    /// Report of the contact at the end of the step.
    ContactReport contact;
    /// Energy dissipated in the step by friction and breaking bonds [J/m].
    double dissipated = 0.;
    /// Energy dissipated in the step by inelastic materials [J/m].
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
   * The forces r_0 by which an initial stress is out of balance without loads, such as at the wall
   * of an excavation, are released with the load factor lambda: the residual is
   * @f$ r(u) - \langle 1 - \lambda\rangle_+ r_0 @f$, since friction depends on the way. So a state
   * that is in balance with all loads stays at rest in all load steps.
   *
   * Order of calls: the constructor, run(), then solution().
   * Lifetime: the elasticity and the contact must outlive this object.
   */
  class ContactStatics
  {
  public:
    /// Displacements, see NonlinearSystem.
    using Vector = NonlinearSystem::Vector;

    /// Solver for @p elasticity with the forces of @p contact, both on the same covers.
    ContactStatics(
      ElasticSystem          &elasticity,
      Contact                &contact,
      const NewtonParameters &newton = default_newton_parameters());
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

    /// Displacements after the last step that converged [m], locally relevant.
    const Vector &
    solution() const;

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
