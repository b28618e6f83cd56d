// Step-by-step statics with bounded displacements.

#include <nmm/mechanics/incremental_statics.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using Type = BoundaryCondition::Type;

  /// A cantilever of length 4 that bends by a good part of it.
  std::unique_ptr<Model>
  beam()
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {4., 1.});
    auto model =
      std::make_unique<Model>(std::move(geometry),
                              mesh_parameters(0.8, Tensor<1, 2>(), 7.),
                              2);
    model->problem.materials           = {material("beam", 1000., 0.2)};
    model->problem.boundary_conditions = {
      condition(Type::displacement, "left"),
      condition(Type::traction, "right", vector_function([](auto &) {
                  return Tensor<1, 2>({0., -8.});
                }))};
    return model;
  }


  std::unique_ptr<IncrementalElasticity>
  incremental(const Model &model)
  {
    return std::make_unique<IncrementalElasticity>(model.covers,
                                                   *model.quadrature,
                                                   model.constraints,
                                                   model.problem);
  }
} // namespace


TEST(IncrementalStatics, NoCoverMovesFurtherThanAllowed)
{
  const auto       model   = beam();
  const auto       bounded = incremental(*model), equal = incremental(*model);
  IncrementalSteps steps;
  steps.load_factors     = {0.5, 0.6, 1.};
  steps.max_displacement = 0.05;
  IncrementalStatics  statics(*bounded);
  double              way    = 0.;
  unsigned int        n_cuts = 0;
  std::vector<double> asked;
  const auto          taken =
    statics.run(steps, [&](const IncrementalStep &step, const Vector &u) {
      EXPECT_LE(step.largest_displacement, 0.05);
      EXPECT_GT(step.largest_displacement, 0.);
      way += step.largest_displacement;
      n_cuts += step.n_cuts;
      if (step.is_asked)
        asked.push_back(step.load_factor);
      EXPECT_EQ(u.size(), bounded->solution().size());
    });
  EXPECT_EQ(asked, steps.load_factors);
  EXPECT_EQ(statics.load_factor(), 1.);
  std::cout << taken.size() << " steps, " << n_cuts << " cuts, way " << way
            << '\n';
  // no more steps than the aim of 0.045 makes, and one per factor asked for
  EXPECT_GE(taken.size(), way / 0.05);
  EXPECT_LE(taken.size(), way / 0.04 + 4.);
  // those of the first step, as nothing is known then
  EXPECT_LE(n_cuts, 4u);

  // the same as many small steps, to the first order in the step
  IncrementalSteps small;
  small.load_factors.clear();
  for (unsigned int k = 1; k <= 400; ++k)
    small.load_factors.push_back(k / 400.);
  EXPECT_EQ(IncrementalStatics(*equal).run(small).size(), 400u);
  EXPECT_LT(relative_difference(bounded->solution(), equal->solution()), 0.02);
  // in one step it is far off
  const auto one = incremental(*model);
  one->step(1.);
  EXPECT_GT(relative_difference(one->solution(), equal->solution()), 0.1);
}


TEST(IncrementalStatics, RefusedStepsChangeNothing)
{
  const auto model      = beam();
  const auto elasticity = incremental(*model);
  elasticity->step(0.1);
  const IncrementalElasticity::State before  = elasticity->state();
  const auto                         refused = elasticity->try_step(1., 1e-3);
  EXPECT_FALSE(refused.is_taken);
  EXPECT_GT(refused.largest_displacement, 1e-3);
  EXPECT_EQ(elasticity->state().stress, before.stress);
  EXPECT_EQ(relative_difference(elasticity->solution(), before.solution), 0.);

  // and a state that is restored goes on with the same bits
  elasticity->step(0.2);
  const Vector once(elasticity->solution());
  elasticity->restore(before);
  elasticity->step(0.2);
  EXPECT_EQ(relative_difference(elasticity->solution(), once), 0.);
}


/// For small displacements the energy is half of the work of a load that grows
/// from nothing, and the step does all of it with the load at its end.
TEST(IncrementalStatics, EnergyOfASmallStep)
{
  const auto model      = beam();
  const auto elasticity = incremental(*model);
  elasticity->step(1e-5);
  EXPECT_GT(elasticity->work_of_loads(), 0.);
  EXPECT_NEAR(elasticity->strain_energy(),
              0.5 * elasticity->work_of_loads(),
              // what the clamp's condition stores
              0.01 * elasticity->strain_energy());
}


TEST(IncrementalStatics, FailsWithAReason)
{
  const auto         model      = beam();
  const auto         elasticity = incremental(*model);
  IncrementalStatics statics(*elasticity);
  IncrementalSteps   steps;
  steps.max_displacement = 0.05;
  steps.min_step         = 0.5;
  try
  {
    statics.run(steps);
    FAIL() << "it should not have been possible";
  }
  catch (const NumericalFailure &failure)
  {
    EXPECT_NE(failure.message().find("moves a cover"), std::string::npos)
      << failure.message();
  }
  EXPECT_EQ(statics.load_factor(), 0.);

  steps.max_displacement = 0.;
  EXPECT_THROW(statics.run(steps), InputError);
  steps              = {};
  steps.load_factors = {1., 1.};
  EXPECT_THROW(statics.run(steps), InputError);
  steps.load_factors = {0.01};
  statics.run(steps);
  EXPECT_THROW(statics.run(steps), InputError);
}
