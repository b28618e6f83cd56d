#include <nmm/mechanics/block_motion.h>

#include <gtest/gtest.h>
#include <mechanics/model.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  // Two blocks, one of which is moved and turned as a whole while the other one is stretched: exact
  // to rounding, as the displacements are linear and the quadrature of degree 4.
  TEST(BlockMotion, TranslationAndRotationOfEachBlock)
  {
    Geometry geometry;
    add_box(geometry, {0., 0.}, {2., 1.});
    Curve joint =
      single_piece_curve("cut", CurvePiece::segment({0.7, 0.}, {0.7, 1.}));
    joint.role  = CurveRole::joint;
    joint.state = JointState::open;
    geometry.add(joint);
    Model model(std::move(geometry), mesh_parameters(0.3), 2);
    model.problem.materials = {material()};
    ASSERT_EQ(model.physical_mesh.n_blocks(), 2U);

    const Point<2>     left(0.35, 0.5), right(1.35, 0.5);
    const Tensor<1, 2> way({0.3, -0.2});
    const double       turn = 0.01, stretch = 0.05;
    const auto         left_moves = [&](const Point<2> &x) {
      return way + turn * Tensor<1, 2>({-(x[1] - left[1]), x[0] - left[0]});
    };
    const auto right_stretches = [&](const Point<2> &x) {
      return stretch * Tensor<1, 2>({x[0] - right[0], 0.});
    };

    const unsigned int        n = model.covers.n_covers();
    std::vector<Tensor<1, 2>> before(n), after(n);
    for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
      for (const unsigned int k : model.covers.covers(e))
      {
        const bool is_left =
          model.manifold_mesh.block(e) ==
          model.manifold_mesh.block(model.locate(left).first);
        const Point<2> &x = model.covers.node(k);
        before[k]         = Tensor<1, 2>({0.1, 0.1});
        after[k] = before[k] + (is_left ? left_moves(x) : right_stretches(x));
      }
    const auto motions =
      block_motions(DisplacementField(model.covers, model.problem, before),
                    DisplacementField(model.covers, model.problem, after),
                    *model.quadrature);

    ASSERT_EQ(motions.size(), 2U);
    const unsigned int b = model.manifold_mesh.block(model.locate(left).first);
    constexpr double   rounding = 1e-13;
    EXPECT_EQ(motions[b].block, b);
    EXPECT_NEAR(motions[b].area, 0.7, rounding);
    EXPECT_LT(motions[b].center.distance(left), rounding);
    EXPECT_LT((motions[b].translation - way).norm(), rounding);
    EXPECT_NEAR(motions[b].rotation, turn, rounding);
    EXPECT_NEAR(motions[b].radius, std::sqrt((0.7 * 0.7 + 1.) / 12.), rounding);
    EXPECT_LT(motions[1 - b].center.distance(right), rounding);
    EXPECT_LT(motions[1 - b].size(), rounding);
  }
} // namespace
