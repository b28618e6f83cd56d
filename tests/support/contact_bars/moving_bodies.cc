#include <nmm/mechanics/mass_matrix.h>

#include <deal.II/base/timer.h>

#include <support/contact_bars/moving_bodies.h>

namespace NMM
{
  namespace ContactBars
  {
    Run &
    Run::operator+=(const Run &other)
    {
      n_steps += other.n_steps;
      n_iterations += other.n_iterations;
      n_cuts += other.n_cuts;
      seconds += other.seconds;
      worst_balance = std::max(worst_balance, other.worst_balance);
      largest_penetration =
        std::max(largest_penetration, other.largest_penetration);
      if (failure.empty())
        failure = other.failure;
      return *this;
    }


    void
    MovingBodies::start(const ContactParameters &parameters,
                        const Kinematics         kinematics,
                        Loading                  loading)
    {
      integrator.reset();
      model.reset();
      touch.reset();
      solid.reset();
      Bodies::start(parameters, kinematics == Kinematics::small);
      make_model(
        make_solid(*elasticity, kinematics, std::move(loading), mass()));
    }


    std::shared_ptr<const ForceTerm::Matrix>
    MovingBodies::mass() const
    {
      return make_mass_matrix(*elasticity, quadrature);
    }


    void
    MovingBodies::make_model(std::unique_ptr<SolidTerm> solid_in)
    {
      solid = std::move(solid_in);
      touch = std::make_unique<ContactTerm>(solid->layout(), *contact);
      model = std::make_unique<MechanicalModel>(
        solid->layout(), std::vector<ForceTerm *>{solid.get(), touch.get()});
    }


    void
    MovingBodies::integrate(const TimeScheme       &scheme,
                            const Vector           &u,
                            const Vector           &v,
                            const RayleighDamping  &damping,
                            const NewtonParameters &newton)
    {
      solid->damp(damping, scheme.is_conserving);
      integrator = std::make_unique<TimeIntegrator>(*model, scheme, newton);
      // candidates are those of the state at rest otherwise
      model->restore_internal_state(model->internal_state());
      integrator->initialize(u, v);
    }


    void
    MovingBodies::integrate(const TimeScheme      &scheme,
                            const RayleighDamping &damping)
    {
      integrate(scheme, zero(), zero(), damping);
    }


    Vector
    MovingBodies::find_rest(const double step, const double tolerance)
    {
      integrate(TimeScheme::constant_acceleration());
      RelaxationParameters parameters;
      parameters.step      = step;
      parameters.tolerance = tolerance;
      relax(*integrator, parameters);
      return integrator->state().u;
    }


    Run
    MovingBodies::run(const double                 step,
                      const double                 end,
                      const std::function<bool()> &after_step)
    {
      Run                   result;
      StepControlParameters steps;
      steps.initial_step = step;
      steps.min_step     = 1e-3 * step;
      dealii::Timer timer;
      try
      {
        StepControl(steps).run(*integrator, end, [&](const StepRecord &record) {
          ++result.n_steps;
          result.n_iterations += record.report.n_iterations;
          result.n_cuts += record.n_cuts;
          result.worst_balance =
            std::max(result.worst_balance,
                     std::abs(integrator->account().balance));
          if (!contact->is_idle())
            result.largest_penetration =
              std::max(result.largest_penetration,
                       contact->report().largest_penetration);
          return !after_step || after_step();
        });
      }
      catch (const NumericalFailure &failure)
      {
        result.failure = failure.message();
      }
      result.seconds = timer.wall_time();
      return result;
    }


    Vector
    MovingBodies::values(const Field &field)
    {
      const auto &blocks = cover_to_block();
      Vector      result = zero();
      for (const auto k : covers.locally_owned_covers())
      {
        const Tensor<1, 2> value = field(covers.node(k), blocks[k]);
        for (unsigned int c = 0; c < 2; ++c)
          result(2 * k + c) = value[c];
      }
      result.compress(dealii::VectorOperation::insert);
      constraints.distribute(result);
      return result;
    }


    Vector
    MovingBodies::zero() const
    {
      return Vector(covers.locally_owned_dofs(2), covers.communicator());
    }


    const std::vector<unsigned int> &
    MovingBodies::cover_to_block()
    {
      if (known_blocks.empty())
      {
        known_blocks.assign(covers.n_covers(), 0);
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const unsigned int cover : covers.covers(e))
            known_blocks[cover] = mesh.block(e);
      }
      return known_blocks;
    }


    Tensor<1, 2>
    MovingBodies::weigh(const unsigned int block, const Vector &field)
    {
      const auto &blocks = cover_to_block();
      Vector      weighed(field);
      solid->layout().mass->vmult(weighed, field);
      constraints.set_zero(weighed);
      Tensor<1, 2> sum;
      for (const auto k : covers.locally_owned_covers())
        if (blocks[k] == block)
          for (unsigned int c = 0; c < 2; ++c)
            sum[c] += weighed(2 * k + c);
      return dealii::Utilities::MPI::sum(sum, covers.communicator());
    }


    double
    MovingBodies::moment(const unsigned int  block,
                         const Vector       &positions,
                         const Tensor<1, 2> &center,
                         const Vector       &velocity)
    {
      const auto &blocks = cover_to_block();
      Vector      momentum(velocity);
      solid->layout().mass->vmult(momentum, velocity);
      constraints.set_zero(momentum);
      double sum = 0.;
      for (const auto k : covers.locally_owned_covers())
        if (blocks[k] == block)
          sum += (positions(2 * k) - center[0]) * momentum(2 * k + 1) -
                 (positions(2 * k + 1) - center[1]) * momentum(2 * k);
      return dealii::Utilities::MPI::sum(sum, covers.communicator());
    }


    double
    MovingBodies::mass(const unsigned int block)
    {
      return weigh(block, values([](const Point<2> &, unsigned int) {
                     return Tensor<1, 2>({1., 0.});
                   }))[0];
    }


    Tensor<1, 2>
    MovingBodies::displacement(const unsigned int block)
    {
      return weigh(block, integrator->state().u) / mass(block);
    }


    Tensor<1, 2>
    MovingBodies::velocity(const unsigned int block)
    {
      return weigh(block, integrator->state().v) / mass(block);
    }


    double
    MovingBodies::angular_velocity(const unsigned int block)
    {
      const double        m        = mass(block);
      const Vector       &at_rest  = *solid->layout().reference_positions;
      const Tensor<1, 2>  center   = weigh(block, at_rest) / m;
      Vector              position = at_rest;
      const DynamicState &state    = integrator->state();
      position += state.u;
      const Vector turn = values([&](const Point<2> &x, unsigned int) {
        return Tensor<1, 2>({-(x[1] - center[1]), x[0] - center[0]});
      });
      return moment(block, position, weigh(block, position) / m, state.v) /
             moment(block, at_rest, center, turn);
    }


    Tensor<1, 2>
    MovingBodies::value_at(const Vector &owned, const Point<2> &x)
    {
      const unsigned int element = mesh.find_element(x);
      AssertThrow(element != invalid_index,
                  dealii::ExcMessage("not in the solid"));
      const Point<2> xi =
        mesh.mathematical_mesh().real_to_reference(mesh.cell(element), x);
      return DisplacementField(covers, problem, relevant(owned))
        .displacement(element, xi);
    }


    Tensor<1, 2>
    MovingBodies::force_of(const std::string &master) const
    {
      Tensor<1, 2> force;
      for (const ContactPoint &point : contact->points())
        if (point.state != ContactState::open &&
            surface.name(point.master) == master)
        {
          const Tensor<1, 2> tangent({-point.normal[1], point.normal[0]});
          force += point.weight *
                   (point.pressure * point.normal - point.shear * tangent);
        }
      return dealii::Utilities::MPI::sum(force, covers.communicator());
    }
  } // namespace ContactBars
} // namespace NMM
