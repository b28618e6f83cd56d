#include "study.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>

namespace StepNMM1
{
  using namespace dealii;

  // @sect3{Parameters}

  NMM::Material
  Parameters::material() const
  {
    NMM::Material result;
    result.name           = "ring";
    result.youngs_modulus = youngs_modulus;
    result.poissons_ratio = poissons_ratio;
    return result;
  }


  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory)
  {
    Parameters parameters;
    parameters.output_directory = output_directory;

    ParameterHandler       prm;
    const Patterns::Double positive(1e-300);
    prm.add_parameter("Inner radius", parameters.inner_radius, "[m]", positive);
    prm.add_parameter("Outer radius", parameters.outer_radius, "[m]", positive);
    prm.add_parameter("Pressure", parameters.pressure, "Inside [Pa].");
    prm.add_parameter("Young's modulus",
                      parameters.youngs_modulus,
                      "[Pa]",
                      positive);
    prm.add_parameter("Poisson's ratio",
                      parameters.poissons_ratio,
                      "[-]",
                      Patterns::Double(-1., 0.5));
    prm.add_parameter("Aggregation threshold",
                      parameters.aggregation_threshold,
                      "Least support that makes an element good [-].",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Refined width",
                      parameters.refined_width,
                      "Width of the zone of smaller triangles at the inner "
                      "circle [m].",
                      positive);
    prm.add_parameter("Cell sizes",
                      parameters.cell_sizes,
                      "Edge lengths of the triangles [m].",
                      Patterns::List(positive, 1));
    Tutorial::add_placements(prm,
                             parameters.offset,
                             parameters.rotation,
                             parameters.n_placements,
                             parameters.seed);
    prm.add_parameter("Placement cell size",
                      parameters.placement_cell_size,
                      "[m]",
                      positive);
    prm.declare_entry("Ring",
                      "quarter",
                      Patterns::Selection("quarter|half|full"),
                      "How much of the ring is modelled; symmetry on the "
                      "cuts.");
    prm.declare_entry("Pattern",
                      "equilateral",
                      Patterns::Selection("equilateral|right-angled"),
                      "Of the regular mesh.");
    prm.declare_entry("Solver",
                      "automatic",
                      Patterns::Selection("automatic|direct|iterative"),
                      "Of the linear system.");
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-1.prm");

    const std::string ring   = prm.get("Ring");
    parameters.shape         = ring == "quarter" ? RingShape::quarter
                               : ring == "half"  ? RingShape::half
                                                 : RingShape::full;
    parameters.pattern       = prm.get("Pattern") == "equilateral"
                                 ? NMM::MeshPattern::equilateral
                                 : NMM::MeshPattern::right_angled;
    const std::string solver = prm.get("Solver");
    using Type               = NMM::LinearSolverParameters::Type;
    parameters.solver.type   = solver == "direct"      ? Type::direct
                               : solver == "iterative" ? Type::iterative
                                                       : Type::automatic;
    return parameters;
  }


  // @sect3{Measuring}

  StageClock::StageClock(Measurement &measurement)
    : measurement(&measurement)
  {
    timer.start();
  }


  void
  StageClock::lap(const std::string &name)
  {
    const double now = timer.wall_time();
    measurement->stages.emplace_back(name, now - last);
    last = now;
  }


  void
  StageClock::stop()
  {
    measurement->total = last;
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    measurement->memory = memory.VmHWM / 1024.;
  }


  namespace
  {
    double
    hoop_stress(const SymmetricTensor<2, 2> &stress, const double angle)
    {
      const Tensor<1, 2> e({-std::sin(angle), std::cos(angle)});
      return e * (stress * e);
    }


    constexpr unsigned int n_samples = 101;

    /// action(r, angle, point) along a radius.
    template <typename Action>
    void
    along_radius(const Parameters &parameters,
                 const double      angle,
                 const Action     &action)
    {
      for (unsigned int k = 0; k < n_samples; ++k)
      {
        const double r = parameters.inner_radius +
                         (parameters.outer_radius - parameters.inner_radius) *
                           k / (n_samples - 1);
        action(r, Point<2>(r * std::cos(angle), r * std::sin(angle)));
      }
    }
  } // namespace


  HoopProfile
  sample_hoop(const NMM::ThickRing &exact,
              const Parameters     &parameters,
              const StressAt       &direct,
              const StressAt       &recovered)
  {
    HoopProfile  profile;
    const double angle = numbers::PI_4;
    along_radius(parameters, angle, [&](const double r, const Point<2> &x) {
      profile.r.push_back(r);
      profile.exact.push_back(exact.hoop_stress(r));
      profile.direct.push_back(hoop_stress(direct(x), angle));
      profile.recovered.push_back(hoop_stress(recovered(x), angle));
    });
    return profile;
  }


  double
  largest_hoop_error(const NMM::ThickRing &exact,
                     const Parameters     &parameters,
                     const StressAt       &stress)
  {
    double largest = 0.;
    for (const double degrees : {15., 45., 75.})
    {
      const double angle = degrees * numbers::PI / 180.;
      along_radius(parameters, angle, [&](const double r, const Point<2> &x) {
        largest = std::max(largest,
                           std::abs(hoop_stress(stress(x), angle) -
                                    exact.hoop_stress(r)) /
                             exact.hoop_stress(r));
      });
    }
    return largest;
  }


  // @sect3{Tables}

  void
  print_progress(const Measurement &m)
  {
    std::cout << std::left << std::setw(9) << m.method << " p=" << m.degree
              << std::right << "  h=" << std::setw(8) << m.cell_size
              << std::setw(9) << m.n_unknowns << " unknowns  "
              << std::scientific << std::setprecision(2) << "u " << m.error_u
              << "  stress " << m.error_stress << "  hoop " << m.error_hoop
              << " / " << m.error_hoop_recovered << std::defaultfloat
              << std::setprecision(3) << "  " << m.total << " s" << std::endl;
  }


  namespace
  {
    /// Observed order: error ~ n^(-order/2) for n unknowns in two dimensions.
    double
    order(const double       error,
          const double       coarse_error,
          const unsigned int n,
          const unsigned int coarse_n)
    {
      return 2. * std::log(coarse_error / error) /
             std::log(static_cast<double>(n) / coarse_n);
    }


    void
    print_stages(const Measurement &m)
    {
      std::cout << "    ";
      for (const auto &[name, seconds] : m.stages)
        std::cout << name << ' ' << std::fixed << std::setprecision(3)
                  << seconds << "  ";
      std::cout << std::defaultfloat << '\n';
    }


    std::string
    describe(const std::string &method)
    {
      return method == "fitted"    ? "deal.II, fitted curved triangles"
             : method == "uniform" ? "Manifold method, regular mesh that does "
                                     "not fit"
                                   : "Manifold method, mesh that does not fit, "
                                     "refined near the inner circle";
    }
  } // namespace


  void
  print_table(const std::vector<Measurement> &measurements)
  {
    const Measurement *coarse = nullptr;
    for (const Measurement &m : measurements)
    {
      if (coarse == nullptr || coarse->method != m.method ||
          coarse->degree != m.degree)
      {
        coarse = nullptr;
        std::cout << '\n'
                  << describe(m.method) << ", degree " << m.degree << "\n"
                  << " unknowns     L2 u  order  L2 stress  order   hoop max  "
                     "recovered   total s    MB\n";
      }
      std::cout << std::setw(9) << m.n_unknowns << std::scientific
                << std::setprecision(2) << std::setw(10) << m.error_u;
      const auto print_order = [&](const double error, const double before) {
        if (coarse == nullptr)
          std::cout << "      -";
        else
          std::cout << std::fixed << std::setw(7)
                    << order(error, before, m.n_unknowns, coarse->n_unknowns)
                    << std::scientific;
      };
      print_order(m.error_u, coarse == nullptr ? 0. : coarse->error_u);
      std::cout << std::setw(11) << m.error_stress;
      print_order(m.error_stress,
                  coarse == nullptr ? 0. : coarse->error_stress);
      std::cout << std::setw(11) << m.error_hoop << std::setw(11);
      if (m.method != "fitted")
        std::cout << m.error_hoop_recovered;
      else
        std::cout << '-';
      std::cout << std::fixed << std::setprecision(3) << std::setw(10)
                << m.total << std::setprecision(0) << std::setw(6) << m.memory
                << std::defaultfloat << '\n';
      coarse = &m;
    }

    std::cout
      << "\nSeconds per stage of the finest meshes (recovery and errors "
         "are not part of the total)\n";
    for (unsigned int i = 0; i < measurements.size(); ++i)
      if (i + 1 == measurements.size() ||
          measurements[i + 1].method != measurements[i].method ||
          measurements[i + 1].degree != measurements[i].degree)
        for (unsigned int j = i >= 1 ? i - 1 : i; j <= i; ++j)
        {
          std::cout << measurements[j].method << ", degree "
                    << measurements[j].degree << ", "
                    << measurements[j].n_unknowns << " unknowns\n";
          print_stages(measurements[j]);
        }
  }


  void
  print_placements(const std::vector<Measurement> &measurements)
  {
    if (measurements.empty())
      return;
    const auto report = [&](const std::string &name, const auto &value) {
      double low = 1e300, high = 0.;
      for (const Measurement &m : measurements)
      {
        low  = std::min(low, value(m));
        high = std::max(high, value(m));
      }
      std::cout << "  " << std::left << std::setw(22) << name << std::right
                << std::scientific << std::setprecision(2) << "best " << low
                << "  worst " << high << std::fixed << "  ratio " << high / low
                << std::defaultfloat << '\n';
    };
    std::cout << "\nMesh moved and turned " << measurements.size()
              << " random ways, h = " << measurements[0].cell_size << '\n';
    report("L2 u", [](const Measurement &m) { return m.error_u; });
    report("L2 stress", [](const Measurement &m) { return m.error_stress; });
    report("hoop, recovered",
           [](const Measurement &m) { return m.error_hoop_recovered; });
    report("hoop, direct", [](const Measurement &m) { return m.error_hoop; });
    std::cout << std::endl;
  }


  // @sect3{Files and figures}

  namespace
  {
    void
    write_measurements(const std::string              &file_name,
                       const std::vector<Measurement> &measurements)
    {
      std::ofstream file(file_name);
      file << "method,degree,cell_size_m,unknowns,constrained,elements,"
              "rel_L2_u,rel_L2_stress,max_hoop_direct,max_hoop_recovered,"
              "total_s,memory_MB,stages_s\n"
           << std::setprecision(6);
      for (const Measurement &m : measurements)
      {
        file << m.method << ',' << m.degree << ',' << m.cell_size << ','
             << m.n_unknowns << ',' << m.n_constrained << ',' << m.n_elements
             << ',' << m.error_u << ',' << m.error_stress << ',' << m.error_hoop
             << ',' << m.error_hoop_recovered << ',' << m.total << ','
             << m.memory << ',';
        for (const auto &[name, seconds] : m.stages)
          file << name << '=' << seconds << ' ';
        file << '\n';
      }
    }
  } // namespace


  void
  write_results(const Parameters                         &parameters,
                const std::vector<Measurement>           &study,
                const std::vector<Measurement>           &placements,
                const std::map<std::string, HoopProfile> &profiles)
  {
    const std::string prefix = parameters.output_directory + "/step-nmm-1-";
    write_measurements(prefix + "study.csv", study);
    write_measurements(prefix + "placements.csv", placements);
    for (const auto &[name, profile] : profiles)
    {
      std::string file_name = name;
      std::replace(file_name.begin(), file_name.end(), ' ', '-');
      std::ofstream file(prefix + "hoop-" + file_name + ".csv");
      file << "r_m,exact_Pa,direct_Pa,recovered_Pa\n" << std::setprecision(10);
      for (unsigned int k = 0; k < profile.r.size(); ++k)
        file << profile.r[k] << ',' << profile.exact[k] << ','
             << profile.direct[k] << ',' << profile.recovered[k] << '\n';
    }
  }


  namespace
  {
    /// PREFIX stands for the path and the beginning of the files' names.
    const char *const figures_script = R"(set datafile separator ','
set terminal pngcairo size 1000,750 font 'DejaVu Sans,13'
set grid
set output 'PREFIXhoop.png'
set title 'Hoop stress along the radius (paper, Fig. 7)'
set xlabel 'r [m]'
set ylabel 'hoop stress [Pa]'
p1 = 'PREFIXhoop-p1-uniform-level-0.csv'
p2 = 'PREFIXhoop-p2-uniform-level-0.csv'
plot p2 skip 1 using 1:2 with lines lw 4 lc 'gray70' title 'exact', \
     p1 skip 1 using 1:3 with lines dt 2 lc 'black' title 'p = 1, coarsest mesh, direct', \
     p2 skip 1 using 1:3 with points pt 6 lc 'dark-red' title 'p = 2, coarsest mesh, direct', \
     p2 skip 1 using 1:4 with lines lw 2 lc 'blue' title 'p = 2, coarsest mesh, recovered'
set logscale xy
set format '%.0e'
set key bottom left
set output 'PREFIXerror-against-time.png'
set title 'Error against time from the curves to the solution, one core'
set xlabel 'seconds'
set ylabel 'relative L2 error'
f = 'PREFIXstudy.csv'
set style data linespoints
plot f skip 1 using 11:(strcol(1) eq 'uniform' && $2 == 1 ? $7 : NaN) pt 7 lc 'skyblue' title 'displacement, manifold, p = 1', \
     f skip 1 using 11:(strcol(1) eq 'graded' ? $7 : NaN) pt 7 lc 'blue' title 'displacement, manifold, p = 2, refined inside', \
     f skip 1 using 11:(strcol(1) eq 'fitted' ? $7 : NaN) pt 6 dt 2 lc 'blue' title 'displacement, fitted, p = 2 (deal.II)', \
     f skip 1 using 11:(strcol(1) eq 'uniform' && $2 == 1 ? $8 : NaN) pt 5 lc 'orange' title 'stress, manifold, p = 1', \
     f skip 1 using 11:(strcol(1) eq 'graded' ? $8 : NaN) pt 5 lc 'dark-red' title 'stress, manifold, p = 2, refined inside', \
     f skip 1 using 11:(strcol(1) eq 'fitted' ? $8 : NaN) pt 4 dt 2 lc 'dark-red' title 'stress, fitted, p = 2 (deal.II)'
)";
  } // namespace


  void
  draw_figures(const Parameters &parameters)
  {
    Tutorial::draw_figures(parameters.output_directory + "/step-nmm-1-",
                           figures_script,
                           {"hoop.png", "error-against-time.png"});
  }
} // namespace StepNMM1
