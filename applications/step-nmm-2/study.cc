#include "study.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "cantilever_data.h"
#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

namespace StepNMM2
{
  using namespace dealii;

  // @sect3{Parameters}

  std::string
  name(const Load load)
  {
    return load == Load::dead ? "dead" : "follower";
  }


  double
  Parameters::section() const
  {
    return std::pow(height, 3) / 12.;
  }


  double
  Parameters::force() const
  {
    return last_load * youngs_modulus * section() / std::pow(length, 3);
  }


  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory)
  {
    Parameters parameters;
    parameters.output_directory = output_directory;

    ParameterHandler       prm;
    const Patterns::Double positive(1e-300);
    prm.add_parameter("Cell sizes",
                      parameters.cell_sizes,
                      "Edge lengths of the triangles [m].",
                      Patterns::List(positive, 1));
    prm.add_parameter("Corner ratio",
                      parameters.corner_ratio,
                      "Edge length at the clamped corners over the others "
                      "[-].",
                      Patterns::Double(1e-3, 1.));
    prm.add_parameter("Corner growth",
                      parameters.corner_growth,
                      "Of the edge length per distance from the corners "
                      "[-].",
                      Patterns::Double(1e-3, 1.));
    Tutorial::add_placements(prm,
                             parameters.offset,
                             parameters.rotation,
                             parameters.n_placements,
                             parameters.seed);
    prm.add_parameter("Load steps",
                      parameters.n_load_steps,
                      "Equal steps up to K = 10.",
                      Patterns::Integer(1, 1000));
    prm.add_parameter("Increments",
                      parameters.increments,
                      "Numbers of steps of the paper's scheme.",
                      Patterns::List(Patterns::Integer(1)));
    prm.add_parameter("Cell size",
                      parameters.cell_size,
                      "Of increments, placements and figures [m].",
                      positive);
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-2.prm");
    return parameters;
  }


  // @sect3{Reference values}

  std::map<double, Reference>
  read_reference(const Load load)
  {
    std::map<double, Reference> result;
    std::istringstream          in(cantilever_csv);
    for (std::string line; std::getline(in, line);)
    {
      std::vector<std::string> cells;
      std::istringstream       row(line);
      for (std::string cell; std::getline(row, cell, ',');)
        cells.push_back(cell);
      if (cells.empty() || cells[0] != name(load))
        continue;
      AssertThrow(cells.size() >= 7,
                  NMM::InputError("a row of the reference values is too short",
                                  line,
                                  "restore cantilever.csv and build again"));
      const double nan       = std::numeric_limits<double>::quiet_NaN();
      const bool   has_solid = cells.size() >= 9;
      const auto   number    = [&](const unsigned int i) {
        return Utilities::string_to_double(cells[i]);
      };
      Reference reference;
      reference.euler    = {{number(2), number(3)}};
      reference.reissner = {{number(5), number(6)}};
      reference.solid    = {
           {has_solid ? number(7) : nan, has_solid ? number(8) : nan}};
      result[number(1)] = reference;
    }
    return result;
  }


  void
  compare(Measurement &measurement)
  {
    const auto reference = read_reference(measurement.load);
    for (const auto &[K, w] : measurement.deflection)
      for (const auto &[reference_K, values] : reference)
        if (std::abs(K - reference_K) < 1e-9 && !std::isnan(values.solid[0]))
          measurement.largest_error =
            std::max(measurement.largest_error,
                     std::abs(w / values.solid[0] - 1.));
  }


  // @sect3{Tables}

  void
  print_header()
  {
    std::cout << "Largest error of w/L at K = 2, 4, ..., 10, relative to the "
                 "solid of cantilever.csv\n"
              << "load      kinematics   p  mesh      unknowns  steps  "
                 "iterations     error   total s  iteration / linear s\n";
  }


  void
  print(const Measurement &m)
  {
    std::cout << std::left << std::setw(10) << name(m.load) << std::setw(13)
              << m.kinematics << m.degree << "  " << std::setw(8) << m.mesh
              << std::right << std::setw(10) << m.n_unknowns << std::setw(7)
              << m.n_steps << std::setw(12) << m.n_iterations << std::scientific
              << std::setprecision(1) << std::setw(10) << m.largest_error
              << std::fixed << std::setprecision(3) << std::setw(10)
              << m.total_time << std::setprecision(4) << std::setw(9)
              << m.iteration_time;
    if (m.linear_time > 0.)
      std::cout << " / " << m.linear_time;
    std::cout << std::defaultfloat << std::endl;
  }


  void
  print_placements(const std::vector<Measurement> &measurements)
  {
    if (measurements.empty())
      return;
    double       low = 1e300, high = 0.;
    unsigned int n_iterations = 0;
    for (const Measurement &m : measurements)
    {
      low          = std::min(low, m.largest_error);
      high         = std::max(high, m.largest_error);
      n_iterations = std::max(n_iterations, m.n_iterations);
    }
    std::cout << "\nMesh moved and turned " << measurements.size() / 2
              << " random ways, both loads, h = " << measurements[0].cell_size
              << ": errors " << std::scientific << std::setprecision(1) << low
              << " to " << high << std::defaultfloat << ", at most "
              << n_iterations << " iterations" << std::endl;
  }


  // @sect3{Files}

  namespace
  {
    void
    write_measurements(const std::string              &file_name,
                       const std::vector<Measurement> &measurements)
    {
      std::ofstream file(file_name);
      file << "load,kinematics,degree,mesh,cell_size_m,unknowns,elements,steps,"
              "iterations,largest_error,total_s,iteration_s,linear_s\n"
           << std::setprecision(7);
      for (const Measurement &m : measurements)
      {
        file << name(m.load) << ',' << m.kinematics << ',' << m.degree << ','
             << m.mesh << ',' << m.cell_size << ',' << m.n_unknowns << ','
             << m.n_elements << ',' << m.n_steps << ',' << m.n_iterations << ','
             << m.largest_error << ',' << m.total_time << ','
             << m.iteration_time << ',' << m.linear_time << '\n';
      }
    }
  } // namespace


  void
  write_results(const Parameters               &parameters,
                const std::vector<Measurement> &measurements,
                const std::map<Load, Curves>   &curves)
  {
    const std::string prefix = parameters.output_directory + "/step-nmm-2-";
    write_measurements(prefix + "study.csv", measurements);
    for (const auto &[load, curve] : curves)
    {
      std::ofstream tip(prefix + "tip-" + name(load) + ".csv");
      tip << "K,w_over_L,u_over_L\n" << std::setprecision(9);
      for (const auto &[K, values] : curve.tip)
        tip << K << ',' << values[0] << ',' << values[1] << '\n';

      std::ofstream reference(prefix + "reference-" + name(load) + ".csv");
      reference << "K,euler_w,euler_u,reissner_w,reissner_u,solid_w,solid_u\n"
                << std::setprecision(9);
      for (const auto &[K, r] : read_reference(load))
      {
        reference << K;
        for (const auto &values : {r.euler, r.reissner, r.solid})
          reference << ',' << values[0] << ',' << values[1];
        reference << '\n';
      }

      std::ofstream shapes(prefix + "shapes-" + name(load) + ".csv");
      shapes << "x_m,y_m,K\n" << std::setprecision(7);
      for (const auto &[K, outline] : curve.outlines)
      {
        for (const Point<2> &x : outline)
          shapes << x[0] << ',' << x[1] << ',' << K << '\n';
        shapes << '\n';
      }
    }
  }
} // namespace StepNMM2
