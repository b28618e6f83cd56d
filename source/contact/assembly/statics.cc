#include <nmm/base/exceptions.h>
#include <nmm/contact/assembly/statics.h>

#include <algorithm>
#include <cmath>
#include <contact/contact.h>
#include <memory>

namespace NMM
{
  using namespace internal;
  using dealii::Tensor;

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
      ContactEquilibrium(StaticSystem           &system,
                         Contact                &contact,
                         const NewtonParameters &parameters)
        : system(&system)
        , contact(&contact)
        , newton(parameters)
        , parameters(parameters)
      {
      }

      StepFault
      find(LoadStep &step, Vector &u, const Vector *change) override;

      void
      accept(const Vector &) override
      {
        reached = found.load_factor;
      }

      void
      reject() override
      {
        contact->restore_history(history);
      }

      /// Data of the last step beside its LoadStep.
      ContactStep found;
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

      StaticSystem    *system;
      Contact         *contact;
      NewtonSolver     newton;
      NewtonParameters parameters;
      ContactHistory   history;
      unsigned int     n_breaks = 0;
    };


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
          solver.solve(*system,
                       system->solid().elasticity().affine_constraints(),
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
          (system->solid().kinematics() == Kinematics::small &&
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
    Data(SolidTerm               &solid,
         Contact                 &contact,
         const NewtonParameters  &newton,
         std::vector<ForceTerm *> others)
      : contact(&contact)
      , touch(solid.layout(), contact)
      , system(solid, with(touch, std::move(others)))
      , search(system, contact, newton)
      , statics(system, search)
    {
    }

    static std::vector<ForceTerm *>
    with(ContactTerm &touch, std::vector<ForceTerm *> others)
    {
      others.insert(others.begin(), &touch);
      return others;
    }

    /// The geometry of contact is linearized in small displacements, until the result is destroyed.
    std::shared_ptr<void>
    linearize_geometry()
    {
      contact->freeze_geometry(system.solid().kinematics() ==
                               Kinematics::small);
      return {nullptr, [this](void *) { contact->freeze_geometry(false); }};
    }

    Contact           *contact;
    ContactTerm        touch;
    StaticSystem       system;
    ContactEquilibrium search;
    NonlinearStatics   statics;
    ForceTerm::Vector  initial_forces;
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


  ContactStatics::ContactStatics(SolidTerm                      &solid,
                                 Contact                        &contact,
                                 const NewtonParameters         &newton,
                                 const std::vector<ForceTerm *> &others)
    : data(std::make_unique<Data>(solid, contact, newton, others))
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


  void
  ContactStatics::begin_stage(const StageChange &change, const double end)
  {
    const std::shared_ptr<void> linear = data->linearize_geometry();
    data->statics.begin_stage(change, end);
  }


  std::vector<ContactStep>
  ContactStatics::run(
    const LoadSteps                                                &steps,
    const std::function<void(const ContactStep &, const Vector &)> &after_step)
  {
    steps.check();
    Data                       &d      = *data;
    const std::shared_ptr<void> linear = d.linearize_geometry();
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
      if (!d.contact->parameters().initial_stress.empty())
      {
        d.initial_forces = d.system.initial_forces(solution(), 1.);
        d.system.hold_initial_forces(solution());
      }
    }
    std::vector<ContactStep> result;
    d.statics.run(steps, [&](const LoadStep &step, const Vector &u) {
      result.push_back(d.search.found);
      static_cast<LoadStep &>(result.back()) = step;
      result.back().dissipated               = d.touch.dissipated();
      result.back().dissipated_by_material =
        d.statics.dissipated() - d.touch.dissipated();
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


  const ContactStatics::Vector &
  ContactStatics::initial_forces() const
  {
    return data->initial_forces;
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
