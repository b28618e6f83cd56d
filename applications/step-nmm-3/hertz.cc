#include "hertz.h"

#include <deal.II/base/numbers.h>

#include "disk_compression_csv.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace StepNMM3
{
  using namespace dealii;

  std::string
  name(const Enforcement enforcement)
  {
    return enforcement == Enforcement::penalty ? "penalty" : "augmented";
  }


  double
  Parameters::plane_strain_modulus() const
  {
    return youngs_modulus / (1. - poissons_ratio * poissons_ratio);
  }


  Hertz
  Hertz::from_half_width(const Parameters &parameters, const double half_width)
  {
    const double E = parameters.plane_strain_modulus();
    const double R = parameters.radius;
    Hertz        result;
    result.half_width = half_width;
    result.force      = numbers::PI * half_width * half_width * E / (4. * R);
    result.peak       = 0.5 * E * half_width / R;
    result.approach   = 2. * result.force / (numbers::PI * E) *
                      (2. * std::log(4. * R / half_width) - 1.);
    return result;
  }


  Hertz
  Hertz::from_force(const Parameters &parameters, const double force)
  {
    return from_half_width(parameters,
                           2. * std::sqrt(force * parameters.radius /
                                          (numbers::PI *
                                           parameters.plane_strain_modulus())));
  }


  double
  Hertz::pressure(const double x) const
  {
    const double part = x / half_width;
    return std::abs(part) < 1. ? peak * std::sqrt(1. - part * part) : 0.;
  }


  namespace
  {
    /// Hertz's p^2 is linear in x^2: where the line fitted to the outer
    /// part of the contact vanishes.
    double
    fit_half_width(const std::vector<PressurePoint> &points, const double guess)
    {
      double sums[5] = {};
      for (const PressurePoint &point : points)
        if (point.x > 0.6 * guess && point.x < 0.95 * guess)
        {
          const double X = point.x * point.x;
          const double Y = point.pressure * point.pressure;
          sums[0] += point.weight;
          sums[1] += point.weight * X;
          sums[2] += point.weight * X * X;
          sums[3] += point.weight * Y;
          sums[4] += point.weight * X * Y;
        }
      const double at_0  = sums[3] * sums[2] - sums[4] * sums[1];
      const double slope = sums[0] * sums[4] - sums[1] * sums[3];
      return std::sqrt(-at_0 / slope);
    }
  } // namespace


  Tutorial::Row
  compare(const Hertz                      &hertz,
          const double                      force,
          const std::vector<PressurePoint> &points)
  {
    const double b      = hertz.half_width;
    double       square = 0., norm = 0., peak = 0., last = 0., ripple = 0.;
    for (const PressurePoint &point : points)
    {
      const double exact = hertz.pressure(point.x);
      square += point.weight * std::pow(point.pressure - exact, 2);
      norm += point.weight * exact * exact;
      peak = std::max(peak, point.pressure);
      if (point.pressure > 0.)
        last = std::max(last, point.x);
      // near the edge of the contact any error is large beside p
      if (point.x < 0.9 * b)
        ripple = std::max(ripple, std::abs(point.pressure / exact - 1.));
    }
    return {{"force_%", 100. * (force / hertz.force - 1.)},
            {"peak_%", 100. * (peak / hertz.peak - 1.)},
            {"width_%", 100. * (fit_half_width(points, b) / b - 1.)},
            {"last_%", 100. * (last / b - 1.)},
            {"L2_p_%", 100. * std::sqrt(square / norm)},
            {"ripple_%", 100. * ripple}};
  }


  void
  add_stage(std::vector<PressurePoint> points,
            const Hertz               &hertz,
            Tutorial::Table           &pressure,
            Tutorial::Table           &hertz_pressure)
  {
    std::sort(points.begin(),
              points.end(),
              [](const PressurePoint &a, const PressurePoint &b) {
                return a.x < b.x;
              });
    for (const PressurePoint &point : points)
      pressure.add({{"x_m", point.x}, {"pressure_Pa", point.pressure}});
    pressure.add_break(2);
    constexpr unsigned int n = 200;
    for (unsigned int i = 0; i <= n; ++i)
    {
      // closer at the ends, where the curve is steep
      const double x = -hertz.half_width * std::cos(numbers::PI * i / n);
      hertz_pressure.add({{"x_m", x}, {"hertz_Pa", hertz.pressure(x)}});
    }
    hertz_pressure.add_break(2);
  }


  Tutorial::Row
  stage_row(const double                      approach,
            const std::array<double, 2>      &forces,
            const Hertz                      &hertz,
            const std::vector<PressurePoint> &points)
  {
    double peak = 0., half_width = 0.;
    for (const PressurePoint &point : points)
    {
      peak       = std::max(peak, point.pressure);
      half_width = std::max(half_width, std::abs(point.x));
    }
    return {{"approach_m", approach},
            {"force_N/m", hertz.force},
            {"difference_%",
             100. * std::abs(forces[0] - forces[1]) / hertz.force},
            {"peak_Pa", peak},
            {"Hertz_Pa", hertz.peak},
            {"half_width_m", half_width},
            {"Hertz_m", hertz.half_width}};
  }


  Tutorial::Row
  compare_forces(const Parameters               &parameters,
                 const std::map<double, double> &forces)
  {
    const double       unit = parameters.youngs_modulus * parameters.radius;
    double             converged_error = 0., early_error = 0.;
    std::istringstream csv(disk_compression_csv);
    for (const Tutorial::Record &record : Tutorial::read_csv(csv))
      for (const auto &[approach, force] : forces)
      {
        const double at = std::stod(record.at("approach_over_R"));
        if (record.at("law") != "neo_hookean" ||
            std::abs(approach / parameters.radius - at) >= 1e-9)
          continue;
        const double error =
          std::abs(force / (std::stod(record.at("F_over_ER")) * unit) - 1.);
        double &worst = at < 0.2 - 1e-9 ? early_error : converged_error;
        worst         = std::max(worst, error);
      }
    return {{"error_from_0.2", converged_error},
            {"error_below_0.2", early_error}};
  }
} // namespace StepNMM3
