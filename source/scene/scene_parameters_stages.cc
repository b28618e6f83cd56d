#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <map>
#include <scene/parsing.h>

// This file has the parameters of stages.
namespace NMM
{
  using namespace internal;

  void
  StageParameters::list_entries(Entries &entries)
  {
    entries.add("Remove regions",
                removed_regions,
                "Names of regions with 'Use = staged' that are removed at the "
                "beginning of the stage.");
    entries.add("Relaxation",
                relaxation,
                dealii::Patterns::Double(0., 1.),
                "Share of the tractions on the walls of all regions removed so "
                "far that is released at the end of the stage; the rest is "
                "held [-].");
  }


  void
  SceneParameters::check_stages() const
  {
    using Use = RegionParameters::Use;
    std::map<std::string, std::string> removed_by;
    double                             released = 0.;
    for (const StageParameters &stage : stages)
    {
      const std::string place = "parameter 'Stages/" + stage.name + "/";
      for (const std::string &name : stage.removed_regions)
      {
        const bool is_staged =
          std::any_of(regions.begin(), regions.end(), [&](const auto &region) {
            return region.name == name && region.use == Use::staged;
          });
        AssertThrow(is_staged,
                    InputError("there is no region '" + name +
                                 "' that a stage can remove",
                               place + "Remove regions'",
                               "name a region of section 'Regions' that has "
                               "'Use = staged'"));
        AssertThrow(removed_by.emplace(name, stage.name).second,
                    InputError("the region '" + name +
                                 "' is removed a second time, after stage '" +
                                 removed_by[name] + "'",
                               place + "Remove regions'",
                               "remove each region once"));
      }
      AssertThrow(!removed_by.empty() || stage.relaxation == 1.,
                  InputError("nothing has been removed whose tractions could "
                             "be held",
                             place + "Relaxation'",
                             "remove it, or set 'Remove regions'"));
      AssertThrow(stage.relaxation >= released ||
                    !stage.removed_regions.empty(),
                  InputError("the share " + to_text(stage.relaxation) +
                               " is less than that of the stage before, " +
                               to_text(released),
                             place + "Relaxation'",
                             "what has been released is not held again"));
      if (!removed_by.empty())
        released = stage.relaxation;
    }
    if (stages.empty())
    {
      for (const RegionParameters &region : regions)
        AssertThrow(region.use != Use::staged,
                    InputError("the region '" + region.name +
                                 "' is there for stages, and there are none",
                               "parameter 'Regions/" + region.name + "/Use'",
                               "set 'Use = excavation', or list stages in "
                               "section 'Stages'"));
      return;
    }
    const std::string names = "parameter 'Stages/Names'";
    AssertThrow(model.analysis == Analysis::statics,
                InputError("there are stages in a " +
                             to_string(model.analysis) + " analysis",
                           names,
                           "set 'Model/Analysis = static'; other analyses have "
                           "no stages yet"));
    AssertThrow(fracture.n_increments == 0,
                InputError("there are stages in a scene whose cracks grow",
                           names,
                           "remove one of the two; they do not go together "
                           "yet"));
    const LoadSteps steps = load_steps.load_steps();
    AssertThrow(steps.are_ascending() && steps.load_factors.back() == 1.,
                InputError("the load factors of stages do not ascend to 1",
                           "parameter 'Load steps/Load factors'",
                           "they are those of each stage: let them ascend to "
                           "1"));
    for (const ObstacleParameters &obstacle : obstacles)
      AssertThrow(obstacle.displacement.empty(),
                  InputError("the obstacle '" + obstacle.name +
                               "' moves in a scene with stages",
                             "parameter 'Obstacles/" + obstacle.name +
                               "/Displacement'",
                             "let it rest"));
  }
} // namespace NMM
