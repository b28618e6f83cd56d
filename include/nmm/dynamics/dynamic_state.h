#ifndef nmm_dynamics_dynamic_state_h
#define nmm_dynamics_dynamic_state_h

#include <nmm/mechanics/mechanical_model.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace NMM
{
  /// Sums of energies since the start, which belong to the state [J/m].
  struct EnergySums
  {
    /// Kinetic energy + strain energy + energy of conditions at the start [J/m].
    double initial = 0.;
    /// Work of loads and of moving supports, and the change of the stored energy when supports
    /// are removed [J/m].
    double external_work = 0.;
    /// Energy dissipated by damping, friction, inelastic materials, blocks that fall asleep, and
    /// stops of a relaxation [J/m].
    double dissipated = 0.;
    /// Kinetic energy + strain energy + energy of conditions of blocks that have left, at that
    /// time [J/m].
    double left = 0.;
    /// Work that the faces of new cracks have done against their closing forces [J/m].
    double fracture = 0.;
    /// Change of the stored and the kinetic energy where the solid was cut again: errors of
    /// interpolation, and the energy of displacement conditions, which depends on the cells
    /// [J/m].
    double cuts = 0.;
  };


  /**
   * Forces by which the faces of new cracks still hold each other. A crack that grows within a
   * time step leaves faces that exerted tractions on each other just before. These forces are the
   * resultants of the tractions, and fade linearly from the beginning to the end,
   * @f[ f(t) = s(t)\,f_0, \qquad s(t) = 1 - \frac{t-t_0}{t_1-t_0}, \quad t_0\le t\le t_1. @f]
   * If the solid follows slowly, their work is the energy release rate times the new area: the
   * faces open in proportion to the part of the forces that is gone.
   * Source: J. Malluck, W. King, in: Crack Arrest Methodology and Applications, ASTM STP 711
   * (1980), 38-53.
   */
  struct ClosingForces
  {
    /// The forces f_0 on owned unknowns, as loads [N/m]; of size 0 if there are none.
    MechanicalModel::Vector forces;
    /// Time at which they begin to fade [s].
    double begin = 0.;
    /// Time at which they are gone [s].
    double end = 0.;

    /// Whether any of them is left at the time @p t [s].
    bool
    act_at(double t) const;

    /// The share s(t) at the time @p t [s]; 1 before the beginning and 0 after the end [-].
    double
    share(double t) const;

    /// Mean of share() from @p t_0 to @p t_1 [s]; for t_1 = t_0 the share there [-].
    double
    mean_share(double t_0, double t_1) const;
  };


  /// All data that a continuation needs besides MechanicalModel::internal_state(). Vectors hold owned
  /// unknowns.
  struct DynamicState
  {
    /// See MechanicalModel::Vector.
    using Vector = MechanicalModel::Vector;

    /// Time [s].
    double time = 0.;
    /// Number of accepted steps since the start.
    unsigned int step = 0;
    /// @{
    /// Displacements [m], velocities [m/s] and accelerations [m/s^2]. In conserving schemes the
    /// accelerations are the mean ones of the last step.
    Vector u, v, a;
    /// @}
    /// Time up to which events of the model have been passed [s]; see MechanicalModel::pass_events().
    double events_passed = 0.;
    /// Step that would be tried next, chosen by the step control; 0: none yet [s].
    double next_step = 0.;
    /// Kinetic energy [J/m].
    double kinetic = 0.;
    /// Sums of the energy account.
    EnergySums sums;
    /// Forces between the faces of new cracks; none unless continue_after_cut() was called.
    ClosingForces closing;
    /// Blocks that have left, in the order in which they did.
    std::vector<unsigned int> left_blocks;
    /// For each block the time that it has been at rest [s]. For a block that sleeps this is
    /// infinity, followed by the two components of the force [N/m] and the moment [N] on it when
    /// it fell asleep. Empty if sleeping is disabled. See SleepParameters.
    std::vector<std::array<double, 4>> rest;
  };


  /**
   * Thresholds for sleeping blocks. A sleeping block is held in place and neither assembled nor
   * solved, while blocks that touch it feel its contact as before. A block falls asleep once
   * it has been slow for some time. It wakes, within the same step, when the forces on it
   * differ from those when it fell asleep. The errors are these: motion slower than `speed` ends
   * and its energy counts as dissipated, and a force on a sleeping block that changes by less
   * than its mass times `acceleration` has no effect.
   */
  struct SleepParameters
  {
    /// Root mean square of a block's speed below which it is at rest [m/s].
    double speed = 0.01;
    /// Time that a block has to be at rest before it sleeps [s].
    double time = 0.25;
    /// A block wakes if the change of the force on it divided by its mass, plus the change of the
    /// moment divided by sqrt(mass * moment of inertia), exceeds this [m/s^2].
    double acceleration = 1.;
  };


  /// The account of energies and momenta of a state, all per unit thickness.
  struct Account
  {
    /// @{
    /// Kinetic energy, strain energy and energy of conditions (AssembledForces) of the
    /// state; external work, dissipated energy, energy of blocks that have left, work of closing
    /// forces and changes by cuts (EnergySums) since the start [J/m].
    double kinetic = 0., strain = 0., conditions = 0., external_work = 0.,
           dissipated = 0., left = 0., fracture = 0., cuts = 0.;
    /// @}
    /// kinetic + strain + conditions + dissipated + left + fracture - cuts - external_work -
    /// EnergySums::initial: energy that the scheme adds (> 0) or removes (< 0) [J/m].
    double balance = 0.;
    /// Linear momentum [kg/s].
    dealii::Tensor<1, 2> linear_momentum;
    /// Angular momentum about the origin, positive counter-clockwise [kg m/s].
    double angular_momentum = 0.;
    /// |r + C v| / force scale [-]; 0 in static equilibrium.
    double imbalance = 0.;
  };
} // namespace NMM

#endif
