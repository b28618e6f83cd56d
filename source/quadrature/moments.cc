#include "moments.h"

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    LegendreBasis::LegendreBasis(const unsigned int degree)
      : m(degree)
      , p1(degree + 2)
      , p2(degree + 2)
      , antiderivative(degree + 1)
    {
      for (unsigned int k = 0; k <= degree; ++k)
      {
        recurrence_a.push_back((2. * k + 1.) / (k + 1.));
        recurrence_b.push_back(k / (k + 1.));
      }
    }


    void
    LegendreBasis::evaluate(const std::vector<double> &s1,
                            const std::vector<double> &s2,
                            std::vector<double>       &values)
    {
      const std::size_t n = s1.size();
      values.resize(size() * n);
      p1.resize(std::max<std::size_t>((m + 1) * n, m + 2));
      p2.resize(std::max<std::size_t>((m + 1) * n, m + 2));
      const auto legendre = [&](const std::vector<double> &s,
                                std::vector<double>       &p) {
        for (std::size_t k = 0; k < n; ++k)
          p[k] = 1.;
        if (m > 0)
          for (std::size_t k = 0; k < n; ++k)
            p[n + k] = s[k];
        for (unsigned int i = 1; i < m; ++i)
        {
          const double  a      = recurrence_a[i];
          const double  b      = recurrence_b[i];
          const double *before = p.data() + (i - 1) * n;
          const double *here   = p.data() + i * n;
          double       *next   = p.data() + (i + 1) * n;
          for (std::size_t k = 0; k < n; ++k)
            next[k] = a * s[k] * here[k] - b * before[k];
        }
      };
      legendre(s1, p1);
      legendre(s2, p2);
      double *row = values.data();
      for (unsigned int total = 0; total <= m; ++total)
        for (unsigned int j = 0; j <= total; ++j, row += n)
        {
          const double *a = p1.data() + (total - j) * n;
          const double *b = p2.data() + j * n;
          for (std::size_t k = 0; k < n; ++k)
            row[k] = a[k] * b[k];
        }
    }


    void
    LegendreBasis::add_boundary_point(const double         s1,
                                      const double         s2,
                                      const double         ds2,
                                      std::vector<double> &result)
    {
      p1[0] = 1.;
      p1[1] = s1;
      p2[0] = ds2;
      p2[1] = s2 * ds2;
      for (unsigned int k = 1; k <= m; ++k)
      {
        p1[k + 1] = recurrence_a[k] * s1 * p1[k] - recurrence_b[k] * p1[k - 1];
        p2[k + 1] = recurrence_a[k] * s2 * p2[k] - recurrence_b[k] * p2[k - 1];
      }
      antiderivative[0] = s1;
      for (unsigned int i = 1; i <= m; ++i)
        antiderivative[i] = (p1[i + 1] - p1[i - 1]) / (2. * i + 1.);
      double *moment = result.data();
      for (unsigned int total = 0; total <= m; ++total)
        for (unsigned int j = 0; j <= total; ++j)
          *moment++ += antiderivative[total - j] * p2[j];
    }


    double
    LegendreBasis::moments(const std::vector<FrameEdge> &edges,
                           GaussTable                   &gauss,
                           std::vector<double>          &result)
    {
      result.assign(size(), 0.);
      p1.resize(std::max<std::size_t>(p1.size(), m + 2));
      p2.resize(std::max<std::size_t>(p2.size(), m + 2));
      double scale = 0.;
      for (const FrameEdge &edge : edges)
        if (!edge.is_arc)
        {
          const double d1 = 0.5 * (edge.end[0] - edge.start[0]);
          const double d2 = 0.5 * (edge.end[1] - edge.start[1]);
          if (d2 == 0.)
            continue;
          const GaussTable::Rule &rule = gauss.rule((m + 3) / 2);
          for (std::size_t q = 0; q < rule.points.size(); ++q)
          {
            const double t   = 2. * rule.points[q] - 1.;
            const double s1  = edge.middle[0] + t * d1;
            const double ds2 = 2. * rule.weights[q] * d2;
            add_boundary_point(s1, edge.middle[1] + t * d2, ds2, result);
            scale += std::abs(s1 * ds2);
          }
        }
        else
        {
          const double            phi  = edge.half_angle;
          const GaussTable::Rule &rule = gauss.rule(n_arc_points(m + 2, phi));
          for (std::size_t q = 0; q < rule.points.size(); ++q)
          {
            const double tau  = phi * (2. * rule.points[q] - 1.);
            const double t    = std::tan(0.5 * tau);
            const double norm = 1. / (1. + t * t);
            const double s1   = edge.arc_coordinate(0, t);
            const double ds2  = 2. * phi * rule.weights[q] *
                               (edge.sine_axis[1] * ((1. - t * t) * norm) -
                                edge.cosine_axis[1] * (2. * t * norm));
            add_boundary_point(s1, edge.arc_coordinate(1, t), ds2, result);
            scale += std::abs(s1 * ds2);
          }
        }
      return scale;
    }


    // The numbers were found by comparison with many more points, for products of Legendre
    // polynomials over arcs that fill the frame. On flat arcs these behave like polynomials of
    // degree 2 k in the angle, which n > k points integrate exactly; the terms that
    // remain grow with phi.
    unsigned int
    n_arc_points(const unsigned int degree, const double half_angle)
    {
      return degree + 4 + static_cast<unsigned int>(5. * half_angle);
    }
  } // namespace internal
} // namespace NMM
