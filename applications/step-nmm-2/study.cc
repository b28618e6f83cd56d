#include "study.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "cantilever_data.h"
#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
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
  read_parameters(const std::string &file_name)
  {
    Parameters             parameters;
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


  // @sect3{Files}

  Tutorial::Row
  row(const Measurement &m)
  {
    return {{"load", name(m.load)},
            {"kinematics", m.kinematics},
            {"degree", m.degree},
            {"mesh", m.mesh},
            {"cell_size_m", m.cell_size},
            {"unknowns", m.n_unknowns},
            {"steps", m.n_steps},
            {"iterations", m.n_iterations},
            {"error", m.largest_error},
            {"total_s", m.total_time},
            {"iteration_s", m.iteration_time},
            {"linear_s", m.linear_time}};
  }


  void
  write_curves(const std::string &prefix, const std::map<Load, Curves> &curves)
  {
    for (const auto &[load, curve] : curves)
    {
      Tutorial::Table tip, reference, shapes;
      for (const auto &[K, values] : curve.tip)
        tip.add({{"K", K}, {"w_over_L", values[0]}, {"u_over_L", values[1]}});
      for (const auto &[K, r] : read_reference(load))
        reference.add({{"K", K},
                       {"euler_w", r.euler[0]},
                       {"euler_u", r.euler[1]},
                       {"reissner_w", r.reissner[0]},
                       {"reissner_u", r.reissner[1]},
                       {"solid_w", r.solid[0]},
                       {"solid_u", r.solid[1]}});
      for (const auto &[K, outline] : curve.outlines)
      {
        for (const Point<2> &x : outline)
          shapes.add({{"x_m", x[0]}, {"y_m", x[1]}, {"K", K}});
        shapes.add_break();
      }
      tip.write(prefix + "tip-" + name(load) + ".csv");
      reference.write(prefix + "reference-" + name(load) + ".csv");
      shapes.write(prefix + "shapes-" + name(load) + ".csv");
    }
  }
} // namespace StepNMM2
