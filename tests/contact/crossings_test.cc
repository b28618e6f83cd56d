// What passes through each other in a step, from positions at its ends alone.

#include <cmath>
#include <contact/detection/crossings.h>
#include <contact/random_polygons.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using internal::ContactCrossings;

  constexpr double reach = 0.05;

  /// A block and a rigid plate, and a step that moves the block from one rigid motion to another.
  class Crossing
  {
  public:
    Crossing(const std::vector<Point<2>> &block,
             const std::vector<Point<2>> &plate)
      : bodies(make(block), options(plate))
      , crossings(bodies.surface, reach)
    {
    }

    StepFault
    find(const Motion &begin,
         const Motion &end,
         const bool    is_in_contact = false)
    {
      crossings.set_step(positions(begin), positions(end));
      const auto                         &edges = bodies.surface.edges();
      std::vector<ContactCrossings::Pair> pairs;
      for (unsigned int e = 0; e < edges.size(); ++e)
        for (unsigned int f = 0; f < edges.size(); ++f)
          if (edges[e].body != edges[f].body && crossings.may_cross(e, f, 0.))
            pairs.emplace_back(e, f);
      n_pairs = pairs.size();
      return crossings.find(std::move(pairs), [=](unsigned int, unsigned int) {
        return is_in_contact;
      });
    }

    Bodies           bodies;
    ContactCrossings crossings;
    unsigned int     n_pairs = 0;

  private:
    static Geometry
    make(const std::vector<Point<2>> &block)
    {
      Geometry geometry;
      geometry.add_polygon(block, "block");
      return geometry;
    }

    static Bodies::Options
    options(std::vector<Point<2>> plate)
    {
      Bodies::Options result;
      result.cell_size = 3.;
      if (plate.size() > 2)
        plate.push_back(plate.front());
      result.obstacles = {obstacle("plate", plate)};
      return result;
    }

    std::vector<ContactPosition>
    positions(const Motion &motion)
    {
      const std::vector<Tensor<1, 2>> nodal = move(bodies, {motion});
      bodies.surface.set_displacements(&nodal);
      std::vector<ContactPosition> result;
      for (unsigned int e = 0; e < bodies.surface.edges().size(); ++e)
        for (const double t : {0., 0.5, 1.})
          result.push_back(bodies.surface.place(e, t).x);
      return result;
    }
  };


  Motion
  shifted(const double x, const double y)
  {
    Motion motion;
    motion.shift = Tensor<1, 2>({x, y});
    return motion;
  }


  const std::vector<Point<2>> square = {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};


  std::vector<Point<2>>
  box(const Point<2> &lower, const Point<2> &upper)
  {
    return {lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}};
  }
} // namespace


// The square falls by 2 m; its lower side meets the plate, 0.01 m thick, after 0.5 m and leaves it
// after 0.51 m: a quarter of that way inside is at (0.5 + 0.0025) / 2.
TEST(ContactCrossings, StraightThroughAPlate)
{
  Crossing        crossing(square, box({-3., -0.51}, {3., -0.5}));
  const StepFault fault = crossing.find(shifted(0., 0.), shifted(0., -2.));
  EXPECT_NE(fault.reason, "");
  EXPECT_NE(fault.remedy, "");
  EXPECT_NEAR(fault.retry, 0.25125, 1e-12);
  // also if something presses
  EXPECT_NE(crossing.find(shifted(0., 0.), shifted(0., -2.), true).reason, "");
  // beyond the middle, and not so far
  EXPECT_NE(crossing.find(shifted(0., 0.), shifted(0., -0.507)).reason, "");
  EXPECT_EQ(crossing.find(shifted(0., 0.), shifted(0., -0.503)).reason, "");
  // from the first half to the second one, and out on the far side
  EXPECT_NE(crossing.find(shifted(0., -0.503), shifted(0., -0.507)).reason, "");
  EXPECT_NE(crossing.find(shifted(0., -0.503), shifted(0., -0.52)).reason, "");
  // back, and along
  EXPECT_EQ(crossing.find(shifted(0., -0.503), shifted(0., 0.3)).reason, "");
  EXPECT_EQ(crossing.find(shifted(0., -0.503), shifted(1.5, -0.503)).reason,
            "");
  // what presses does not hold the square on the side from which it came
  EXPECT_NE(
    crossing.find(shifted(0., -0.503), shifted(0., -0.507), true).reason, "");
}


// The circumference of the square is 4 m. Stretched by 8, its corners go 7 times their distance
// from the middle, 5.0 m; by 6, 3.5 m; turned by a half, 1.4 m.
TEST(ContactCrossings, DeformationBeyondTheCircumference)
{
  Crossing   crossing(square, box({-3., -50.}, {3., -49.}));
  const auto moved = [](const double stretch, const double angle) {
    Motion motion;
    motion.center  = Point<2>(0.5, 0.5);
    motion.stretch = stretch;
    motion.angle   = angle;
    return motion;
  };
  const auto reason = [&](const Motion &end) {
    return crossing.find(moved(1., 0.), end).reason;
  };
  EXPECT_NE(reason(moved(8., 0.)).find("circumference"), std::string::npos);
  EXPECT_EQ(reason(moved(6., 0.)), "");
  EXPECT_EQ(reason(moved(1., dealii::numbers::PI)), "");
}


// The plate is between the corners of the square: its own corners pass through that.
TEST(ContactCrossings, CornersOfObstacles)
{
  Crossing crossing(square, box({0.4, -0.51}, {0.6, -0.5}));
  EXPECT_NE(crossing.find(shifted(0., 0.), shifted(0., -3.)).reason, "");
  EXPECT_EQ(crossing.find(shifted(0., 0.), shifted(3., -1.5)).reason, "");
}


// The corner of the square, pressed 0.03 m into that of the plate, is 0.028 to 0.032 m from both of
// its faces: more than half of the reach. Which of them is nearer changes by the smallest motion. A
// plate of 2.03 m is not thinner there than elsewhere, and a fortieth of the circumference is 0.1 m
// of the square and 0.2 m of the plate.
TEST(ContactCrossings, DeepInACorner)
{
  Crossing   crossing(square, box({-2., -2.}, {0.03, 0.03}));
  const auto reason = [&](const double depth, const bool is_in_contact) {
    const double shift = 0.03 - depth;
    return crossing
      .find(shifted(shift + 0.002, shift - 0.002),
            shifted(shift - 0.002, shift + 0.002),
            is_in_contact)
      .reason;
  };
  EXPECT_EQ(reason(0.03, true), "");
  EXPECT_EQ(reason(0.09, true), "");
  EXPECT_NE(reason(0.12, true).find("beyond the middle"), std::string::npos);
  // what is not in contact has been missed
  EXPECT_NE(reason(0.03, false), "");
  // in through one face and out through the other one, 0.08 m from the corner
  EXPECT_NE(
    crossing.find(shifted(0.1, -0.12), shifted(-0.12, 0.1), true).reason, "");
}


// The corner of the square in a wedge of 20 degrees, 2 m long, 0.296 m wide in the mean: it may pass
// the middle of the wedge a fifth of that from the tip, and not where the wedge is thicker.
TEST(ContactCrossings, TipOfAWedge)
{
  const double half = 2. * std::tan(10. * dealii::numbers::PI / 180.);
  Crossing     crossing(square, {{0., 0.}, {-2., half}, {-2., -half}});
  const auto   reason = [&](const double x, const bool is_in_contact) {
    return crossing.find(shifted(-x, -0.002), shifted(-x, 0.002), is_in_contact)
      .reason;
  };
  EXPECT_EQ(reason(0.02, true), "");
  EXPECT_EQ(reason(0.05, true), "");
  EXPECT_NE(reason(0.05, false), "");
  EXPECT_NE(reason(0.07, true), "");
  EXPECT_NE(reason(0.5, true), "");
}


// Half of the plane has no far side: what is deep in it must be in contact.
TEST(ContactCrossings, HalfOfThePlane)
{
  Crossing     crossing(square, {{30., -0.5}, {-30., -0.5}});
  const Motion deep = shifted(0., -2000.5);
  EXPECT_EQ(crossing.find(shifted(0., 0.), deep, true).reason, "");
  const StepFault fault = crossing.find(shifted(0., 0.), deep);
  EXPECT_NE(fault.reason, "");
  // where it is a quarter of the reach deep
  EXPECT_NEAR(fault.retry * 2000.5, 0.5 + 0.25 * reach, 1e-9);
  EXPECT_EQ(crossing.find(shifted(0., 0.), shifted(0., -0.51)).reason, "");
}


// A bar of 2 m turns by 2.5 rad about its middle. Its end passes a plate that stands at 1.25
// rad, 0.7 to 1.2 m from there; the straight way from where it begins to where it ends is 0.3 m
// from the middle.
TEST(ContactCrossings, ArcsAreFollowed)
{
  const auto place = [](const double r, const double offset) {
    const double angle = 1.25;
    return Point<2>(r * std::cos(angle) - offset * std::sin(angle),
                    r * std::sin(angle) + offset * std::cos(angle));
  };
  const auto plate = [&](const double r_0, const double r_1) {
    return std::vector<Point<2>>{place(r_0, -0.005),
                                 place(r_1, -0.005),
                                 place(r_1, 0.005),
                                 place(r_0, 0.005)};
  };
  const std::vector<Point<2>> bar = box({-1., -0.05}, {1., 0.05});
  Motion                      turned;
  turned.angle = 2.5;
  Crossing        crossing(bar, plate(0.7, 1.2));
  const StepFault fault = crossing.find(Motion(), turned);
  EXPECT_NE(fault.reason, "");
  // the bar's side, 0.05 m ahead of its middle line, comes to it at the radius of 0.7 to 1
  EXPECT_GT(fault.retry, (1.25 - 0.005 / 0.7 - 0.05 / 0.7) / 2.5 - 0.005);
  EXPECT_LT(fault.retry, (1.25 + 0.005 / 0.7) / 2.5);
  Crossing out_of_reach(bar, plate(1.1, 1.6));
  EXPECT_EQ(out_of_reach.find(Motion(), turned).reason, "");
  Crossing within(bar, plate(0.2, 0.4));
  EXPECT_NE(within.find(Motion(), turned).reason, "");
}


// What moves less than the thickness at stake, see the class, is not looked at.
TEST(ContactCrossings, SlowMotionCostsNothing)
{
  Crossing crossing(square, {{30., -0.5}, {-30., -0.5}});
  // tau = reach / 2, and r / (D + r) = 1/9 with r = 1/4, D = 2
  const double least = 0.5 * (0.5 * reach / 9.);
  EXPECT_FALSE(crossing.crossings.may_cross(0.99 * least));
  EXPECT_TRUE(crossing.crossings.may_cross(1.01 * least));
  crossing.find(shifted(0., 0.), shifted(0., -0.99 * least));
  EXPECT_EQ(crossing.n_pairs, 0U);
  crossing.find(shifted(0., 0.), shifted(0., -1.01 * least));
  EXPECT_GT(crossing.n_pairs, 0U);
}
