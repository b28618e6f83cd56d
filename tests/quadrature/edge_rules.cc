// Rules on boundary pieces: lengths, normals, and the divergence theorem that
// ties them to the rules of elements.

#include <nmm/quadrature/element_quadrature.h>
#include <nmm/quadrature/element_rule_builder.h>

#include "random_elements.h"
#include "support/n_samples.h"
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Testing;

namespace
{
  constexpr unsigned int seed_of_edges = 5;

  /// Polygon with a disk-shaped hole and one side bulged by an arc.
  std::vector<ElementEdge>
  curved_element(RandomElements &random, const dealii::Point<2> &center)
  {
    std::vector<ElementEdge> edges;
    const double             a = random.uniform(0., 6.), b = a + 2. * M_PI / 3.;
    edges.push_back(arc(center, 1., a, b));
    const dealii::Point<2> corner(center[0] - std::cos(a + M_PI / 3.),
                                  center[1] - std::sin(a + M_PI / 3.));
    edges.push_back(straight(edges[0].end, corner));
    edges.push_back(straight(corner, edges[0].start));
    const double r = random.uniform(0.05, 0.4);
    edges.push_back(arc(center, -r, a, a - M_PI));
    edges.push_back(arc(center, -r, a - M_PI, a - 2. * M_PI));
    edges[4].start = edges[3].end;
    edges[4].end   = edges[3].start;
    return edges;
  }


  dealii::Point<2>
  to_real(const CellFrame &frame, const dealii::Point<2> &xi)
  {
    return frame.origin + frame.jacobian * xi;
  }


  TEST(EdgeRules, LengthsAndOutwardNormals)
  {
    CellFrame frame;
    frame.origin         = {1., 2.};
    frame.jacobian[0][0] = 2.;
    frame.jacobian[0][1] = 0.5;
    frame.jacobian[1][1] = 3.;

    const EdgeRule line =
      make_edge_rule(straight({1., 2.}, {4., 6.}), frame, 4);
    ASSERT_EQ(line.points.size(), 3u);
    double length = 0.;
    for (unsigned int q = 0; q < 3; ++q)
    {
      length += line.weights[q];
      // the element is on the left of the direction (3, 4) / 5
      EXPECT_NEAR(line.normals[q][0], 0.8, 1e-15);
      EXPECT_NEAR(line.normals[q][1], -0.6, 1e-15);
    }
    EXPECT_NEAR(length, 5., 1e-14);

    const dealii::Point<2> c(1.5, 2.5);
    for (const double radius : {0.7, -0.7})
    {
      const double   from = 0.3, to = radius > 0. ? from + 2. : from - 2.;
      const EdgeRule rule = make_edge_rule(arc(c, radius, from, to), frame, 4);
      length              = 0.;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        length += rule.weights[q];
        const auto radial = to_real(frame, rule.points[q]) - c;
        EXPECT_NEAR(radial.norm(), 0.7, 1e-15 * 8);
        // radial for a counter-clockwise arc, towards the centre else
        EXPECT_NEAR(rule.normals[q] * radial, radius, 1e-15 * 8);
      }
      EXPECT_NEAR(length, 1.4, 1e-14);
    }
  }


  TEST(EdgeRules, ZeroLengthHasNoPoints)
  {
    CellFrame frame;
    frame.jacobian = dealii::unit_symmetric_tensor<2>();
    EXPECT_TRUE(
      make_edge_rule(straight({1., 2.}, {1., 2.}), frame, 2).points.empty());
  }


  TEST(EdgeRules, DivergenceTheorem)
  {
    RandomElements random(seed_of_edges);
    for (unsigned int sample = 0; sample < n_samples(200); ++sample)
    {
      SCOPED_TRACE("seed " + std::to_string(seed_of_edges) + " sample " +
                   std::to_string(sample));
      std::vector<ElementEdge> element;
      const dealii::Point<2>   center(random.uniform(-1., 1.),
                                    random.uniform(-1., 1.));
      CellFrame                frame = random.frame(4.);
      frame.origin += center;
      if (sample % 2)
        element = curved_element(random, center);
      else
      {
        element = random.element(
          static_cast<RandomElements::Shape>(random.integer(0, 5)));
        transform(element, 1., 1., 1., center);
      }
      const auto rule =
        make_element_rule(dealii::make_array_view(element), frame, 4);
      const double det = std::abs(dealii::determinant(frame.jacobian));

      // about the centre, coordinates are of size one
      for (unsigned int i = 0; i <= 5; ++i)
        for (unsigned int j = 0; i + j <= 5; ++j)
        {
          const auto monomial = [](const double x, const unsigned int n) {
            return std::pow(x, static_cast<int>(n));
          };
          dealii::Tensor<1, 2> boundary, interior;
          for (const ElementEdge &edge : element)
          {
            const EdgeRule er = make_edge_rule(edge, frame, 5);
            for (unsigned int q = 0; q < er.points.size(); ++q)
            {
              const auto x = to_real(frame, er.points[q]) - center;
              boundary += er.weights[q] * monomial(x[0], i) *
                          monomial(x[1], j) * er.normals[q];
            }
          }
          for (unsigned int k = 0; k < rule.size(); ++k)
          {
            const auto   x = to_real(frame, rule.point(k)) - center;
            const double w = det * rule.weight(k);
            if (i > 0)
              interior[0] += w * i * monomial(x[0], i - 1) * monomial(x[1], j);
            if (j > 0)
              interior[1] += w * j * monomial(x[0], i) * monomial(x[1], j - 1);
          }
          // sums of a few hundred terms of size one
          EXPECT_NEAR(boundary[0], interior[0], 2e-14) << i << ' ' << j;
          EXPECT_NEAR(boundary[1], interior[1], 2e-14) << i << ' ' << j;
        }
    }
  }


  // deal.II's documented map of an immersed surface to real space.
  TEST(EdgeRules, SurfaceRuleMapsToTheEdgeRule)
  {
    RandomElements random(seed_of_edges);
    for (unsigned int sample = 0; sample < n_samples(100); ++sample)
    {
      SCOPED_TRACE("seed " + std::to_string(seed_of_edges) + " sample " +
                   std::to_string(sample));
      CellFrame frame = random.frame(3.);
      // a clockwise cell too
      if (sample % 5 == 0)
        for (unsigned int d = 0; d < 2; ++d)
          std::swap(frame.jacobian[d][0], frame.jacobian[d][1]);
      for (const ElementEdge &edge : curved_element(random, {0.1, -0.2}))
      {
        const EdgeRule real    = make_edge_rule(edge, frame, 4);
        const auto     surface = make_surface_rule(edge, frame, 4);
        ASSERT_EQ(real.points.size(), surface.size());
        const auto   map = dealii::transpose(dealii::invert(frame.jacobian));
        const double det = std::abs(dealii::determinant(frame.jacobian));
        for (unsigned int q = 0; q < surface.size(); ++q)
        {
          EXPECT_NEAR(surface.normal_vector(q).norm(), 1., 1e-15 * 4);
          const auto normal = det * (map * surface.normal_vector(q));
          EXPECT_NEAR(normal.norm() * surface.weight(q),
                      real.weights[q],
                      1e-14);
          EXPECT_NEAR((normal / normal.norm() - real.normals[q]).norm(),
                      0.,
                      1e-14);
          EXPECT_EQ(surface.point(q), real.points[q]);
        }
      }
    }
  }
} // namespace
