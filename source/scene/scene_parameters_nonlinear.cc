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
    check_releases();
    check_output_quantities();
    if (model.analysis == Analysis::statics)
      return;
    for (const Material &material : materials)
      AssertThrow(material.density > 0.,
                  InputError("the density is " + to_text(material.density),
                             "parameter 'Materials/" + material.name +
                               "/Density'",
                             "a " + to_string(model.analysis) +
                               " analysis needs it above 0"));
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
    const auto has_strength = [](const ContactLawParameters &law) {
      return law.make_law(CoulombLaw())->transmits_shear();
    };
    const bool have_joints =
      contact.is_present() &&
      (has_strength(contact.law) ||
       std::any_of(contact.laws.begin(), contact.laws.end(), has_strength));
    const bool have_blocks = has_inelastic_material();
    AssertThrow(safety_factor.reduced != ReducedStrength::blocks || have_blocks,
                InputError("no material has strength to be reduced",
                           "parameter 'Safety factor/Reduce'",
                           "set a material's 'Law = Mohr-Coulomb', or reduce "
                           "the strength of joints"));
    AssertThrow(safety_factor.reduced == ReducedStrength::blocks ||
                  have_joints || !contact.is_present() ||
                  (have_blocks &&
                   safety_factor.reduced == ReducedStrength::both),
                InputError("no law of contact has strength to be reduced",
                           "section 'Contact'",
                           "give a friction angle or a cohesion"));
    AssertThrow(safety_factor.reduced != ReducedStrength::joints ||
                  contact.is_present(),
                InputError("there are no joints whose strength could be "
                           "reduced, since faces do not touch",
                           "parameter 'Safety factor/Reduce'",
                           "set 'Contact/Enforcement = penalty', or reduce "
                           "the strength of blocks"));
  }


  void
  SceneParameters::check_releases() const
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
  }


  void
  SceneParameters::check_bolts() const
  {
    std::map<std::string, std::string> installed_in;
    for (const StageParameters &stage : stages)
      for (const std::string &name : stage.installed)
      {
        const std::string where =
          "parameter 'Stages/" + stage.name + "/Install'";
        AssertThrow(std::any_of(bolts.begin(),
                                bolts.end(),
                                [&](const BoltParameters &bolt) {
                                  return bolt.name == name;
                                }),
                    InputError("there is no bolt '" + name + "'",
                               where,
                               "name a bolt of section 'Bolts'"));
        AssertThrow(installed_in.emplace(name, stage.name).second,
                    InputError("the bolt '" + name +
                                 "' is installed a second time, after stage '" +
                                 installed_in[name] + "'",
                               where,
                               "install each bolt once"));
      }
  }
} // namespace NMM
