#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>

// Time: steps, schemes, relaxation, initial velocities, loads as functions of time.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const std::vector<std::pair<std::string, Analysis>> analyses = {
      {"static", Analysis::statics},
      {"dynamic", Analysis::dynamics},
      {"relaxation", Analysis::relaxation},
      {"safety factor", Analysis::safety_factor}};

    using Start = TimeParameters::Start;
    const std::vector<std::pair<std::string, Start>> starts = {
      {"undeformed", Start::undeformed},
      {"equilibrium", Start::equilibrium},
      {"relaxation", Start::relaxation}};

    using Scheme = TimeParameters::Scheme;
    const std::vector<std::pair<std::string, Scheme>> schemes = {
      {"automatic", Scheme::automatic},
      {"newmark", Scheme::newmark},
      {"generalized alpha", Scheme::generalized_alpha},
      {"constant acceleration", Scheme::constant_acceleration},
      {"energy momentum", Scheme::energy_momentum}};


    /// Entries of `Time` that are numbers: key, place, limits and help.
    struct NumberEntry
    {
      const char *key;
      double     &value;
      double      least, greatest;
      const char *help;
    };


    std::vector<NumberEntry>
    step_entries(TimeParameters &time)
    {
      const double none = Patterns::Double::max_double_value;
      return {
        {"Initial step",
         time.initial_step,
         0.,
         none,
         "First step, and the only one if nothing below asks for "
         "others, > 0 [s]."},
        {"Smallest step",
         time.min_step,
         0.,
         none,
         "A step that fails, moves too far or errs too much is cut, but not "
         "below this (exit code 3) [s]; 0: a millionth of the first."},
        {"Largest step",
         time.max_step,
         0.,
         none,
         "Steps grow to this while they are easy [s]; 0: not beyond the "
         "first."},
        {"Largest displacement",
         time.max_displacement,
         0.,
         none,
         "No part moves further in a step [m]; 0: any."},
        {"Largest error",
         time.max_error,
         0.,
         none,
         "Estimated error of a step's displacement [m]; 0: any."}};
    }


    std::vector<NumberEntry>
    scheme_entries(TimeParameters &time)
    {
      const double none = Patterns::Double::max_double_value;
      return {
        {"Newmark beta",
         time.beta,
         0.,
         1.,
         "newmark: beta, > 0; with 1/4 and gamma 1/2 second order and "
         "no damping [-]."},
        {"Newmark gamma",
         time.gamma,
         0.5,
         2.,
         "newmark: gamma; more than 1/2 damps and is of first order [-]."},
        {"Spectral radius",
         time.spectral_radius,
         0.,
         1.,
         "generalized alpha: share of the highest frequencies that is left "
         "after a step; 1: no damping [-]."},
        {"Mass damping",
         time.damping.mass,
         0.,
         none,
         "Rayleigh damping: coefficient of the mass matrix [1/s]."},
        {"Stiffness damping",
         time.damping.stiffness,
         -none,
         none,
         "Rayleigh damping: coefficient of the stiffness at rest [s]. "
         "Negative: "
         "0, but in a dynamic analysis with friction and the scheme energy "
         "momentum what damps the lowest vibration of a block of median size "
         "critically."}};
    }


    std::vector<NumberEntry>
    sleep_entries(TimeParameters &time)
    {
      const double none = Patterns::Double::max_double_value;
      return {
        {"Sleep speed",
         time.sleep.speed,
         0.,
         none,
         "A block whose root mean square speed stays below this may sleep: it "
         "is held where it is and costs nearly nothing until forces on it "
         "change [m/s]; 0: nobody sleeps. Contact, one rank."},
        {"Sleep time",
         time.sleep.time,
         0.,
         none,
         "How long it must stay below before it sleeps [s]."},
        {"Wake acceleration",
         time.sleep.acceleration,
         0.,
         none,
         "A block that sleeps wakes when the force on it changes by more than "
         "its mass times this, or the moment by as much over the radius of "
         "inertia, > 0 [m/s^2]."}};
    }


    void
    declare_numbers(ParameterHandler               &prm,
                    const std::vector<NumberEntry> &entries)
    {
      for (const NumberEntry &entry : entries)
        prm.declare_entry(entry.key,
                          to_text(entry.value),
                          Patterns::Double(entry.least, entry.greatest),
                          entry.help);
    }
  } // namespace


  const std::string &
  to_string(const Analysis analysis)
  {
    for (const auto &choice : analyses)
      if (choice.second == analysis)
        return choice.first;
    AssertThrow(false, dealii::ExcInternalError());
    return analyses.front().first;
  }


  namespace internal
  {
    void
    declare_analysis(ParameterHandler &prm)
    {
      prm.declare_entry("Analysis",
                        "static",
                        selection(analyses),
                        "static: equilibrium; dynamic: the motion, see section "
                        "Time; relaxation: equilibrium, found by a motion that "
                        "is stopped whenever its energy has passed a peak, see "
                        "section Relaxation; safety factor: by how much the "
                        "strength of contact can be divided before blocks "
                        "move, see section Safety factor.");
    }


    Analysis
    get_analysis(const ParameterHandler &prm)
    {
      return get_selection(prm, "Analysis", analyses);
    }
  } // namespace internal


  void
  TimeDependence::declare(ParameterHandler &prm, const bool may_be_released)
  {
    prm.declare_entry("Amplitude",
                      "",
                      Patterns::Anything(),
                      "Dynamic analysis: factor on it, an expression of the "
                      "time t, or 'file: name' of a file with lines of time "
                      "and factor. Empty: 1.");
    if (may_be_released)
      prm.declare_entry("Release time",
                        "-1",
                        Patterns::Double(),
                        "Dynamic analysis, displacements: from this time on it "
                        "holds no longer [s]; negative: it always holds.");
  }


  void
  TimeDependence::parse(ParameterHandler &prm, const bool may_be_released)
  {
    amplitude = prm.get("Amplitude");
    if (may_be_released)
      release_time = prm.get_double("Release time");
  }


  void
  TimeDependence::expect_default(const std::string &section,
                                 const std::string &by) const
  {
    const std::string where = "parameter '" + section + "/" + name + "/";
    AssertThrow(amplitude.empty(),
                InputError("the amplitude '" + amplitude +
                             "' would not be used by " + by,
                           where + "Amplitude'",
                           "remove it, or set 'Model/Analysis = dynamic' with "
                           "small or finite kinematics"));
    AssertThrow(release_time < 0.,
                InputError("a release at " + to_text(release_time) +
                             " s would not be used by " + by,
                           where + "Release time'",
                           "remove it, or set 'Model/Analysis = dynamic' with "
                           "small or finite kinematics"));
  }


  void
  TimeParameters::declare(ParameterHandler &prm)
  {
    TimeParameters defaults;
    prm.declare_entry("End time",
                      "0",
                      Patterns::Double(0),
                      "Dynamic analysis: it runs from 0 to this, > 0 [s].");
    prm.declare_entry("Start",
                      "undeformed",
                      selection(starts),
                      "What a dynamic analysis starts from. equilibrium: of "
                      "loads, supports and obstacles as they are at 0 s, "
                      "before anything is released, in the steps of the "
                      "section 'Load steps'; relaxation: the same, found by "
                      "motion that is stopped again and again (section "
                      "'Relaxation').");
    declare_numbers(prm, step_entries(defaults));
    prm.declare_entry(
      "Scheme",
      "automatic",
      selection(schemes),
      "newmark: trapezoidal rule, good for small displacements; "
      "generalized alpha: damps what steps do not resolve; constant "
      "acceleration: the scheme of DDA, damps much, first order; energy "
      "momentum: conserves energy and momenta under large rotations; "
      "automatic: newmark for small, energy momentum for finite kinematics and "
      "contact, constant acceleration for incremental kinematics and "
      "relaxation.");
    declare_numbers(prm, scheme_entries(defaults));
    declare_numbers(prm, sleep_entries(defaults));
  }


  void
  TimeParameters::parse(ParameterHandler &prm)
  {
    end_time = prm.get_double("End time");
    start    = get_selection(prm, "Start", starts);
    for (const auto &entries :
         {step_entries(*this), scheme_entries(*this), sleep_entries(*this)})
      for (const NumberEntry &entry : entries)
        entry.value = prm.get_double(entry.key);
    scheme = get_selection(prm, "Scheme", schemes);
  }


  void
  TimeParameters::check(const Analysis   analysis,
                        const Kinematics kinematics,
                        const bool       has_contact) const
  {
    TimeParameters given = *this, defaults;
    // 0 asks for what these have anyway
    if (given.damping.stiffness == 0.)
      given.damping.stiffness = defaults.damping.stiffness;
    const std::string by =
      "a " + to_string(analysis) +
      (analysis == Analysis::relaxation ? "" : " analysis");
    const auto expect_defaults = [&](const std::vector<NumberEntry> &values,
                                     const std::vector<NumberEntry> &others) {
      for (unsigned int i = 0; i < values.size(); ++i)
        expect_default("Time",
                       values[i].key,
                       values[i].value,
                       others[i].value,
                       by,
                       "remove it, or set 'Model/Analysis = dynamic'");
    };
    if (analysis != Analysis::dynamics)
    {
      expect_default("Time",
                     "End time",
                     end_time,
                     0.,
                     by,
                     "remove it, or set 'Model/Analysis = dynamic'");
      expect_defaults(step_entries(given), step_entries(defaults));
      expect_defaults(sleep_entries(given), sleep_entries(defaults));
      AssertThrow(start == Start::undeformed,
                  InputError("a start would not be used by " + by,
                             "parameter 'Time/Start'",
                             "remove it, or set 'Model/Analysis = dynamic'"));
    }
    AssertThrow(sleep.speed == 0. || (has_contact && sleep.acceleration > 0. &&
                                      kinematics != Kinematics::incremental),
                InputError("blocks sleep only in motion with contact and small "
                           "or finite kinematics, and wake at accelerations "
                           "above 0",
                           "parameter 'Time/Sleep speed'",
                           "set it to 0, or 'Contact' and 'Wake "
                           "acceleration'"));
    AssertThrow(start == Start::undeformed ||
                  kinematics != Kinematics::incremental,
                InputError("a start from equilibrium is not available with "
                           "incremental kinematics",
                           "parameter 'Time/Start'",
                           "set 'Model/Kinematics' to small or finite"));
    if (analysis == Analysis::statics)
    {
      expect_defaults(scheme_entries(given), scheme_entries(defaults));
      AssertThrow(scheme == Scheme::automatic,
                  InputError("a scheme would not be used by " + by,
                             "parameter 'Time/Scheme'",
                             "remove it, or set 'Model/Analysis = dynamic'"));
      return;
    }
    check_scheme(analysis, kinematics, has_contact);
    if (analysis == Analysis::dynamics)
      check_steps(kinematics);
  }


  void
  TimeParameters::check_scheme(const Analysis   analysis,
                               const Kinematics kinematics,
                               const bool       has_contact) const
  {
    const TimeParameters defaults;
    const std::string    name =
      time_scheme(analysis, kinematics, has_contact).name;
    const auto expect = [&](const bool         is_used,
                            const std::string &key,
                            const double       value,
                            const double       default_value) {
      if (!is_used)
        expect_default("Time",
                       key,
                       value,
                       default_value,
                       "the scheme '" + name + "'",
                       "remove it, or choose its scheme in 'Time/Scheme'");
    };
    const bool is_newmark =
      scheme == Scheme::newmark ||
      (scheme == Scheme::automatic && kinematics == Kinematics::small &&
       analysis == Analysis::dynamics && !has_contact);
    expect(is_newmark, "Newmark beta", beta, defaults.beta);
    expect(is_newmark, "Newmark gamma", gamma, defaults.gamma);
    expect(scheme == Scheme::generalized_alpha,
           "Spectral radius",
           spectral_radius,
           defaults.spectral_radius);
    AssertThrow(beta > 0.,
                InputError("beta is 0",
                           "parameter 'Time/Newmark beta'",
                           "choose it in (0, 1]; explicit schemes are not "
                           "available"));
    if (kinematics != Kinematics::incremental)
      return;
    AssertThrow(scheme == Scheme::automatic ||
                  scheme == Scheme::constant_acceleration,
                InputError("the scheme '" + name +
                             "' is not available with incremental kinematics",
                           "parameter 'Time/Scheme'",
                           "set it to constant acceleration, or "
                           "'Model/Kinematics' to small or finite"));
    const std::string by = "incremental kinematics";
    const std::string remedy =
      "remove it, or set 'Model/Kinematics' to small or finite";
    expect_default("Time", "Mass damping", damping.mass, 0., by, remedy);
    expect_default("Time",
                   "Stiffness damping",
                   std::max(0., damping.stiffness),
                   0.,
                   by,
                   remedy);
  }


  void
  TimeParameters::check_steps(const Kinematics kinematics) const
  {
    TimeParameters given = *this;
    const auto     check = [](const bool         is_good,
                          const std::string &key,
                          const double       value,
                          const std::string &remedy) {
      AssertThrow(is_good,
                  InputError("'" + key + "' is " + to_text(value),
                             "parameter 'Time/" + key + "'",
                             remedy));
    };
    check(end_time > 0. && std::isfinite(end_time),
          "End time",
          end_time,
          "set the time the motion ends at, above 0 s");
    check(initial_step > 0. && std::isfinite(initial_step),
          "Initial step",
          initial_step,
          "set the first time step, above 0 s");
    check(initial_step <= end_time,
          "Initial step",
          initial_step,
          "choose it no longer than 'End time'");
    check(min_step <= initial_step,
          "Smallest step",
          min_step,
          "choose it no longer than 'Initial step'");
    check(max_step == 0. || max_step >= initial_step,
          "Largest step",
          max_step,
          "choose it no shorter than 'Initial step', or 0");
    if (kinematics != Kinematics::incremental)
      return;
    // equal steps, or steps that a bound on displacements divides
    for (const NumberEntry &entry : step_entries(given))
    {
      const std::string key = entry.key;
      if (key == "Initial step" || key == "Largest displacement" ||
          (key == "Smallest step" && max_displacement > 0.))
        continue;
      expect_default("Time",
                     key,
                     entry.value,
                     0.,
                     "incremental kinematics",
                     "remove it, or set 'Model/Kinematics' to small or "
                     "finite");
    }
  }


  StepControlParameters
  TimeParameters::step_control() const
  {
    StepControlParameters parameters;
    parameters.initial_step     = initial_step;
    parameters.min_step         = min_step;
    parameters.max_step         = max_step;
    parameters.max_displacement = max_displacement;
    parameters.max_error        = max_error;
    return parameters;
  }


  TimeScheme
  TimeParameters::time_scheme(const Analysis   analysis,
                              const Kinematics kinematics,
                              const bool       has_contact) const
  {
    switch (scheme)
    {
      case Scheme::newmark:
        return TimeScheme::newmark(beta, gamma);
      case Scheme::generalized_alpha:
        return TimeScheme::generalized_alpha(spectral_radius);
      case Scheme::constant_acceleration:
        return TimeScheme::constant_acceleration();
      case Scheme::energy_momentum:
        return TimeScheme::energy_momentum();
      case Scheme::automatic:
        break;
    }
    if (analysis == Analysis::relaxation ||
        analysis == Analysis::safety_factor ||
        kinematics == Kinematics::incremental)
      return TimeScheme::constant_acceleration();
    return kinematics == Kinematics::finite || has_contact
             ? TimeScheme::energy_momentum()
             : TimeScheme::newmark(beta, gamma);
  }


  void
  RelaxationSectionParameters::declare(ParameterHandler &prm)
  {
    const RelaxationParameters defaults;
    prm.declare_entry("Step",
                      "0",
                      Patterns::Double(0),
                      "First time step, > 0; the lowest period is a good one "
                      "[s].");
    prm.declare_entry("Step growth",
                      to_text(defaults.growth),
                      Patterns::Double(1, 10),
                      "Factor on the step after each step [-].");
    prm.declare_entry("Tolerance",
                      to_text(defaults.tolerance),
                      Patterns::Double(0, 1),
                      "Forces out of balance over forces in balance that count "
                      "as rest, > 0 [-].");
    prm.declare_entry("Maximum steps",
                      to_text(defaults.max_steps),
                      Patterns::Integer(1, 100000000),
                      "Steps after which it gives up (exit code 3).");
  }


  void
  RelaxationSectionParameters::parse(ParameterHandler &prm)
  {
    relaxation.step      = prm.get_double("Step");
    relaxation.growth    = prm.get_double("Step growth");
    relaxation.tolerance = prm.get_double("Tolerance");
    relaxation.max_steps = prm.get_integer("Maximum steps");
  }


  void
  RelaxationSectionParameters::check(const Analysis analysis) const
  {
    if (analysis != Analysis::relaxation)
    {
      const RelaxationParameters defaults;
      const auto                 expect =
        [&](const char *key, const double value, const double default_value) {
          expect_default("Relaxation",
                         key,
                         value,
                         default_value,
                         "a " + to_string(analysis) + " analysis",
                         "remove it, or set 'Model/Analysis = relaxation'");
        };
      expect("Step", relaxation.step, 0.);
      expect("Step growth", relaxation.growth, defaults.growth);
      expect("Tolerance", relaxation.tolerance, defaults.tolerance);
      expect("Maximum steps", relaxation.max_steps, defaults.max_steps);
      return;
    }
    AssertThrow(relaxation.step > 0. && std::isfinite(relaxation.step),
                InputError("the first step is " + to_text(relaxation.step) +
                             " s",
                           "parameter 'Relaxation/Step'",
                           "set it to about the lowest period of the solid"));
    AssertThrow(relaxation.tolerance > 0.,
                InputError("the tolerance is 0",
                           "parameter 'Relaxation/Tolerance'",
                           "give a positive number such as 1e-8"));
  }


  void
  InitialVelocityParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Block",
                      "all",
                      Patterns::Anything(),
                      "x, y of a point inside the block that moves [m], or "
                      "all: the whole solid.");
    prm.declare_entry("Translation",
                      "0, 0",
                      vector_pattern(),
                      "Velocity vx, vy [m/s].");
    prm.declare_entry("Angular velocity",
                      "0",
                      Patterns::Double(),
                      "Counter-clockwise about Center [rad/s].");
    prm.declare_entry("Center",
                      "",
                      Patterns::Anything(),
                      "x, y of the point it turns about [m]; empty: the "
                      "centroid of what moves.");
  }


  void
  InitialVelocityParameters::parse(ParameterHandler &prm)
  {
    block =
      get_optional_point(prm, "Block", "all", "Initial velocities/" + name);
    center =
      get_optional_point(prm, "Center", "", "Initial velocities/" + name);
    translation      = get_point(prm, "Translation");
    angular_velocity = prm.get_double("Angular velocity");
  }
} // namespace NMM
