// Cases with a rule that is known, or with none.

#include <nmm/base/exceptions.h>
#include <nmm/quadrature/element_rule_builder.h>

#include "random_elements.h"
#include "support/n_samples.h"
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Testing;

namespace
{
  CellFrame
  unit_frame()
  {
    CellFrame frame;
    frame.jacobian[0][0] = frame.jacobian[1][1] = 1.;
    return frame;
  }


  TEST(ElementRule, WeightsSumToTheReferenceArea)
  {
    CellFrame frame;
    frame.origin         = {10., 20.};
    frame.jacobian[0][0] = 4.;
    frame.jacobian[0][1] = 1.;
    frame.jacobian[1][1] = 2.;
    std::vector<ElementEdge> whole;
    append_loop(whole, {{10., 20.}, {14., 20.}, {11., 22.}});
    double     sum = 0.;
    const auto rule =
      make_element_rule(dealii::make_array_view(whole), frame, 4);
    for (const double w : rule.get_weights())
      sum += w;
    EXPECT_NEAR(sum, 0.5, 1e-15);
  }


  // Area zero or lost in the rounding of the vertices: no points, no fallback.
  TEST(ElementRule, AreaThatRoundsToZeroHasNoPoints)
  {
    ElementRuleBuilder builder(4);
    const double       ulp = std::numeric_limits<double>::epsilon() / 4.;
    for (const Points &loop :
         {Points{{0.2, 0.3}, {0.2, 0.3}, {0.2, 0.3}},
          Points{{0.1, 0.3}, {0.5, 0.3}, {0.3, 0.3}},
          Points{{0.1, 0.3}, {0.5, 0.3}, {0.3, 0.3 + ulp}},
          Points{{0.1, 0.3}, {0.3, 0.3 + ulp}, {0.5, 0.3}}})
    {
      std::vector<ElementEdge> element;
      append_loop(element, loop);
      EXPECT_EQ(
        builder.build(dealii::make_array_view(element), unit_frame()).size(),
        0u);
      EXPECT_FALSE(builder.last_was_fallback());
    }
    // no edges at all
    EXPECT_EQ(builder
                .build(dealii::ArrayView<const ElementEdge>(nullptr, 0),
                       unit_frame())
                .size(),
              0u);
  }


  // As thin, but at y = 0, where doubles are dense: a sliver like any other.
  TEST(ElementRule, SliverOfAspect1e14KeepsItsArea)
  {
    std::vector<ElementEdge> element;
    append_loop(element, {{0.1, 0.}, {0.5, 0.}, {0.3, 1e-14}});
    double     sum = 0.;
    const auto rule =
      make_element_rule(dealii::make_array_view(element), unit_frame(), 4);
    for (const double w : rule.get_weights())
      sum += w;
    EXPECT_NEAR(sum / (0.5 * 0.4 * 1e-14), 1., 1e-13);
  }


  TEST(ElementRule, RejectsDegreesOutOfRange)
  {
    EXPECT_THROW(ElementRuleBuilder(21), InputError);
    EXPECT_THROW(make_triangle_rule(15), InputError);
  }


  TEST(ElementRule, ReportsCoordinatesThatAreNotFinite)
  {
    std::vector<ElementEdge> element;
    append_loop(element, {{0., 0.}, {1., 0.}, {0., std::nan("")}});
    ElementRuleBuilder builder(2);
    EXPECT_THROW(builder.build(dealii::make_array_view(element), unit_frame()),
                 NumericalFailure);
  }


  // Arcs in thin and flat pieces, thousands of them: the rule is there, short,
  // positive, and its area is that of the element.
  TEST(ElementRule, ArcSlivers)
  {
    constexpr unsigned int seed = 11;
    RandomElements         random(seed);
    ElementRuleBuilder     builder(4);
    for (unsigned int sample = 0; sample < n_samples(3000); ++sample)
    {
      SCOPED_TRACE("seed " + std::to_string(seed) + " sample " +
                   std::to_string(sample));
      const dealii::Point<2>   c(random.uniform(-1., 1.),
                               random.uniform(-1., 1.));
      const double             R = random.uniform(0.5, 2.);
      const double             a = random.uniform(-3., 3.);
      std::vector<ElementEdge> element;
      double                   area, resolution;
      if (sample % 2)
      {
        // flat segment: sagitta down to 1e-9 of the radius
        const double phi = std::pow(10., random.uniform(-4., -1.));
        element.push_back(arc(c, R, a - phi, a + phi));
        element.push_back(straight(element[0].end, element[0].start));
        // phi - sin(phi) cos(phi) without cancellation
        const long double x = 2. * phi, y = x * x;
        // x - sin(x) cancels
        const long double difference =
          phi < 0.01 ? x * y / 6. * (1. - y / 20. * (1. - y / 42.))
                     : x - std::sin(x);
        area = static_cast<double>(0.5 * R * R * difference);
        // ends rounded by 1e-16: chord length to 1e-16/phi, cubed
        resolution = 1e-14 / phi;
      }
      else
      {
        const double gap = std::pow(10., random.uniform(-8., -1.));
        const double r = R * (1. - gap), b = a + random.uniform(0.1, 3.1);
        element.resize(4);
        element[0] = arc(c, R, a, b);
        element[2] = arc(c, -r, b, a);
        element[1] = straight(element[0].end, element[2].start);
        element[3] = straight(element[2].end, element[0].start);
        area       = 0.5 * (b - a) * (R - r) * (R + r);
        resolution = 1e-14 / gap;
      }
      CellFrame frame = random.frame(3. * R);
      frame.origin += c;
      const auto rule = builder.build(dealii::make_array_view(element), frame);
      EXPECT_FALSE(builder.last_was_fallback());
      EXPECT_LE(rule.size(), 15u);
      double sum = 0.;
      for (const double w : rule.get_weights())
      {
        EXPECT_GT(w, 0.);
        sum += w * std::abs(dealii::determinant(frame.jacobian));
      }
      EXPECT_NEAR(sum / area, 1., resolution);
    }
  }


  // The rule for whole triangles: exact to its degree, positive, inside, and the
  // shortest that deal.II has.
  TEST(TriangleRule, DegreesAndSizes)
  {
    const std::vector<unsigned int> sizes = {
      1, 1, 3, 4, 6, 7, 12, 15, 16, 19, 25, 28, 33, 37, 42};
    for (unsigned int degree = 0; degree <= 14; ++degree)
    {
      const auto rule = make_triangle_rule(degree);
      EXPECT_EQ(rule.size(), sizes[degree]);
      for (unsigned int i = 0; i <= degree; ++i)
      {
        double sum = 0.;
        for (unsigned int k = 0; k < rule.size(); ++k)
        {
          const auto &x = rule.point(k);
          EXPECT_GT(rule.weight(k), 0.);
          EXPECT_GT(std::min({x[0], x[1], 1. - x[0] - x[1]}), 0.);
          sum += rule.weight(k) * std::pow(x[0], static_cast<int>(i)) *
                 std::pow(x[1], static_cast<int>(degree - i));
        }
        EXPECT_NEAR(sum,
                    std::tgamma(i + 1.) * std::tgamma(degree - i + 1.) /
                      std::tgamma(degree + 3.),
                    1e-15)
          << "degree " << degree;
      }
    }
  }
} // namespace
