#include <nmm/base/exceptions.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/scene/scene_parameters_dynamics.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>

// This file has the parameters of dynamics: steps, schemes, relaxation, initial velocities, and
// loads as functions of time.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<Analysis> analyses = {{"static", Analysis::statics},
                                      {"dynamic", Analysis::dynamics},
                                      {"relaxation", Analysis::relaxation},
                                      {"safety factor",
                                       Analysis::safety_factor}};

    using Start               = TimeParameters::Start;
    const Words<Start> starts = {{"undeformed", Start::undeformed},
                                 {"equilibrium", Start::equilibrium},
                                 {"relaxation", Start::relaxation}};

    using Scheme                = TimeParameters::Scheme;
    const Words<Scheme> schemes = {
      {"automatic", Scheme::automatic},
      {"newmark", Scheme::newmark},
      {"generalized alpha", Scheme::generalized_alpha},
      {"constant acceleration", Scheme::constant_acceleration},
      {"energy momentum", Scheme::energy_momentum}};
  } // namespace


  const std::string &
  to_string(const Analysis analysis)
  {
    return word_of(analysis, analyses);
  }


  void
  list_entry(Entries &entries, Analysis &analysis)
  {
    entries.add(
      "Analysis",
      analysis,
      analyses,
      "static: equilibrium; dynamic: the motion, see section Time; relaxation: "
      "equilibrium, found by a motion that is stopped again and again, "
      "see section Relaxation; safety factor: by how much the "
      "strength of contact can be divided before blocks move, see section "
      "Safety factor.");
  }


  void
  TimeDependence::list_entries(Entries &entries, const bool may_be_released)
  {
    entries.add(
      "Amplitude",
      amplitude,
      "Dynamic analysis: factor on it, an expression of the time t, or 'file: "
      "name' of a file with lines of time and factor. Empty: 1.");
    if (may_be_released)
      entries.add("Release time",
                  release_time,
                  Patterns::Double(),
                  "Dynamic analysis, displacements: from this time on it holds "
                  "no longer [s]; negative: it always holds.");
  }


  void
  TimeParameters::list_entries(Entries &entries)
  {
    entries.add("End time",
                end_time,
                Patterns::Double(0),
                "Dynamic analysis: it runs from 0 to this, > 0 [s].");
    entries.add(
      "Start",
      start,
      starts,
      "What a dynamic analysis starts from. equilibrium: of loads, supports "
      "and obstacles as they are at 0 s, before anything is released, in the "
      "steps of the section 'Load steps'; relaxation: the same, found by "
      "motion that is stopped again and again (section 'Relaxation').");
    entries.add("Initial step",
                initial_step,
                Patterns::Double(0),
                "First step, and the only one if nothing below asks for "
                "others, > 0 [s].");
    entries.add(
      "Smallest step",
      min_step,
      Patterns::Double(0),
      "A step that fails, moves too far or errs too much is cut, but not below "
      "this (exit code 3) [s]; 0: a millionth of the first.");
    entries.add(
      "Largest step",
      max_step,
      Patterns::Double(0),
      "Steps grow to this while they are easy [s]; 0: not beyond the first.");
    entries.add("Largest displacement",
                max_displacement,
                Patterns::Double(0),
                "No part moves further in a step [m]; 0: any.");
    entries.add("Largest error",
                max_error,
                Patterns::Double(0),
                "Estimated error of a step's displacement [m]; 0: any.");
    entries.add(
      "Scheme",
      scheme,
      schemes,
      "newmark: trapezoidal rule, good for small displacements; generalized "
      "alpha: damps what steps do not resolve; constant acceleration: the "
      "scheme of DDA, damps much, first order; energy momentum: conserves "
      "energy and momenta under large rotations; automatic: newmark for small, "
      "energy momentum for finite kinematics and contact, constant "
      "acceleration for relaxation.");
    entries.add("Newmark beta",
                beta,
                Patterns::Double(0, 1),
                "newmark: beta, > 0; with 1/4 and gamma 1/2 second order and "
                "no damping [-].");
    entries.add(
      "Newmark gamma",
      gamma,
      Patterns::Double(0.5, 2),
      "newmark: gamma; more than 1/2 damps and is of first order [-].");
    entries.add("Spectral radius",
                spectral_radius,
                Patterns::Double(0, 1),
                "generalized alpha: share of the highest frequencies that is "
                "left after a step; 1: no damping [-].");
    entries.add("Mass damping",
                damping.mass,
                Patterns::Double(0),
                "Rayleigh damping: coefficient of the mass matrix [1/s].");
    entries.add("Stiffness damping",
                damping.stiffness,
                Patterns::Double(),
                "Rayleigh damping: coefficient of the stiffness at rest [s]. "
                "Negative: 0, but in a dynamic analysis with friction and the "
                "scheme energy momentum what damps the lowest vibration of a "
                "block of median size critically.");
    entries.add(
      "Sleep speed",
      sleep.speed,
      Patterns::Double(0),
      "A block whose root mean square speed stays below this may sleep: it is "
      "held where it is and costs nearly nothing until forces on it change "
      "[m/s]; 0: no block sleeps. Contact, one rank.");
    entries.add("Sleep time",
                sleep.time,
                Patterns::Double(0),
                "How long it must stay below before it sleeps [s].");
    entries.add("Wake acceleration",
                sleep.acceleration,
                Patterns::Double(0),
                "A block that sleeps wakes when the force on it changes by "
                "more than its mass times this, or the moment by as much over "
                "the radius of inertia, > 0 [m/s^2].");
  }


  void
  TimeParameters::check(const Analysis   analysis,
                        const Kinematics kinematics,
                        const bool       has_contact) const
  {
    if (analysis != Analysis::dynamics)
    {
      TimeParameters       given = *this;
      const TimeParameters defaults;
      const bool           is_static = analysis == Analysis::statics;
      if (!is_static)
      {
        // Relaxation uses a time scheme, whose parameters may differ from their defaults.
        given.scheme          = defaults.scheme;
        given.beta            = defaults.beta;
        given.gamma           = defaults.gamma;
        given.spectral_radius = defaults.spectral_radius;
        given.damping.mass    = defaults.damping.mass;
      }
      // Other analyses have no damping, so a coefficient of 0 is what they use.
      if (!is_static || given.damping.stiffness == 0.)
        given.damping.stiffness = defaults.damping.stiffness;
      expect_defaults("Time",
                      given,
                      "a " + to_string(analysis) +
                        (analysis == Analysis::relaxation ? "" : " analysis"),
                      "remove it, or set 'Model/Analysis = dynamic'");
      if (is_static)
        return;
    }
    AssertThrow(
      sleep.speed == 0. || sleep.acceleration > 0.,
      InputError("blocks that sleep would wake without any acceleration",
                 "parameter 'Time/Wake acceleration'",
                 "set it above 0"));
    check_scheme(analysis, kinematics, has_contact);
    if (analysis == Analysis::dynamics)
      check_steps();
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
    AssertThrow(
      beta > 0.,
      InputError("beta is 0",
                 "parameter 'Time/Newmark beta'",
                 "choose it in (0, 1]; explicit schemes are not available"));
  }


  void
  TimeParameters::check_steps() const
  {
    const auto check = [](const bool         is_good,
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
    if (analysis == Analysis::relaxation || analysis == Analysis::safety_factor)
      return TimeScheme::constant_acceleration();
    return kinematics == Kinematics::finite || has_contact
             ? TimeScheme::energy_momentum()
             : TimeScheme::newmark(beta, gamma);
  }


  void
  RelaxationSectionParameters::list_entries(Entries &entries)
  {
    entries.add("Step",
                relaxation.step,
                Patterns::Double(0),
                "First time step, > 0; the lowest period is a good one [s].");
    entries.add("Step growth",
                relaxation.growth,
                Patterns::Double(1, 10),
                "Factor on the step after each step [-].");
    entries.add(
      "Tolerance",
      tolerance,
      Patterns::Double(0, 1),
      "Forces out of balance over forces in balance that count as "
      "rest [-]; 0: 1e-8, in trials of the factor of safety 1e-4 times "
      "their tolerance and at most 1e-6.");
    entries.add("Largest displacement",
                relaxation.max_displacement,
                Patterns::Double(0),
                "What moves further finds no rest (exit code 3, and the block "
                "is named), and no step moves further than a hundredth of it "
                "[m]; 0: twice the length of a block of mean size, at least a "
                "tenth of the solid's, and steps of up to a tenth of that.");
    entries.add("Maximum steps",
                relaxation.max_steps,
                Patterns::Integer(1, 100000000),
                "Steps after which it gives up (exit code 3).");
  }


  RelaxationParameters
  RelaxationSectionParameters::bounded(const PhysicalMesh &mesh) const
  {
    RelaxationParameters result = relaxation;
    if (tolerance > 0.)
      result.tolerance = tolerance;
    // A column that topples comes to rest further away than it is long. A block that slides out of
    // a rock mass has to be called a mechanism before its whole way has been computed.
    if (result.max_displacement == 0.)
    {
      const auto   corners = mesh.bounding_box().get_boundary_points();
      const double extent  = corners.first.distance(corners.second);
      result.max_displacement =
        extent * std::max(0.1, 2. / std::sqrt(double(mesh.n_blocks())));
      result.max_step_displacement =
        0.1 * std::min(extent, result.max_displacement);
    }
    return result;
  }


  RelaxationParameters
  RelaxationSectionParameters::of_trial(const double max_displacement,
                                        const double factor_tolerance) const
  {
    RelaxationParameters result = relaxation;
    result.tolerance =
      tolerance > 0. ? tolerance : std::min(1e-6, 1e-4 * factor_tolerance);
    result.max_displacement = max_displacement;
    return result;
  }


  void
  RelaxationSectionParameters::check(const Analysis analysis) const
  {
    if (analysis != Analysis::relaxation)
    {
      expect_defaults("Relaxation",
                      *this,
                      "a " + to_string(analysis) + " analysis",
                      "remove it, or set 'Model/Analysis = relaxation'");
      return;
    }
    AssertThrow(relaxation.step > 0. && std::isfinite(relaxation.step),
                InputError("the first step is " + to_text(relaxation.step) +
                             " s",
                           "parameter 'Relaxation/Step'",
                           "set it to about the lowest period of the solid"));
  }


  void
  InitialVelocityParameters::list_entries(Entries &entries)
  {
    entries.add("Block",
                block,
                "all",
                "Initial velocities/" + name,
                "x, y of a point inside the block that moves [m], or all: the "
                "whole solid.");
    entries.add("Translation", translation, "Velocity vx, vy [m/s].");
    entries.add("Angular velocity",
                angular_velocity,
                Patterns::Double(),
                "Counter-clockwise about Center [rad/s].");
    entries.add("Center",
                center,
                "",
                "Initial velocities/" + name,
                "x, y of the point it turns about [m]; empty: the centroid of "
                "what moves.");
  }
} // namespace NMM
