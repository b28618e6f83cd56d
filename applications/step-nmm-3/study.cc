#include "study.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "disk_compression_data.h"
#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace StepNMM3
{
  using namespace dealii;

  // @sect3{Parameters}

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


  Parameters
  read_parameters(const std::string &file_name)
  {
    Parameters             parameters;
    ParameterHandler       prm;
    const Patterns::Double positive(1e-300);
    const Patterns::List   sizes(positive, 1);
    prm.add_parameter("Half-widths",
                      parameters.half_widths,
                      "Of Hertz's contact over the radius [-].",
                      Patterns::List(Patterns::Double(1e-3, 0.2), 1));
    prm.add_parameter("Contact ratios",
                      parameters.contact_ratios,
                      "Edge lengths of triangles at the contact over the "
                      "half-width [-].",
                      sizes);
    prm.add_parameter("Cell size",
                      parameters.cell_size,
                      "Edge length far from the contact [m].",
                      positive);
    prm.add_parameter("Growth",
                      parameters.growth,
                      "Of the edge length per distance from the contact "
                      "[-].",
                      Patterns::Double(1e-3, 1.));
    Tutorial::add_placements(prm,
                             parameters.offset,
                             parameters.rotation,
                             parameters.n_placements,
                             parameters.seed);
    prm.add_parameter("Repetitions",
                      parameters.n_repetitions,
                      "Of timed runs, of which the fastest counts.",
                      Patterns::Integer(1));
    prm.add_parameter("Compression sizes",
                      parameters.compression_sizes,
                      "Edge lengths at the contact, quarter disk [m].",
                      sizes);
    prm.add_parameter("Load steps",
                      parameters.n_load_steps,
                      "Equal steps up to an approach of 0.4 m.",
                      Patterns::Integer(1, 1000));
    prm.add_parameter("Press size",
                      parameters.press_size,
                      "Edge length at the contacts of the whole cylinder "
                      "[m].",
                      positive);
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-3.prm");
    return parameters;
  }


  // @sect3{Hertz}

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


  void
  compare(const Hertz &hertz, const double force, Measurement &measurement)
  {
    double square = 0., norm = 0., peak = 0., last = 0.;
    for (const PressurePoint &point : measurement.pressure)
    {
      const double exact = hertz.pressure(point.x);
      square += point.weight * std::pow(point.pressure - exact, 2);
      norm += point.weight * exact * exact;
      peak = std::max(peak, point.pressure);
      if (point.pressure > 0.)
        last = std::max(last, point.x);
      // near the edge of the contact any error is large beside p
      if (point.x < 0.9 * hertz.half_width)
        measurement.ripple =
          std::max(measurement.ripple, std::abs(point.pressure / exact - 1.));
    }
    const double b               = hertz.half_width;
    measurement.force_error      = force / hertz.force - 1.;
    measurement.peak_error       = peak / hertz.peak - 1.;
    measurement.last_point_error = last / b - 1.;
    measurement.pressure_error   = std::sqrt(square / norm);
    measurement.half_width_error =
      fit_half_width(measurement.pressure, b) / b - 1.;
  }


  // @sect3{Reference values}

  std::map<double, double>
  read_reference()
  {
    std::map<double, double> result;
    std::istringstream       in(disk_compression_csv);
    for (std::string line; std::getline(in, line);)
    {
      const std::vector<std::string> cells =
        Utilities::split_string_list(line, ',');
      if (cells.empty() || cells[0] != "neo_hookean")
        continue;
      AssertThrow(
        cells.size() == 3,
        NMM::InputError("a row of the reference values has not three cells",
                        line,
                        "restore disk_compression.csv and build again"));
      result[Utilities::string_to_double(cells[1])] =
        Utilities::string_to_double(cells[2]);
    }
    return result;
  }


  void
  compare_forces(const Parameters &parameters, Measurement &measurement)
  {
    const std::map<double, double> reference = read_reference();
    const double unit = parameters.youngs_modulus * parameters.radius;
    for (const auto &[approach, force] : measurement.forces)
      for (const auto &[reference_approach, value] : reference)
        if (std::abs(approach / parameters.radius - reference_approach) < 1e-9)
        {
          const double error = std::abs(force / (value * unit) - 1.);
          double      &worst = reference_approach < 0.2 - 1e-9
                                 ? measurement.early_error
                                 : measurement.converged_error;
          worst              = std::max(worst, error);
        }
  }


  // @sect3{Tables}

  Tutorial::Row
  hertz_row(const Measurement &m)
  {
    return {{"springs", name(m.enforcement)},
            {"half_width_m", m.half_width},
            {"size_over_b", m.contact_size / m.half_width},
            {"unknowns", m.n_unknowns},
            {"iterations", m.n_iterations},
            {"augmentations", m.n_augmentations},
            {"force_%", 100. * m.force_error},
            {"peak_%", 100. * m.peak_error},
            {"width_%", 100. * m.half_width_error},
            {"last_%", 100. * m.last_point_error},
            {"L2_p_%", 100. * m.pressure_error},
            {"ripple_%", 100. * m.ripple},
            {"cutting_s", m.cutting_time},
            {"covers_s", m.setup_time},
            {"solution_s", m.solution_time},
            {"total_s", m.total_time}};
  }


  Tutorial::Row
  compression_row(const Measurement &m)
  {
    return {{"springs", name(m.enforcement)},
            {"contact_size_m", m.contact_size},
            {"unknowns", m.n_unknowns},
            {"steps", m.n_steps},
            {"cuts", m.n_cuts},
            {"iterations", m.n_iterations},
            {"penetration_m", m.penetration},
            {"total_s", m.total_time},
            {"error_from_0.2", m.converged_error},
            {"error_below_0.2", m.early_error}};
  }


  void
  print_press(const Parameters &parameters, const PressResult &press)
  {
    Tutorial::Table table("The paper's press, " +
                          name(press.measurement.enforcement));
    table.add(compression_row(press.measurement));
    Tutorial::Table stages("Its stages, beside Hertz at the same force");
    for (const Stage &stage : press.stages)
    {
      const Hertz hertz = Hertz::from_force(parameters, stage.force);
      double      peak = 0., half_width = 0.;
      for (const PressurePoint &point : stage.pressure)
      {
        peak       = std::max(peak, point.pressure);
        half_width = std::max(half_width, std::abs(point.x));
      }
      stages.add({{"approach_m", stage.approach},
                  {"time_s", stage.approach / parameters.speed},
                  {"force_N/m", stage.force},
                  {"difference_%", 100. * stage.force_difference / stage.force},
                  {"peak_Pa", peak},
                  {"Hertz_Pa", hertz.peak},
                  {"half_width_m", half_width},
                  {"Hertz_m", hertz.half_width}});
    }
  }


  // @sect3{Files}

  namespace
  {
    Tutorial::Table
    lines_table(const std::vector<std::vector<Point<2>>> &lines)
    {
      Tutorial::Table table;
      for (const auto &line : lines)
      {
        for (const Point<2> &x : line)
          table.add({{"x_m", x[0]}, {"y_m", x[1]}});
        table.add_break();
      }
      return table;
    }


    /// A quarter of the stages: those of the paper's figures.
    bool
    is_drawn(const Parameters &parameters, const Stage &stage)
    {
      const double part = 4. * stage.approach / parameters.approach;
      return std::abs(part - std::round(part)) < 1e-6;
    }


    void
    write_press(const Parameters  &parameters,
                const PressResult &press,
                const std::string &prefix)
    {
      Tutorial::Table pressure, curves;
      unsigned int    number = 0;
      for (const Stage &stage : press.stages)
      {
        if (!is_drawn(parameters, stage))
          continue;
        const Hertz hertz  = Hertz::from_force(parameters, stage.force);
        auto        points = stage.pressure;
        std::sort(points.begin(),
                  points.end(),
                  [](const PressurePoint &a, const PressurePoint &b) {
                    return a.x < b.x;
                  });
        for (const PressurePoint &point : points)
          pressure.add({{"x_m", point.x}, {"pressure_Pa", point.pressure}});
        pressure.add_break(2);
        constexpr unsigned int n = 100;
        for (unsigned int i = 0; i <= 2 * n; ++i)
        {
          // closer at the ends, where the curve is steep
          const double x =
            -hertz.half_width * std::cos(numbers::PI * i / (2. * n));
          curves.add({{"x_m", x}, {"hertz_Pa", hertz.pressure(x)}});
        }
        curves.add_break(2);
        const std::string stage_prefix =
          prefix + "stage-" + std::to_string(++number);
        lines_table(stage.outlines).write(stage_prefix + "-outlines.csv");
        lines_table(stage.material_lines).write(stage_prefix + "-lines.csv");
      }
      pressure.write(prefix + "stages.csv");
      curves.write(prefix + "stages-hertz.csv");
    }


    /// The columns of tables of forces.
    Tutorial::Row
    force_row(const double approach_over_R, const double F_over_ER)
    {
      return {{"approach_over_R", approach_over_R}, {"F_over_ER", F_over_ER}};
    }


    void
    write_forces(const Parameters               &parameters,
                 const std::vector<Measurement> &compression,
                 const std::vector<PressResult> &press,
                 const std::string              &prefix)
    {
      const double R = parameters.radius, unit = parameters.youngs_modulus * R;
      Tutorial::Table forces, whole, reference, hertz;
      for (const Measurement &m : compression)
        if (m.enforcement == Enforcement::augmented)
        {
          for (const auto &[approach, force] : m.forces)
            forces.add(force_row(approach / R, force / unit));
          forces.add_break();
        }
      for (const auto &[approach, force] : press.back().measurement.forces)
        whole.add(force_row(approach / R, force / unit));
      for (const auto &[approach, force] : read_reference())
        reference.add(force_row(approach, force));
      // Hertz's force by approach, beside what large strain makes of it
      for (unsigned int i = 1; i <= 40; ++i)
      {
        const Hertz h = Hertz::from_half_width(parameters, 0.01 * i);
        if (h.approach <= parameters.approach)
          hertz.add(force_row(h.approach / R, h.force / unit));
      }
      forces.write(prefix + "forces.csv");
      whole.write(prefix + "press-forces.csv");
      reference.write(prefix + "reference.csv");
      hertz.write(prefix + "hertz-forces.csv");
    }
  } // namespace


  void
  write_results(const Parameters               &parameters,
                const std::vector<Measurement> &hertz,
                const std::vector<Measurement> &compression,
                const std::vector<PressResult> &press,
                const std::string              &prefix)
  {
    Tutorial::Table pressure;
    for (const Measurement &m : hertz)
    {
      const Hertz exact = Hertz::from_half_width(parameters, m.half_width);
      for (const PressurePoint &point : m.pressure)
        if (point.x < 1.3 * m.half_width)
          pressure.add(
            {{"x_over_b", point.x / m.half_width},
             {"p_over_p0", point.pressure / exact.peak},
             {"springs", name(m.enforcement)},
             {"half_width_m", m.half_width},
             {"size_over_b", m.contact_size / m.half_width},
             {"error_over_p0",
              (point.pressure - exact.pressure(point.x)) / exact.peak}});
    }
    pressure.write(prefix + "pressure.csv");
    write_forces(parameters, compression, press, prefix);
    for (const PressResult &result : press)
      write_press(parameters,
                  result,
                  prefix + name(result.measurement.enforcement) + "-");
  }
} // namespace StepNMM3
