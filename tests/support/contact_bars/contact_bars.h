#ifndef nmm_tests_support_contact_bars_contact_bars_h
#define nmm_tests_support_contact_bars_contact_bars_h

#include <support/contact_bars/measurements.h>

namespace NMM
{
  /**
   * Scenarios of contact in time with known outcome. Each is built and run by a
   * function that adds what it measured; the program nmm-contact-bars runs them at
   * full size, the tests at a smaller one.
   */
  namespace ContactBars
  {
    /// @name A block on an incline, which gravity is turned for
    /// @{
    struct Incline
    {
      /// [degrees]
      double       angle = 30., friction_angle = 20.;
      TimeScheme   scheme  = TimeScheme::energy_momentum();
      double       step    = 0.005;
      unsigned int n_steps = 10000;
      /// Of the block, which is 1 m high [m].
      double length = 3.;
      /// Sliding: how far [m].
      double distance = 25.;
      /// Of the block [s]: elastic bodies that slide with much friction flutter.
      double stiffness_damping = 0.;
      /// Begin in equilibrium; otherwise undeformed, and fall onto the springs.
      bool begins_at_rest = true;
      /// Share of the critical damping of the block on its springs.
      double dashpot = 0.;
      /**
       * Sliding: time until the fall onto the springs has died away [s]; from then on
       * the way counts. An elastic block of height H with waves of speed c
       * does not feel friction before they have crossed it: it is faster by some
       * g H/c, 0.01 m/s, than a rigid one for good.
       */
      double   settling     = 0.;
      MPI_Comm communicator = MPI_COMM_WORLD;
      double   bound        = 1e-4;
    };

    /**
     * Distance against v_0 t + g (sin a - cos a tan phi) t^2 / 2. This needs a block
     * that stays in contact. One of which nothing takes energy flutters and hops at
     * friction near and above 1: sliding waves are unstable there (Adams, J.
     * Appl. Mech. 62 (1995) 867), and the less the step damps them the more.
     */
    void
    slide_down_incline(const Incline &incline, Measurements &measurements);

    /// Falls, and is damped as rock on a joint is: it hops no more, and is as good
    /// as rigid.
    Incline
    damped_incline();

    /// Creep over what the shear spring gives way by under the block's weight.
    void
    stick_to_incline(const Incline &incline, Measurements &measurements);
    /// @}


    /// Bars of 10 m, c = 100 m/s, that run into each other.
    struct Impact
    {
      double cell_size = 0.5, step = 5e-4;
      /// Penalty times cell size over Young's modulus [-].
      double       penalty         = 10.;
      unsigned int n_further_steps = 10000;
      TimeScheme   scheme          = TimeScheme::energy_momentum();
      Kinematics   kinematics      = Kinematics::small;
      MPI_Comm     communicator    = MPI_COMM_WORLD;
      double       bound           = 0.01;
      double       energy_bound    = 1e-3;
    };

    /// Duration of contact, rebound speed, energy.
    void
    run_into_each_other(const Impact &impact, Measurements &measurements);


    /// Square blocks of 1 m on each other on a floor, in equilibrium.
    struct Stack
    {
      unsigned int n_blocks = 10;
      /// [s]
      double     step = 0.01, duration = 10.;
      Kinematics kinematics = Kinematics::small;
      /// Share of the critical damping of a block on its springs.
      double   dashpot      = 0.;
      MPI_Comm communicator = MPI_COMM_WORLD;
    };

    /// Drift and the force on the floor.
    void
    rest_in_a_stack(const Stack &stack, Measurements &measurements);


    /// One to three random polygons, convex or stars, that fall on each other and on a
    /// tilted floor with random friction. What is random follows from the seed.
    struct Drops
    {
      unsigned int n_drops = 1000, first_seed = 0;
      double       youngs_modulus = 1e8;
      /// First step and duration [s].
      double step = 0.005, duration = 1.5;
      /// Share of the critical damping of a block on its springs.
      double dashpot = 0.1;
      /// Tangent of the dilation angle over that of friction [-], and the slip
      /// after which it ends [m].
      double   dilation = 0., dilation_limit = 0.;
      MPI_Comm communicator = MPI_COMM_WORLD;
    };

    /// Every drop ends, energy never grows, its account closes.
    void
    drop_polygons(const Drops &drops, Measurements &measurements);


    /// A slender block released at a tilt on a rigid floor.
    struct Rocking
    {
      /// Of the diagonal against the side, and tilt [rad].
      double alpha = 0.25, tilt = 0.1;
      /// Half of the diagonal [m].
      double          half_diagonal  = 1.;
      double          youngs_modulus = 1e8;
      double          cell_size      = 0.6;
      double          penalty        = 1.;
      double          step           = 1e-3;
      TimeScheme      scheme         = TimeScheme::energy_momentum();
      RayleighDamping damping;
      /// Height of the middle of the base above its corners over the width; 0: it
      /// lands flat, and the impulse is not that of the corner alone.
      double hollow = 0.;
      /// Share of the critical damping of the block on its springs.
      double      dashpot = 0.;
      std::string name    = "conserving";
      /// In quarter periods of the first swing.
      double duration = 6.;
    };

    /// Quarter period and energy lost at the first impact (Housner, Bull. Seismol.
    /// Soc. Am. 53 (1963) 403).
    void
    rock(const Rocking &rocking, Measurements &measurements);


    /// A disk of radius 1 m that starts with a velocity and a spin on a floor.
    struct Disk
    {
      double       youngs_modulus = 1e7;
      double       cell_size      = 0.25;
      unsigned int n_points       = 12;
      /// Penalty times cell size over Young's modulus [-].
      double penalty  = 10.;
      double velocity = 1.;
      /// Over velocity / radius; 1: rolls, 0: slides at first.
      double spin     = 1.;
      double friction = 0.2;
      double step     = 5e-3;
      /// Rolling: [s]; sliding: in times of sliding.
      double   duration     = 2.;
      MPI_Comm communicator = MPI_COMM_WORLD;
    };

    /// Against a rigid disk: within the share of its radius by which an elastic one
    /// sinks to the floor.
    void
    roll(const Disk &disk, Measurements &measurements);


    /// A harmonic P wave through an elastic joint between two bars.
    struct JointWave
    {
      /// omega Z / (2 k) [-].
      double frequency = 1.;
      /// Per wave length and per period.
      double   cells = 8., steps = 40.;
      MPI_Comm communicator = MPI_COMM_WORLD;
      double   bound        = 0.01;
    };

    /// Amplitude behind the joint over that of the wave that comes in.
    void
    transmit(const JointWave &wave, Measurements &measurements);


    /// @name Corners
    /// @{
    struct Corners
    {
      /// Multiplies the durations.
      double   duration     = 1.;
      MPI_Comm communicator = MPI_COMM_WORLD;
    };

    /// A square falls with a vertex on that of another one, exactly and beside it.
    void
    fall_on_vertex(const Corners &corners, Measurements &measurements);

    /// A block slides over the end of a face: onto one in line with it, and onto one
    /// that slopes down.
    void
    slide_off_edge(const Corners &corners, Measurements &measurements);

    /// A wedge in a notch of the same angle: at rest and dropped.
    void
    drop_into_notch(const Corners &corners, Measurements &measurements);

    /// Four blocks that meet in a point: compressed, and flying there.
    void
    meet_in_a_point(const Corners &corners, Measurements &measurements);
    /// @}


    /// Polygons that are thrown at a wall, straight or spinning, with steps in which they fly 0.1 to
    /// 1,000 times its thickness of 0.001 to 1 m. The wall is rigid, deformable and free, or
    /// half of the plane. What is random follows from the seed.
    struct Shots
    {
      unsigned int n_shots = 1000, first_seed = 0;
      /// Of a shot: impact and what follows; steps that do not converge grow and are cut for long.
      unsigned int max_steps = 100;
      /// Print a line for each.
      bool is_verbose = false;
    };

    /// None has passed the middle of the wall after any step; a run may end because a step would be too
    /// short.
    void
    shoot_at_walls(const Shots &shots, Measurements &measurements);


    /// Displacements and velocities in the end of small runs of each kind, for
    /// comparisons between repeated runs and numbers of ranks.
    std::vector<std::pair<std::string, std::vector<double>>>
    final_states(MPI_Comm communicator);
  } // namespace ContactBars
} // namespace NMM

#endif
