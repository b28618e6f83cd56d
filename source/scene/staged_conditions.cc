#include <algorithm>
#include <scene/staged_conditions.h>
#include <set>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      bool
      changes_conditions(const StageParameters &stage)
      {
        return !stage.added_conditions.empty() ||
               !stage.removed_conditions.empty() || !stage.water_table.empty();
      }
    } // namespace


    StagedConditions::StagedConditions(const SceneParameters &parameters,
                                       const unsigned int     n_of_a_table)
      : parameters(parameters)
      , n_of_a_table(n_of_a_table)
    {
      const auto &stages = parameters.stages;
      if (std::none_of(stages.begin(), stages.end(), changes_conditions))
        return;
      std::size_t n_conditions = 0;
      for (const BoundaryConditionParameters &one :
           parameters.boundary_conditions)
        n_conditions += one.boundaries.size();
      present_table = n_conditions;
      n_conditions +=
        n_of_a_table * (1 + std::count_if(stages.begin(),
                                          stages.end(),
                                          [](const StageParameters &stage) {
                                            return !stage.water_table.empty();
                                          }));
      current.boundary_conditions.assign(n_conditions, 1.);
      current.released_conditions.assign(n_conditions, false);
      current.point_forces.assign(parameters.point_forces.size(), 1.);
      current.fixed_points.assign(parameters.fixed_points.size(), 1.);
      current.released_fixed_points.assign(parameters.fixed_points.size(),
                                           false);
      std::fill(current.boundary_conditions.begin() + present_table,
                current.boundary_conditions.end(),
                0.);
      set_table(true);
      std::set<std::string> mentioned;
      for (const StageParameters &stage : stages)
      {
        for (const std::string &name : stage.added_conditions)
          if (mentioned.insert(name).second)
            set(name, false);
        mentioned.insert(stage.removed_conditions.begin(),
                         stage.removed_conditions.end());
      }
    }


    bool
    StagedConditions::begin(const StageParameters &stage)
    {
      for (const std::string &name : stage.added_conditions)
        set(name, true);
      for (const std::string &name : stage.removed_conditions)
        set(name, false);
      if (!stage.water_table.empty())
      {
        set_table(false);
        present_table += n_of_a_table;
        set_table(true);
      }
      return changes_conditions(stage);
    }


    void
    StagedConditions::set_table(const bool acts)
    {
      for (unsigned int i = 0; i < n_of_a_table; ++i)
        current.boundary_conditions[present_table + i] = acts ? 1. : 0.;
    }


    void
    StagedConditions::set(const std::string &name, const bool acts)
    {
      using Type    = BoundaryCondition::Type;
      std::size_t n = 0;
      for (const BoundaryConditionParameters &one :
           parameters.boundary_conditions)
        for (std::size_t i = 0; i < one.boundaries.size(); ++i, ++n)
          if (one.name == name)
          {
            if (one.type == Type::displacement ||
                one.type == Type::normal_displacement)
              current.released_conditions[n] = !acts;
            else
              current.boundary_conditions[n] = acts ? 1. : 0.;
          }
      for (std::size_t i = 0; i < parameters.point_forces.size(); ++i)
        if (parameters.point_forces[i].time.name == name)
          current.point_forces[i] = acts ? 1. : 0.;
      for (std::size_t i = 0; i < parameters.fixed_points.size(); ++i)
        if (parameters.fixed_points[i].time.name == name)
          current.released_fixed_points[i] = !acts;
    }
  } // namespace internal
} // namespace NMM
