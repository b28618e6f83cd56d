#ifndef nmm_analysis_motion_h
#define nmm_analysis_motion_h

#include <nmm/analysis/contact_model.h>
#include <nmm/analysis/further_terms.h>
#include <nmm/dynamics/time_integrator.h>
#include <nmm/mechanics/absorbing_term.h>
#include <nmm/mechanics/solid.h>
#include <nmm/mechanics/solid_term.h>

#include <memory>
#include <optional>

namespace NMM
{
  /// How a solid moves; see Motion.
  struct MotionParameters
  {
    /// The theory of strains.
    Kinematics kinematics = Kinematics::small;
    /// The time scheme.
    TimeScheme scheme = TimeScheme::energy_momentum();
    /// Loads and supports as functions of time.
    Loading loading;
    /// Rayleigh damping.
    RayleighDamping damping;
    /// When contact looks for nearest faces.
    ContactUpdate contact_update = ContactUpdate::every_iteration;
    /// Whether obstacles are removed when their time has come, and accepted states of contact are
    /// taken into account, see AccountedContact.
    bool is_accounted = true;
    /// Whether absorbing boundaries absorb, see AbsorbingTerm. Otherwise they are held, as in a
    /// motion that is a means to find rest.
    bool absorbs = false;
    /// Newton's method, see newton_in_motion().
    NewtonParameters newton = TimeIntegrator::default_newton_parameters();
    /// Force terms beside solid and contact.
    std::vector<TermMaker> further_terms;
  };


  /**
   * The equations of motion of a solid, with contact if there is any, and the integrator that advances
   * them: StepControl takes steps with it, and relax() lets it come to rest. The state is that of
   * TimeIntegrator::initialize() until a caller sets another one.
   *
   * Lifetime: solid, problem and contact must outlive this object.
   */
  class Motion
  {
  public:
    /// @p contact is null for a solid whose faces do not touch. @throws InputError for materials
    /// without density, and as the constructors of SolidTerm and TimeIntegrator.
    Motion(const Solid             &solid,
           const ElasticityProblem &problem,
           MotionParameters         parameters,
           ContactModel            *contact = nullptr);

    /// Start at @p time [s] with the displacements @p u and velocities @p v, as
    /// TimeIntegrator::initialize(). What the supports of absorbing boundaries exert in this state
    /// stays as their static part. What materials remember must have been restored before.
    void
    start(const ForceTerm::Vector &u,
          const ForceTerm::Vector &v,
          double                   time = 0.);

    /// Begin again with an undeformed solid, and with the contact that the model has now, such as one of
    /// reduced strength. What materials remember is forgotten.
    void
    begin_anew();

    /// Let the contact be made again, by ContactModel::begin_anew(): the equations that refer to it are
    /// destroyed until begin_anew() is called.
    void
    release_contact();

    /// Steps in time, and the state.
    TimeIntegrator &
    integrator() const
    {
      return *time_integrator;
    }

    /// The forces of the solid.
    SolidTerm &
    solid_term() const
    {
      return *term;
    }

    /// The further terms.
    FurtherTerms &
    further_terms() const
    {
      return *further;
    }

    /// The account of contact; null without one.
    AccountedContact *
    contact_account() const
    {
      return account.get();
    }

    /// Displacements of the present state [m], locally relevant.
    ForceTerm::Vector
    displacement() const;

    /// An owned vector of zeros.
    ForceTerm::Vector
    zero() const;

    /// The parameters given to the constructor.
    const MotionParameters &
    parameters() const
    {
      return given;
    }

  private:
    void
    make_equations();

    /// Let absorbing boundaries exert what their supports do at the displacements @p u [m] and the
    /// time @p t [s].
    void
    hold_at_boundaries(const ForceTerm::Vector &u, double t);

    const Solid                          *solid;
    MotionParameters                      given;
    ContactModel                         *contact;
    std::unique_ptr<QuadratureCollection> mass_rules;
    std::unique_ptr<FiniteElasticity>     elasticity;
    std::unique_ptr<SolidTerm>            term;
    /// Null unless boundaries absorb.
    std::unique_ptr<AbsorbingTerm>    absorbing;
    std::unique_ptr<FurtherTerms>     further;
    std::unique_ptr<ContactTerm>      touch;
    std::unique_ptr<AccountedContact> account;
    std::unique_ptr<MechanicalModel>  model;
    std::unique_ptr<TimeIntegrator>   time_integrator;
  };


  /// The parameters @p given for time steps. With contact or materials that yield (@p is_rough) there are
  /// more iterations than by default, unless a number is given.
  NewtonParameters
  newton_in_motion(const NewtonParameters &given, bool is_rough);
} // namespace NMM

#endif
