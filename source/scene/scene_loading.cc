#include <nmm/base/exceptions.h>
#include <nmm/scene/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <scene/expression.h>
#include <scene/parsing.h>
#include <scene/staged_conditions.h>
#include <scene/time_function.h>
#include <set>
#include <utility>

// This file makes loads and conditions as functions of time and stage.
namespace NMM
{
  namespace
  {
    /// Checks that a function has a finite value, without which the analysis cannot continue.
    /// @throws NumericalFailure if it has not.
    double
    checked(const double       value,
            const double       t,
            const std::string &unit,
            const std::string &parameter)
    {
      AssertThrow(std::isfinite(value),
                  NumericalFailure("the value is not finite",
                                   "parameter '" + parameter +
                                     "' at t = " + internal::to_text(t) + unit,
                                   "correct the expression"));
      return value;
    }
  } // namespace


  namespace internal
  {
    TimeFunction
    make_time_function(
      const std::string                                     &text,
      const std::string                                     &parameter,
      const double                                           end_time,
      const std::string                                     &unit,
      const std::function<std::string(const std::string &)> &relative_to_scene)
    {
      const std::string trimmed = dealii::Utilities::trim(text);
      if (trimmed.empty())
        return nullptr;
      const std::string prefix = "file:";
      if (trimmed.rfind(prefix, 0) == 0)
      {
        const std::string name =
          dealii::Utilities::trim(trimmed.substr(prefix.size()));
        AssertThrow(!name.empty(),
                    InputError("the file has no name",
                               "parameter '" + parameter + "'",
                               "write 'file: name'"));
        return TimeHistory::read(relative_to_scene(name));
      }
      const auto function =
        internal::parse_expressions<1>({trimmed}, "t", parameter);
      for (const double t : {0., end_time})
        AssertThrow(std::isfinite(function->value(dealii::Point<1>(t))),
                    InputError("'" + trimmed + "' is not finite at t = " +
                                 internal::to_text(t) + unit,
                               "parameter '" + parameter + "'",
                               "give an expression that has a value from 0 "
                               "to the end"));
      return [function, unit, parameter](const double t) {
        return checked(function->value(dealii::Point<1>(t)),
                       t,
                       unit,
                       parameter);
      };
    }
  } // namespace internal


  namespace
  {
    using internal::make_time_function;
    using internal::TimeFunction;

    /// The functions of time of some loads, with the indices of these.
    using TimeFunctions = std::vector<std::pair<unsigned int, TimeFunction>>;

    void
    evaluate(const TimeFunctions &functions,
             const std::size_t    n,
             const double         t,
             std::vector<double> &values)
    {
      if (functions.empty())
        return;
      values.assign(n, 1.);
      for (const auto &[index, function] : functions)
        values[index] = function(t);
    }


    bool
    is_displacement(const BoundaryCondition::Type type)
    {
      return type == BoundaryCondition::Type::displacement ||
             type == BoundaryCondition::Type::normal_displacement;
    }


    /// All loads and conditions of a scene that depend on time.
    struct LoadFunctions
    {
      TimeFunctions conditions, forces, fixed_points;
      TimeFunction  gravity, body_force;
      std::size_t   n_conditions = 0, n_forces = 0, n_fixed_points = 0;

      bool
      is_empty() const
      {
        return conditions.empty() && forces.empty() && fixed_points.empty() &&
               !gravity && !body_force;
      }

      LoadAmplitudes
      amplitudes(const double t) const
      {
        LoadAmplitudes result;
        evaluate(conditions, n_conditions, t, result.boundary_conditions);
        evaluate(forces, n_forces, t, result.point_forces);
        evaluate(fixed_points, n_fixed_points, t, result.fixed_points);
        if (gravity)
          result.gravity = gravity(t);
        if (body_force)
          result.body_force = body_force(t);
        return result;
      }
    };
  } // namespace


  Loading
  Scene::make_loading() const
  {
    const Loading              loading = loads_in_time();
    internal::StagedConditions stages(scene_parameters,
                                      n_conditions_of_a_table());
    bool                       has_changes = false;
    for (const StageParameters &stage : scene_parameters.stages)
      has_changes = stages.begin(stage) || has_changes;
    return has_changes ? loading_after_stage(loading, stages.amplitudes())
                       : loading;
  }


  Loading
  Scene::loads_in_time() const
  {
    const SceneParameters &p         = scene_parameters;
    const auto             functions = std::make_shared<LoadFunctions>();
    Loading                loading;
    const auto make = [&](const std::string &text, const std::string &name) {
      return make_time_function(
        text, name, p.time.end_time, " s", [this](const std::string &file) {
          return relative_to_scene(file);
        });
    };
    // Without amplitudes, a relaxation lets what is prescribed grow from where the solid is.
    const auto ramp = [&](const bool is_moved) {
      const double end = internal::ramp_time(p.relaxation.relaxation.step);
      if (!is_moved || p.model.analysis != Analysis::relaxation)
        return TimeFunction();
      return TimeFunction([end](const double t) {
        return t < end ? 0.5 - 0.5 * std::cos(dealii::numbers::PI * t / end)
                       : 1.;
      });
    };
    const auto add = [&](const TimeDependence &time,
                         const std::string    &section,
                         const Release::Kind   kind,
                         TimeFunctions        &list,
                         std::size_t          &n,
                         const std::size_t     n_conditions,
                         const bool            is_moved) {
      TimeFunction function =
        make(time.amplitude, section + "/" + time.name + "/Amplitude");
      if (!function)
        function = ramp(is_moved);
      for (std::size_t i = 0; i < n_conditions; ++i, ++n)
      {
        if (function)
          list.emplace_back(n, function);
        if (time.release_time >= 0.)
          loading.releases.push_back(
            {kind, static_cast<unsigned int>(n), time.release_time});
      }
    };
    for (const BoundaryConditionParameters &condition : p.boundary_conditions)
      add(condition.time,
          "Boundary conditions",
          Release::Kind::boundary_condition,
          functions->conditions,
          functions->n_conditions,
          condition.boundaries.size(),
          is_displacement(condition.type) &&
            condition.value.find_first_not_of(" 0;.") != std::string::npos);
    for (const PointForceParameters &force : p.point_forces)
      add(force.time,
          "Point forces",
          Release::Kind::fixed_point,
          functions->forces,
          functions->n_forces,
          1,
          /* is_moved = */ false);
    for (const FixedPointParameters &point : p.fixed_points)
      add(point.time,
          "Fixed points",
          Release::Kind::fixed_point,
          functions->fixed_points,
          functions->n_fixed_points,
          1,
          point.point.displacement.norm_square() > 0.);
    // Water does not change in time.
    functions->n_conditions += make_water().size() * n_conditions_of_a_table();
    functions->gravity =
      make(p.model.gravity_amplitude, "Model/Gravity amplitude");
    functions->body_force =
      make(p.model.body_force_amplitude, "Model/Body force amplitude");

    if (!functions->is_empty())
      loading.amplitudes = [functions](const double t) {
        return functions->amplitudes(t);
      };
    loading.base_acceleration = make_vector_function(p.model.base_acceleration,
                                                     "Model/Base acceleration");
    return loading;
  }


  std::function<dealii::Tensor<1, 2>(double)>
  Scene::make_vector_function(const std::string &text,
                              const std::string &name) const
  {
    if (dealii::Utilities::trim(text).empty())
      return nullptr;
    const std::vector<std::string> parts =
      dealii::Utilities::split_string_list(text, ';');
    AssertThrow(parts.size() == 2,
                InputError("'" + text + "' has " +
                             std::to_string(parts.size()) +
                             " component(s) instead of 2",
                           "parameter '" + name + "'",
                           "give two, separated by a semicolon"));
    const bool is_static = scene_parameters.model.analysis == Analysis::statics;
    const double end     = is_static
                             ? scene_parameters.load_steps.load_steps().largest()
                             : scene_parameters.time.end_time;
    TimeFunction components[2];
    for (unsigned int c = 0; c < 2; ++c)
    {
      components[c] = make_time_function(parts[c],
                                         name,
                                         end,
                                         is_static ? "" : " s",
                                         [this](const std::string &file) {
                                           return relative_to_scene(file);
                                         });
      AssertThrow(components[c] != nullptr,
                  InputError("'" + text + "' has an empty component",
                             "parameter '" + name + "'",
                             "write 0 for a direction in which there is "
                             "nothing"));
    }
    return [x = components[0], y = components[1]](const double t) {
      return dealii::Tensor<1, 2>({x(t), y(t)});
    };
  }


  LoadAmplitudes
  Scene::loads_before_stages() const
  {
    const Loading loading = loads_in_time();
    return product(loading.amplitudes ? loading.amplitudes(0.)
                                      : LoadAmplitudes(),
                   internal::StagedConditions(scene_parameters,
                                              n_conditions_of_a_table())
                     .amplitudes());
  }


  std::vector<StageChange>
  Scene::make_stages(const PhysicalMesh &mesh) const
  {
    std::vector<StageChange> result;
    std::set<unsigned int>   gone;
    const Loading            in_time = loads_in_time();
    const LoadAmplitudes     at_start =
      in_time.amplitudes ? in_time.amplitudes(0.) : LoadAmplitudes();
    internal::StagedConditions conditions(scene_parameters,
                                          n_conditions_of_a_table());
    for (const StageParameters &stage : scene_parameters.stages)
    {
      const auto &names = stage.removed_regions;
      StageChange change;
      change.released = stage.relaxation;
      for (const RegionParameters &region : scene_parameters.regions)
        if (std::find(names.begin(), names.end(), region.name) != names.end())
          for (const unsigned int block :
               mesh.blocks_inside(make_region(region)))
            // regions may overlap
            if (gone.insert(block).second)
              change.removed_blocks.push_back(block);
      AssertThrow(names.empty() || !change.removed_blocks.empty(),
                  InputError("no block of the solid is inside the regions that "
                             "the stage removes",
                             "parameter 'Stages/" + stage.name +
                               "/Remove regions'",
                             "let their borders surround a part of the solid"));
      if (conditions.begin(stage))
        change.loads = product(at_start, conditions.amplitudes());
      result.push_back(change);
    }
    return result;
  }
} // namespace NMM
