#include <nmm/base/exceptions.h>

#include <algorithm>
#include <scene/dynamic_analysis.h>

namespace NMM
{
  namespace internal
  {
    // This file removes blocks that leave the scene.
    void
    DynamicAnalysis::make_leaving()
    {
      const std::vector<Curve> limits = scene.make_limits();
      if (limits.empty())
        return;
      leaving = std::make_unique<LeavingBlocks>(
        solid->covers(),
        limits,
        motion->solid_term().elasticity().tied_blocks());
      const DisplacementField undeformed(solid->covers(),
                                         problem,
                                         std::vector<dealii::Tensor<1, 2>>(
                                           solid->covers().n_covers()));
      const auto              outside = leaving->find(undeformed);
      AssertThrow(
        outside.empty(),
        InputError("the block from " + to_string(outside.front().lower) +
                     " to " + to_string(outside.front().upper) +
                     " lies outside of the limits at the begin",
                   "parameter 'Regions/" + limits.front().name + "/Shape'",
                   "let the limits contain all of the solid"));
    }


    void
    DynamicAnalysis::open_departures(const int continue_after)
    {
      if (leaving)
        departures =
          std::make_unique<CsvSeries>(directory->file("left-blocks.csv"),
                                      std::vector<std::string>{"block",
                                                               "reference_x",
                                                               "reference_y",
                                                               "x",
                                                               "y",
                                                               "energy",
                                                               "kinetic",
                                                               "momentum_x",
                                                               "momentum_y"},
                                      continue_after);
    }


    void
    DynamicAnalysis::drop_blocks()
    {
      const auto  gone    = leaving->find(DisplacementField(solid->covers(),
                                                        problem,
                                                        displacement()),
                                      motion->integrator().state().left_blocks);
      const auto &regions = physical_mesh->regions();
      // Blocks are removed one after the other, so that the energy of each one is known.
      for (const LeavingBlocks::Departure &departure : gone)
      {
        const Account before = motion->integrator().account();
        motion->integrator().drop_blocks({departure.block});
        const Account             &after = motion->integrator().account();
        const dealii::Tensor<1, 2> momentum =
          before.linear_momentum - after.linear_momentum;
        const dealii::Point<2> middle =
          departure.lower + 0.5 * (departure.upper - departure.lower);
        const auto region =
          std::find_if(regions.begin(), regions.end(), [&](const auto &r) {
            return r.block == departure.block;
          });
        on_first_rank([&]() {
          departures->append(time(),
                             step_number(),
                             {static_cast<double>(departure.block),
                              region->inside[0],
                              region->inside[1],
                              middle[0],
                              middle[1],
                              after.left - before.left,
                              before.kinetic - after.kinetic,
                              momentum[0],
                              momentum[1]});
        });
      }
    }
  } // namespace internal
} // namespace NMM
