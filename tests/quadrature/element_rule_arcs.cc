// Rules on elements with circular arcs against closed forms in long double.

#include <nmm/quadrature/element_rule_builder.h>

#include "random_elements.h"
#include "support/n_samples.h"
#include <gtest/gtest.h>

using namespace NMM;
using namespace NMM::Testing;

namespace
{
  constexpr unsigned int seed_of_arcs = 77;

  using Real = long double;

  /// Integral of cos^i sin^j over [a, b], by the usual recurrences.
  Real
  cosine_sine_integral(const int i, const int j, const Real a, const Real b)
  {
    if (i == 0 && j == 0)
      return b - a;
    if (i == 1 && j == 0)
      return std::sin(b) - std::sin(a);
    if (i == 0 && j == 1)
      return std::cos(a) - std::cos(b);
    if (i == 1 && j == 1)
      return 0.5L * (std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a));
    const auto boundary = [&](const int p, const int q) {
      return std::pow(std::cos(b), Real(p)) * std::pow(std::sin(b), Real(q)) -
             std::pow(std::cos(a), Real(p)) * std::pow(std::sin(a), Real(q));
    };
    if (i > 1)
      return (boundary(i - 1, j + 1) +
              (i - 1) * cosine_sine_integral(i - 2, j, a, b)) /
             (i + j);
    return (-boundary(i + 1, j - 1) +
            (j - 1) * cosine_sine_integral(i, j - 2, a, b)) /
           (i + j);
  }


  /// Integral of x^i y^j over the sector of radius r, angles [a, b], about 0.
  Real
  sector_moment(const int  i,
                const int  j,
                const Real r,
                const Real a,
                const Real b)
  {
    return std::pow(r, Real(i + j + 2)) / (i + j + 2) *
           cosine_sine_integral(i, j, a, b);
  }


  /// Integral of x^i y^j over the triangle (0, p, q), p and q at angles a, b on
  /// the circle of radius r: Gauss would do, this is exact.
  Real
  triangle_moment(const int  i,
                  const int  j,
                  const Real r,
                  const Real a,
                  const Real b)
  {
    const Real px = r * std::cos(a), py = r * std::sin(a);
    const Real qx = r * std::cos(b), qy = r * std::sin(b);
    Real       sum = 0;
    for (int k = 0; k <= i; ++k)
      for (int l = 0; l <= j; ++l)
      {
        const auto binomial = [](const int n, const int m) {
          return std::tgamma(Real(n + 1)) /
                 (std::tgamma(Real(m + 1)) * std::tgamma(Real(n - m + 1)));
        };
        sum += binomial(i, k) * binomial(j, l) * std::pow(px, Real(k)) *
               std::pow(qx, Real(i - k)) * std::pow(py, Real(l)) *
               std::pow(qy, Real(j - l)) * std::tgamma(Real(k + l + 1)) *
               std::tgamma(Real(i + j - k - l + 1));
      }
    return (px * qy - py * qx) * sum / std::tgamma(Real(i + j + 3));
  }


  class ElementRuleArcs : public ::testing::TestWithParam<unsigned int>
  {
  protected:
    RandomElements random{seed_of_arcs};
    double         worst = 0.;
    unsigned int   n     = 0;

    /// @p moment(i, j) about @p center; @p radius of a disk around the element;
    /// @p inside(x - center) in long double.
    template <typename Moment, typename Inside>
    void
    check(const std::vector<ElementEdge> &element,
          const dealii::Point<2>         &center,
          const double                    radius,
          const Moment                   &moment,
          const Inside                   &inside)
    {
      const unsigned int degree = GetParam();
      SCOPED_TRACE("seed " + std::to_string(seed_of_arcs) + ", element " +
                   std::to_string(n));
      CellFrame frame = random.frame(3. * radius);
      frame.origin += center;
      ElementRuleBuilder          builder(degree);
      const dealii::Quadrature<2> rule =
        builder.build(dealii::make_array_view(element), frame);
      ++n;
      EXPECT_FALSE(builder.last_was_fallback());
      EXPECT_GT(rule.size(), 0u);
      EXPECT_LE(rule.size(), (degree + 1) * (degree + 2) / 2);

      const auto &J = frame.jacobian;
      const Real  det =
        std::abs(Real(J[0][0]) * Real(J[1][1]) - Real(J[0][1]) * Real(J[1][0]));
      std::vector<std::array<Real, 2>> x;
      for (unsigned int k = 0; k < rule.size(); ++k)
      {
        EXPECT_GT(rule.weight(k), 0.);
        std::array<Real, 2> p;
        for (unsigned int d = 0; d < 2; ++d)
          p[d] = Real(frame.origin[d]) - Real(center[d]) +
                 Real(J[d][0]) * Real(rule.point(k)[0]) +
                 Real(J[d][1]) * Real(rule.point(k)[1]);
        EXPECT_TRUE(inside(p[0], p[1])) << p[0] << ' ' << p[1];
        x.push_back(p);
      }
      for (unsigned int i = 0; i <= degree; ++i)
        for (unsigned int j = 0; i + j <= degree; ++j)
        {
          Real sum = 0;
          for (unsigned int k = 0; k < rule.size(); ++k)
            sum += det * Real(rule.weight(k)) * std::pow(x[k][0], Real(i)) *
                   std::pow(x[k][1], Real(j));
          const Real box =
            4 * std::pow(Real(radius), Real(i + j + 2)) / ((i + 1) * (j + 1));
          const double error =
            std::abs(static_cast<double>((sum - moment(i, j)) / box));
          // The edges' ends are rounded (1e-16 of the size) before the rule
          // sees them: the moments are not known better than 1e-15.
          EXPECT_LE(error, 1e-14) << "x^" << i << " y^" << j;
          worst = std::max(worst, error);
        }
    }

    void
    TearDown() override
    {
      std::cout << "    " << n << " elements, worst error " << worst
                << std::endl;
    }

    dealii::Point<2>
    random_center()
    {
      return {random.uniform(-1., 1.), random.uniform(-1., 1.)};
    }
  };


  TEST_P(ElementRuleArcs, Segments)
  {
    for (unsigned int sample = 0; sample < n_samples(200); ++sample)
    {
      const auto               c   = random_center();
      const double             R   = random.uniform(0.5, 2.);
      const double             phi = random.uniform(0.05, M_PI / 2);
      const double             a = random.uniform(-3., 3.), b = a + 2. * phi;
      std::vector<ElementEdge> element{arc(c, R, a, b)};
      element.push_back(straight(element[0].end, element[0].start));
      check(
        element,
        c,
        R,
        [&](const int i, const int j) {
          return sector_moment(i, j, R, a, b) - triangle_moment(i, j, R, a, b);
        },
        [&](const Real x, const Real y) {
          const Real m = a + phi;
          return x * x + y * y < Real(R) * R * (1 + 1e-15L) &&
                 x * std::cos(m) + y * std::sin(m) >
                   R * std::cos(Real(phi)) * (1 - 1e-15L) - 1e-16L;
        });
    }
  }


  TEST_P(ElementRuleArcs, Sectors)
  {
    for (unsigned int sample = 0; sample < n_samples(200); ++sample)
    {
      const auto               c = random_center();
      const double             R = random.uniform(0.5, 2.);
      const double             a = random.uniform(-3., 3.);
      const double             b = a + random.uniform(0.1, 3.1);
      std::vector<ElementEdge> element{arc(c, R, a, b)};
      element.push_back(straight(element[0].end, c));
      element.push_back(straight(c, element[0].start));
      check(
        element,
        c,
        R,
        [&](const int i, const int j) { return sector_moment(i, j, R, a, b); },
        [&](const Real x, const Real y) {
          return x * x + y * y < Real(R) * R &&
                 std::cos(Real(a)) * y - std::sin(Real(a)) * x > 0 &&
                 std::cos(Real(b)) * y - std::sin(Real(b)) * x < 0;
        });
    }
  }


  // The inner arc is concave to the element.
  TEST_P(ElementRuleArcs, AnnularPieces)
  {
    for (unsigned int sample = 0; sample < n_samples(200); ++sample)
    {
      const auto               c = random_center();
      const double             R = random.uniform(0.5, 2.);
      const double             r = R * (sample % 2 ? random.uniform(0.3, 0.9)
                                                   : 1. - random.uniform(0.01, 0.1));
      const double             a = random.uniform(-3., 3.);
      const double             b = a + random.uniform(0.1, 3.1);
      std::vector<ElementEdge> element(4);
      element[0] = arc(c, R, a, b);
      element[2] = arc(c, -r, b, a);
      element[1] = straight(element[0].end, element[2].start);
      element[3] = straight(element[2].end, element[0].start);
      check(
        element,
        c,
        R,
        [&](const int i, const int j) {
          return sector_moment(i, j, R, a, b) - sector_moment(i, j, r, a, b);
        },
        [&](const Real x, const Real y) {
          return x * x + y * y < Real(R) * R && x * x + y * y > Real(r) * r;
        });
    }
  }


  // Whole disks and annuli: arcs of a half circle and vertical tangents.
  TEST_P(ElementRuleArcs, DisksAndAnnuli)
  {
    for (unsigned int sample = 0; sample < n_samples(100); ++sample)
    {
      const auto   c      = random_center();
      const double R      = random.uniform(0.5, 2.);
      const double r      = sample % 2 ? 0. : R * random.uniform(0.1, 0.9);
      const double a      = random.uniform(-3., 3.);
      const auto   circle = [&](const double radius, const unsigned int m) {
        std::vector<ElementEdge> edges;
        const double             step = (radius > 0. ? 2. : -2.) * M_PI / m;
        for (unsigned int i = 0; i < m; ++i)
          edges.push_back(arc(c, radius, a + i * step, a + (i + 1) * step));
        for (unsigned int i = 0; i < m; ++i)
          edges[i].end = edges[(i + 1) % m].start;
        return edges;
      };
      std::vector<ElementEdge> element = circle(R, 2 + sample % 3);
      if (r > 0.)
        for (const ElementEdge &edge : circle(-r, 2 + sample % 3))
          element.push_back(edge);
      check(
        element,
        c,
        R,
        [&](const int i, const int j) {
          return sector_moment(i, j, R, 0., 2 * std::acos(Real(-1))) -
                 sector_moment(i, j, r, 0., 2 * std::acos(Real(-1)));
        },
        [&](const Real x, const Real y) {
          return x * x + y * y < Real(R) * R && x * x + y * y >= Real(r) * r;
        });
    }
  }


  INSTANTIATE_TEST_SUITE_P(Degrees,
                           ElementRuleArcs,
                           ::testing::Values(1, 2, 3, 4, 6, 8));
} // namespace
