// The slope of jointed rock of applications/nmm/scenes/slope.prm, that slides when its
// wall is taken away.

#include <nmm/scene/scene.h>

#include "measure.h"
#include "timed_term.h"
#include <cmath>
#include <support/contact_bars/moving_bodies.h>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using namespace ContactBars;

      /// Centre of mass of all blocks, moved by [m].
      Tensor<1, 2>
      displacement_of_all(MovingBodies &bodies, const Vector &u)
      {
        Vector       one = bodies.zero(), product = one;
        Tensor<1, 2> sum;
        double       mass = 0.;
        for (unsigned int c = 0; c < 2; ++c)
        {
          one = 0.;
          for (const auto k : bodies.covers.locally_owned_covers())
            if (!bodies.constraints.is_constrained(2 * k + c))
              one(2 * k + c) = 1.;
          one.compress(dealii::VectorOperation::insert);
          bodies.solid->layout().mass->vmult(product, one);
          sum[c] = product * u;
          mass   = product * one;
        }
        return sum / mass;
      }


      Row
      run(const double step, const double end, Tensor<1, 2> &way)
      {
        Row row;
        row.name              = "slope";
        row.method            = "manifold mesh for each block";
        row.kinematics        = "finite";
        row.enforcement       = "penalty";
        row.stabilization     = "aggregation";
        row.solver            = "MUMPS";
        row.error_kind        = "way of the centre of mass";
        row.second_error_kind = "energy balance";
        row.degree            = 2;
        Stopwatch   watch;
        const Scene scene(NMM_SOURCE_DIR "/applications/nmm/scenes/slope.prm",
                          {"Contact/Friction angle=20"});
        std::vector<ObstacleRelease> releases;
        Bodies::Options              options;
        options.cell_size           = 10.;
        options.mesh_of_every_block = true;
        options.obstacles =
          scene.make_obstacles(PhysicalMesh(scene.make_geometry()), &releases);
        row.geometry = watch.lap();
        MovingBodies bodies(scene.make_geometry(), options);
        bodies.problem = scene.make_problem();
        row.covers     = watch.lap();
        bodies.start(scene.make_contact_parameters(bodies.surface,
                                                   bodies.problem),
                     Kinematics::finite);
        const Vector u = bodies.find_rest(1e-3, 1e-7);
        row.solution   = watch.lap();

        ContactTerm contact(bodies.solid->layout(), *bodies.contact, releases);
        TimedTerm   elastic(*bodies.solid), touch(contact);
        MechanicalModel all(bodies.solid->layout(), {&elastic, &touch});
        TimeIntegrator  integrator(all, TimeScheme::energy_momentum());
        integrator.initialize(u, bodies.zero());
        StepControlParameters steps;
        steps.initial_step = step;
        row.steps = row.iterations = row.factorization = 0.;
        double released = 0., balance = 0.;
        StepControl(steps).run(integrator, end, [&](const StepRecord &record) {
          row.steps += 1.;
          row.iterations +=
            record.report.n_iterations + record.n_lost_iterations;
          row.factorization +=
            record.report.factorization_time + record.report.substitution_time;
          const Account &account = integrator.account();
          balance                = std::max(balance, std::abs(account.balance));
          released               = std::max(released, account.kinetic);
          return true;
        });
        watch.lap();
        row.total        = watch.total();
        row.assembly     = elastic.forces.wall_time();
        row.contact      = touch.forces.wall_time();
        row.search       = touch.steps.wall_time();
        row.elements     = bodies.mesh.n_elements();
        row.unknowns     = 2. * (bodies.covers.n_covers() -
                             bodies.aggregation.cover_to_root.size());
        row.second_error = balance / released;
        way              = displacement_of_all(bodies, integrator.state().u) -
              displacement_of_all(bodies, u);
        return row;
      }
    } // namespace


    void
    measure_slope(Recorder &recorder)
    {
      if (recorder.size() != Size::full)
        return;
      constexpr double end = 0.25;
      Tensor<1, 2>     exact;
      recorder.record([&]() {
        Row row  = run(0.0025, end, exact);
        row.name = "slope reference";
        return row;
      });
      for (const double step : {0.02, 0.01, 0.005})
        recorder.record([&]() {
          Tensor<1, 2> way;
          Row          row = run(step, end, way);
          row.error        = (way - exact).norm() / exact.norm();
          return row;
        });
    }
  } // namespace Bench
} // namespace NMM
