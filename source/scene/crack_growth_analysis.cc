#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/base/stop.h>
#include <nmm/contact/state/carried_history.h>
#include <nmm/mechanics/carried_covers.h>
#include <nmm/output/csv_series.h>

#include <algorithm>
#include <cmath>
#include <dynamics/checkpoint_file.h>
#include <limits>
#include <mechanics/nodal_values.h>
#include <mechanics/solid_hash.h>
#include <scene/crack_growth_analysis.h>
#include <scene/current_stress.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    using Stage = Progress::Stage;

    namespace
    {
      const std::string kind_of_checkpoint =
        "the growth of cracks in equilibrium";
    }

    void
    CrackGrowthAnalysis::make_system()
    {
      const bool is_restart = earlier_path && states.empty();
      if (is_restart && fingerprint() != earlier_path->fingerprint)
        refuse_checkpoint(
          "The checkpoint is of another mesh, geometry or material", restart);
      if (!has_load_path())
      {
        StaticAnalysis::make_system();
        return;
      }
      load_path = std::make_unique<LoadPath>(
        scene, *solid, problem, contact.get(), progress);
      if (former)
      {
        if (contact)
          contact->continue_from(
            former->first.contact->largest_penetration_so_far());
        carried = carry_over();
      }
      else if (is_restart && earlier_path->carried_factor > 0.)
      {
        carried = {earlier_path->carried_factor,
                   LoadingState::Vector(solid->covers().locally_owned_dofs(2),
                                        communicator),
                   earlier_path->history,
                   earlier_path->friction_work};
        require_in_checkpoint(earlier_path->displacement.size() ==
                                carried.displacement.size(),
                              "it has another number of unknowns");
        for (const auto i : carried.displacement.locally_owned_elements())
          carried.displacement(i) = earlier_path->displacement[i];
        carried.displacement.compress(dealii::VectorOperation::insert);
      }
      load_path->continue_from(carried);
    }


    LoadingState
    CrackGrowthAnalysis::carry_over() const
    {
      const auto &[before, state] = *former;
      LoadingState result;
      result.load_factor  = state.load_factor;
      result.displacement = CarriedCovers(before.solid->covers(),
                                          solid->covers(),
                                          solid->quadrature())
                              .carry(state.displacement);
      result.friction_work = state.friction_work;
      if (contact)
        result.history =
          carry_history(state.history,
                        before.contact->faces(),
                        contact->faces(),
                        contact->contact().parameters().slave_priority);
      return result;
    }


    bool
    CrackGrowthAnalysis::has_load_path() const
    {
      return scene.parameters().contact.is_present() ||
             scene.parameters().model.kinematics == Kinematics::finite;
    }


    bool
    CrackGrowthAnalysis::can_have_tip_covers() const
    {
      return !has_load_path();
    }


    ElasticityProblem
    CrackGrowthAnalysis::problem_now() const
    {
      return load_path ? load_path->equations().problem_now() : problem;
    }


    void
    CrackGrowthAnalysis::show(
      const dealii::TrilinosWrappers::MPI::Vector &solution)
    {
      StaticAnalysis::show(solution);
      if (load_path)
        evaluator = std::make_unique<FieldEvaluator>(
          *field,
          *recovery,
          problem,
          CurrentStress::of(load_path->equations().solid_term(),
                            solid->quadrature()));
    }


    void
    CrackGrowthAnalysis::clear()
    {
      load_path.reset();
      StaticAnalysis::clear();
    }


    std::uint64_t
    CrackGrowthAnalysis::fingerprint() const
    {
      Hash hash = hash_of_solid(solid->covers(), problem);
      for (const Material &material : problem.materials)
      {
        hash.add(material.toughness);
        hash.add(material.fracture_strength);
      }
      return hash.value();
    }


    std::vector<Increment>
    CrackGrowthAnalysis::earlier_increments()
    {
      if (restart.empty())
        return {};
      earlier_path.emplace();
      from_bytes(CheckpointFile::read(restart, communicator, kind_of_checkpoint)
                   .preparation,
                 *earlier_path);
      check(*earlier_path);
      for (const Increment &increment : earlier_path->increments)
        increments.add(increment);
      return earlier_path->increments;
    }


    void
    CrackGrowthAnalysis::check(const SavedPath &path)
    {
      check_increments(path.increments);
      require_in_checkpoint(!path.states.empty(), "it has no state");
      for (const State &state : path.states)
        require_in_checkpoint(state.probes.size() ==
                                path.states.back().probes.size(),
                              "states have other numbers of probes");
      require_in_checkpoint(are_finite(path.displacement) &&
                              std::isfinite(path.carried_factor) &&
                              std::isfinite(path.friction_work),
                            "the state before the last cut is not finite");
    }


    void
    CrackGrowthAnalysis::continue_path()
    {
      states     = earlier_path->states;
      n_unturned = earlier_path->n_unturned;
      states.pop_back();
      equilibrate();
      take_state();
      const State &saved = earlier_path->states.back();
      if (saved.probes.size() != states.back().probes.size())
        refuse_checkpoint("The checkpoint is of other probes", restart);
      // Rounding on another number of ranks and the search for the load with contact leave less.
      constexpr double tolerance = 2e-3;
      const double before = saved.load_factor, now = states.back().load_factor;
      if (std::abs(now - before) > tolerance * std::abs(before) ||
          std::isfinite(now) != std::isfinite(before))
        refuse_checkpoint("The load factor of the checkpoint is " +
                            std::to_string(before) +
                            " and that of the scene in the same state " +
                            std::to_string(now),
                          restart);
    }


    void
    CrackGrowthAnalysis::open_files()
    {
      if (earlier_path)
        continue_path();
      const bool is_continued = continues_in_folder();
      if (is_continued)
        series->resume(last_value());
      on_first_rank([&]() {
        if (is_continued)
          directory->resume();
        else
          directory->create();
      });
    }


    void
    CrackGrowthAnalysis::write_checkpoint() const
    {
      if (scene.parameters().output.checkpoint_every == 0)
        return;
      const SavedPath path{
        increments.increments(),
        states,
        n_unturned,
        state_fingerprint,
        carried.load_factor,
        carried.friction_work,
        of_all_ranks(std::vector<double>(carried.displacement.begin(),
                                         carried.displacement.end()),
                     communicator),
        carried.history};
      CheckpointFile{kind_of_checkpoint, to_bytes(path), {}}.write(
        checkpoint_file(), communicator);
    }


    void
    CrackGrowthAnalysis::equilibrate()
    {
      if (load_path)
      {
        equilibrate_on_path();
        return;
      }
      solve_problem();
      const double driven = find_growing_tips();
      // If no tip is driven, no load factor makes one grow.
      load_factor =
        driven > 0. ? 1. / driven : std::numeric_limits<double>::quiet_NaN();
    }


    void
    CrackGrowthAnalysis::equilibrate_on_path()
    {
      constexpr unsigned int most_trials = 20;
      constexpr double       tolerance   = 1e-3;
      // These are the load factor and the drive of the previous trial.
      std::optional<std::pair<double, double>> before;
      // The crack grows at a constant load first.
      const bool is_carried = carried.load_factor > 0.;
      double     factor     = is_carried ? carried.load_factor : 0.5;
      for (unsigned int i = 0; i < most_trials; ++i)
      {
        try
        {
          Stage stage(progress, "solution");
          show(load_path->solve(factor));
        }
        catch (const NumericalFailure &)
        {
          // With the longer crack the solid may not bear that load.
          if (i > 0 || !is_carried)
            throw;
          factor *= 0.5;
          continue;
        }
        const double driven = find_growing_tips();
        load_factor =
          driven > 0. ? factor : std::numeric_limits<double>::quiet_NaN();
        if (std::abs(driven - 1.) <= tolerance)
          return;
        // Contact states may differ much between loads that are far apart.
        constexpr double most_change = 4.;
        if (driven <= 0.)
        {
          // Cohesion may hold the faces together until the load is larger.
          constexpr unsigned int most_closed = 3;
          if (i == most_closed)
            return;
          factor *= most_change;
          continue;
        }
        double next = factor / driven;
        if (before && driven != before->second)
        {
          const double secant =
            (factor - before->first) / (driven - before->second);
          if (secant > 0.)
            next = factor + (1. - driven) * secant;
        }
        before = {factor, driven};
        factor =
          std::min(most_change * factor, std::max(factor / most_change, next));
      }
      AssertThrow(false,
                  NumericalFailure(
                    "No load factor was found at which a crack grows; the "
                    "last trial was " +
                      std::to_string(before->first) + ", with " +
                      std::to_string(before->second) +
                      " of the toughness at the tip",
                    "after " + std::to_string(states.size()) + " length(s)",
                    "choose another 'Fracture/Increment'"));
    }


    double
    CrackGrowthAnalysis::find_growing_tips()
    {
      const FractureParameters &parameters = scene.parameters().fracture;
      growing_tips =
        judge_tips(*crack_tips, parameters, problem, *physical_mesh);
      if (parameters.can_start_cracks(problem.materials))
        add_new_tips(
          growing_tips,
          *crack_tips,
          increments,
          parameters,
          problem,
          solid->covers(),
          load_path ? CurrentStress::in_material_axes(
                        field->on_all_ranks(),
                        load_path->equations().solid_term().elasticity(),
                        scene.parameters().model.kinematics)
                    : [u = field->on_all_ranks()](const unsigned int element,
                                                  const dealii::Point<2> &xi) {
                        return u.stress(element, xi);
                      });
      double most_driven = 0.;
      for (const GrowingTip &tip : growing_tips)
        most_driven = std::max(most_driven, tip.drive);
      const double least = (1. - parameters.tolerance) * most_driven;
      growing_tips.erase(std::remove_if(growing_tips.begin(),
                                        growing_tips.end(),
                                        [&](const GrowingTip &tip) {
                                          return tip.drive <= 0. ||
                                                 tip.drive < least;
                                        }),
                         growing_tips.end());
      return most_driven;
    }


    double
    CrackGrowthAnalysis::scale_of_fields() const
    {
      return load_path ? 1. : load_factor;
    }


    void
    CrackGrowthAnalysis::take_state()
    {
      const double scale = scale_of_fields();
      State        state;
      state.load_factor  = load_factor;
      state.crack_length = increments.grown_length();
      state.strain_energy =
        scene.parameters().model.kinematics == Kinematics::finite
          ? problem.thickness *
              load_path->equations().solid_term().strain_energy_at(
                load_path->equations().solution(),
                load_path->equations().load_factor())
          : scale * scale * small_strain_energy();
      const auto samples = probes->evaluate(solid->covers(), *evaluator);
      for (unsigned int i = 0; i < samples.size(); ++i)
        if (!scene.parameters().probes[probes->entries()[i].probe].is_line)
          for (unsigned int c = 0; c < 2; ++c)
            state.probes.push_back(
              samples[i] ? scale * samples[i]->displacement[c]
                         : std::numeric_limits<double>::quiet_NaN());
      states.push_back(std::move(state));
      if (scene.parameters().output.checkpoint_every > 0)
        state_fingerprint = fingerprint();
    }


    double
    CrackGrowthAnalysis::last_value() const
    {
      return states.empty() ? 0. : states.size() - 1.;
    }


    void
    CrackGrowthAnalysis::show_state()
    {
      const unsigned int every = scene.parameters().output.fields_every,
                         step  = states.size() - 1;
      if (every == 0 || step % every != 0)
        return;
      std::ostringstream description;
      description << step << " increment(s)";
      if (std::isfinite(states.back().load_factor))
        description << ", load factor " << states.back().load_factor;
      series->write(step / every,
                    step,
                    description.str(),
                    *evaluator,
                    sample_cracks().get());
    }


    void
    CrackGrowthAnalysis::solve()
    {
      const unsigned int n     = scene.parameters().fracture.n_increments,
                         every = scene.parameters().output.checkpoint_every;
      growth_table             = &increments;
      {
        Stage stage(progress, "crack growth");
        if (states.empty())
        {
          equilibrate();
          take_state();
        }
        write_tables();
        try
        {
          while (states.size() <= n && grow())
          {
            take_state();
            write_tables();
            show_state();
            if (every > 0 && (states.size() - 1) % every == 0)
              write_checkpoint();
            stage.update([&](double) {
              return std::to_string(states.size() - 1) + " of " +
                     std::to_string(n) + " increments";
            });
            stop_if_asked(communicator);
          }
        }
        catch (const NumericalFailure &)
        {
          write_checkpoint();
          throw;
        }
        catch (const Stopped &)
        {
          write_checkpoint();
          verify();
          throw;
        }
        write_checkpoint();
        stage.remark(std::to_string(states.size() - 1) + " increment(s)");
      }
      if (!end_reason.empty())
        progress.message("  crack growth ended: " + end_reason);
      if (n_unturned > 0)
        progress.message("  warning: the direction of " +
                         std::to_string(n_unturned) +
                         " increment(s) is off local symmetry by more than "
                         "0.001 rad, after as many turns as are made");
      for (const std::string &line : crack_tips->description())
        progress.message("  " + line);
      is_solved = true;
    }


    bool
    CrackGrowthAnalysis::grow()
    {
      if (growing_tips.empty())
      {
        const auto &tips = crack_tips->all_tips();
        end_reason       = tips.empty() ? "no crack tip is left"
                           : std::all_of(tips.begin(),
                                   tips.end(),
                                   [](const CrackTip &tip) {
                                     return tip.tied_curve != invalid_index;
                                   })
                             ? "all crack tips have arrived at interfaces"
                             : "no crack tip is open";
        return false;
      }
      std::vector<GrowingTip> tips     = std::move(growing_tips);
      const Geometry          before   = geometry;
      const unsigned int      n_blocks = physical_mesh->n_blocks();
      if (load_path)
      {
        // The state is that of equations which refer to the solid, so it is taken first.
        LoadingState state = load_path->state();
        former.emplace(release_solid(), std::move(state));
      }
      const std::shared_ptr<void> forget(nullptr,
                                         [this](void *) { former.reset(); });
      try
      {
        // Each turn reduces the residual by a factor of five and more.
        constexpr unsigned int most_turns = 8;
        bool                   turns      = true;
        for (unsigned int i = 0; turns && i < most_turns; ++i)
        {
          geometry = before;
          try_increments(tips);
          turns = growth_criterion(scene.parameters().fracture).is_implicit() &&
                  turn_increments(tips);
        }
        n_unturned += turns;
      }
      catch (const NumericalFailure &)
      {
        const bool has_come_free =
          physical_mesh && physical_mesh->n_blocks() > n_blocks;
        restore(before);
        if (!has_come_free)
          throw;
        std::ostringstream reason;
        reason << "a crack that arrives at " << tips.front().extension.met
               << " sets a block free that nothing holds, at load factor "
               << states.back().load_factor;
        end_reason = reason.str();
        return false;
      }
      catch (const InputError &error)
      {
        // The scene itself is valid, but the geometry with the extended crack is not.
        restore(before);
        AssertThrow(false,
                    NumericalFailure("A crack that grows makes a geometry that "
                                     "cannot be cut: " +
                                       error.description(),
                                     error.place(),
                                     "choose another 'Fracture/Increment'"));
      }
      for (const GrowingTip &tip : tips)
        increments.add(states.size(), states.back().load_factor, tip);
      return true;
    }


    void
    CrackGrowthAnalysis::restore(const Geometry &before)
    {
      geometry = before;
      build(geometry);
      equilibrate();
    }


    void
    CrackGrowthAnalysis::try_increments(std::vector<GrowingTip> &tips)
    {
      for (GrowingTip &growing : tips)
        extend_by_increment(growing, scene.parameters().fracture, geometry);
      build(geometry);
      equilibrate();
    }


    bool
    CrackGrowthAnalysis::turn_increments(std::vector<GrowingTip> &tips) const
    {
      constexpr double tolerance = 1e-3;
      bool             turns     = false;
      for (GrowingTip &growing : tips)
        for (unsigned int i = 0; i < crack_tips->all_tips().size(); ++i)
          // The direction of a crack that starts follows from the stress before.
          if (!growing.advance.is_new && growing.extension.met.empty() &&
              crack_tips->all_tips()[i].point == growing.extension.end)
          {
            const IntensityFactors &k = crack_tips->all_factors()[i];
            if (k.K_I <= 0.)
              continue;
            const double residual =
              growth_criterion(scene.parameters().fracture)
                .judge(k.K_I, k.K_II)
                .angle -
              (growing.angle - growing.verdict.angle);
            if (std::abs(residual) <= tolerance)
              continue;
            // A chord that is turned by a small angle turns what the crack does at its end back
            // by about the same angle; two trials show by how much it does here.
            double slope = -2.;
            if (growing.last_trial)
            {
              const auto [last_angle, last_residual] = *growing.last_trial;
              const double secant =
                (residual - last_residual) / (growing.angle - last_angle);
              if (secant > -6. && secant < -1.2)
                slope = secant;
            }
            growing.last_trial = {growing.angle, residual};
            growing.angle -= residual / slope;
            turns = true;
          }
      return turns;
    }


    void
    CrackGrowthAnalysis::verify()
    {
      StaticAnalysis::verify();
      summary.add("increments", states.size() - 1.);
      summary.add("grown_length",
                  increments.grown_length(),
                  scene.parameters().output.length_unit);
      double largest = 0.;
      for (const State &state : states)
        if (std::isfinite(state.load_factor))
          largest = std::max(largest, state.load_factor);
      summary.add("largest_load_factor", largest);
    }


    void
    CrackGrowthAnalysis::write_tables() const
    {
      on_first_rank([&]() {
        directory->write_text("history.csv", [&](std::ostream &out) {
          out << "step,load_factor,grown_length,strain_energy";
          for (const Probe &probe : scene.parameters().probes)
            if (!probe.is_line)
              out << ',' << quoted(probe.name + "_x") << ','
                  << quoted(probe.name + "_y");
          out << '\n';
          out.precision(12);
          // A cell is empty if no load makes a crack grow, or if a probe is outside the solid.
          const auto write = [&](const double value) {
            out << ',';
            if (std::isfinite(value))
              out << value;
          };
          for (unsigned int i = 0; i < states.size(); ++i)
          {
            out << i;
            write(states[i].load_factor);
            write(states[i].crack_length);
            write(states[i].strain_energy);
            for (const double value : states[i].probes)
              write(value);
            out << '\n';
          }
        });
        increments.write(*directory);
      });
    }
  } // namespace internal
} // namespace NMM
