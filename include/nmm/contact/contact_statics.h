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
   * Elasticity and contact as one system of equations: forces add, the tangent is
   * the sum. Without candidates it is the elasticity alone.
   *
   * Lifetime: both must outlive this object.
   */
  class ContactSystem : public NonlinearSystem
  {
  public:
    ContactSystem(NonlinearSystem &elasticity, Contact &contact);
    ~ContactSystem() override;

    Deformation
    assemble(const Vector &u,
             Tangent       tangent,
             const Vector *increment) override;

    const Vector &
    residual() const override;

    const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const override;

    bool
    tangent_is_symmetric() const override;

    double
    force_scale() const override;

    unsigned int
    pattern_version() const override;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };


  /// A load step with contact that converged.
  struct ContactStep : public LoadStep
  {
    unsigned int  n_augmentations = 0;
    ContactReport contact;
    /// Energy dissipated in the step by friction and breaking bonds, and by inelastic materials
    /// [J/m].
    double dissipated = 0., dissipated_by_material = 0.;
  };


  /**
   * Static equilibrium of elastic bodies in contact under growing load, obstacles
   * being where they are at the time that equals the load factor.
   *
   * Each step: Newton's method for displacements and contact states together
   * (points open, stick and slip as they come: a semi-smooth Newton method); then
   * candidates and divisions are found anew at the solution and, with a
   * penetration tolerance, multipliers are updated; again, until residual and penetration
   * are below their tolerances. All loops are bounded: a step converges, or
   * it is halved, with the reason.
   */
  class ContactStatics
  {
  public:
    using Vector = NonlinearSystem::Vector;

    ContactStatics(
      ElasticSystem          &elasticity,
      Contact                &contact,
      const NewtonParameters &newton = default_newton_parameters());
    ~ContactStatics();

    static NewtonParameters
    default_newton_parameters();

    /// See NonlinearStatics::run(). @throws InputError for blocks that overlap an
    /// obstacle before the first step.
    std::vector<ContactStep>
    run(const LoadSteps &steps,
        const std::function<void(const ContactStep &, const Vector &)>
          &after_step = {});

    /// Displacements [m], locally relevant.
    const Vector &
    solution() const;

    /// See NonlinearStatics.
    const LoadStep &
    last_attempt() const;

    /// See NonlinearStatics.
    const Vector &
    last_iterate() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
