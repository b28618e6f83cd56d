#include <nmm/base/exceptions.h>
#include <nmm/contact/law/coulomb_law.h>
#include <nmm/materials/material.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <map>
#include <scene/parsing.h>
#include <sstream>

// This file has the parameters of load steps and Newton's method, and the checks of parameters in
// combination with kinematics and analysis.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    /// What a message calls the analysis of a scene.
    std::string
    name_of(const Kinematics kinematics, const bool is_nonlinear)
    {
      return to_string(kinematics) + " kinematics" +
             (kinematics == Kinematics::small && !is_nonlinear
                ? " without contact and without a material that yields"
                : "");
    }


    /// How a message advises to make a static analysis with small kinematics nonlinear.
    const char *const become_nonlinear =
      "remove it, or set 'Model/Kinematics = finite', 'Contact/Enforcement = "
      "penalty' or a material's 'Law = Mohr-Coulomb'";
  } // namespace


  void
  LoadStepParameters::list_entries(Entries &entries)
  {
    entries.add("Number of steps",
                n_steps,
                Patterns::Integer(1, 1000000),
                "Finite kinematics and contact: equal steps in which loads "
                "and prescribed displacements grow to their values.");
    entries.add("Smallest step",
                min_step,
                Patterns::Double(0, 1),
                "Finite kinematics and contact: a step that does not converge "
                "is divided, but not below this part of the last load factor, "
                "> 0 [-].");
    entries.add(
      "Load factors",
      load_factors,
      Patterns::List(Patterns::Double(0), 0),
      "Instead of equal steps: the factors on loads and prescribed "
      "displacements, one after the other [-]. Where they descend, loads are "
      "taken away; the first is above 0.");
  }


  void
  LoadStepParameters::check(const Kinematics kinematics,
                            const Analysis   analysis,
                            const bool       is_nonlinear) const
  {
    const std::string        section = "Load steps";
    const LoadStepParameters defaults;
    const bool               is_static = analysis == Analysis::statics;
    const bool is_linear = kinematics == Kinematics::small && !is_nonlinear;
    const std::string by = is_static ? name_of(kinematics, is_nonlinear)
                                     : "a " + to_string(analysis) + " analysis";
    if (is_linear || !is_static)
    {
      const std::string remedy =
        is_static ? become_nonlinear
                  : "remove it, or set 'Model/Analysis = static'";
      expect_default(
        section, "Number of steps", n_steps, defaults.n_steps, by, remedy);
      AssertThrow(load_factors.empty(),
                  UnusedValue(section,
                              "Load factors",
                              to_text(load_factors.front()) + ", ...",
                              by,
                              remedy));
      expect_default(
        section, "Smallest step", min_step, defaults.min_step, by, remedy);
    }
    AssertThrow(min_step > 0.,
                InputError("the smallest step is 0",
                           "parameter 'Load steps/Smallest step'",
                           "give a number above 0 and at most 1"));
    AssertThrow(load_factors.empty() || n_steps == defaults.n_steps,
                InputError("the number of steps is " + std::to_string(n_steps) +
                             ", but " + std::to_string(load_factors.size()) +
                             " load factors are listed",
                           "parameter 'Load steps/Number of steps'",
                           "set either 'Number of steps' or 'Load factors'"));
    double last = 0.;
    for (const double factor : load_factors)
    {
      AssertThrow(factor != last,
                  InputError("the load factor " + to_text(factor) +
                               " follows " + to_text(last),
                             "parameter 'Load steps/Load factors'",
                             "give each factor another value than that of the "
                             "one before it, which is 0 at first"));
      last = factor;
    }
  }


  LoadSteps
  LoadStepParameters::load_steps() const
  {
    LoadSteps steps = LoadSteps::equal(n_steps);
    if (!load_factors.empty())
      steps.load_factors = load_factors;
    steps.min_step = min_step;
    return steps;
  }


  void
  NewtonSectionParameters::list_entries(Entries &entries)
  {
    entries.add("Residual tolerance",
                newton.residual_tolerance,
                Patterns::Double(0, 1),
                "Finite kinematics: forces out of balance over the forces in "
                "balance at which an iteration ends, > 0 [-].");
    entries.add("Energy tolerance",
                newton.energy_tolerance,
                Patterns::Double(0, 1),
                "Finite kinematics: and the work of these forces in the last "
                "correction over the largest such work, > 0 [-].");
    entries.add(
      "Maximum iterations",
      newton.max_iterations,
      Patterns::Integer(1, 1000),
      "Finite kinematics: iterations after which a load step is halved.");
  }


  void
  NewtonSectionParameters::check(const Kinematics kinematics,
                                 const Analysis   analysis,
                                 const bool       is_nonlinear) const
  {
    const NewtonParameters defaults;
    if (kinematics != Kinematics::finite && !is_nonlinear)
      expect_defaults("Newton",
                      *this,
                      name_of(kinematics, is_nonlinear),
                      become_nonlinear);
    // A time step starts so close to its solution that the energy of the first
    // correction is no scale for the tolerance.
    if (analysis != Analysis::statics)
      expect_default("Newton",
                     "Energy tolerance",
                     newton.energy_tolerance,
                     defaults.energy_tolerance,
                     "a " + to_string(analysis) + " analysis",
                     "remove it, or set 'Model/Analysis = static'");
    AssertThrow(newton.residual_tolerance > 0.,
                InputError("the residual tolerance is 0",
                           "parameter 'Newton/Residual tolerance'",
                           "give a positive number such as 1e-9"));
    AssertThrow(newton.energy_tolerance > 0.,
                InputError("the energy tolerance is 0",
                           "parameter 'Newton/Energy tolerance'",
                           "give a positive number such as 1e-12"));
  }


  void
  SceneParameters::check_kinematics() const
  {
    const bool        is_static  = model.analysis == Analysis::statics;
    const std::string kinematics = to_string(model.kinematics) + " kinematics";
    for (const Material &material : materials)
      AssertThrow(
        model.kinematics == Kinematics::finite ||
          material.law->has_small_strains(),
        InputError("this law would not be used by " + kinematics,
                   "parameter 'Materials/" + material.name + "/Law'",
                   "set 'Law = linear', or 'Model/Kinematics = finite'"));
    if (model.kinematics == Kinematics::small && is_static && !is_nonlinear())
    {
      if (fracture.n_increments == 0)
        expect_default("Output",
                       "Fields every",
                       output.fields_every,
                       0,
                       name_of(model.kinematics, is_nonlinear()),
                       become_nonlinear);
      return;
    }

    const std::string name =
      !is_static ? to_string(model.analysis) + " analysis"
      : model.kinematics == Kinematics::small
        ? (contact.is_present()       ? "contact"
           : has_inelastic_material() ? "inelastic materials"
                                      : "stages")
        : kinematics;
    AssertThrow(covers.stabilization != Stabilization::ghost_penalty,
                InputError("'ghost penalty' is not available with " + name,
                           "parameter 'Covers/Stabilization'",
                           "set 'Stabilization = aggregation'"));
    AssertThrow(solver.type != LinearSolverParameters::Type::iterative,
                InputError("'iterative' is not available with " + name,
                           "parameter 'Solver/Type'",
                           "set 'Type' to automatic or direct"));
    AssertThrow(!solver.estimate_condition,
                InputError("'true' is not available with " + name,
                           "parameter 'Solver/Condition number'",
                           "set it to false, or 'Model/Kinematics = small' and "
                           "'Model/Analysis = static'"));
    AssertThrow(exact_solution.type == ExactSolutionParameters::Type::none,
                InputError("the thick ring is no solution of " + name,
                           "parameter 'Exact solution/Type'",
                           "set it to none, or 'Model/Kinematics = small' and "
                           "'Model/Analysis = static'"));
  }


  void
  SceneParameters::check_contact() const
  {
    using Scheme             = TimeParameters::Scheme;
    const bool may_be_damped = model.analysis == Analysis::dynamics &&
                               (time.scheme == Scheme::automatic ||
                                time.scheme == Scheme::energy_momentum);
    contact.check(model.analysis, may_be_damped);
    for (const ObstacleParameters &obstacle : obstacles)
    {
      AssertThrow(
        contact.is_present(),
        InputError("the obstacle '" + obstacle.name +
                     "' would not be used by a scene without contact",
                   "parameter 'Obstacles/Names'",
                   "remove it, or set 'Contact/Enforcement = penalty'"));
      obstacle.check(model.analysis);
    }
  }


  void
  SceneParameters::check_analysis() const
  {
    time.check(model.analysis, model.kinematics, contact.is_present());
    // A relaxed start is a relaxation before a dynamic analysis, and trials of
    // strength are relaxations, too.
    const bool has_relaxed_start =
      model.analysis == Analysis::dynamics &&
      time.start == TimeParameters::Start::relaxation;
    relaxation.check(has_relaxed_start ||
                         model.analysis == Analysis::safety_factor
                       ? Analysis::relaxation
                       : model.analysis);
    check_safety_factor();
    check_loads_in_time();
    const std::string analysis = to_string(model.analysis) + " analysis";
    if (model.analysis != Analysis::dynamics)
      for (const InitialVelocityParameters &velocity : initial_velocities)
        AssertThrow(false,
                    UnusedValue("Initial velocities",
                                "Names",
                                velocity.name,
                                "a " + analysis,
                                "remove it, or set 'Model/Analysis = "
                                "dynamic'"));
    if (!may_be_continued())
      expect_default("Output",
                     "Checkpoint every",
                     output.checkpoint_every,
                     0.,
                     "a " + analysis,
                     "remove it, or set 'Model/Analysis = dynamic', or let "
                     "cracks grow in a static analysis");
    check_output_quantities();
    if (model.analysis == Analysis::statics)
      return;
    for (const Material &material : materials)
      AssertThrow(material.density > 0.,
                  InputError("the density is " + to_text(material.density),
                             "parameter 'Materials/" + material.name +
                               "/Density'",
                             "a " + analysis + " needs it above 0"));
  }


  void
  SceneParameters::check_output_quantities() const
  {
    const bool moves = model.analysis == Analysis::dynamics ||
                       model.analysis == Analysis::relaxation;
    const auto check = [&](const Quantity quantity, const char *key) {
      AssertThrow(
        moves || !is_velocity(quantity),
        InputError(
          "a " + to_string(model.analysis) + " analysis has no " +
            to_string(quantity),
          std::string("parameter 'Output/") + key + "'",
          "choose another quantity, or set 'Model/Analysis = dynamic'"));
      AssertThrow(has_inelastic_material() ||
                    quantity != Quantity::plastic_strain,
                  InputError("no material of the scene yields",
                             std::string("parameter 'Output/") + key + "'",
                             "choose another quantity, or a material's 'Law = "
                             "Mohr-Coulomb'"));
    };
    check(output.quantity, "Picture quantity");
    for (const Quantity quantity : output.animation_quantities)
      check(quantity, "Animation quantities");
  }


  void
  SceneParameters::check_safety_factor() const
  {
    safety_factor.check(model.analysis);
    if (model.analysis != Analysis::safety_factor)
      return;
    AssertThrow(is_nonlinear(),
                InputError("a scene without contact and without a material "
                           "that yields has no strength",
                           "parameter 'Model/Analysis'",
                           "set 'Contact/Enforcement = penalty', and a "
                           "friction angle or a cohesion, or a material's "
                           "'Law = Mohr-Coulomb'"));
    if (has_inelastic_material())
      return check_safety_output();
    const auto has_strength = [](const ContactLawParameters &law) {
      return law.make_law(CoulombLaw())->transmits_shear();
    };
    AssertThrow(has_strength(contact.law) || std::any_of(contact.laws.begin(),
                                                         contact.laws.end(),
                                                         has_strength),
                InputError("no law of contact has strength to be reduced",
                           "section 'Contact'",
                           "give a friction angle or a cohesion"));
    check_safety_output();
  }


  void
  SceneParameters::check_safety_output() const
  {
    AssertThrow(
      output.fields_every == 0,
      InputError(
        "a series of fields is not available with a safety factor analysis",
        "parameter 'Output/Fields every'",
        "remove it"));
  }


  void
  SceneParameters::check_loads_in_time() const
  {
    if (model.analysis == Analysis::dynamics)
      for (const BoundaryConditionParameters &condition : boundary_conditions)
        AssertThrow(condition.time.release_time < 0. ||
                      condition.type == BoundaryCondition::Type::displacement ||
                      condition.type ==
                        BoundaryCondition::Type::normal_displacement,
                    InputError("a load cannot be released",
                               "parameter 'Boundary conditions/" +
                                 condition.name + "/Release time'",
                               "remove it, and let 'Amplitude' become 0"));
    if (model.analysis == Analysis::dynamics)
      return;

    const std::string by = "a " + to_string(model.analysis) + " analysis";
    for (const BoundaryConditionParameters &condition : boundary_conditions)
      condition.time.expect_default("Boundary conditions", by);
    for (const PointForceParameters &force : point_forces)
      force.time.expect_default("Point forces", by);
    for (const FixedPointParameters &point : fixed_points)
      point.time.expect_default("Fixed points", by);
    for (const auto &[key, text] :
         {std::make_pair("Gravity amplitude", model.gravity_amplitude),
          std::make_pair("Body force amplitude", model.body_force_amplitude),
          std::make_pair("Base acceleration", model.base_acceleration)})
      AssertThrow(text.empty(),
                  UnusedValue("Model",
                              key,
                              text,
                              by,
                              "remove it, or set 'Model/Analysis = dynamic'"));
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
