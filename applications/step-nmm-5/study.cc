#include "study.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include "tutorial/table.h"
#include "tutorial/tutorial.h"
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>

namespace StepNMM5
{
  using namespace dealii;
  using Complex = std::complex<double>;

  // @sect3{Parameters}

  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory)
  {
    Parameters parameters;
    parameters.output_directory = output_directory;

    ParameterHandler       prm;
    const Patterns::Double length(0.);
    const Patterns::List   numbers(length, 1);
    prm.add_parameter(
      "Gradings",
      parameters.gradings,
      "Sizes of cells at the free radius of the tip over that radius [-].",
      numbers);
    prm.add_parameter(
      "Cell sizes",
      parameters.cell_sizes,
      "Sizes of cells of meshes that know nothing of the tip [m].",
      numbers);
    prm.add_parameter("Increments",
                      parameters.increments,
                      "Increments of the crack in the beam [in].",
                      numbers);
    prm.add_parameter("Beam cell size",
                      parameters.beam_cell_size,
                      "Size of the beam's cells [in].",
                      length);
    prm.add_parameter("Beam grading",
                      parameters.beam_grading,
                      "Like Gradings, for the beam [-].",
                      length);
    prm.add_parameter(
      "Wing increments",
      parameters.n_wing_increments,
      "Number of the wings' increments; 0: this part is left out.",
      Patterns::Integer(0));
    prm.add_parameter("Wing increment",
                      parameters.wing_increment,
                      "Length of the wings' increments [m].",
                      length);
    prm.add_parameter(
      "Slope end time",
      parameters.slope_end_time,
      "Until when the slope is followed [s]; 0: this part is left out.",
      length);
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-5.prm");
    return parameters;
  }


  // @sect3{The exact solution}

  Westergaard::Westergaard(const NMM::CrackTip        &tip,
                           const NMM::PlaneElasticity &elasticity)
    : tip(tip.point)
    , elasticity(elasticity)
  {
    for (unsigned int i = 0; i < 2; ++i)
      frame[i][0] = tip.direction[i];
    frame[0][1] = -tip.direction[1];
    frame[1][1] = tip.direction[0];
  }


  double
  Westergaard::K_I()
  {
    return sigma * std::sqrt(numbers::PI * a);
  }


  Complex
  Westergaard::local(const Point<2> &x) const
  {
    const Tensor<1, 2> d = transpose(frame) * (x - tip);
    return {d[0], d[1]};
  }


  namespace
  {
    /// sqrt(z (z + 2a)), which jumps on the crack.
    Complex
    root(const Complex &z)
    {
      return std::sqrt(z) * std::sqrt(z + 2. * Westergaard::a);
    }
  } // namespace


  Tensor<1, 2>
  Westergaard::displacement(const Point<2> &x) const
  {
    if (x == tip)
      return {};
    const double  mu = elasticity.mu, lambda = elasticity.lambda;
    const double  kappa = (lambda + 3. * mu) / (lambda + mu);
    const Complex z = local(x), Z = sigma * (z + a) / root(z),
                  integral = sigma * root(z);
    return frame *
           Tensor<1, 2>(
             {(0.5 * (kappa - 1.) * integral.real() - z.imag() * Z.imag()) /
                (2. * mu),
              (0.5 * (kappa + 1.) * integral.imag() - z.imag() * Z.real()) /
                (2. * mu)});
  }


  SymmetricTensor<2, 2>
  Westergaard::stress(const Point<2> &x) const
  {
    // sigma_11 = Re Z - x_2 Im Z', sigma_22 = Re Z + x_2 Im Z', sigma_12 = -x_2 Re Z'
    const Complex z = local(x), Z = sigma * (z + a) / root(z);
    const Complex derivative = -sigma * a * a / std::pow(root(z), 3);
    Tensor<2, 2>  stress;
    stress[0][0] = Z.real() - z.imag() * derivative.imag();
    stress[1][1] = Z.real() + z.imag() * derivative.imag();
    stress[0][1] = stress[1][0] = -z.imag() * derivative.real();
    return symmetrize(frame * stress * transpose(frame));
  }


  // @sect3{Tables and figures}

  double
  CrackPath::x_at(const double y) const
  {
    for (unsigned int i = 1; i < points.size(); ++i)
      if (points[i - 1][1] <= y && y <= points[i][1])
        return points[i - 1][0] + (y - points[i - 1][1]) /
                                    (points[i][1] - points[i - 1][1]) *
                                    (points[i][0] - points[i - 1][0]);
    return std::numeric_limits<double>::quiet_NaN();
  }


  namespace
  {
    /// PREFIX stands for the path and the beginning of the files' names.
    const char *const figures_script = R"(set datafile separator ','
set terminal pngcairo size 1250,750 font 'DejaVu Sans,13'
set grid
set logscale xy
set format '%.0e'
set key outside right top
set output 'PREFIXerrors.png'
set title 'A crack tip anywhere in the mesh: error against time, one core'
set xlabel 'seconds'
set ylabel 'relative error'
f = 'PREFIXstudy.csv'
set style data linespoints
row(mesh, degree, column) = strcol(1) eq mesh && $2 == degree ? column : NaN
plot f skip 1 using 7:(row('covered', 2, $4)) pt 5 lc 'dark-green' title 'K, second order, cover of the tip', \
     f skip 1 using 7:(row('graded', 2, $4)) pt 7 lc 'blue' title 'K, second order, graded', \
     f skip 1 using 7:(row('graded', 1, $4)) pt 6 lc 'blue' dt 2 title 'K, first order, graded', \
     f skip 1 using 7:(row('uniform', 2, $4)) pt 4 lc 'gray50' title 'K, second order, cells of one size', \
     f skip 1 using 7:(row('covered', 2, $6)) pt 5 lc 'orange-red' title 'stress, second order, cover of the tip', \
     f skip 1 using 7:(row('graded', 2, $6)) pt 7 lc 'dark-red' title 'stress, second order, graded', \
     f skip 1 using 7:(row('graded', 1, $6)) pt 6 lc 'dark-red' dt 2 title 'stress, first order, graded', \
     f skip 1 using 7:(row('uniform', 2, $6)) pt 4 lc 'orange' title 'stress, second order, cells of one size'
unset logscale
set format '%g'
set size ratio -1
set output 'PREFIXpaths.png'
set title 'Paths of the crack from the notch [in]'
set xrange [-7:-3]
set yrange [0:8]
set xlabel 'x [in]'
set ylabel 'y [in]'
set key outside right top
set object 1 circle at -4,2.75 size 0.25 fc 'gray70' fs solid border lc 'black'
set object 2 circle at -4,4.75 size 0.25 fc 'gray70' fs solid border lc 'black'
set object 3 circle at -4,6.75 size 0.25 fc 'gray70' fs solid border lc 'black'
set style data lines
set datafile separator whitespace
plot for [i=0:*] 'PREFIXpaths.txt' index i using 1:2 lw 2 title columnheader(1), \
     '-' using 1:2 lw 3 lc 'black' title 'notch'
-6 0
-6 1
e
)";


    using Row = std::map<std::string, std::string>;

    /// The rows of a table with a header, by column. Lines that start with # have the units.
    std::vector<Row>
    read_rows(const std::string &file_name)
    {
      std::ifstream            file(file_name);
      std::vector<std::string> columns;
      std::vector<Row>         rows;
      for (std::string line; std::getline(file, line);)
      {
        if (line[0] == '#')
          continue;
        const std::vector<std::string> cells =
          Utilities::split_string_list(line, ',');
        if (columns.empty())
        {
          columns = cells;
          continue;
        }
        Row row;
        for (unsigned int i = 0; i < columns.size(); ++i)
          row[columns[i]] = i < cells.size() ? cells[i] : "";
        rows.push_back(row);
      }
      return rows;
    }
  } // namespace


  void
  print_slope(const std::string &directory)
  {
    Tutorial::Table growth("The slope: cracks that grow");
    for (const Row &row : read_rows(directory + "/growth.csv"))
    {
      Tutorial::Row increment;
      for (const char *column : {"time", "x", "y", "end_x", "end_y"})
        increment.emplace_back(column, std::stod(row.at(column)));
      increment.emplace_back("met", row.at("met"));
      growth.add(increment);
    }
    const std::vector<Row> states = read_rows(directory + "/history.csv"),
                           probes =
                             read_rows(directory + "/probes-history.csv");
    Tutorial::Table motion("The slope: energies [J/m], way of the mass [m]");
    // a row each quarter of a second
    double next = 0.;
    for (unsigned int i = 0; i < states.size() && i < probes.size(); ++i)
    {
      if (std::stod(states[i].at("time")) < next - 1e-9 &&
          i + 1 < states.size())
        continue;
      next += 0.25;
      Tutorial::Row state;
      for (const char *column :
           {"time", "kinetic", "dissipated", "fracture", "balance"})
        state.emplace_back(column, std::stod(states[i].at(column)));
      state.emplace_back("way",
                         std::hypot(std::stod(probes[i].at("mass_x")),
                                    std::stod(probes[i].at("mass_y"))));
      motion.add(state);
    }
  }


  void
  write_paths(const std::string &prefix, const std::vector<CrackPath> &paths)
  {
    Tutorial::Table table;
    std::ofstream   curves(prefix + "paths.txt");
    curves << std::setprecision(9);
    for (const CrackPath &path : paths)
    {
      // gnuplot reads blocks that are two empty lines apart, each with its title
      curves << '"' << path.criterion << ", " << path.increment << " in\"\n";
      for (unsigned int i = 0; i < path.points.size(); ++i)
      {
        const Point<2> &x = path.points[i];
        table.add({{"criterion", path.criterion},
                   {"increment_in", path.increment},
                   {"step", i},
                   {"x_in", x[0]},
                   {"y_in", x[1]},
                   {"load",
                    i < path.loads.size() ? Tutorial::Value(path.loads[i])
                                          : Tutorial::Value("")}});
        curves << x[0] << ' ' << x[1] << '\n';
      }
      curves << "\n\n";
    }
    table.write(prefix + "paths.csv");
  }


  void
  draw_figures(const std::string &prefix)
  {
    Tutorial::draw_figures(prefix, figures_script, {"errors.png", "paths.png"});
  }
} // namespace StepNMM5
