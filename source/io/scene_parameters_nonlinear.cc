#include <nmm/base/exceptions.h>
#include <nmm/io/scene_parameters.h>

#include <io/parsing.h>
#include <sstream>

// Load steps, Newton's method, and what goes together with which kinematics.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    std::string
    to_text(const double value)
    {
      std::ostringstream out;
      out.precision(12);
      out << value;
      return out.str();
    }


    /// @throws InputError if a value that differs from its default would be
    /// ignored.
    void
    expect_default(const std::string &section,
                   const std::string &key,
                   const double       value,
                   const double       default_value,
                   const Kinematics   kinematics,
                   const std::string &remedy)
    {
      AssertThrow(value == default_value,
                  InputError("'" + key + " = " + to_text(value) +
                               "' would not be used by " +
                               to_string(kinematics) + " kinematics",
                             "parameter '" + section + "/" + key + "'",
                             remedy));
    }
  } // namespace


  void
  LoadStepParameters::declare(ParameterHandler &prm)
  {
    const LoadStepParameters defaults;
    prm.declare_entry("Number of steps",
                      std::to_string(defaults.n_steps),
                      Patterns::Integer(1, 1000000),
                      "Finite and incremental kinematics: equal steps in which "
                      "loads and prescribed displacements grow to their "
                      "values.");
    prm.declare_entry("Smallest step",
                      dealii::Patterns::Tools::to_string(defaults.min_step),
                      Patterns::Double(0, 1),
                      "Finite kinematics: a step that does not converge is "
                      "halved, but not below this part of the last load "
                      "factor, > 0 [-].");
    prm.declare_entry("Load factors",
                      "",
                      Patterns::List(Patterns::Double(0), 0),
                      "Instead of equal steps: the factors on loads and "
                      "prescribed displacements, ascending from above 0 [-]. "
                      "The last may be any.");
  }


  void
  LoadStepParameters::parse(ParameterHandler &prm)
  {
    n_steps  = prm.get_integer("Number of steps");
    min_step = prm.get_double("Smallest step");
    load_factors =
      dealii::Utilities::string_to_double(get_names(prm, "Load factors"));
  }


  void
  LoadStepParameters::check(const Kinematics kinematics) const
  {
    const std::string        section = "Load steps";
    const LoadStepParameters defaults;
    if (kinematics == Kinematics::small)
    {
      const std::string remedy =
        "remove it, or set 'Model/Kinematics' to finite or incremental";
      expect_default(section,
                     "Number of steps",
                     n_steps,
                     defaults.n_steps,
                     kinematics,
                     remedy);
      AssertThrow(
        load_factors.empty(),
        InputError("the list of " + std::to_string(load_factors.size()) +
                     " load factor(s) from " + to_text(load_factors.front()) +
                     " on would not be used by small kinematics",
                   "parameter 'Load steps/Load factors'",
                   remedy));
    }
    if (kinematics != Kinematics::finite)
      expect_default(section,
                     "Smallest step",
                     min_step,
                     defaults.min_step,
                     kinematics,
                     "remove it, or set 'Model/Kinematics = finite'");
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
      AssertThrow(factor > last,
                  InputError("the load factor " + to_text(factor) +
                               " follows " + to_text(last),
                             "parameter 'Load steps/Load factors'",
                             "give factors that ascend from above 0"));
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
  NewtonSectionParameters::declare(ParameterHandler &prm)
  {
    const NewtonParameters defaults;
    prm.declare_entry(
      "Residual tolerance",
      dealii::Patterns::Tools::to_string(defaults.residual_tolerance),
      Patterns::Double(0, 1),
      "Finite kinematics: forces out of balance over the forces "
      "in balance at which an iteration ends, > 0 [-].");
    prm.declare_entry("Energy tolerance",
                      dealii::Patterns::Tools::to_string(
                        defaults.energy_tolerance),
                      Patterns::Double(0, 1),
                      "Finite kinematics: and the work of these forces in the "
                      "last correction over the largest such work, > 0 [-].");
    prm.declare_entry("Maximum iterations",
                      std::to_string(defaults.max_iterations),
                      Patterns::Integer(1, 1000),
                      "Finite kinematics: iterations after which a load step "
                      "is halved.");
  }


  void
  NewtonSectionParameters::parse(ParameterHandler &prm)
  {
    newton.residual_tolerance = prm.get_double("Residual tolerance");
    newton.energy_tolerance   = prm.get_double("Energy tolerance");
    newton.max_iterations     = prm.get_integer("Maximum iterations");
  }


  void
  NewtonSectionParameters::check(const Kinematics kinematics) const
  {
    const NewtonParameters defaults;
    if (kinematics != Kinematics::finite)
    {
      const std::string remedy =
        "remove it, or set 'Model/Kinematics = finite'";
      expect_default("Newton",
                     "Residual tolerance",
                     newton.residual_tolerance,
                     defaults.residual_tolerance,
                     kinematics,
                     remedy);
      expect_default("Newton",
                     "Energy tolerance",
                     newton.energy_tolerance,
                     defaults.energy_tolerance,
                     kinematics,
                     remedy);
      expect_default("Newton",
                     "Maximum iterations",
                     newton.max_iterations,
                     defaults.max_iterations,
                     kinematics,
                     remedy);
    }
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
    const std::string name = to_string(model.kinematics);
    if (model.kinematics != Kinematics::finite)
      for (const Material &material : materials)
        AssertThrow(material.law == MaterialLaw::linear,
                    InputError("a law other than linear would not be used by " +
                                 name + " kinematics",
                               "parameter 'Materials/" + material.name +
                                 "/Law'",
                               "set 'Law = linear', or 'Model/Kinematics = "
                               "finite'"));
    if (model.kinematics == Kinematics::small)
    {
      expect_default("Output",
                     "Fields every",
                     output.fields_every,
                     0,
                     model.kinematics,
                     "remove it, or set 'Model/Kinematics' to finite or "
                     "incremental");
      return;
    }

    AssertThrow(covers.stabilization != Stabilization::ghost_penalty,
                InputError("'ghost penalty' is not available with " + name +
                             " kinematics",
                           "parameter 'Covers/Stabilization'",
                           "set 'Stabilization = aggregation'"));
    AssertThrow(solver.type != LinearSolverParameters::Type::iterative,
                InputError("'iterative' is not available with " + name +
                             " kinematics",
                           "parameter 'Solver/Type'",
                           "set 'Type' to automatic or direct"));
    AssertThrow(!solver.estimate_condition,
                InputError("'true' is not available with " + name +
                             " kinematics",
                           "parameter 'Solver/Condition number'",
                           "set it to false, or 'Model/Kinematics = small'"));
    AssertThrow(exact_solution.type == ExactSolutionParameters::Type::none,
                InputError("the thick ring is no solution of " + name +
                             " kinematics",
                           "parameter 'Exact solution/Type'",
                           "set it to none, or 'Model/Kinematics = small'"));
  }
} // namespace NMM
