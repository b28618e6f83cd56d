#ifndef nmm_scene_scene_parameters_dynamics_h
#define nmm_scene_scene_parameters_dynamics_h

#include <nmm/dynamics/step_control.h>
#include <nmm/dynamics/strength_reduction.h>
#include <nmm/dynamics/time_scheme.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <optional>
#include <string>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  enum class Kinematics;

  /// What is asked about the solid.
  enum class Analysis
  {
    /// Equilibrium.
    statics,
    /// Motion in time.
    dynamics,
    /// Equilibrium, found by motion with kinetic damping.
    relaxation,
    /// Find the number by which strength can be divided before blocks move.
    safety_factor
  };

  /// Its name in scene files.
  const std::string &
  to_string(Analysis analysis);


  /// How a load or condition changes in time.
  struct TimeDependence
  {
    /// Name of the load's section entry, for messages.
    std::string name;
    /// Expression of t or "file: name"; empty: 1.
    std::string amplitude;
    /// [s]; negative: never.
    double release_time = -1.;

    void
    list_entries(internal::Entries &entries, bool may_be_released);
    /// @throws InputError, if something is set, that @p by makes no use of it.
    /// @p section is that of the load.
    void
    expect_default(const std::string &section, const std::string &by) const;
  };


  /// The section `Time`.
  struct TimeParameters
  {
    enum class Scheme
    {
      /// energy_momentum, newmark and constant_acceleration for finite, small and
      /// incremental kinematics; with contact energy_momentum.
      automatic,
      newmark,
      generalized_alpha,
      constant_acceleration,
      energy_momentum
    };

    /// What a dynamic analysis starts from.
    enum class Start
    {
      /// No displacements.
      undeformed,
      /// Equilibrium of the loads and supports at t = 0, before any release, by
      /// load steps and Newton's method.
      equilibrium,
      /// The same by motion with kinetic damping.
      relaxation
    };

    Start  start    = Start::undeformed;
    double end_time = 0.;
    /// StepControlParameters.
    double initial_step = 0., min_step = 0., max_step = 0.,
           max_displacement = 0., max_error = 0.;
    Scheme scheme = Scheme::automatic;
    double beta = 0.25, gamma = 0.5, spectral_radius = 0.8;
    /// Stiffness below 0: chosen, see Scene::make_damping().
    RayleighDamping damping = {0., -1.};
    /// With a speed of 0 no block sleeps.
    SleepParameters sleep = {0., 0.25, 1.};

    void
    list_entries(internal::Entries &entries);
    /// @throws InputError naming the parameter that is wrong or would not be
    /// used.
    void
    check(Analysis analysis, Kinematics kinematics, bool has_contact) const;

    StepControlParameters
    step_control() const;

    TimeScheme
    time_scheme(Analysis   analysis,
                Kinematics kinematics,
                bool       has_contact) const;

  private:
    void
    check_scheme(Analysis   analysis,
                 Kinematics kinematics,
                 bool       has_contact) const;
    void
    check_steps(Kinematics kinematics) const;
  };


  /// The section `Relaxation`.
  struct RelaxationSectionParameters
  {
    RelaxationParameters relaxation;

    void
    list_entries(internal::Entries &entries);
    /// @throws InputError as TimeParameters::check().
    void
    check(Analysis analysis) const;
  };


  /// The section `Safety factor`.
  struct SafetyFactorSectionParameters
  {
    /// What each trial begins with.
    enum class Start
    {
      /// No displacements: blocks are put together under reduced strength.
      unstressed,
      /// Equilibrium under full strength, with places of sticking.
      settled
    };

    SafetyFactorParameters search;
    /// Further than this [m] is motion.
    double max_displacement = 0.;
    Start  start            = Start::unstressed;

    void
    list_entries(internal::Entries &entries);
    /// @throws InputError as TimeParameters::check().
    void
    check(Analysis analysis) const;
  };


  /// Rigid motion that a block, or the whole solid, starts with.
  struct InitialVelocityParameters
  {
    std::string name;
    /// Empty: the whole solid, else the block with this point [m].
    std::optional<dealii::Point<2>> block;
    /// [m/s], [rad/s].
    dealii::Tensor<1, 2> translation;
    double               angular_velocity = 0.;
    /// [m]; empty: the centroid of what moves.
    std::optional<dealii::Point<2>> center;

    void
    list_entries(internal::Entries &entries);
  };
} // namespace NMM

#endif
