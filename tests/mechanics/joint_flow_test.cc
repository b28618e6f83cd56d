#include <nmm/base/exceptions.h>
#include <nmm/mechanics/joint_flow.h>

#include <gtest/gtest.h>

using namespace NMM;

// Steady flow in networks of joints by the cubic law.
namespace
{
  FlowNetwork::Link
  link(const unsigned int a,
       const unsigned int b,
       const double       length,
       const double       aperture)
  {
    return {{a, b}, length, {aperture, aperture}};
  }
} // namespace


TEST(JointFlow, FollowsTheCubicLaw)
{
  const FlowNetwork network;
  // gamma b^3 / 12 mu
  EXPECT_NEAR(network.conductance(link(0, 1, 1., 1e-4)), 8.175e-7, 1e-19);
  EXPECT_NEAR(network.conductance(link(0, 1, 2., 5e-4)),
              0.5 * 1.021875e-4,
              1e-17);
  // The mean of b^-3 over a linear aperture, from many short links in series.
  FlowNetwork::Link wedge = {{0, 1}, 1., {1e-4, 3e-4}};
  double            sum   = 0.;
  constexpr int     n     = 1000;
  for (int i = 0; i < n; ++i)
    sum +=
      1. / network.conductance(link(0, 1, 1. / n, 1e-4 + 2e-4 * (i + 0.5) / n));
  // second order in 1/n
  EXPECT_NEAR(network.conductance(wedge) * sum, 1., 3e-6);
}


TEST(JointFlow, CrossingOfFourArms)
{
  FlowNetwork network;
  network.nodes          = {{0.}, {0., 10.}, {0., 0.}, {0., 6.}, {0., 0.}};
  network.links          = {link(1, 0, 5., 2e-4),
                            link(2, 0, 5., 2e-4),
                            link(0, 3, 3., 1e-4),
                            link(4, 0, 4., 3e-4)};
  const NetworkFlow flow = solve_flow(network);
  // sum of g h / sum of g with g = b^3 / L; nine digits are given, at most 1e-13 off
  EXPECT_NEAR(flow.heads[0], 1.7504051864, 1e-10);
  EXPECT_NEAR(flow.inflows[1], 1.07904700e-5, 6e-14);
  EXPECT_NEAR(flow.inflows[2], -2.28952998e-6, 6e-14);
  EXPECT_NEAR(flow.inflows[3], 1.15801459e-6, 6e-14);
  EXPECT_NEAR(flow.inflows[4], -9.65895462e-6, 6e-14);
  EXPECT_NEAR(flow.inflows[0], 0., 1e-19);
  EXPECT_EQ(flow.flows[2], -flow.inflows[3]);
  EXPECT_EQ(flow.n_dry, 0u);
}


TEST(JointFlow, SeepsOutIntoTheAirButNotIn)
{
  // A rising joint with outlets at 1, 3 and 5 m from a head of 4 m: the highest one draws no air or
  // water in, since its head is that of the node below it.
  FlowNetwork network;
  network.nodes = {{0., 4.}, {1.}, {3.}, {5.}, {1.}, {3.}, {5.}};
  for (const unsigned int outlet : {4u, 5u, 6u})
    network.nodes[outlet].is_in_air = true;
  network.links          = {link(0, 1, 1., 1e-4),
                            link(1, 2, 1., 1e-4),
                            link(2, 3, 1., 1e-4),
                            link(1, 4, 10., 1e-4),
                            link(2, 5, 10., 1e-4),
                            link(3, 6, 10., 1e-4)};
  const NetworkFlow flow = solve_flow(network);
  EXPECT_LT(flow.inflows[4], 0.);
  EXPECT_LT(flow.inflows[5], 0.);
  EXPECT_EQ(flow.heads[4], 1.);
  EXPECT_EQ(flow.heads[5], 3.);
  EXPECT_NEAR(flow.inflows[6], 0., 1e-18);
  EXPECT_NEAR(flow.heads[6], flow.heads[2], 1e-12);
  // (h_1 - 1)/10 + (h_1 - h_2) = 4 - h_1 and (h_2 - 3)/10 = h_1 - h_2
  const double h_1 = (1.1 * 4.1 + 0.3) / (2.1 * 1.1 - 1.);
  EXPECT_NEAR(flow.heads[1], h_1, 1e-12);
  EXPECT_NEAR(flow.heads[2], (h_1 + 0.3) / 1.1, 1e-12);
  // what goes in comes out
  double sum = 0.;
  for (const double q : flow.inflows)
    sum += q;
  EXPECT_NEAR(sum, 0., 1e-18);
}


TEST(JointFlow, WithoutAHeadJointsAreDry)
{
  FlowNetwork network;
  network.nodes              = {{0., 4.}, {1.}, {2.}, {3.}};
  network.nodes[3].is_in_air = true;
  network.links              = {link(0, 1, 1., 1e-4), link(2, 3, 1., 1e-4)};
  const NetworkFlow flow     = solve_flow(network);
  EXPECT_NEAR(flow.heads[1], 4., 6e-14);
  EXPECT_EQ(flow.heads[2], 2.);
  EXPECT_EQ(flow.inflows[3], flow.flows[1] * -1.);
  EXPECT_EQ(flow.n_dry, 2u);
}
