// Springs beside contact.

#include <nmm/mechanics/spring_term.h>

#include <array>
#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>
#include <support/contact_bars/moving_bodies.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// Two squares that fall on a floor beside each other and are bound by a spring.
  struct Falling
  {
    explicit Falling(const bool mesh_of_every_block)
    {
      using namespace ContactBars;
      Geometry geometry;
      add_block(geometry,
                "left",
                {{0., 0.02}, {1., 0.02}, {1., 1.02}, {0., 1.02}});
      add_block(geometry,
                "right",
                {{1.01, 0.05}, {2.01, 0.05}, {2.01, 1.05}, {1.01, 1.05}});
      MovingBodies::Options options;
      options.cell_size           = mesh_of_every_block ? 2.5 : 0.6;
      options.mesh_of_every_block = mesh_of_every_block;
      options.obstacles           = {obstacle("floor", {{6., 0.}, {-6., 0.}})};
      bodies = std::make_unique<MovingBodies>(std::move(geometry), options);
      bodies->problem.materials = {
        material("rock", rock_modulus, 0.2, rock_density)};
      bodies->problem.gravity = Tensor<1, 2>({0., -standard_gravity});
      ContactParameters parameters =
        contact_parameters(0.1 * rock_modulus, 0.05);
      coulomb(parameters).friction = 0.5;
      bodies->start(parameters, Kinematics::finite);
      Spring spring;
      spring.start          = {0.3, 0.9};
      spring.end            = {1.8, 0.8};
      spring.stiffness      = 2e6;
      spring.natural_length = 1.49;
      springs               = std::make_unique<SpringTerm>(bodies->covers,
                                             bodies->solid->layout(),
                                             std::vector<Spring>{spring});
    }

    /// Displacements after some contact.
    Vector
    run(const bool        spring_last,
        const TimeScheme &scheme,
        const bool        solves_groups_separately = true)
    {
      std::vector<ForceTerm *> terms = {bodies->solid.get(),
                                        springs.get(),
                                        bodies->touch.get()};
      if (spring_last)
        std::swap(terms[1], terms[2]);
      bodies->integrator.reset();
      bodies->model =
        std::make_unique<MechanicalModel>(bodies->solid->layout(), terms);
      NewtonParameters newton = TimeIntegrator::default_newton_parameters();
      newton.solves_groups_separately = solves_groups_separately;
      bodies->integrate(scheme, bodies->zero(), bodies->zero(), {}, newton);
      for (unsigned int n = 0; n < 60; ++n)
      {
        step(*bodies->integrator, 0.0025);
        has_body_matrix =
          has_body_matrix || bodies->model->forces().body_tangent != nullptr;
        worst_balance =
          std::max(worst_balance,
                   std::abs(bodies->integrator->account().balance));
      }
      EXPECT_FALSE(bodies->contact->is_idle());
      return bodies->integrator->state().u;
    }

    std::unique_ptr<ContactBars::MovingBodies> bodies;
    std::unique_ptr<SpringTerm>                springs;
    bool                                       has_body_matrix = false;
    double                                     worst_balance   = 0.;
  };


  /// The tangent of the last assembly times a vector.
  Vector
  times_tangent(const AssembledForces &forces, const Vector &direction)
  {
    Vector product(direction);
    if (forces.body_tangent != nullptr)
      forces.body_tangent->sparse().vmult(product, direction);
    else
      forces.tangent->vmult(product, direction);
    return product;
  }


  // Springs add the same to both kinds of matrices, while contact points are closed: what
  // they add to the solid alone.
  TEST(SpringsAndContact, AddTheSameToEachMatrix)
  {
    for (const bool mesh_of_every_block : {true, false})
    {
      Falling            falling(mesh_of_every_block);
      const Vector       u = falling.run(true, TimeScheme::energy_momentum());
      ForceTerm *const   solid  = falling.bodies->solid.get();
      ForceTerm *const   touch  = falling.bodies->touch.get();
      ForceTerm *const   spring = falling.springs.get();
      const ModelLayout &layout = falling.bodies->solid->layout();
      const double       t      = falling.bodies->integrator->state().time;
      std::mt19937       generator(5);
      const Vector       direction = random_displacement(layout, 1., generator);
      Trial              trial     = Trial::step(u, u, t, t + 0.0025, true);
      trial.tangent                = Tangent::consistent;
      // what springs add to r and to K times the direction
      const auto added = [&](std::vector<ForceTerm *> terms) {
        MechanicalModel without(layout, terms);
        terms.insert(terms.begin() + 1, spring);
        MechanicalModel       with(layout, terms);
        std::array<Vector, 2> result = {direction, direction};
        result[0] = result[1] = 0.;
        for (MechanicalModel *model : {&with, &without})
        {
          model->begin_step({u, u, t, 0.0025, 0.});
          EXPECT_EQ(model->assemble(trial), Deformation::admissible);
          const double sign = model == &with ? 1. : -1.;
          result[0].add(sign, *model->forces().residual);
          result[1].add(sign, times_tangent(model->forces(), direction));
          if (model == &with && terms.size() > 2)
          {
            EXPECT_EQ(model->forces().body_tangent != nullptr,
                      mesh_of_every_block);
          }
        }
        return result;
      };
      const auto beside = added({solid, touch});
      const auto alone  = added({solid});
      for (const unsigned int i : {0, 1})
      {
        Vector difference(beside[i]);
        difference -= alone[i];
        // rounding of contact and elasticity, 1e9 Pa, of which springs of 2e6 Pa are a part
        EXPECT_LT(difference.linfty_norm(), 1e-10 * alone[i].linfty_norm())
          << i;
        EXPECT_GT(alone[i].linfty_norm(), i == 0 ? 1e3 : 1e5);
      }
    }
  }


  // Springs and contact, in either order, with a body matrix, a matrix that may be added to, and one
  // that may not.
  TEST(SpringsAndContact, ActBesideContactMPI)
  {
    const bool is_serial =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    for (const bool mesh_of_every_block : {true, false})
      for (const TimeScheme &scheme :
           {TimeScheme::energy_momentum(), TimeScheme::generalized_alpha(0.9)})
      {
        // on several ranks all blocks are one group, and there is no body matrix
        if (mesh_of_every_block && !is_serial)
          continue;
        Falling first(mesh_of_every_block), second(mesh_of_every_block),
          together(mesh_of_every_block);
        const Vector expected = first.run(true, scheme);
        EXPECT_EQ(first.has_body_matrix,
                  mesh_of_every_block && scheme.is_conserving);
        if (scheme.is_conserving)
        {
          // of the potential energy of 2,500 kg/m that fall by 2 cm
          EXPECT_LT(first.worst_balance, 1e-7 * 2500. * 9.81 * 0.02);
        }
        for (Falling *other : {&second, &together})
        {
          if (other == &together && !is_serial)
            continue;
          Vector difference =
            other->run(other == &together, scheme, other == &second);
          difference -= expected;
          // rounding and the tolerance of Newton's method, which contact amplifies
          EXPECT_LT(difference.linfty_norm(), 1e-7 * expected.linfty_norm())
            << scheme.name << (other == &second ? ", order" : ", groups");
        }
      }
  }

  // A spring draws two blocks on a rough floor towards each other: friction holds them, or the lighter
  // one slides until the spring pulls no more than friction bears. (If both slid, nothing would hold
  // their common place, and rounding would decide on it.)
  TEST(SpringsAndContact, AreInEquilibriumAtRest)
  {
    using namespace ContactBars;
    for (const double friction : {0.5, 0.1})
    {
      Geometry geometry;
      add_block(geometry, "left", {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}});
      add_block(geometry,
                "right",
                {{1.5, 0.}, {3.5, 0.}, {3.5, 1.}, {1.5, 1.}});
      Bodies::Options options;
      options.cell_size = 0.6;
      options.obstacles = {obstacle("floor", {{6., 0.}, {-6., 0.}})};
      Bodies bodies(std::move(geometry), options);
      bodies.problem.materials = {
        material("rock", rock_modulus, 0.2, rock_density)};
      bodies.problem.gravity = Tensor<1, 2>({0., -standard_gravity});
      ContactParameters parameters =
        contact_parameters(0.1 * rock_modulus, 0.05);
      coulomb(parameters).friction = friction;
      bodies.start(parameters, /* is_linearized = */ false);
      Spring spring;
      spring.start          = {0.5, 0.5};
      spring.end            = {2.5, 0.5};
      spring.stiffness      = 5e4;
      spring.natural_length = 1.9;
      SpringTerm     springs(bodies.covers,
                         bodies.static_solid->layout(),
                         {spring});
      ContactStatics statics(*bodies.static_solid,
                             *bodies.contact,
                             ContactStatics::default_newton_parameters(),
                             {&springs});
      statics.run(LoadSteps::equal(1));
      const double weight    = rock_density * standard_gravity;
      double       normal[2] = {0., 0.}, shear[2] = {0., 0.};
      for (const ContactPoint &point : bodies.contact->points())
        if (point.state != ContactState::open)
        {
          const unsigned int b = bodies.surface.edges()[point.edge].body;
          normal[b] += point.weight * point.pressure;
          shear[b] += point.weight * point.shear;
        }
      Vector owned(bodies.contact->residual());
      owned             = statics.solution();
      const double pull = springs.forces(owned)[0];
      for (const unsigned int b : {0, 1})
      {
        // the tolerance of Newton's method
        EXPECT_NEAR(normal[b] / weight, 1. + b, 1e-7);
        EXPECT_NEAR(std::abs(shear[b]) / pull, 1., 1e-7);
      }
      EXPECT_LT(shear[0] * shear[1], 0.);
      if (friction == 0.1)
        EXPECT_NEAR(pull / (friction * weight), 1., 1e-7);
      else
      {
        // A pull T moves the square by T / K along the springs of its base, of the stiffness K on 1 m,
        // and by 3 T / K by tilting it: (T / 2) / (K / 12) is the angle, and 1/2 the height. On a base
        // of 2 m these are T / (2 K) and 3 T / (8 K). Blocks are strained by some T / E, a tenth of that.
        const double K = 0.1 * rock_modulus;
        EXPECT_NEAR(pull / (spring.stiffness * 0.1),
                    1. / (1. + 4.875 * spring.stiffness / K),
                    5e-4);
      }
    }
  }
} // namespace
