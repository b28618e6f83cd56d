#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <map>
#include <scene/parsing.h>
#include <string>

// This file checks that stages fit each other and the rest of the scene.
namespace NMM
{
  using namespace internal;

  namespace
  {
    /// What the name of a condition stands for.
    enum class ConditionKind
    {
      none,
      load,
      support,
      absorbing_boundary,
      ambiguous
    };


    ConditionKind
    condition_kind(const SceneParameters &parameters, const std::string &name)
    {
      using Type           = BoundaryCondition::Type;
      ConditionKind result = ConditionKind::none;
      const auto    found  = [&result](const ConditionKind kind) {
        result =
          result == ConditionKind::none ? kind : ConditionKind::ambiguous;
      };
      for (const BoundaryConditionParameters &one :
           parameters.boundary_conditions)
        if (one.name == name)
          found(one.type == Type::displacement ||
                    one.type == Type::normal_displacement
                  ? ConditionKind::support
                : one.type == Type::absorbing || one.type == Type::free_field
                  ? ConditionKind::absorbing_boundary
                  : ConditionKind::load);
      for (const PointForceParameters &one : parameters.point_forces)
        if (one.time.name == name)
          found(ConditionKind::load);
      for (const FixedPointParameters &one : parameters.fixed_points)
        if (one.time.name == name)
          found(ConditionKind::support);
      return result;
    }


    /// Checks that the condition @p name can be added (@p adds) or removed. @p acts are the conditions
    /// that earlier stages have changed, and whether they act. @throws InputError that names @p place.
    void
    check_change(const SceneParameters       &parameters,
                 const std::string           &name,
                 const bool                   adds,
                 const std::string           &place,
                 std::map<std::string, bool> &acts)
    {
      const ConditionKind kind = condition_kind(parameters, name);
      AssertThrow(kind != ConditionKind::none,
                  InputError("there is no condition, force or point '" + name +
                               "'",
                             place,
                             "name one of section 'Boundary conditions', "
                             "'Point forces' or 'Fixed points'"));
      AssertThrow(kind != ConditionKind::ambiguous,
                  InputError("'" + name + "' is the name of two conditions",
                             place,
                             "give one of them another name"));
      AssertThrow(kind != ConditionKind::absorbing_boundary,
                  InputError("the absorbing boundary '" + name +
                               "' holds the solid in all stages, and absorbs "
                               "waves in the motion that follows",
                             place,
                             "leave it out"));
      AssertThrow(!adds || kind == ConditionKind::load,
                  InputError("the support '" + name + "' cannot be added",
                             place,
                             "name a load; what is to hold the solid from a "
                             "stage on is a bolt"));
      const auto [entry, is_first] = acts.emplace(name, !adds);
      AssertThrow(is_first || entry->second != adds,
                  InputError("'" + name + "' acts " +
                               (adds ? "already" : "no longer"),
                             place,
                             std::string("leave it out, or ") +
                               (adds ? "remove" : "add") + " it before"));
      AssertThrow(is_first || kind == ConditionKind::load,
                  InputError("the support '" + name + "' is gone already",
                             place,
                             "remove it once"));
      entry->second = adds;
    }
  } // namespace


  void
  SceneParameters::check_stages() const
  {
    using Use = RegionParameters::Use;
    std::map<std::string, std::string> removed_by;
    std::map<std::string, bool>        acts;
    double                             released = 0.;
    bool                               may_hold = false;
    for (const StageParameters &stage : stages)
    {
      const std::string place = "parameter 'Stages/" + stage.name + "/";
      for (const std::string &name : stage.added_conditions)
        check_change(*this, name, true, place + "Add conditions'", acts);
      bool removes = !stage.removed_regions.empty();
      for (const std::string &name : stage.removed_conditions)
      {
        check_change(*this, name, false, place + "Remove conditions'", acts);
        removes =
          removes || condition_kind(*this, name) == ConditionKind::support;
      }
      may_hold = may_hold || removes;
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
      AssertThrow(may_hold || stage.relaxation == 1.,
                  InputError("nothing has been removed whose tractions could "
                             "be held",
                             place + "Relaxation'",
                             "remove it, or set 'Remove regions'"));
      AssertThrow(stage.relaxation >= released || removes,
                  InputError("the share " + to_text(stage.relaxation) +
                               " is less than that of the stage before, " +
                               to_text(released),
                             place + "Relaxation'",
                             "what has been released is not held again"));
      if (may_hold)
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
    AssertThrow(model.analysis != Analysis::dynamics ||
                  time.start != TimeParameters::Start::relaxation,
                InputError("a motion after stages starts from the equilibrium "
                           "at the end of the last one",
                           "parameter 'Time/Start'",
                           "leave it out, or set it to equilibrium"));
    AssertThrow(
      stages.back().relaxation == 1. || model.analysis == Analysis::statics,
      InputError("tractions that are held cannot act in a " +
                   to_string(model.analysis) + " analysis",
                 "parameter 'Stages/" + stages.back().name + "/Relaxation'",
                 "release them by another stage, or let a bolt or a "
                 "load bear them"));
    const LoadSteps steps = load_steps.load_steps();
    AssertThrow(steps.are_ascending() && steps.load_factors.back() == 1.,
                InputError("the load factors of stages do not ascend to 1",
                           "parameter 'Load steps/Load factors'",
                           "they are those of each stage: let them ascend to "
                           "1"));
  }
} // namespace NMM
