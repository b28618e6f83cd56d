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
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
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
  read_parameters(const std::string &file_name,
                  const std::string &output_directory)
  {
    Parameters parameters;
    parameters.output_directory = output_directory;

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

  namespace
  {
    std::string
    percent(const double value)
    {
      std::ostringstream out;
      out << std::fixed << std::setprecision(2) << 100. * value;
      return out.str();
    }
  } // namespace


  void
  print_hertz_header(const Hertz &hertz)
  {
    std::cout << "\nHertz, half-width " << hertz.half_width
              << " m: errors in percent, times in seconds\n"
              << "springs    size/b  unknowns  iterations (augm.)   force   "
                 "peak  width  last  L2(p)  ripple  cutting  covers  solution  "
                 "total\n";
  }


  void
  print_hertz(const Measurement &m)
  {
    std::cout << std::left << std::setw(11) << name(m.enforcement) << std::right
              << std::setprecision(3) << std::setw(6)
              << m.contact_size / m.half_width << std::setw(10) << m.n_unknowns
              << std::setw(12) << m.n_iterations << std::setw(4) << "("
              << m.n_augmentations << ")  ";
    for (const double error : {m.force_error,
                               m.peak_error,
                               m.half_width_error,
                               m.last_point_error,
                               m.pressure_error,
                               m.ripple})
      std::cout << std::setw(7) << percent(error);
    std::cout << std::fixed << std::setprecision(3);
    for (const double time :
         {m.cutting_time, m.setup_time, m.solution_time, m.total_time})
      std::cout << std::setw(8) << time;
    std::cout << std::defaultfloat << std::endl;
  }


  void
  print_placements(const std::vector<Measurement> &measurements)
  {
    if (measurements.empty())
      return;
    std::map<double, std::vector<const Measurement *>> by_size;
    for (const Measurement &m : measurements)
      by_size[-m.contact_size].push_back(&m);
    std::cout << "\nMesh moved and turned at random, augmented, half-width "
              << measurements[0].half_width << " m: from ... to, in percent\n"
              << "size/b  unknowns        force            peak             "
                 "width          L2(p)          ripple  iterations\n";
    for (const auto &[size, rows] : by_size)
    {
      const auto range = [&](const auto member) {
        double low = 1e300, high = -1e300;
        for (const Measurement *m : rows)
        {
          low  = std::min<double>(low, m->*member);
          high = std::max<double>(high, m->*member);
        }
        return std::make_pair(low, high);
      };
      std::cout << std::setw(6) << -size / measurements[0].half_width
                << std::setw(10) << range(&Measurement::n_unknowns).second;
      for (const auto member : {&Measurement::force_error,
                                &Measurement::peak_error,
                                &Measurement::half_width_error,
                                &Measurement::pressure_error,
                                &Measurement::ripple})
        std::cout << std::setw(8) << percent(range(member).first) << " ..."
                  << std::setw(6) << percent(range(member).second);
      std::cout << std::setw(6) << range(&Measurement::n_iterations).second
                << std::endl;
    }
  }


  void
  print_compression_header()
  {
    std::cout << "\nQuarter disk, neo-Hookean, rigid plate: error of the force "
                 "in percent\n"
              << "springs       size  unknowns  steps  cuts  iterations  "
                 "approach >= 0.2  < 0.2  penetration  total s\n";
  }


  void
  print_compression(const Measurement &m)
  {
    std::cout << std::left << std::setw(11) << name(m.enforcement) << std::right
              << std::setw(7) << m.contact_size << std::setw(10) << m.n_unknowns
              << std::setw(7) << m.n_steps << std::setw(6) << m.n_cuts
              << std::setw(12) << m.n_iterations << std::setw(17)
              << percent(m.converged_error) << std::setw(7)
              << percent(m.early_error) << std::setw(13) << std::scientific
              << std::setprecision(1) << m.penetration << std::fixed
              << std::setprecision(2) << std::setw(9) << m.total_time
              << std::defaultfloat << std::endl;
  }


  void
  print_press(const Parameters &parameters, const PressResult &press)
  {
    const Measurement &m = press.measurement;
    std::cout << "\nThe paper's press, " << name(m.enforcement) << ", edges of "
              << m.contact_size << " m at the contacts: " << m.n_unknowns
              << " unknowns, " << m.n_steps << " steps, " << m.n_cuts
              << " cuts, " << m.n_iterations << " iterations, " << std::fixed
              << std::setprecision(1) << m.total_time << " s\n"
              << "Force beside that of rigid plates: " << percent(m.early_error)
              << " % below 0.2 m, " << percent(m.converged_error)
              << " % from there on\n"
              << "approach m  time s  force kN/m  difference %  peak kPa  "
                 "Hertz's  half-width m  Hertz's\n";
    for (const Stage &stage : press.stages)
    {
      const Hertz hertz = Hertz::from_force(parameters, stage.force);
      double      peak = 0., half_width = 0.;
      for (const PressurePoint &point : stage.pressure)
      {
        peak       = std::max(peak, point.pressure);
        half_width = std::max(half_width, std::abs(point.x));
      }
      std::cout << std::fixed << std::setprecision(2) << std::setw(10)
                << stage.approach << std::setw(8)
                << stage.approach / parameters.speed << std::setw(12)
                << stage.force / 1000. << std::setw(14)
                << percent(stage.force_difference / stage.force)
                << std::setw(10) << peak / 1000. << std::setw(9)
                << hertz.peak / 1000. << std::setprecision(4) << std::setw(14)
                << half_width << std::setw(9) << hertz.half_width
                << std::defaultfloat << std::endl;
    }
  }


  // @sect3{Files}

  namespace
  {
    void
    write_compression(const std::string              &file_name,
                      const std::vector<Measurement> &measurements)
    {
      std::ofstream file(file_name);
      file << "springs,contact_size_m,unknowns,elements,steps,cuts,iterations,"
              "augmentations,penetration_m,solution_s,total_s,"
              "force_error_from_0.2,force_error_below_0.2\n"
           << std::setprecision(7);
      for (const Measurement &m : measurements)
        file << name(m.enforcement) << ',' << m.contact_size << ','
             << m.n_unknowns << ',' << m.n_elements << ',' << m.n_steps << ','
             << m.n_cuts << ',' << m.n_iterations << ',' << m.n_augmentations
             << ',' << m.penetration << ',' << m.solution_time << ','
             << m.total_time << ',' << m.converged_error << ',' << m.early_error
             << '\n';
    }


    void
    write_lines(const std::string                                &file_name,
                const std::vector<std::vector<dealii::Point<2>>> &lines)
    {
      std::ofstream file(file_name);
      file << "x_m,y_m\n" << std::setprecision(7);
      for (const auto &line : lines)
      {
        for (const Point<2> &x : line)
          file << x[0] << ',' << x[1] << '\n';
        file << '\n';
      }
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
      std::ofstream pressure(prefix + "stages.csv");
      pressure << "x_m,pressure_Pa,approach_m\n" << std::setprecision(7);
      std::ofstream curves(prefix + "stages-hertz.csv");
      curves << "x_m,hertz_Pa,approach_m\n" << std::setprecision(7);
      unsigned int number = 0;
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
          pressure << point.x << ',' << point.pressure << ',' << stage.approach
                   << '\n';
        pressure << "\n\n";
        constexpr unsigned int n = 100;
        for (unsigned int i = 0; i <= 2 * n; ++i)
        {
          // closer at the ends, where the curve is steep
          const double x = -std::cos(numbers::PI * i / (2. * n));
          curves << x * hertz.half_width << ','
                 << hertz.pressure(x * hertz.half_width) << ','
                 << stage.approach << '\n';
        }
        curves << "\n\n";
        ++number;
        const std::string stage_prefix =
          prefix + "stage-" + std::to_string(number);
        write_lines(stage_prefix + "-outlines.csv", stage.outlines);
        write_lines(stage_prefix + "-lines.csv", stage.material_lines);
      }
    }


    void
    write_forces(const Parameters               &parameters,
                 const std::vector<Measurement> &compression,
                 const std::vector<PressResult> &press,
                 const std::string              &prefix)
    {
      const double  unit = parameters.youngs_modulus * parameters.radius;
      std::ofstream file(prefix + "forces.csv");
      file << "approach_over_R,F_over_ER,springs,contact_size_m\n"
           << std::setprecision(7);
      for (const Measurement &m : compression)
      {
        for (const auto &[approach, force] : m.forces)
          file << approach / parameters.radius << ',' << force / unit << ','
               << name(m.enforcement) << ',' << m.contact_size << '\n';
        file << "\n\n";
      }
      std::ofstream whole(prefix + "press-forces.csv");
      whole << "approach_over_R,F_over_ER\n" << std::setprecision(7);
      for (const auto &[approach, force] : press.back().measurement.forces)
        whole << approach / parameters.radius << ',' << force / unit << '\n';
      std::ofstream reference(prefix + "reference.csv");
      reference << "approach_over_R,F_over_ER\n" << std::setprecision(7);
      for (const auto &[approach, force] : read_reference())
        reference << approach << ',' << force << '\n';
      // Hertz's force by approach, beside what large strain makes of it
      std::ofstream hertz(prefix + "hertz-forces.csv");
      hertz << "approach_over_R,F_over_ER\n" << std::setprecision(7);
      for (unsigned int i = 1; i <= 40; ++i)
      {
        const Hertz h = Hertz::from_half_width(parameters, 0.01 * i);
        if (h.approach <= parameters.approach)
          hertz << h.approach / parameters.radius << ',' << h.force / unit
                << '\n';
      }
    }
  } // namespace


  void
  write_results(const Parameters               &parameters,
                const std::vector<Measurement> &hertz,
                const std::vector<Measurement> &compression,
                const std::vector<PressResult> &press)
  {
    const std::string prefix = parameters.output_directory + "/step-nmm-3-";
    write_compression(prefix + "compression.csv", compression);

    std::ofstream pressure(prefix + "pressure.csv");
    pressure << "x_over_b,p_over_p0,springs,half_width_m,size_over_b,"
                "error_over_p0\n"
             << std::setprecision(7);
    for (const Measurement &m : hertz)
    {
      const Hertz exact = Hertz::from_half_width(parameters, m.half_width);
      for (const PressurePoint &point : m.pressure)
        if (point.x < 1.3 * m.half_width)
          pressure << point.x / m.half_width << ','
                   << point.pressure / exact.peak << ',' << name(m.enforcement)
                   << ',' << m.half_width << ','
                   << m.contact_size / m.half_width << ','
                   << (point.pressure - exact.pressure(point.x)) / exact.peak
                   << '\n';
    }
    write_forces(parameters, compression, press, prefix);
    for (const PressResult &result : press)
      write_press(parameters,
                  result,
                  prefix + name(result.measurement.enforcement) + "-");
  }
} // namespace StepNMM3
