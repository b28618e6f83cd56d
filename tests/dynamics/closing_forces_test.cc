// A solid in motion that is cut further: closing forces, and the energy that they take.

#include <nmm/mechanics/carried_covers.h>

#include <dynamics/dynamic_model.h>
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// A plate of 2 x 1 with an edge crack, which may have grown. It is under initial tension, so that
  /// the crack opens, and its bottom and its top are held.
  Body
  cracked_plate(const double crack_length, const bool is_finite)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 1.});
    geometry.add_polyline({{-0.1, 0.53}, {0.8, 0.53}},
                          "crack",
                          CurveRole::joint,
                          JointState::open);
    if (crack_length > 0.8)
      geometry.add_polyline({{0.8, 0.53}, {crack_length, 0.53}},
                            "crack",
                            CurveRole::joint,
                            JointState::open);
    Material rock             = material("rock", 1e3, 0.25, 1.);
    rock.initial_stress[1][1] = 0.1;
    Body body;
    body.model = std::make_unique<Model>(
      std::move(geometry),
      mesh_parameters(0.12, Tensor<1, 2>({0.03, 0.02}), 17.),
      2,
      Stabilization::none);
    body.model->problem.materials           = {rock};
    body.model->problem.boundary_conditions = {
      condition(BoundaryCondition::Type::displacement, "bottom"),
      condition(BoundaryCondition::Type::displacement, "top")};
    if (is_finite)
      body.make_finite();
    else
      body.make_small();
    return body;
  }


  /// The crack is open and the plate at rest. Then the crack grows by 0.2, and its faces separate in a
  /// time @p duration that is long compared with that of waves through the plate, about 0.03 s.
  void
  check_growth(const bool is_finite, const TimeScheme &scheme)
  {
    Body before = cracked_plate(0.8, is_finite),
         after  = cracked_plate(1., is_finite);
    RayleighDamping damping;
    damping.mass      = 20.;
    damping.stiffness = 1e-3;
    for (const Body *body : {&before, &after})
      body->solid->damp(damping, scheme.is_conserving);
    TimeIntegrator first(*before.mechanics, scheme);
    for (unsigned int i = 0; i < 200; ++i)
      step(first, 0.01);
    ASSERT_LT(first.account().kinetic, 1e-5 * std::abs(first.account().strain));
    first.balance_accelerations();

    const CarriedCovers carried(before.model->covers,
                                after.model->covers,
                                *after.model->quadrature);
    DynamicState        state = first.state();
    for (Vector *vector : {&state.u, &state.v, &state.a})
      *vector = carried.carry(*vector);
    const Account &of_first = first.account();
    const double   energy =
      of_first.kinetic + of_first.strain + of_first.conditions;
    TimeIntegrator   second(*after.mechanics, scheme);
    constexpr double duration = 1.;
    second.restore(state);
    const double imbalance_of_free_faces = second.account().imbalance;
    second.continue_after_cut(state, energy, duration);

    // The function is the same, so that no energy is gained or lost.
    const double potential =
      first.account().strain + first.account().conditions;
    EXPECT_NEAR(second.account().cuts, 0., 1e-10 * std::abs(potential));
    EXPECT_NEAR(second.account().kinetic,
                of_first.kinetic,
                1e-9 * of_first.kinetic);
    // Without closing forces the faces would separate at once: the plate is in equilibrium with them.
    EXPECT_LT(second.account().imbalance, 0.05 * imbalance_of_free_faces);
    EXPECT_EQ(second.state().closing.share(state.time), 1.);

    const double before_fading = second.account().balance;
    for (unsigned int i = 0; i < 300; ++i)
      step(second, 0.005);
    EXPECT_FALSE(second.state().closing.act_at(second.state().time));
    const Account &end = second.account();
    // The account closes to rounding if the scheme conserves energy, and to the error of the
    // trapezoidal rule otherwise.
    EXPECT_NEAR(end.balance - before_fading,
                0.,
                (scheme.is_conserving ? 1e-9 : 1e-5) * std::abs(energy));
    // Stored energy becomes work against closing forces; what waves carry away is of the order of
    // the square of (0.03 s / 1 s).
    const double released = energy - end.kinetic - end.strain - end.conditions +
                            end.external_work - of_first.external_work -
                            (end.dissipated - of_first.dissipated);
    EXPECT_GT(released, 1e-3 * std::abs(energy));
    EXPECT_NEAR(end.fracture, released, 5e-3 * released);
  }
} // namespace


TEST(ClosingForcesTest, SmallDisplacements)
{
  check_growth(false, TimeScheme());
}


TEST(ClosingForcesTest, LargeDisplacementsConserving)
{
  check_growth(true, TimeScheme::energy_momentum());
}


// The mean over a step is that of the linear function up to its end, and of zero afterwards.
TEST(ClosingForcesTest, MeanShare)
{
  ClosingForces none;
  EXPECT_EQ(none.share(0.), 0.);
  EXPECT_EQ(none.mean_share(0., 1.), 0.);
  ClosingForces closing;
  closing.forces.reinit(dealii::complete_index_set(2), MPI_COMM_SELF);
  closing.begin = 1.;
  closing.end   = 3.;
  EXPECT_DOUBLE_EQ(closing.share(1.), 1.);
  EXPECT_DOUBLE_EQ(closing.share(2.), 0.5);
  EXPECT_EQ(closing.share(3.), 0.);
  EXPECT_DOUBLE_EQ(closing.mean_share(1., 2.), 0.75);
  EXPECT_DOUBLE_EQ(closing.mean_share(2., 4.), 0.125);
  EXPECT_EQ(closing.mean_share(3., 4.), 0.);
}
