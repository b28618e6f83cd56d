#include <nmm/analysis/motion.h>
#include <nmm/mechanics/mass_matrix.h>

#include <limits>
#include <utility>
#include <vector>

namespace NMM
{
  NewtonParameters
  newton_in_motion(const NewtonParameters &given, const bool is_rough)
  {
    NewtonParameters newton   = TimeIntegrator::default_newton_parameters();
    newton.residual_tolerance = given.residual_tolerance;
    // Without contact more iterations would only allow steps to grow that should be cut.
    if (given.max_iterations != NewtonParameters().max_iterations || !is_rough)
      newton.max_iterations = given.max_iterations;
    newton.after_iteration = given.after_iteration;
    return newton;
  }


  Motion::Motion(const Solid             &solid,
                 const ElasticityProblem &problem,
                 MotionParameters         parameters,
                 ContactModel            *contact)
    : solid(&solid)
    , given(std::move(parameters))
    , contact(contact)
    , elasticity(std::make_unique<FiniteElasticity>(solid.covers(),
                                                    solid.quadrature(),
                                                    solid.constraints(),
                                                    problem,
                                                    /* may_float = */ true))
  {
    const unsigned int degree = 2 * solid.mathematical_mesh().degree();
    // the rules of the solid, if they are exact for masses
    const QuadratureCollection *rules = &solid.quadrature();
    if (solid.quadrature_degree() != degree)
    {
      mass_rules = std::make_unique<QuadratureCollection>(
        solid.manifold_mesh(),
        degree,
        degree,
        solid.covers().locally_owned_elements());
      rules = mass_rules.get();
    }
    Loading loading = given.loading;
    if (given.absorbs)
      for (const Release &release : releases_of_absorbing(problem))
        loading.releases.push_back(release);
    term = make_solid(*elasticity,
                      given.kinematics,
                      loading,
                      make_mass_matrix(*elasticity, *rules));
    if (given.absorbs && has_absorbing_boundary(problem))
      absorbing = std::make_unique<AbsorbingTerm>(solid.covers(),
                                                  term->layout(),
                                                  problem,
                                                  loading.amplitudes,
                                                  given.damping);
    if (given.damping.mass > 0. || given.damping.stiffness > 0.)
      term->damp(given.damping, given.scheme.is_conserving);
    further = std::make_unique<FurtherTerms>(given.further_terms,
                                             solid,
                                             term->layout());
    make_equations();
  }


  void
  Motion::make_equations()
  {
    std::vector<ForceTerm *> terms = {term.get()};
    if (contact != nullptr && given.is_accounted)
    {
      account = std::make_unique<AccountedContact>(term->layout(),
                                                   *contact,
                                                   given.contact_update);
      account->append_to(terms);
    }
    else if (contact != nullptr)
    {
      touch = std::make_unique<ContactTerm>(term->layout(),
                                            contact->contact(),
                                            std::vector<ObstacleRelease>(),
                                            given.contact_update);
      terms.push_back(touch.get());
    }
    if (absorbing)
    {
      hold_at_boundaries(zero(), 0.);
      terms.push_back(absorbing.get());
    }
    for (ForceTerm *const other : further->pointers())
      terms.push_back(other);
    model = std::make_unique<MechanicalModel>(term->layout(), terms);
    time_integrator =
      std::make_unique<TimeIntegrator>(*model, given.scheme, given.newton);
  }


  void
  Motion::hold_at_boundaries(const ForceTerm::Vector &u, const double t)
  {
    if (!absorbing)
      return;
    ForceTerm::Vector relevant(term->layout().locally_owned,
                               term->layout().locally_relevant,
                               solid->covers().communicator());
    relevant = u;
    // the releases of these supports are in effect before any other event
    Presence presence;
    presence.events_passed = -std::numeric_limits<double>::infinity();
    term->set_presence(presence);
    ForceTerm::Vector forces = term->residual_at(relevant, t);
    presence.events_passed   = std::numeric_limits<double>::lowest();
    term->set_presence(presence);
    forces -= term->residual_at(relevant, t);
    absorbing->hold(forces);
  }


  void
  Motion::start(const ForceTerm::Vector &u,
                const ForceTerm::Vector &v,
                const double             time)
  {
    hold_at_boundaries(u, time);
    time_integrator->initialize(u, v, time);
  }


  void
  Motion::release_contact()
  {
    time_integrator.reset();
    model.reset();
    account.reset();
    touch.reset();
  }


  void
  Motion::begin_anew()
  {
    release_contact();
    if (InelasticTerms *const inelastic = term->inelastic_terms())
      inelastic->forget_states();
    further->forget();
    make_equations();
  }


  ForceTerm::Vector
  Motion::displacement() const
  {
    ForceTerm::Vector relevant(term->layout().locally_owned,
                               term->layout().locally_relevant,
                               solid->covers().communicator());
    relevant = time_integrator->state().u;
    return relevant;
  }


  ForceTerm::Vector
  Motion::zero() const
  {
    return ForceTerm::Vector(term->layout().locally_owned,
                             solid->covers().communicator());
  }
} // namespace NMM
