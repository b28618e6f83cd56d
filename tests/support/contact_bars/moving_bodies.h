#ifndef nmm_tests_support_contact_bars_moving_bodies_h
#define nmm_tests_support_contact_bars_moving_bodies_h

#include <nmm/contact/assembly/term.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/mechanics/solid_term.h>

#include <contact/contact_model.h>

namespace NMM
{
  namespace ContactBars
  {
    using namespace Test;

    /// What happened between two times.
    struct Run
    {
      unsigned int n_steps = 0, n_iterations = 0, n_cuts = 0;
      double       seconds = 0.;
      /// Largest |balance| of the energy account [J/m].
      double worst_balance = 0.;
      /// Of any step [m].
      double largest_penetration = 0.;
      /// Why it ended before the end asked for; empty: it did not.
      std::string failure;

      Run &
      operator+=(const Run &other);
    };


    /// Bodies that move and touch. Fill in `problem`, then start().
    class MovingBodies : public Bodies
    {
    public:
      using Bodies::Bodies;
      using Field =
        std::function<Tensor<1, 2>(const Point<2> &, unsigned int block)>;

      void
      start(const ContactParameters &parameters,
            Kinematics               kinematics,
            Loading                  loading = {});

      /// Begin at time 0 with what was reached last, if anything.
      void
      integrate(const TimeScheme       &scheme,
                const Vector           &u,
                const Vector           &v,
                const RayleighDamping  &damping = {},
                const NewtonParameters &newton =
                  TimeIntegrator::default_newton_parameters());

      /// At rest, undeformed.
      void
      integrate(const TimeScheme &scheme, const RayleighDamping &damping = {});

      /// Equilibrium by dynamic relaxation; the displacements.
      Vector
      find_rest(double step, double tolerance = 1e-9);

      /// To the time @p end by equal steps; @p after_step stops it by returning false.
      Run
      run(double                       step,
          double                       end,
          const std::function<bool()> &after_step = {});

      /// Of a function of the reference position; owned unknowns.
      Vector
      values(const Field &field);

      Vector
      zero() const;

      /// @name Of a block, at the current state
      /// @{
      double
      mass(unsigned int block);

      /// Displacement of the centre of mass [m].
      Tensor<1, 2>
      displacement(unsigned int block);

      /// Of the centre of mass [m/s].
      Tensor<1, 2>
      velocity(unsigned int block);

      /// Angular momentum about the centre of mass over the moment of inertia at
      /// rest [rad/s].
      double
      angular_velocity(unsigned int block);
      /// @}

      /// Displacement (or another field's value) at a point of the solid, which
      /// this rank must know.
      Tensor<1, 2>
      value_at(const Vector &owned, const Point<2> &x);

      /// Forces on slaves of the last assembly by name of the master [N/m].
      Tensor<1, 2>
      force_of(const std::string &master) const;

      /// The model is the sum of the terms of solid and contact.
      std::unique_ptr<SolidTerm>       solid;
      std::unique_ptr<ContactTerm>     touch;
      std::unique_ptr<MechanicalModel> model;
      std::unique_ptr<TimeIntegrator>  integrator;

      /// Make the model of @p solid and the contact.
      void
      make_model(std::unique_ptr<SolidTerm> solid);

      /// The mass matrix of the solid.
      std::shared_ptr<const ForceTerm::Matrix>
      mass() const;

    private:
      /// Sums of weights e_b^T M f for a block: f's two components.
      Tensor<1, 2>
      weigh(unsigned int block, const Vector &field);

      double
      moment(unsigned int        block,
             const Vector       &positions,
             const Tensor<1, 2> &center,
             const Vector       &velocity);

      const std::vector<unsigned int> &
      cover_to_block();

      std::vector<unsigned int> known_blocks;
    };


    /// A free-standing polygon, its sides all of one name.
    inline void
    add_block(Geometry                    &geometry,
              const std::string           &name,
              const std::vector<Point<2>> &corners)
    {
      geometry.add_polygon(corners, name);
    }


    inline double
    degrees(const double angle)
    {
      return angle * dealii::numbers::PI / 180.;
    }

    constexpr double standard_gravity = 9.81;

    /// Of the rock that most bodies are of [kg/m^3], [Pa].
    constexpr double rock_density = 2500., rock_modulus = 1e9;


    /// A block of 3 m x 1 m of rock that touches a floor, in a mesh that is turned against it.
    inline std::unique_ptr<MovingBodies>
    block_on_floor(const MPI_Comm communicator)
    {
      Geometry geometry;
      add_block(geometry, "block", {{0., 0.}, {3., 0.}, {3., 1.}, {0., 1.}});
      Bodies::Options options;
      options.cell_size    = 0.7;
      options.rotation     = 17.;
      options.offset[0]    = 0.217;
      options.offset[1]    = 0.119;
      options.communicator = communicator;
      options.obstacles    = {obstacle("floor", {{99., 0.}, {-99., 0.}})};
      auto block = std::make_unique<MovingBodies>(std::move(geometry), options);
      block->problem.materials = {
        material("rock", rock_modulus, 0.2, rock_density)};
      return block;
    }
  } // namespace ContactBars
} // namespace NMM

#endif
