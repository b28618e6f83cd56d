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

  ContactSystem::ContactSystem(NonlinearSystem &elasticity, Contact &contact)
    : elasticity(&elasticity)
    , contact(&contact)
    , sum(contact.residual())
  {
  }


  Deformation
  ContactSystem::assemble(const Vector &u,
                          const Tangent tangent,
                          const Vector *increment)
  {
    const Deformation state = elasticity->assemble(u, tangent, increment);
    if (state != Deformation::admissible)
      return state;
    const AssembledSystem &elastic = elasticity->assembled();
    result                         = elastic;
    if (contact->is_idle() && held_forces.size() == 0)
      return state;
    sum             = *elastic.residual;
    result.residual = &sum;
    if (held_forces.size() > 0)
      sum.add(-held_share, held_forces);
    if (contact->is_idle())
      return state;
    const bool with_tangent = tangent != Tangent::none;
    contact->assemble(u, with_tangent);
    sum += contact->residual();
    if (with_tangent)
      contact->add_to_tangent(*elastic.tangent);
    result.force_scale =
      std::hypot(elastic.force_scale, contact->residual().l2_norm());
    result.force_rounding = contact->force_rounding();
    result.tangent        = &contact->tangent();
    result.is_symmetric =
      elastic.is_symmetric && contact->tangent_is_symmetric();
    result.pattern_version = contact->pattern_version();
    return state;
  }


  namespace internal
  {
    /**
     * Search for the equilibrium of a load step. Newton's method finds displacements and contact
     * states together. Then candidate pairs and contact points are updated at the solution and,
     * with a penetration tolerance, multipliers, too. This is repeated until nothing changes. A
     * step fails if faces, or obstacles that move with the load factor, pass through something on
     * the straight way to its solution.
     *
     * Where faces that touch open one after the other, |r| rises and falls for long, and Newton's
     * method takes that for cycles of contact states. The arms of a double cantilever open by a
     * wave length of a beam on the springs behind in each iteration: 26 iterations for arms of five
     * times their height, 51 for eleven. That is the same for all loads, so smaller steps do not
     * help; a second, patient search does, in which |r| need not fall.
     */
    class ContactEquilibrium : public EquilibriumSearch
    {
    public:
      ContactEquilibrium(ElasticSystem          &elasticity,
                         Contact                &contact,
                         const NewtonParameters &parameters)
        : elasticity(&elasticity)
        , contact(&contact)
        , system(elasticity, contact)
        , newton(parameters)
        , parameters(parameters)
      {
      }

      StepFault
      find(LoadStep &step, Vector &u, const Vector *change) override;

      void
      accept(const Vector &u) override
      {
        // Newton's method leaves contact out where nothing is near.
        if (contact->is_idle())
          contact->assemble(u, /* with_tangent = */ false);
        found.dissipated = contact->accept();
        reached          = found.load_factor;
        largest_reached  = std::max(largest_reached, reached);
      }

      void
      reject() override
      {
        contact->restore_history(history);
      }

      /// Data of the last step beside its LoadStep.
      ContactStep found;
      /// Hold the forces of the undeformed state @p u, to which contact has just been accepted, that
      /// are out of balance without loads.
      void
      hold_initial_forces(const Vector &u);

      /// Load factor of the last accepted step, at which the next one begins.
      double reached = 0.;

    private:
      /// The largest motion of a point of a face between two displacements [m].
      double
      find_largest_motion(const Vector &from, const Vector &to);

      StepFault
      find_by(NewtonSolver &solver,
              LoadStep     &step,
              Vector       &u,
              const Vector *change);

      bool
      break_bonds();

      ElasticSystem   *elasticity;
      Contact         *contact;
      ContactSystem    system;
      NewtonSolver     newton;
      NewtonParameters parameters;
      ContactHistory   history;
      unsigned int     n_breaks        = 0;
      double           largest_reached = 0.;
    };


    void
    ContactEquilibrium::hold_initial_forces(const Vector &u)
    {
      if (contact->parameters().initial_stress.empty())
        return;
      elasticity->set_load_factor(0.);
      (void)elasticity->assemble(u, Tangent::none, nullptr);
      Vector forces = elasticity->residual();
      if (!contact->is_idle())
        forces += contact->residual();
      system.hold(forces);
    }


    /// Break the bonds with the largest stress. The remaining ones get a new equilibrium before
    /// more bonds break.
    bool
    ContactEquilibrium::break_bonds()
    {
      constexpr double       broken_at_once = 0.9;
      constexpr unsigned int max_breaks     = 1000;
      const bool is_broken = contact->break_bonds(broken_at_once) > 0;
      n_breaks += is_broken;
      return is_broken && n_breaks <= max_breaks;
    }


    double
    ContactEquilibrium::find_largest_motion(const Vector &from,
                                            const Vector &to)
    {
      const std::vector<double> motions = contact->motions(from, to);
      return *std::max_element(motions.begin(), motions.end());
    }


    StepFault
    ContactEquilibrium::find(LoadStep &step, Vector &u, const Vector *change)
    {
      history = contact->history();
      const Vector start(u);
      StepFault    fault = find_by(newton, step, u, change);
      if (!step.newton.converged && step.n_cuts == 0)
      {
        NewtonParameters patient = parameters;
        patient.max_iterations *= 4;
        patient.stops_cycles = false;
        NewtonSolver patient_newton(patient);
        reject();
        u     = start;
        fault = find_by(patient_newton, step, u, change);
      }
      return fault;
    }


    StepFault
    ContactEquilibrium::find_by(NewtonSolver &solver,
                                LoadStep     &step,
                                Vector       &u,
                                const Vector *change)
    {
      const double tolerance    = contact->parameters().penetration_tolerance;
      const bool   is_augmented = tolerance > 0.;
      // Candidate pairs and divisions follow the solution, which they hardly change.
      constexpr unsigned int n_plain = 3;
      // Fraction of the reach: displacements that are smaller change neither candidate pairs nor
      // divisions nor, to first order, forces.
      constexpr double   small_motion = 0.01;
      const unsigned int n =
        is_augmented ? contact->parameters().max_augmentations + 1 : n_plain;

      // What has been released once stays so.
      system.set_held_share(
        std::max(0., 1. - std::max(largest_reached, step.load_factor)));
      found              = ContactStep();
      found.load_factor  = step.load_factor;
      n_breaks           = 0;
      double penetration = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        // Search at the end of the last step, not at the predicted displacements, and with obstacles
        // where they were then, so that the whole way of the step is looked at.
        Vector detected(u);
        if (i == 0 && change != nullptr)
          detected -= *change;
        contact->set_time(i == 0 ? reached : step.load_factor);
        contact->detect(detected);
        contact->set_time(step.load_factor);
        // Linearized geometry is that of the first assembly.
        if (i == 0 && change != nullptr && !contact->is_idle())
          contact->assemble(detected, /* with_tangent = */ false);
        step.newton =
          solver.solve(system,
                       elasticity->elasticity().affine_constraints(),
                       u,
                       i == 0 ? change : nullptr);
        step.n_iterations += step.newton.iterations.size();
        step.relative_residual = step.newton.relative_residual;
        if (!step.newton.converged)
          return {step.newton.reason};
        const StepFault crossing = contact->find_crossing(u);
        if (!crossing.reason.empty())
          return crossing;
        found.contact = contact->report();
        // If everything has moved far, there may be candidate pairs now.
        if (contact->is_idle() &&
            (i > 0 || contact->find_fault(u).reason.empty()))
          return {};
        if (contact->is_idle())
          continue;
        const bool is_settled =
          (i > 0 && step.newton.iterations.front().relative_residual <=
                      100. * parameters.residual_tolerance) ||
          (elasticity->is_linearized() &&
           find_largest_motion(detected, u) <=
             small_motion * contact->parameters().reach);
        if (!is_augmented)
        {
          if (!is_settled && i + 1 < n)
            continue;
          if (!break_bonds())
            return {};
          i = 0;
          continue;
        }
        penetration = contact->augment();
        if (penetration > tolerance)
        {
          ++found.n_augmentations;
          continue;
        }
        if (!break_bonds())
          return {};
        i = 0;
      }
      std::ostringstream text;
      text << "a penetration of " << penetration << " m is left after "
           << found.n_augmentations << " augmentations";
      return {text.str()};
    }
  } // namespace internal


  struct ContactStatics::Data
  {
    Data(ElasticSystem          &elasticity,
         Contact                &contact,
         const NewtonParameters &newton)
      : elasticity(&elasticity)
      , contact(&contact)
      , search(elasticity, contact, newton)
      , statics(elasticity, search)
    {
    }

    ElasticSystem     *elasticity;
    Contact           *contact;
    ContactEquilibrium search;
    NonlinearStatics   statics;
  };


  NewtonParameters
  ContactStatics::default_newton_parameters()
  {
    NewtonParameters parameters;
    parameters.max_iterations = 25;
    // Later solutions of a step start close to their end, where the energy of the first correction
    // is no measure.
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


  void
  ContactStatics::continue_from(const double          load_factor,
                                const Vector         &u,
                                const ContactHistory &history)
  {
    Assert(load_factor > 0., dealii::ExcMessage("Nothing is to be continued."));
    data->contact->restore_history(history);
    data->search.reached = load_factor;
    data->statics.continue_from(load_factor, u);
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
    if (d.statics.load_factor() == 0.)
    {
      // Rounding of arcs, as a fraction of the reach.
      constexpr double tolerance = 1e-6;
      d.contact->set_time(0.);
      d.contact->surface().check_initial_overlap(tolerance *
                                                 d.contact->parameters().reach);
      // Set the anchors at the initial positions, not where the first solution moves the points.
      d.contact->detect(solution());
      d.contact->assemble(solution(), false);
      d.contact->accept();
      d.search.hold_initial_forces(solution());
    }
    std::vector<ContactStep> result;
    d.statics.run(steps, [&](const LoadStep &step, const Vector &u) {
      result.push_back(d.search.found);
      static_cast<LoadStep &>(result.back()) = step;
      result.back().dissipated_by_material   = d.statics.dissipated();
      if (after_step)
        after_step(result.back(), u);
    });
    return result;
  }


  const ContactStatics::Vector &
  ContactStatics::solution() const
  {
    return data->statics.solution();
  }


  const LoadStep &
  ContactStatics::last_attempt() const
  {
    return data->statics.last_attempt();
  }


  const ContactStatics::Vector &
  ContactStatics::last_iterate() const
  {
    return data->statics.last_iterate();
  }
} // namespace NMM
