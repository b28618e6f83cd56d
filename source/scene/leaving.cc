#include <nmm/base/exceptions.h>

#include <algorithm>
#include <scene/dynamic_analysis.h>

namespace NMM
{
  namespace internal
  {

    // Blocks that leave the scene.
    using namespace NMM;

    void
    DynamicAnalysis::make_leaving()
    {
      const std::vector<Curve> limits = scene.make_limits();
      if (limits.empty())
        return;
      leaving = std::make_unique<LeavingBlocks>(*covers,
                                                limits,
                                                elasticity->tied_blocks());
      const DisplacementField undeformed(*covers,
                                         problem,
                                         std::vector<dealii::Tensor<1, 2>>(
                                           covers->n_covers()));
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
        departures = std::make_unique<TimeTable>(
          (directory->path() / "left-blocks.csv").string(),
          "# time [s]; a point of the block in the undeformed solid and the "
          "middle "
          "of "
          "the box around it where it left [m]; per unit thickness: energies "
          "that "
          "left with it [J/m], momentum [kg/s]",
          std::vector<std::string>{"block",
                                   "reference_x",
                                   "reference_y",
                                   "x",
                                   "y",
                                   "energy",
                                   "kinetic",
                                   "momentum_x",
                                   "momentum_y"},
          MPI_COMM_SELF,
          continue_after);
    }


    void
    DynamicAnalysis::drop_blocks()
    {
      const auto gone =
        leaving->find(DisplacementField(*covers, problem, displacement()),
                      integrator->state().left_blocks);
      const auto &regions = physical_mesh->regions();
      // one after the other, so that each one's share is known
      for (const LeavingBlocks::Departure &departure : gone)
      {
        const Account before = integrator->account();
        integrator->drop_blocks({departure.block});
        const Account             &after = integrator->account();
        const dealii::Tensor<1, 2> momentum =
          before.linear_momentum - after.linear_momentum;
        const dealii::Point<2> middle =
          departure.lower + 0.5 * (departure.upper - departure.lower);
        const auto region =
          std::find_if(regions.begin(), regions.end(), [&](const auto &r) {
            return r.block == departure.block;
          });
        on_first_rank([&]() {
          departures->write(time(),
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


    std::vector<std::string>
    DynamicAnalysis::further_columns() const
    {
      std::vector<std::string> columns;
      if (contact)
        columns = contact->columns();
      if (leaving)
        columns.insert(columns.end(), {"blocks_left", "left_energy"});
      if (scene.parameters().time.sleep.speed > 0.)
        columns.push_back("blocks_asleep");
      return columns;
    }


    std::vector<double>
    DynamicAnalysis::further_values() const
    {
      std::vector<double> values;
      if (contact)
        values = contact->numbers(/* thickness = */ 1.);
      if (leaving)
        values.insert(values.end(),
                      {static_cast<double>(
                         integrator->state().left_blocks.size()),
                       integrator->account().left});
      if (scene.parameters().time.sleep.speed > 0.)
        values.push_back(integrator->n_asleep());
      return values;
    }

  } // namespace internal
} // namespace NMM
