#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/dynamics/checkpoint.h>

#include <algorithm>
#include <analysis/mechanism.h>
#include <cmath>
#include <scene/dynamic_analysis.h>
#include <scene/fastest_turn.h>
#include <scene/static_start.h>
#include <scene/time_function.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    // This file has the set-up and the course of the run; dynamic_output.cc writes the results.
    using dealii::Point;
    using dealii::Tensor;
    using Stage = Progress::Stage;

    DynamicAnalysis::DynamicAnalysis(const Scene       &scene,
                                     Progress          &progress,
                                     const MPI_Comm     communicator,
                                     const std::string &restart)
      : SceneAnalysis(scene, progress, communicator, restart)
      , kind(scene.parameters().model.analysis)
    {
      if (scene.parameters().fracture.n_increments > 0)
      {
        growth = std::make_unique<GrowthInMotion>(scene.parameters().fracture);
        growth_table = &growth->table();
      }
    }


    void
    DynamicAnalysis::clear()
    {
      clear_equations();
      SceneAnalysis::clear();
    }


    void
    DynamicAnalysis::clear_equations()
    {
      velocity_field.reset();
      evaluator.reset();
      recovery.reset();
      field.reset();
      leaving.reset();
      motion.reset();
    }


    void
    DynamicAnalysis::make_system()
    {
      Stage system_stage(progress, "masses");
      make_integrator();
      if (probe_history)
      {
        // A solid that is cut again goes on from the state that it was in.
        probe_history->follow(solid->covers(),
                              *probes,
                              scene.parameters().probes);
        return;
      }
      probe_history = std::make_unique<ProbeHistory>(solid->covers(),
                                                     *probes,
                                                     scene.parameters().probes);
      set_first_state();
    }


    void
    DynamicAnalysis::make_integrator()
    {
      const SceneParameters &parameters = scene.parameters();
      MotionParameters       how;
      how.kinematics = parameters.model.kinematics;
      how.scheme =
        parameters.time.time_scheme(kind, how.kinematics, contact != nullptr);
      how.loading = scene.make_loading();
      how.absorbs = kind == Analysis::dynamics;
      if (kind == Analysis::relaxation)
        how.contact_update = update_in_relaxation(how.scheme);
      damping =
        scene.make_damping(*physical_mesh, problem, contact && has_friction());
      how.damping = damping;
      how.newton  = motion_newton_parameters(scene, progress);
      bolts       = SceneBolts::make(scene);
      if (bolts)
        how.further_terms = {bolts->maker()};
      joint_water = SceneJointWater::make(scene);
      if (joint_water)
        how.further_terms.push_back(
          joint_water->maker(/* is_at_rest = */ false));
      motion = std::make_unique<Motion>(*solid,
                                        problem,
                                        std::move(how),
                                        contact.get());
      make_leaving();
      if (parameters.time.sleep.speed > 0.)
        motion->integrator().let_blocks_sleep(parameters.time.sleep);
    }


    void
    DynamicAnalysis::set_first_state()
    {
      const SceneParameters &parameters = scene.parameters();
      if (continues_in_start())
      {
        if (contact)
          contact->hold_obstacles(true);
        make_relaxation();
        Checkpoint::read(restart, relaxing->motion.integrator());
        relaxing->continued_step = earlier_part->next_step_of_start;
        return;
      }
      if (!restart.empty())
      {
        Checkpoint::read(restart, motion->integrator());
        // A run that was killed before it wrote its final results can have reached the end time.
        AssertThrow(time() <= parameters.time.end_time * (1. + 1e-12),
                    InputError("the checkpoint '" + restart +
                                 "' is of t = " + std::to_string(time()) +
                                 " s, and the run ends at " +
                                 std::to_string(parameters.time.end_time) +
                                 " s",
                               "parameter 'Time/End time'",
                               "choose a later end to continue"));
      }
      else if (!parameters.initial_velocities.empty())
      {
        motion->integrator().initialize(motion->zero(), initial_velocity());
      }
      start_time = time();
    }


    InelasticTerms *
    DynamicAnalysis::inelastic_terms() const
    {
      return motion ? motion->solid_term().inelastic_terms() : nullptr;
    }


    bool
    DynamicAnalysis::has_friction() const
    {
      return contact->contact().parameters().has_friction();
    }


    DynamicAnalysis::Vector
    DynamicAnalysis::initial_velocity() const
    {
      struct Motion
      {
        unsigned int  block;
        RigidVelocity velocity;
      };
      std::vector<Motion> motions;
      for (const InitialVelocityParameters &parameters :
           scene.parameters().initial_velocities)
      {
        unsigned int block = invalid_index;
        if (parameters.block)
        {
          const unsigned int element =
            solid->manifold_mesh().find_element(*parameters.block);
          AssertThrow(element != invalid_index,
                      InputError("the point " + to_string(*parameters.block) +
                                   " lies in no block",
                                 "parameter 'Initial velocities/" +
                                   parameters.name + "/Block'",
                                 "give a point inside the block that moves"));
          block = solid->manifold_mesh().block(element);
        }
        motions.push_back(
          {block,
           {parameters.translation,
            parameters.angular_velocity,
            parameters.center ? *parameters.center : centroid(block)}});
      }
      return interpolate_velocity(solid->covers(),
                                  solid->constraints(),
                                  [&](const Point<2>    &x,
                                      const unsigned int block) {
                                    Tensor<1, 2> v;
                                    for (const Motion &motion : motions)
                                      if (motion.block == invalid_index ||
                                          motion.block == block)
                                        v += motion.velocity(x);
                                    return v;
                                  });
    }


    Point<2>
    DynamicAnalysis::centroid(const unsigned int block) const
    {
      // The entries are the area and its first moments.
      std::vector<double> local(3, 0.), sums(3);
      const auto [first, last] = solid->covers().locally_owned_elements();
      for (unsigned int element = first; element < last; ++element)
        if (block == invalid_index ||
            solid->manifold_mesh().block(element) == block)
        {
          const dealii::Quadrature<2> &rule = solid->quadrature().rule(element);
          const unsigned int cell = solid->manifold_mesh().cell(element);
          const double       area = solid->mathematical_mesh().cell_area(cell);
          for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const Point<2> x =
              solid->mathematical_mesh().reference_to_real(cell, rule.point(q));
            local[0] += rule.weight(q) * area;
            local[1] += rule.weight(q) * area * x[0];
            local[2] += rule.weight(q) * area * x[1];
          }
        }
      dealii::Utilities::MPI::sum(local, communicator, sums);
      return {sums[1] / sums[0], sums[2] / sums[0]};
    }


    bool
    DynamicAnalysis::has_start() const
    {
      return continues_in_start() ||
             (restart.empty() && kind == Analysis::dynamics &&
              (scene.parameters().time.start !=
                 TimeParameters::Start::undeformed ||
               !scene.parameters().stages.empty()));
    }


    bool
    DynamicAnalysis::continues_in_start() const
    {
      return earlier_part && earlier_part->next_step_of_start > 0.;
    }


    StartInput
    DynamicAnalysis::start_input()
    {
      return {scene, *solid, problem, contact.get(), progress};
    }


    void
    DynamicAnalysis::make_relaxation()
    {
      relaxing              = std::make_unique<StartRelaxation>(start_input());
      relaxing->before_step = [this](const double length) {
        const unsigned int step    = relaxing->motion.integrator().state().step;
        const bool         is_last = is_asked_to_stop(communicator);
        if (is_last || (step > 0 && is_checkpoint_due(step)))
          Checkpoint::write(relaxing->motion.integrator(),
                            checkpoint_file(),
                            part_to_save(length));
        if (is_last)
          stop();
      };
    }


    void
    DynamicAnalysis::run_start()
    {
      last_good = motion->integrator().state();
      // The checkpoint is that of the relaxation, not of the undeformed solid.
      can_be_saved = false;
      if (contact)
        contact->hold_obstacles(true);
      if (scene.parameters().time.start == TimeParameters::Start::relaxation &&
          !relaxing)
        make_relaxation();
      const Vector u = relaxing ? find_start(start_input(), *relaxing, start)
                                : find_start(start_input(), start);
      relaxing.reset();
      if (contact)
        contact->hold_obstacles(false);
      if (InelasticTerms *const terms = inelastic_terms())
        terms->restore_internal_state(start.material_state);
      motion->further_terms().restore(start.term_state);
      Vector v = motion->zero();
      if (!scene.parameters().initial_velocities.empty())
        v = initial_velocity();
      // This applies the releases at 0 s.
      motion->start(u, v);
      if (!start.removed_blocks.empty())
        motion->integrator().drop_blocks(start.removed_blocks);
      last_good    = motion->integrator().state();
      can_be_saved = true;
      write_first_state();
      if (scene.parameters().output.checkpoint_every > 0)
        write_checkpoint();
    }


    void
    DynamicAnalysis::solve()
    {
      if (damping.stiffness > 0. &&
          scene.parameters().time.damping.stiffness < 0.)
      {
        std::ostringstream line;
        line << "  damping: " << damping.stiffness
             << " s times the stiffness, since there is friction (set "
                "'Time/Stiffness damping' for another)";
        if (!has_start() && restart.empty() &&
            std::none_of(problem.materials.begin(),
                         problem.materials.end(),
                         [](const Material &material) {
                           return material.has_initial_stress();
                         }))
          line
            << "; loads act at once on blocks without stress, which may slip a "
               "little until they bear them ('Time/Start = equilibrium' begins "
               "at rest)";
        progress.message(line.str());
      }
      warn_of_flutter();
      try
      {
        if (has_start())
          run_start();
        Stage running(progress,
                      kind == Analysis::relaxation ? "relaxation" : "motion");
        stage = &running;
        if (kind == Analysis::relaxation)
          run_relaxation();
        else
          run_dynamics();
      }
      catch (const NumericalFailure &error)
      {
        recover();
        show();
        verify();
        explain_balance(error.message());
        throw;
      }
      catch (const Stopped &)
      {
        show();
        verify();
        throw;
      }
      if (balance_is_off())
        progress.message("  warning: " + balance_note());
      {
        Stage recovery_stage(progress, "stress recovery");
        show();
      }
      if (crack_tips)
        for (const std::string &line : crack_tips->description())
          progress.message("  " + line);
      is_solved = true;
    }


    void
    DynamicAnalysis::warn_of_flutter() const
    {
      if (kind != Analysis::dynamics || !contact || !has_friction() ||
          damping.stiffness > 0. ||
          scene.parameters().time.damping.stiffness >= 0. ||
          scene.parameters().time.scheme != TimeParameters::Scheme::newmark)
        return;
      progress.message(
        "  notice: the scheme 'newmark' keeps all vibrations, so that blocks "
        "hop on faces with friction, and what depends on slip counts only "
        "while they touch: leave 'Time/Scheme' out, choose 'generalized "
        "alpha', or set 'Time/Stiffness damping'");
    }


    void
    DynamicAnalysis::warn_of_turns(const double length)
    {
      // The trapezoidal and the conserving scheme turn a rigid body by 2 atan(a / 2) in a step in
      // which it turns by the angle a, 2 % too little for this one.
      constexpr double large = 0.5;

      if (has_warned_of_turns || kind != Analysis::dynamics ||
          scene.parameters().model.kinematics != Kinematics::finite)
        return;
      Vector v(displacement());
      v = velocity();
      const FastestTurn fastest =
        find_fastest_turn(solid->covers(), displacement(), v);
      if (fastest.rate * length <= large)
        return;
      has_warned_of_turns = true;
      std::ostringstream line;
      line.precision(3);
      line << "  notice: block " << fastest.block << " turns by "
           << fastest.rate * length << " rad in the step of " << length
           << " s to " << time()
           << " s: energies are right, but angles and positions are not "
              "resolved by such steps (choose a smaller 'Time/Initial step' or "
              "'Time/Largest step', for turns of at most "
           << large << " rad)";
      progress.message(line.str());
    }


    void
    DynamicAnalysis::recover()
    {
      motion->integrator().restore(last_good);
      // If the end of a step was being checked, the contact history is that of a refused state,
      // from which a run must not continue.
      if (kind == Analysis::dynamics && can_be_saved)
        write_checkpoint();
    }


    void
    DynamicAnalysis::run_dynamics()
    {
      const TimeParameters &parameters = scene.parameters().time;
      const StepControl     control(parameters.step_control());
      StepRecord            record;
      const auto            count_lost = [&]() {
        n_cuts += record.n_cuts;
        n_lost_iterations += record.n_lost_iterations;
      };
      last_good = motion->integrator().state();
      note_energies();
      if (growth)
        continue_growth();
      try
      {
        grow();
        while (
          control.advance(motion->integrator(), parameters.end_time, record))
        {
          count_lost();
          after_step(record);
          grow();
        }
      }
      catch (const NumericalFailure &)
      {
        count_lost();
        throw;
      }
      if (scene.parameters().output.checkpoint_every > 0)
        write_checkpoint();
    }


    void
    DynamicAnalysis::run_relaxation()
    {
      last_good = motion->integrator().state();
      // Amplitudes are those of prescribed displacements, which grow first.
      const double settled =
        motion->parameters().loading.amplitudes
          ? ramp_time(scene.parameters().relaxation.relaxation.step)
          : 0.;
      const RelaxationParameters parameters =
        scene.parameters().relaxation.bounded(
          solid->covers().manifold_mesh().physical_mesh());
      do
      {
        const Vector begin = motion->integrator().state().u;
        relaxation         = relax(motion->integrator(),
                           parameters,
                           [&](const StepRecord &record) {
                             n_cuts += record.n_cuts;
                             n_lost_iterations += record.n_lost_iterations;
                             after_step(record);
                           });
        if (relaxation.moves_away)
          refuse_motion(solid->covers(),
                        problem,
                        solid->quadrature(),
                        begin,
                        motion->integrator().state().u);
        // Those of the last step are of the solid before it was stopped.
        compute_tips_in_motion();
      } while (grow() || motion->integrator().state().closing.act_at(time()) ||
               time() < settled);
    }


    double
    DynamicAnalysis::time() const
    {
      return motion->integrator().state().time;
    }


    unsigned int
    DynamicAnalysis::step_number() const
    {
      return motion->integrator().state().step;
    }


    const DynamicAnalysis::Vector &
    DynamicAnalysis::velocity() const
    {
      return motion->integrator().state().v;
    }


    DynamicAnalysis::Vector
    DynamicAnalysis::displacement() const
    {
      return motion->displacement();
    }
  } // namespace internal
} // namespace NMM
