#ifndef nmm_scene_scene_parameters_dynamics_h
#define nmm_scene_scene_parameters_dynamics_h

#include <nmm/analysis/strength_reduction.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/dynamics/strength_reduction.h>
#include <nmm/dynamics/time_scheme.h>
#include <nmm/mechanics/loading.h>

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
  class PhysicalMesh;

  /// The kind of analysis.
  enum class Analysis
  {
    /// The equilibrium is computed.
    statics,
    /// The motion in time is computed.
    dynamics,
    /// The equilibrium is found by motion with kinetic damping.
    relaxation,
    /// The number is found by which strength can be divided before blocks move.
    safety_factor
  };

  /// The name of an analysis in scene files.
  const std::string &
  to_string(Analysis analysis);


  /// The dependence of a load or condition on time.
  struct TimeDependence
  {
    /// Name of the load's subsection, for messages.
    std::string name;
    /// Factor on the load [-]: an expression of the time t, or "file: name"; empty for 1.
    std::string amplitude;
    /// Time from which on a condition no longer holds [s]; a negative time stands for never.
    double release_time = -1.;

    /// Declares or reads the entries; there is a release time only if @p may_be_released.
    void
    list_entries(internal::Entries &entries, bool may_be_released);
  };


  /// The section `Time`.
  struct TimeParameters
  {
    /// The time scheme, see TimeScheme.
    enum class Scheme
    {
      /// The scheme is constant_acceleration for relaxation and safety factors; else energy_momentum for finite kinematics and with contact; else newmark.
      automatic,
      newmark,
      generalized_alpha,
      constant_acceleration,
      energy_momentum
    };

    /// The state from which a dynamic analysis starts.
    enum class Start
    {
      /// The analysis starts without displacements.
      undeformed,
      /// The analysis starts from the equilibrium of the loads and supports at t = 0, before any
      /// release. It is found by load steps and Newton's method.
      equilibrium,
      /// The analysis starts from the same equilibrium, found by motion with kinetic damping.
      relaxation
    };

    /// The state at t = 0.
    Start start = Start::undeformed;
    /// Time at which a dynamic analysis ends [s], > 0; it starts at 0.
    double end_time = 0.;
    /// First time step [s], > 0; all steps are equal if no other bound is given.
    double initial_step = 0.;
    /// Smallest step [s]; 0 stands for a millionth of the first.
    double min_step = 0.;
    /// Largest step [s]; 0 stands for the first.
    double max_step = 0.;
    /// Largest displacement of a cover in a step [m]; 0 stands for no bound.
    double max_displacement = 0.;
    /// Largest estimated error of a step's displacement [m]; 0 stands for no bound.
    double max_error = 0.;
    /// The time scheme.
    Scheme scheme = Scheme::automatic;
    /// Coefficient beta of Newmark's scheme [-], > 0.
    double beta = 0.25;
    /// Coefficient gamma of Newmark's scheme [-], >= 1/2; more than 1/2 damps.
    double gamma = 0.5;
    /// Factor per step on the amplitude of the highest frequencies with generalized alpha [-], in
    /// [0, 1].
    double spectral_radius = 0.8;
    /// Coefficients of Rayleigh damping. A negative coefficient of the stiffness stands for
    /// Scene::make_damping().
    RayleighDamping damping = {0., -1.};
    /// Conditions for blocks to sleep; no block sleeps if the speed is 0.
    SleepParameters sleep = {0., 0.25, 1.};

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks all values. @throws InputError naming the parameter that is wrong, or that would not
    /// be used.
    void
    check(Analysis analysis, Kinematics kinematics, bool has_contact) const;

    /// The steps and their bounds, for StepControl.
    StepControlParameters
    step_control() const;

    /// The time scheme; Scheme::automatic is resolved by the arguments.
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
    check_steps() const;
  };


  /// The section `Relaxation`.
  struct RelaxationSectionParameters
  {
    /// The parameters of relax(), with a largest displacement of 0 if the scene gives none, and
    /// without the tolerance.
    RelaxationParameters relaxation;
    /// The tolerance [-]; 0 if the scene gives none.
    double tolerance = 0.;

    /// The parameters of a relaxation to equilibrium. If the scene says nothing, what moves finds no
    /// rest after twice the mean length of a block, the diagonal of the solid over the root of the
    /// number of blocks, and at least a tenth of the diagonal.
    RelaxationParameters
    bounded(const PhysicalMesh &mesh) const;

    /**
     * Those of a trial of the factor of safety, in which nothing may move by more than
     * @p max_displacement [m]. If the scene gives no tolerance of rest, it is 1e-4 of
     * @p factor_tolerance, that of the factor, and at most 1e-6: forces out of balance
     * are then far below those by which strength differs between two trials, and small blocks that
     * are loose in a network may go on rattling.
     */
    RelaxationParameters
    of_trial(double max_displacement, double factor_tolerance) const;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks all values. @throws InputError as TimeParameters::check().
    void
    check(Analysis analysis) const;
  };


  /// The section `Safety factor`.
  struct SafetyFactorSectionParameters
  {
    /// The state from which each trial starts.
    enum class Start
    {
      /// A trial starts without displacements, so that loads act under reduced strength from the
      /// beginning.
      unstressed,
      /// A trial starts from the equilibrium under full strength, with its anchors of the stick
      /// state.
      settled
    };

    /// The parameters of find_safety_factor().
    SafetyFactorParameters search;
    /// Displacement above which a trial counts as moving [m], > 0.
    double max_displacement = 0.;
    /// The state from which each trial starts.
    Start start = Start::unstressed;
    /// What loses strength.
    ReducedStrength reduced = ReducedStrength::both;
    /// The flow of materials that yield.
    FlowRule flow_rule = FlowRule::associated;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks all values. @throws InputError as TimeParameters::check().
    void
    check(Analysis analysis) const;
  };


  /// Initial rigid-body velocity of a block, or of the whole solid: a subsection of
  /// `Initial velocities`. Velocities of the same block add up.
  struct InitialVelocityParameters
  {
    /// Name of the subsection, for messages.
    std::string name;
    /// A point inside the block that moves [m]; if not given, the whole solid moves.
    std::optional<dealii::Point<2>> block;
    /// Velocity of the centre of rotation [m/s].
    dealii::Tensor<1, 2> translation;
    /// Angular velocity, counter-clockwise [rad/s].
    double angular_velocity = 0.;
    /// Centre of rotation [m]; if not given, the centroid of what moves.
    std::optional<dealii::Point<2>> center;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
  };
} // namespace NMM

#endif
