#include <nmm/base/exceptions.h>

#include <algorithm>
#include <scene/contact_loading.h>
#include <scene/mechanism.h>

namespace NMM
{
  namespace internal
  {
    ContactLoading::ContactLoading(
      const Scene                             &scene,
      const CoverSystem                       &covers,
      const QuadratureCollection              &quadrature,
      const dealii::AffineConstraints<double> &constraints,
      const ElasticityProblem                 &problem,
      ContactAnalysis                         &contact,
      Progress                                &progress)
      : scene(scene)
      , covers(covers)
      , quadrature(quadrature)
      , problem(problem)
      , contact(contact)
      , progress(progress)
      // Blocks without supports are allowed, since contact may hold them.
      , elasticity(covers, quadrature, constraints, problem, true)
      , solid(make_solid_at_rest(elasticity, Kinematics::small))
    {
    }


    void
    ContactLoading::begin_anew()
    {
      loading.reset();
      contact.begin_anew();
      loading = std::make_unique<ContactStatics>(
        *solid, contact.contact(), contact_newton_parameters(scene, progress));
      if (first.load_factor > 0.)
        loading->continue_from(first.load_factor,
                               first.displacement,
                               first.history);
      reached       = first.load_factor;
      friction_work = first.friction_work;
    }


    void
    ContactLoading::continue_from(LoadingState carried)
    {
      loading.reset();
      first = std::move(carried);
    }


    LoadingState
    ContactLoading::state() const
    {
      LoadingState state{reached,
                         Vector(covers.locally_owned_dofs(2),
                                covers.communicator()),
                         contact.contact().history(),
                         friction_work};
      state.displacement = loading->solution();
      return state;
    }


    const ContactLoading::Vector &
    ContactLoading::solve(const double load_factor)
    {
      const LoadStepParameters &given = scene.parameters().load_steps;
      LoadSteps                 steps;
      steps.load_factors       = {load_factor};
      steps.leaves_out_reached = false;
      const bool is_further =
        load_factor > reached
          ? reached >= first.load_factor
          : load_factor < reached && reached <= first.load_factor;
      if (!loading || !is_further)
      {
        begin_anew();
        if (first.load_factor == 0. &&
            (!given.load_factors.empty() ||
             given.n_steps != LoadStepParameters::default_n_steps))
        {
          steps.load_factors = given.load_steps().load_factors;
          const double scale = load_factor / steps.largest();
          for (double &factor : steps.load_factors)
            factor *= scale;
        }
      }
      constexpr double least_step = 0.5;
      steps.min_step              = std::max(given.min_step, least_step);
      // Small displacements are linear in the load as long as no contact state changes.
      steps.extrapolation_degree = 1;
      load(steps);
      const std::string fault = contact.find_deep_penetration();
      AssertThrow(fault.empty(),
                  NumericalFailure("There is " + fault,
                                   "load factor " + std::to_string(load_factor),
                                   "choose a higher 'Contact/Normal "
                                   "stiffness'"));
      if (load_factor == first.load_factor)
        first = state();
      return loading->solution();
    }


    void
    ContactLoading::load(const LoadSteps &steps)
    {
      try
      {
        loading->run(steps, [&](const ContactStep &step, const Vector &) {
          reached = step.load_factor;
          friction_work += step.dissipated;
          contact.take_state(friction_work);
          contact.remember_states();
        });
      }
      catch (const NumericalFailure &error)
      {
        if (loading->last_attempt().newton.converged)
        {
          loading.reset();
          throw;
        }
        const Mechanism mechanism = find_mechanism(
          *loading, *solid, contact.contact(), reached, quadrature);
        loading.reset();
        AssertThrow(false,
                    NumericalFailure(error.description() + ". " +
                                       mechanism.description,
                                     error.place(),
                                     "hold the block, or choose other laws of "
                                     "contact"));
      }
    }
  } // namespace internal
} // namespace NMM
