// Motion of a solid that yields: the account of energy, restart, ranks.

#include <nmm/dynamics/checkpoint.h>
#include <nmm/materials/mohr_coulomb_law.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// A block that yields.
  Body
  yielding_block(const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    auto law              = std::make_shared<MohrCoulombLaw>();
    law->friction         = std::tan(0.5);
    law->cohesion         = 1.;
    law->tensile_strength = 1.;
    Material rock         = material("rock", 1000., 0.2, 1.);
    rock.law              = law;
    Body body             = box({0., 0.}, {1., 2.}, 0.4, rock, communicator);
    body.model->problem.plane_state = PlaneState::plane_strain;
    return body;
  }


  /// The block stands on its clamped bottom, and is pushed sideways so that it yields there.
  Body
  pushed_block(const MPI_Comm   communicator = MPI_COMM_WORLD,
               const Kinematics kinematics   = Kinematics::small)
  {
    Body body                               = yielding_block(communicator);
    body.model->problem.gravity             = Tensor<1, 2>({0., -1.});
    body.model->problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "bottom")};
    if (kinematics == Kinematics::small)
      body.make_small();
    else
      body.make_finite();
    return body;
  }


  void
  push(const Body &body, TimeIntegrator &integrator)
  {
    const Vector rest(body.mechanics->layout().locally_owned,
                      body.mechanics->layout().communicator);
    integrator.initialize(
      rest,
      interpolate_velocity(body.model->covers,
                           body.model->constraints,
                           [](const Point<2> &x, const unsigned int) {
                             return Tensor<1, 2>({0.4 * x[1], 0.});
                           }));
  }
} // namespace


/// Kinetic energy goes into plastic strain, and the account closes to what Newton's method
/// leaves.
TEST(InelasticMotion, AccountClosesMPI)
{
  for (const Kinematics kinematics : {Kinematics::small, Kinematics::finite})
  {
    Body           body = pushed_block(MPI_COMM_WORLD, kinematics);
    TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
    push(body, integrator);
    const double start = integrator.account().kinetic;
    for (unsigned int i = 0; i < 100; ++i)
    {
      step(integrator, 0.01);
      ASSERT_NEAR(integrator.account().balance, 0., 1e-8 * start) << i;
    }
    // without yielding all of it would still swing
    EXPECT_GT(integrator.account().dissipated, 0.2 * start);
    // gravity adds what it does while the block leans and, in finite displacements, sinks
    EXPECT_LT(integrator.account().dissipated,
              start + integrator.account().external_work);
  }
}


/// A free block that spins so fast that it yields by what its halves pull at each other: momenta
/// are those at the start, and the kinetic energy that is missing is stored or dissipated.
TEST(InelasticMotion, SpinningBlockMPI)
{
  Body body = yielding_block();
  body.make_finite();
  TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
  const RigidVelocity spin{{}, 1.2, {0.5, 1.}};
  integrator.initialize(body.zero(), body.velocity(spin));
  const Account start      = integrator.account();
  double        dissipated = 0.;
  for (unsigned int i = 0; i < 60; ++i)
  {
    step(integrator, 0.01);
    const Account &now = integrator.account();
    // Newton's method leaves 1e-10 of forces
    ASSERT_NEAR(now.balance, 0., 1e-8 * start.kinetic) << i;
    ASSERT_NEAR(now.angular_momentum,
                start.angular_momentum,
                1e-8 * start.angular_momentum);
    // the mean of both stresses could take energy back only if a step went from one side of the
    // yield surface to the other
    EXPECT_GE(now.dissipated, dissipated - 1e-8 * start.kinetic);
    dissipated = now.dissipated;
  }
  EXPECT_GT(dissipated, 1e-5 * start.kinetic);
}


TEST(InelasticMotion, ContinuesWithTheSameBitsMPI)
{
  const std::string file =
    NMM_TEST_OUTPUT_DIR "/inelastic-" +
    std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
    ".state";
  Vector straight;
  {
    Body           body = pushed_block();
    TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
    push(body, integrator);
    for (unsigned int i = 0; i < 60; ++i)
    {
      if (i == 30)
        Checkpoint::write(integrator, file);
      step(integrator, 0.01);
    }
    straight = integrator.state().u;
  }
  Body           body = pushed_block();
  TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
  Checkpoint::read(file, integrator);
  for (unsigned int i = 0; i < 30; ++i)
    step(integrator, 0.01);
  const Vector &u = integrator.state().u;
  EXPECT_TRUE(std::equal(u.begin(), u.end(), straight.begin()));
}


TEST(InelasticMotion, RanksAgreeMPI)
{
  const auto end_energies = [](const MPI_Comm communicator) {
    Body           body = pushed_block(communicator);
    TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
    push(body, integrator);
    for (unsigned int i = 0; i < 40; ++i)
      step(integrator, 0.01);
    return std::make_pair(integrator.account().kinetic,
                          integrator.account().dissipated);
  };
  const auto all = end_energies(MPI_COMM_WORLD),
             one = end_energies(MPI_COMM_SELF);
  EXPECT_NEAR(all.first, one.first, 1e-8 * one.first);
  EXPECT_NEAR(all.second, one.second, 1e-8 * one.second);
}
