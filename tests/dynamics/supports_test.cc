// The conserving scheme with supports and bonded joints.

#include <nmm/materials/material.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  /// A unit square about the origin, cut by a closed joint that is oblique to the
  /// mesh if @p with_joint. Dynamics are those of a soft solid.
  Body
  square(const std::shared_ptr<const MaterialLaw> &law,
         const PlaneState                          state,
         const bool                                with_joint,
         const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    Geometry geometry;
    add_box(geometry, {-0.5, -0.5}, {0.5, 0.5});
    if (with_joint)
      geometry.add_polyline({{-0.6, -0.13}, {0.1, 0.09}, {0.6, -0.04}},
                            "joint",
                            CurveRole::joint,
                            JointState::closed);
    Body         body;
    Tensor<1, 2> offset;
    offset[0]                     = 0.11;
    offset[1]                     = 0.07;
    body.model                    = std::make_unique<Model>(std::move(geometry),
                                         mesh_parameters(0.4, offset, 17.),
                                         2,
                                         Stabilization::aggregation,
                                         communicator);
    Material rock                 = material("rock", 20., 0.3, 1.);
    rock.law                      = law;
    body.model->problem.materials = {rock};
    body.model->problem.plane_state = state;
    return body;
  }


  struct DriftAndEnergies
  {
    double energy = 0., angular_momentum = 0., linear_momentum = 0.;
    /// Largest energies of the material and of conditions seen.
    double       strain = 0., conditions = 0.;
    unsigned int n_iterations = 0;
  };


  DriftAndEnergies
  run(TimeIntegrator &integrator, const double h, const unsigned int n)
  {
    const Account    start  = integrator.account();
    const double     energy = start.kinetic + start.strain + start.conditions;
    DriftAndEnergies drift;
    for (unsigned int i = 0; i < n; ++i)
    {
      const StepReport report = integrator.try_step(h);
      AssertThrow(report.converged, dealii::ExcMessage(report.reason));
      integrator.accept();
      drift.n_iterations += report.n_iterations;
      const Account &now = integrator.account();
      drift.energy = std::max(drift.energy, std::abs(now.balance) / energy);
      drift.angular_momentum =
        std::max(drift.angular_momentum,
                 std::abs(now.angular_momentum / start.angular_momentum - 1.));
      drift.linear_momentum =
        std::max(drift.linear_momentum,
                 (now.linear_momentum - start.linear_momentum).norm());
      drift.strain = std::max(drift.strain, now.strain / energy);
      drift.conditions =
        std::max(drift.conditions, std::abs(now.conditions) / energy);
    }
    return drift;
  }


  void
  print(const std::string &name, const DriftAndEnergies &drift)
  {
    std::cout << name << ": energy " << drift.energy << ", angular momentum "
              << drift.angular_momentum << ", linear " << drift.linear_momentum
              << "; strain energy up to " << drift.strain << ", conditions "
              << drift.conditions << ", iterations " << drift.n_iterations
              << '\n';
  }


  Tensor<1, 2>
  spin_and_stretch(const Point<2> &x)
  {
    Tensor<1, 2> v;
    v[0] = -x[1] + 0.6 * x[0];
    v[1] = x[0] + 0.5 * x[0] * x[1];
    return v;
  }


  TEST(Supports, BondedJointKeepsEnergyAndMomenta)
  {
    for (const auto &[law, n_steps] :
         {std::make_pair(material_law("St. Venant-Kirchhoff"), 1000u),
          std::make_pair(material_law("neo-Hookean"), 100u)})
    {
      Body body =
        square(law, PlaneState::plane_strain, /* with_joint = */ true);
      body.make_finite();
      TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
      integrator.initialize(body.zero(), body.velocity(spin_and_stretch));
      const DriftAndEnergies drift = run(integrator, 0.1, n_steps);
      print("bonded joint", drift);
      // residuals left by Newton's method, which may add up
      EXPECT_LT(drift.energy, 1e-8);
      // rounding of the steps; what Newton's method leaves is no moment
      EXPECT_LT(drift.angular_momentum, 1e-12);
      EXPECT_LT(drift.linear_momentum, 1e-12);
      // this is no rigid motion, and the joint takes part
      EXPECT_GT(drift.strain, 0.1);
      EXPECT_GT(drift.conditions, 1e-4);
      // Newton's method as quick as without joint, four to five
      EXPECT_LT(drift.n_iterations, 5 * n_steps);
    }
  }


  /// A body that flies off its supports' rest position: held on one side, or
  /// on rollers, or by a pin.
  TEST(Supports, FixedSupportsKeepEnergy)
  {
    for (const std::shared_ptr<const MaterialLaw> &law :
         {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
      for (const PlaneState state :
           {PlaneState::plane_strain, PlaneState::plane_stress})
        for (const Type type : {Type::displacement, Type::normal_displacement})
        {
          Body body = square(law, state, /* with_joint = */ true);
          body.model->problem.boundary_conditions = {condition(type, "left")};
          body.make_finite();
          TimeIntegrator integrator(*body.mechanics,
                                    TimeScheme::energy_momentum());
          integrator.initialize(body.zero(),
                                body.velocity([&](const Point<2> &x) {
                                  Tensor<1, 2> v;
                                  v[0] = 0.3 * (x[0] + 0.5);
                                  v[1] = 0.6 * (x[0] + 0.5);
                                  return v;
                                }));
          const DriftAndEnergies drift = run(integrator, 0.05, 100);
          print(type == Type::displacement ? "clamped" : "rollers", drift);
          EXPECT_LT(drift.energy, 1e-9);
          EXPECT_GT(drift.strain, 0.3);
          EXPECT_GT(drift.conditions, 4e-4);
        }
  }


  TEST(Supports, PinKeepsTheMomentAboutIt)
  {
    Body       body = square(material_law("St. Venant-Kirchhoff"),
                       PlaneState::plane_strain,
                       /* with_joint = */ true);
    FixedPoint pin;
    pin.point                        = {0., 0.3};
    body.model->problem.fixed_points = {pin};
    body.make_finite();
    TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
    integrator.initialize(body.zero(), body.velocity([&](const Point<2> &x) {
      Tensor<1, 2> v = spin_and_stretch(x);
      v[0] += 0.3;
      return v;
    }));
    // moment about the pin
    const auto moment = [&] {
      return integrator.account().angular_momentum -
             (pin.point[0] * integrator.account().linear_momentum[1] -
              pin.point[1] * integrator.account().linear_momentum[0]);
    };
    const double           start = moment();
    const DriftAndEnergies drift = run(integrator, 0.1, 100);
    print("pin", drift);
    EXPECT_LT(drift.energy, 1e-9);
    EXPECT_NEAR(moment(), start, 1e-12 * start);
    // forces of the pin are large
    EXPECT_GT(drift.linear_momentum, 0.1);
  }


  TEST(Supports, MovingSupportsDoTheWorkThatIsStored)
  {
    for (const std::shared_ptr<const MaterialLaw> &law :
         {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
    {
      Body body =
        square(law, PlaneState::plane_strain, /* with_joint = */ true);
      FixedPoint hook;
      hook.point                              = {0.3, 0.2};
      hook.displacement[1]                    = 0.05;
      body.model->problem.fixed_points        = {hook};
      body.model->problem.boundary_conditions = {condition(
        Type::displacement, "left", vector_function([](const Point<2> &x) {
          Tensor<1, 2> u;
          u[0] = 0.1 * x[1];
          u[1] = 0.2;
          return u;
        }))};
      Loading loading;
      loading.amplitudes = [](const double t) {
        LoadAmplitudes amplitudes;
        amplitudes.boundary_conditions = {std::sin(2. * t)};
        amplitudes.fixed_points        = {std::sin(3. * t)};
        return amplitudes;
      };
      body.make_finite(loading);
      TimeIntegrator integrator(*body.mechanics, TimeScheme::energy_momentum());
      integrator.initialize();
      double balance = 0., largest = 0.;
      for (unsigned int i = 0; i < 150; ++i)
      {
        step(integrator, 0.02);
        const Account &now = integrator.account();
        balance            = std::max(balance, std::abs(now.balance));
        largest            = std::max(largest, std::abs(now.external_work));
      }
      std::cout << "moving supports: balance " << balance << " of work "
                << largest << '\n';
      EXPECT_GT(largest, 0.1);
      EXPECT_LT(balance, 1e-9 * largest);
    }
  }


  TEST(Supports, TangentIsTheDerivativeByTheMean)
  {
    for (const std::shared_ptr<const MaterialLaw> &law :
         {material_law("St. Venant-Kirchhoff"), material_law("neo-Hookean")})
      for (const PlaneState state :
           {PlaneState::plane_strain, PlaneState::plane_stress})
        for (const double size : {0.002, 0.05})
        {
          Body body = square(law, state, /* with_joint = */ true);
          body.model->problem.boundary_conditions = {
            condition(Type::displacement, "left"),
            condition(Type::normal_displacement, "bottom")};
          body.make_finite();
          std::mt19937                           generator(11);
          std::uniform_real_distribution<double> random(-size, size);
          // each cover on its own, so that the joint opens
          const auto field = [&](const double scale) {
            Vector v = body.zero();
            for (const auto k : body.mechanics->layout().locally_owned)
              v(k) = scale * random(generator);
            v.compress(dealii::VectorOperation::insert);
            body.model->constraints.distribute(v);
            return v;
          };
          const Vector begin = field(0.1), end = field(0.1),
                       direction = field(0.1 / size);
          const auto relevant    = [&](const Vector &v) {
            Vector result(body.mechanics->layout().locally_owned,
                          body.mechanics->layout().locally_relevant,
                          body.mechanics->layout().communicator);
            result = v;
            return result;
          };
          const auto residual = [&](const double share,
                                    const bool   with_tangent) {
            Vector at(end);
            at.add(share, direction);
            const Vector from = relevant(begin), to = relevant(at);
            Trial        trial =
              Trial::step(from, to, 0., 0., /* is_conserving = */ true);
            trial.tangent = with_tangent ? Tangent::consistent : Tangent::none;
            EXPECT_EQ(body.mechanics->assemble(trial), Deformation::admissible);
            return Vector(*body.mechanics->forces().residual);
          };
          const double step = 1e-5;
          Vector       difference(residual(step, false));
          difference -= residual(-step, false);
          difference *= 1. / step; // twice the derivative by the end
          residual(0., true);
          Vector product(begin);
          Vector free(direction);
          body.model->constraints.set_zero(free);
          body.mechanics->forces().tangent->vmult(product, free);
          body.model->constraints.set_zero(product);
          const double norm = product.l2_norm();
          product -= difference;
          std::cout << "derivative off by " << product.l2_norm() / norm << '\n';
          // truncation and rounding of the difference quotients
          EXPECT_LT(product.l2_norm(), 1e-8 * norm);
        }
  }


  /// A support that is elsewhere at once is no solution of the step: the potential of Nitsche's
  /// method is not bounded from below, and the jump says so.
  TEST(Supports, JumpsOfSupportsAreRefused)
  {
    Body body = square(material_law("St. Venant-Kirchhoff"),
                       PlaneState::plane_strain,
                       /* with_joint = */ false,
                       MPI_COMM_SELF);
    body.model->problem.boundary_conditions = {
      condition(Type::displacement, "left", vector_function([](auto &) {
                  return Tensor<1, 2>({0.3, 0.});
                }))};
    body.make_finite();
    TimeIntegrator   integrator(*body.mechanics, TimeScheme::energy_momentum());
    const StepReport report = integrator.try_step(1e-4);
    EXPECT_FALSE(report.converged);
    EXPECT_NE(report.reason.find("are missed"), std::string::npos)
      << report.reason;
  }
} // namespace
