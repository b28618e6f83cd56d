#include <nmm/geometry/physical_mesh.h>
#include <nmm/scene/scene_parameters_dynamics.h>

#include <analysis/mechanism.h>
#include <gtest/gtest.h>
#include <limits>

using namespace NMM;
using namespace NMM::internal;
using dealii::Point;
using dealii::Tensor;

namespace
{
  BlockMotion
  motion(const unsigned int  block,
         const Tensor<1, 2> &translation,
         const double        rotation)
  {
    BlockMotion result;
    result.block       = block;
    result.area        = 1.;
    result.center      = Point<2>(1. + block, 2.);
    result.radius      = 0.5;
    result.translation = translation;
    result.rotation    = rotation;
    return result;
  }


  /// What is said of blocks that move as given.
  void
  expect(const std::vector<BlockMotion> &motions,
         const double                    power,
         const bool                      does_anything_move,
         const std::string              &description)
  {
    const Mechanism mechanism = find_mechanism(motions, power, 0.1);
    EXPECT_EQ(mechanism.does_anything_move, does_anything_move);
    EXPECT_EQ(mechanism.description, description);
  }


  TEST(Mechanism, LoadsSayWhichWay)
  {
    const auto slide = motion(0, Tensor<1, 2>({-3e6, 4e6}), 1e-3);
    expect({slide},
           1.,
           true,
           "Block 0 around (1, 2) slides towards (-0.6, 0.8)");
    expect({slide},
           -1.,
           true,
           "Block 0 around (1, 2) slides towards (0.6, -0.8)");
    // about (2, 2) + (-t_y, t_x) / omega
    const auto turn = motion(1, Tensor<1, 2>({2e4, -1e4}), 2e4);
    expect({motion(0, Tensor<1, 2>(), 0.), turn},
           1.,
           true,
           "Block 1 around (2, 2) turns counter-clockwise about (2.5, 3)");
    expect({slide, motion(1, Tensor<1, 2>({-3e6, 4e6}), 0.), turn},
           -1.,
           true,
           "Block 0 around (1, 2) slides towards (0.6, -0.8), and 1 more "
           "block(s) move with it");
  }


  TEST(Mechanism, StatesThatAlternateMoveNothing)
  {
    expect({motion(0, Tensor<1, 2>({3e-8, 0.}), 1e-8)},
           1.,
           false,
           "No block gives way: contact points keep changing between sticking "
           "and slipping, or between open and closed");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect({motion(0, Tensor<1, 2>({nan, 0.}), 0.)},
           nan,
           false,
           "The iteration produced displacements that are not finite");
  }


  // Twice the mean length of a block, the diagonal over the root of the number of blocks, and at least a
  // tenth of the diagonal; steps are bounded by a tenth of the diagonal or of that distance.
  TEST(Mechanism, RelaxationsEndWhereBlocksHaveLeftTheirPlace)
  {
    for (const auto &[n, ways] : std::vector<std::pair<unsigned int, double>>{
           {1, 2.}, {2, 1.}, {20, 0.1}, {25, 0.1}})
    {
      Geometry geometry;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          const double x = 3. * i / n, y = 4. * j / n, a = 2.9 / n, b = 3.9 / n;
          const bool   is_last_x = i + 1 == n, is_last_y = j + 1 == n;
          const double right = is_last_x ? 3. : x + a,
                       top   = is_last_y ? 4. : y + b;
          geometry.add_polygon({{x, y}, {right, y}, {right, top}, {x, top}},
                               "block");
        }
      const PhysicalMesh mesh(std::move(geometry));
      ASSERT_EQ(mesh.n_blocks(), n * n);
      RelaxationSectionParameters parameters;
      const RelaxationParameters  by_default = parameters.bounded(mesh);
      const double                diagonal   = 5.;
      EXPECT_NEAR(by_default.max_displacement, ways * diagonal, 1e-12);
      EXPECT_NEAR(by_default.max_step_displacement,
                  0.1 * std::min(ways, 1.) * diagonal,
                  1e-12);
      parameters.relaxation.max_displacement = 0.3;
      const RelaxationParameters given       = parameters.bounded(mesh);
      EXPECT_EQ(given.max_displacement, 0.3);
      EXPECT_EQ(given.max_step_displacement, 0.);
    }
  }
} // namespace
