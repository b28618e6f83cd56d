#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/contact/state/carried_history.h>
#include <nmm/dynamics/checkpoint.h>
#include <nmm/fracture/tip_grading.h>
#include <nmm/mechanics/carried_covers.h>

#include <algorithm>
#include <cmath>
#include <scene/dynamic_analysis.h>
#include <scene/growth_in_motion.h>

namespace NMM
{
  namespace internal
  {
    std::vector<Increment>
    DynamicAnalysis::earlier_increments()
    {
      if (restart.empty())
        return {};
      earlier_part.emplace();
      from_bytes(Checkpoint::read_of_caller(restart, communicator),
                 *earlier_part);
      require_in_checkpoint(
        std::isfinite(earlier_part->next_step_of_start) &&
          earlier_part->next_step_of_start >= 0. &&
          are_finite(std::vector<double>{earlier_part->largest_balance,
                                         earlier_part->largest_energy}),
        "its largest energies are not finite");
      largest_balance = earlier_part->largest_balance;
      largest_energy  = earlier_part->largest_energy;
      // The cracks of the earlier part may have been at rest, or this part holds them.
      const SavedGrowth &earlier = earlier_part->growth;
      if (!growth || !earlier_part->has_growth)
        return {};
      growth->restore(earlier);
      further_sizes = earlier.sizes;
      return earlier.increments;
    }


    void
    DynamicAnalysis::continue_growth()
    {
      if (earlier_part && earlier_part->has_growth)
        // Contact has all points sticking now, while factors are those of the state before that.
        crack_tips->restore(earlier_part->growth.factors);
      else if (!restart.empty())
        compute_tips_in_motion();
    }


    std::vector<char>
    DynamicAnalysis::part_to_save(const double next_step_of_start) const
    {
      SavedPart saved;
      saved.next_step_of_start = next_step_of_start;
      saved.largest_balance    = largest_balance;
      saved.largest_energy     = largest_energy;
      saved.has_growth         = growth != nullptr && next_step_of_start == 0.;
      if (saved.has_growth)
      {
        growth->save(saved.growth);
        saved.growth.sizes   = further_sizes;
        saved.growth.factors = crack_tips->all_factors();
      }
      return to_bytes(saved);
    }


    bool
    DynamicAnalysis::grow()
    {
      // A run that continues from a checkpoint may have grown at the end of its last step already.
      if (!growth || !growth->has_increments_left() ||
          growth->has_grown_in(step_number()))
        return false;
      const FractureParameters &fracture = scene.parameters().fracture;
      std::vector<GrowingTip>   judged =
        judge_tips(*crack_tips, fracture, problem, *physical_mesh);
      if (fracture.can_start_cracks(problem.materials))
        add_new_tips(judged,
                     *crack_tips,
                     growth->table(),
                     fracture,
                     problem,
                     solid->covers(),
                     stress_in_material_axes());
      std::vector<GrowingTip> tips =
        growth->find_growing_tips(std::move(judged), time());
      if (tips.empty())
        return false;
      Geometry grown = geometry;
      for (GrowingTip &tip : tips)
        extend_by_increment(tip, fracture, grown);
      // A relaxation is at rest again only after its first step, in which the forces fade.
      const double duration =
        kind == Analysis::relaxation
          ? scene.parameters().relaxation.relaxation.step
          : growth->travel_time(tips, problem, *physical_mesh);
      // Cells must not become larger where a tip has been, see CarriedCovers.
      if (fracture.grades_mesh())
        for (const GrowingTip &tip : tips)
          if (!tip.advance.is_new)
            further_sizes.push_back(
              grade_towards(tip.tip,
                            fracture.grading,
                            least_cell_size(*physical_mesh),
                            fracture.smallest_at_tips(/* in_motion = */ true)));
      cut_anew(grown, duration);
      growth->add(step_number(), time(), duration, tips);
      on_first_rank([&]() { growth->table().write(*directory); });
      return true;
    }


    void
    DynamicAnalysis::cut_anew(const Geometry &grown, const double duration)
    {
      can_be_saved = false;
      motion->integrator().balance_accelerations();
      FormerState former;
      former.state  = motion->integrator().state();
      former.energy = motion->integrator().account().kinetic +
                      motion->integrator().account().strain +
                      motion->integrator().account().conditions;
      if (contact)
      {
        former.history       = contact->contact().history();
        former.friction_work = motion->contact_account()->friction_work();
      }
      // The solid remains until its state is carried over; what else refers to it does not.
      clear_equations();
      former.solid = release_solid();

      const Geometry before = geometry;
      std::string    fault, place;
      try
      {
        build(grown);
        carry_over(former, duration);
      }
      catch (const InputError &error)
      {
        // The scene itself is valid, but the geometry with the extended crack is not.
        fault = "A crack that grows makes a geometry that cannot be cut: " +
                error.description();
        place = error.place();
      }
      catch (const NumericalFailure &failure)
      {
        fault = failure.message();
      }
      can_be_saved = fault.empty();
      if (can_be_saved)
        return;
      build(before);
      carry_over(former, duration);
      AssertThrow(false,
                  NumericalFailure(fault,
                                   place,
                                   "choose another 'Fracture/Increment'"));
    }


    void
    DynamicAnalysis::carry_over(const FormerState &former,
                                const double       duration)
    {
      const CarriedCovers carried(former.solid.solid->covers(),
                                  solid->covers(),
                                  solid->quadrature());
      DynamicState        state = former.state;
      for (Vector *vector : {&state.u, &state.v, &state.a})
        *vector = carried.carry(*vector);
      // The waves of a crack that grows wake all blocks.
      state.rest.clear();
      state.left_blocks.clear();
      const std::vector<unsigned int> &left = former.state.left_blocks;
      for (unsigned int block = 0; block < physical_mesh->n_blocks(); ++block)
        if (std::find(left.begin(), left.end(), carried.former_block(block)) !=
            left.end())
          state.left_blocks.push_back(block);
      if (contact)
      {
        contact->continue_from(
          former.solid.contact->largest_penetration_so_far());
        motion->contact_account()->continue_from(
          carry_history(former.history,
                        former.solid.contact->faces(),
                        contact->faces(),
                        contact->contact().parameters().slave_priority),
          former.friction_work);
      }
      motion->integrator().continue_after_cut(state, former.energy, duration);
      // A few steps resolve the time in which the faces separate.
      constexpr double steps_per_increment = 4.;
      const double     usual               = state.next_step > 0.
                                               ? state.next_step
                                               : scene.parameters().time.initial_step;
      motion->integrator().set_next_step(
        std::min(usual, duration / steps_per_increment));
      if (contact)
        take_contact();
      note_energies();
      last_good = motion->integrator().state();
    }
  } // namespace internal
} // namespace NMM
