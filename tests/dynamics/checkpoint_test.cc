// Checkpoints: the same bits on continuing, refusal of what does not fit.

#include <nmm/base/program.h>
#include <nmm/dynamics/checkpoint.h>
#include <nmm/materials/material.h>

#include <csignal>
#include <cstdio>
#include <dynamics/dynamic_model.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/resource.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  std::string
  file_name(const std::string &name)
  {
    return NMM_TEST_OUTPUT_DIR "/" + name + "-" +
           std::to_string(
             dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
           ".state";
  }


  Body
  beam(const bool     is_small,
       const double   youngs_modulus = 1e3,
       const MPI_Comm communicator   = MPI_COMM_WORLD)
  {
    Material rock = material("rock", youngs_modulus, 0.2, 1.);
    rock.law      = material_law("neo-Hookean");
    Body body     = box({0., 0.}, {2., 0.4}, 0.3, rock, communicator);
    body.model->problem.boundary_conditions = {
      condition(Type::displacement, "left"),
      condition(Type::pressure, "top", constant(2.))};
    Loading loading;
    loading.amplitudes = [](const double t) {
      LoadAmplitudes amplitudes;
      amplitudes.boundary_conditions = {1., std::sin(3. * t)};
      return amplitudes;
    };
    loading.releases = {{Release::Kind::boundary_condition, 0, 0.33}};
    if (is_small)
      body.make_small(loading);
    else
      body.make_finite(loading);
    return body;
  }


  StepControl
  control()
  {
    StepControlParameters parameters;
    parameters.initial_step     = 0.02;
    parameters.max_step         = 0.05;
    parameters.max_displacement = 0.06;
    return StepControl(parameters);
  }


  void
  expect_same_bits(const DynamicState &a, const DynamicState &b)
  {
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.next_step, b.next_step);
    EXPECT_EQ(a.kinetic, b.kinetic);
    EXPECT_EQ(a.sums.initial, b.sums.initial);
    EXPECT_EQ(a.sums.external_work, b.sums.external_work);
    EXPECT_EQ(a.sums.dissipated, b.sums.dissipated);
    for (const auto &[x, y] :
         {std::make_pair(&a.u, &b.u), {&a.v, &b.v}, {&a.a, &b.a}})
      EXPECT_TRUE(std::equal(x->begin(), x->end(), y->begin()));
  }


  /// Write at one third, before the release, and go on to the end; read, and go on to
  /// the end.
  void
  check_restart(const bool is_small, const TimeScheme &scheme)
  {
    const std::string     file = file_name("restart");
    const RayleighDamping damping{0.1, 1e-4};
    DynamicState          straight;
    {
      Body body = beam(is_small);
      body.solid->damp(damping, scheme.is_conserving);
      TimeIntegrator integrator(*body.mechanics, scheme);
      bool           is_written = false;
      control().run(integrator, 0.45, [&](const StepRecord &) {
        if (!is_written && integrator.state().time > 0.17)
        {
          Checkpoint::write(integrator, file);
          is_written = true;
        }
        return true;
      });
      ASSERT_TRUE(is_written);
      straight = integrator.state();
    }
    Body body = beam(is_small);
    body.solid->damp(damping, scheme.is_conserving);
    TimeIntegrator integrator(*body.mechanics, scheme);
    Checkpoint::read(file, integrator);
    EXPECT_GT(integrator.state().time, 0.17);
    EXPECT_LT(integrator.state().time, 0.33);
    control().run(integrator, 0.45);
    expect_same_bits(straight, integrator.state());
    EXPECT_GT(integrator.state().step, 9u);
  }


  TEST(Checkpoint, ContinuesWithTheSameBitsSmallMPI)
  {
    check_restart(true, TimeScheme::newmark());
    check_restart(true, TimeScheme::generalized_alpha(0.7));
  }


  TEST(Checkpoint, ContinuesWithTheSameBitsFiniteMPI)
  {
    check_restart(false, TimeScheme::newmark());
    check_restart(false, TimeScheme::energy_momentum());
  }


  std::string
  refusal(const std::string &file, TimeIntegrator &integrator)
  {
    try
    {
      Checkpoint::read(file, integrator);
    }
    catch (const InputError &error)
    {
      return error.message();
    }
    return "accepted";
  }


  TEST(Checkpoint, RefusesWhatIsDamagedOrForeign)
  {
    const std::string file = file_name("damaged");
    Body              body = beam(true);
    TimeIntegrator    integrator(*body.mechanics, TimeScheme::newmark());
    step(integrator, 0.02);
    const std::vector<char> of_caller = {'a', 'b', 'c'};
    Checkpoint::write(integrator, file, of_caller);
    EXPECT_EQ(Checkpoint::read_of_caller(file, MPI_COMM_WORLD), of_caller);
    std::ifstream     in(file, std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    const auto        put = [&](const std::string &bytes) {
      std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
      return refusal(file, integrator);
    };
    const DynamicState before = integrator.state();

    EXPECT_NE(put("").find("missing or empty"), std::string::npos);
    EXPECT_NE(put("hello, world, this is text").find("no checkpoint"),
              std::string::npos);
    EXPECT_NE(put(good.substr(0, good.size() / 2)).find("instead of"),
              std::string::npos);
    EXPECT_NE(put(good + "x").find("instead of"), std::string::npos);
    // every bit counts
    unsigned int n_tried = 0;
    for (std::size_t i = 0; i < good.size(); i += 97, ++n_tried)
    {
      std::string bad = good;
      bad[i] ^= static_cast<char>(1 << (i % 8));
      EXPECT_NE(put(bad), "accepted") << "byte " << i;
    }
    EXPECT_GT(n_tried, 20u);
    EXPECT_NE(put(good).find("accepted"), std::string::npos);
    expect_same_bits(before, integrator.state());

    std::remove(file.c_str());
    EXPECT_NE(refusal(file, integrator).find("missing"), std::string::npos);
    put(good);

    Body           softer = beam(true, 999.);
    TimeIntegrator other(*softer.mechanics, TimeScheme::newmark());
    EXPECT_NE(refusal(file, other).find("another mesh"), std::string::npos);
    TimeIntegrator scheme(*body.mechanics, TimeScheme::generalized_alpha(0.5));
    EXPECT_NE(refusal(file, scheme).find("scheme"), std::string::npos);
  }


  TEST(Checkpoint, KillWhileWritingLeavesTheLastGoodOne)
  {
    const std::string file = file_name("kill");
    Body              body = beam(true);
    TimeIntegrator    integrator(*body.mechanics, TimeScheme::newmark());
    step(integrator, 0.02);
    Checkpoint::write(integrator, file);
    const DynamicState good = integrator.state();
    // what a kill in the middle of the next one leaves
    std::ofstream(file + ".part", std::ios::binary) << "NMMSTATE half of it";
    step(integrator, 0.02);
    Checkpoint::read(file, integrator);
    expect_same_bits(good, integrator.state());
    // and it is no obstacle
    step(integrator, 0.02);
    Checkpoint::write(integrator, file);
    EXPECT_FALSE(std::ifstream(file + ".part"));
    EXPECT_THROW(Checkpoint::write(integrator, "no/such/folder/state"),
                 OutputFailure);
  }


  TEST(Checkpoint, FullDiskLeavesTheLastGoodOne)
  {
    const std::string file = file_name("full-disk");
    Body              body = beam(true);
    TimeIntegrator    integrator(*body.mechanics, TimeScheme::newmark());
    Checkpoint::write(integrator, file);
    rlimit limit;
    getrlimit(RLIMIT_FSIZE, &limit);
    const rlim_t unlimited = limit.rlim_cur;
    const auto   action    = std::signal(SIGXFSZ, SIG_IGN);
    limit.rlim_cur         = 100;
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_THROW(Checkpoint::write(integrator, file), OutputFailure);
    limit.rlim_cur = unlimited;
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, action);
    EXPECT_FALSE(std::ifstream(file + ".part").good());
    EXPECT_NO_THROW(Checkpoint::read(file, integrator));
  }


  TEST(Checkpoint, OneAndTwoRanksAgreeMPI)
  {
    // the same run on this many ranks and on each rank alone
    const auto run = [](const MPI_Comm communicator) {
      Body           body = beam(false, 1e3, communicator);
      TimeIntegrator integrator(*body.mechanics, TimeScheme::newmark());
      for (unsigned int i = 0; i < 5; ++i)
        step(integrator, 0.02);
      return integrator.account();
    };
    const Account all = run(MPI_COMM_WORLD), one = run(MPI_COMM_SELF);
    const double  scale = one.kinetic + one.strain;
    // rounding, and the tolerance of the iterations
    EXPECT_NEAR(all.kinetic, one.kinetic, 1e-8 * scale);
    EXPECT_NEAR(all.strain, one.strain, 1e-8 * scale);
    EXPECT_NEAR(all.conditions, one.conditions, 1e-8 * scale);
    EXPECT_NEAR(all.external_work, one.external_work, 1e-8 * scale);
    EXPECT_NEAR(all.angular_momentum,
                one.angular_momentum,
                1e-8 * std::abs(one.angular_momentum));
  }


  TEST(Checkpoint, IsReadOnAnotherNumberOfRanksMPI)
  {
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const auto name = [](const unsigned int r) {
      return file_name("ranks" + std::to_string(r));
    };
    Body           alone = beam(false, 1e3, MPI_COMM_SELF);
    TimeIntegrator one(*alone.mechanics, TimeScheme::newmark());
    for (unsigned int i = 0; i < 3; ++i)
      step(one, 0.02);
    Checkpoint::write(one, name(rank));
    MPI_Barrier(MPI_COMM_WORLD);

    Body           together = beam(false);
    TimeIntegrator all(*together.mechanics, TimeScheme::newmark());
    Checkpoint::read(name(0), all);
    EXPECT_EQ(all.state().step, 3u);
    step(one, 0.02);
    step(all, 0.02);
    // rounding, and the tolerance of the iterations
    EXPECT_NEAR(all.account().kinetic,
                one.account().kinetic,
                1e-8 * one.account().kinetic);
    EXPECT_NEAR(all.account().strain,
                one.account().strain,
                1e-8 * one.account().kinetic);
  }
} // namespace
