#include <nmm/base/exceptions.h>
#include <nmm/contact/contact_statics.h>

#include <algorithm>
#include <cmath>
#include <contact/contact_data.h>
#include <memory>

namespace NMM
{
  using namespace internal;
  using dealii::Tensor;

  struct ContactSystem::Data
  {
    NonlinearSystem *elasticity;
    Contact         *contact;
    Vector           sum;
    double           scale = 0.;
  };


  ContactSystem::ContactSystem(NonlinearSystem &elasticity, Contact &contact)
    : data(std::make_unique<Data>())
  {
    data->elasticity = &elasticity;
    data->contact    = &contact;
    data->sum.reinit(contact.residual());
  }


  ContactSystem::~ContactSystem() = default;


  Deformation
  ContactSystem::assemble(const Vector &u,
                          const Tangent tangent,
                          const Vector *increment)
  {
    Data             &d     = *data;
    const Deformation state = d.elasticity->assemble(u, tangent, increment);
    if (state != Deformation::admissible)
      return state;
    d.scale = d.elasticity->force_scale();
    if (d.contact->is_idle())
      return state;
    const bool with_tangent = tangent != Tangent::none;
    d.contact->assemble(u, with_tangent);
    d.sum = d.elasticity->residual();
    d.sum += d.contact->residual();
    d.scale = std::hypot(d.scale, d.contact->residual().l2_norm());
    if (with_tangent)
      d.contact->add_to_tangent(d.elasticity->tangent());
    return state;
  }


  const ContactSystem::Vector &
  ContactSystem::residual() const
  {
    return data->contact->is_idle() ? data->elasticity->residual() : data->sum;
  }


  const dealii::TrilinosWrappers::SparseMatrix &
  ContactSystem::tangent() const
  {
    return data->contact->is_idle() ? data->elasticity->tangent()
                                    : data->contact->tangent();
  }


  bool
  ContactSystem::tangent_is_symmetric() const
  {
    return data->elasticity->tangent_is_symmetric() &&
           (data->contact->is_idle() || data->contact->tangent_is_symmetric());
  }


  double
  ContactSystem::force_scale() const
  {
    return data->scale;
  }


  unsigned int
  ContactSystem::pattern_version() const
  {
    return data->contact->is_idle() ? 0 : data->contact->pattern_version();
  }


  struct ContactStatics::Data
  {
    Data(ElasticSystem          &elasticity,
         Contact                &contact,
         const NewtonParameters &newton)
      : elasticity(&elasticity)
      , contact(&contact)
      , system(elasticity, contact)
      , newton(newton)
      , parameters(newton)
      , solution(elasticity.elasticity().initial_solution())
    {
    }

    bool
    try_step(double load_factor, Vector &u, ContactStep &step);

    ElasticSystem   *elasticity;
    Contact         *contact;
    ContactSystem    system;
    NewtonSolver     newton;
    NewtonParameters parameters;
    Vector           solution;
    double           load_factor = 0.;
    std::string      reason;
  };


  NewtonParameters
  ContactStatics::default_newton_parameters()
  {
    NewtonParameters parameters;
    parameters.max_iterations = 25;
    // later solutions of a step start next to their end, where the energy of the
    // first correction says nothing
    parameters.energy_tolerance = 1.;
    parameters.always_search    = true;
    return parameters;
  }


  ContactStatics::ContactStatics(ElasticSystem          &elasticity,
                                 Contact                &contact,
                                 const NewtonParameters &newton)
    : data(std::make_unique<Data>(elasticity, contact, newton))
  {
  }


  ContactStatics::~ContactStatics() = default;


  /// False, with the reason, if there is no solution.
  bool
  ContactStatics::Data::try_step(const double factor,
                                 Vector      &u,
                                 ContactStep &step)
  {
    const bool is_augmented = contact->parameters().penetration_tolerance > 0.;
    const double tolerance  = contact->parameters().penetration_tolerance;
    // candidates and divisions follow the solution, which moves little by them
    constexpr unsigned int n_plain = 3;
    // of the reach: small displacements by which neither candidates nor divisions nor, to first
    // order, forces change
    constexpr double   small_motion = 0.01;
    const unsigned int n =
      is_augmented ? contact->parameters().max_augmentations + 1 : n_plain;

    elasticity->set_load_factor(factor);
    contact->set_time(factor);
    step               = ContactStep();
    step.load_factor   = factor;
    double penetration = 0.;
    // joints break where they are stressed most, and what is left finds a new
    // equilibrium before others do
    constexpr double       broken_at_once = 0.9;
    constexpr unsigned int max_breaks     = 1000;
    unsigned int           n_breaks       = 0;
    const auto             breaks         = [&]() {
      const bool is_broken = contact->break_bonds(broken_at_once) > 0;
      n_breaks += is_broken;
      return is_broken && n_breaks <= max_breaks;
    };
    for (unsigned int i = 0; i < n; ++i)
    {
      contact->detect(u);
      const Vector       detected(u);
      const NewtonReport report =
        newton.solve(system, elasticity->elasticity().affine_constraints(), u);
      step.n_iterations += report.iterations.size();
      step.relative_residual = report.relative_residual;
      reason                 = report.reason;
      if (!report.converged)
        return false;
      step.contact = contact->report();
      // where all has moved far, there may be candidates now
      if (contact->is_idle() &&
          (i > 0 || contact->find_fault(u).reason.empty()))
        return true;
      if (contact->is_idle())
        continue;
      const bool is_settled =
        (i > 0 && report.iterations.front().relative_residual <=
                    100. * parameters.residual_tolerance) ||
        (elasticity->is_linearized() &&
         contact->largest_motion(u, detected) <=
           small_motion * contact->parameters().reach);
      if (!is_augmented)
      {
        if (!is_settled && i + 1 < n)
          continue;
        if (!breaks())
          return true;
        i = 0;
        continue;
      }
      penetration = contact->augment();
      if (penetration > tolerance)
      {
        ++step.n_augmentations;
        continue;
      }
      if (!breaks())
        return true;
      i = 0;
    }
    std::ostringstream text;
    text << "a penetration of " << penetration << " m is left after "
         << step.n_augmentations << " augmentations";
    reason = text.str();
    return false;
  }


  std::vector<ContactStep>
  ContactStatics::run(
    const LoadSteps                                                &steps,
    const std::function<void(const ContactStep &, const Vector &)> &after_step)
  {
    steps.check();
    Data &d = *data;
    d.contact->freeze_geometry(d.elasticity->is_linearized());
    const std::shared_ptr<void> thaw(nullptr, [&d](void *) {
      d.contact->freeze_geometry(false);
    });
    if (d.load_factor == 0.)
    {
      // rounding of arcs, in parts of the range that is looked at
      constexpr double tolerance = 1e-6;
      d.contact->set_time(0.);
      d.contact->surface().check_initial_overlap(tolerance *
                                                 d.contact->parameters().reach);
      // points stick where they are now, not where the first solution takes them
      d.contact->detect(d.solution);
      d.contact->assemble(d.solution, false);
      d.contact->accept();
    }
    std::vector<ContactStep> result;
    const double             least = steps.min_step * steps.load_factors.back();
    double                   length = steps.load_factors.back();
    unsigned int             n_cuts = 0, n_lost = 0;
    for (const double asked : steps.load_factors)
      while (d.load_factor < asked)
      {
        const double         remaining = asked - d.load_factor;
        const bool           is_last   = length >= remaining * (1. - 1e-9);
        const double         next = is_last ? asked : d.load_factor + length;
        Vector               u(d.solution);
        ContactStep          step;
        const ContactHistory history = d.contact->history();
        if (d.try_step(next, u, step))
        {
          step.dissipated = d.contact->accept();

          length        = std::max(length, 2. * (next - d.load_factor));
          d.solution    = u;
          d.load_factor = next;
          step.is_asked = is_last;
          step.n_cuts   = n_cuts;
          step.n_lost_iterations = n_lost;
          n_cuts = n_lost = 0;
          result.push_back(step);
          if (after_step)
            after_step(step, d.solution);
          continue;
        }
        d.contact->restore_history(history);
        ++n_cuts;
        n_lost += step.n_iterations;
        length = 0.5 * (next - d.load_factor);
        AssertThrow(
          length >= least,
          NumericalFailure("The load step would be smaller than allowed: " +
                             d.reason,
                           "load factor " + std::to_string(next),
                           "look at the last state that converged for what "
                           "gives way, or allow "
                           "smaller steps"));
      }
    return result;
  }


  const ContactStatics::Vector &
  ContactStatics::solution() const
  {
    return data->solution;
  }
} // namespace NMM
