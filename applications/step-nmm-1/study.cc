#include "study.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include "tutorial/tutorial.h"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

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
  read_parameters(const std::string &file_name)
  {
    Parameters             parameters;
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
    Tutorial::read_parameter_file(prm, file_name, "step-nmm-1.prm");

    const std::string ring = prm.get("Ring");
    parameters.shape       = ring == "quarter" ? RingShape::quarter
                             : ring == "half"  ? RingShape::half
                                               : RingShape::full;
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


  Tutorial::Table
  sample_hoop(const NMM::ThickRing &exact,
              const Parameters     &parameters,
              const StressAt       &direct,
              const StressAt       &recovered)
  {
    Tutorial::Table profile;
    const double    angle = numbers::PI_4;
    along_radius(parameters, angle, [&](const double r, const Point<2> &x) {
      profile.add({{"r_m", r},
                   {"exact_Pa", exact.hoop_stress(r)},
                   {"direct_Pa", hoop_stress(direct(x), angle)},
                   {"recovered_Pa", hoop_stress(recovered(x), angle)}});
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


  // @sect3{Table and figures}

  Tutorial::Row
  row(const Measurement &m, const Measurement *coarse)
  {
    // error ~ n^(-order/2) for n unknowns in two dimensions
    const auto order = [&](const double Measurement::*error) {
      return coarse == nullptr
               ? Tutorial::Value("-")
               : Tutorial::Value(
                   2. * std::log(coarse->*error / m.*error) /
                   std::log(double(m.n_unknowns) / coarse->n_unknowns));
    };
    std::ostringstream stages;
    stages << std::setprecision(3);
    for (const auto &[name, seconds] : m.stages)
      stages << name << '=' << seconds << ' ';
    return {{"method", m.method},
            {"degree", m.degree},
            {"cell_size_m", m.cell_size},
            {"unknowns", m.n_unknowns},
            {"L2_u", m.error_u},
            {"order_u", order(&Measurement::error_u)},
            {"L2_stress", m.error_stress},
            {"order_stress", order(&Measurement::error_stress)},
            {"hoop_direct", m.error_hoop},
            {"hoop_recovered",
             m.method == "fitted" ? Tutorial::Value("-")
                                  : Tutorial::Value(m.error_hoop_recovered)},
            {"total_s", m.total},
            {"memory_MB", m.memory},
            {"stages_s", stages.str()}};
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
p1 = 'PREFIXhoop-1.csv'
p2 = 'PREFIXhoop-2.csv'
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
plot f skip 1 using 11:(strcol(1) eq 'uniform' && $2 == 1 ? $5 : NaN) pt 7 lc 'skyblue' title 'displacement, manifold, p = 1', \
     f skip 1 using 11:(strcol(1) eq 'graded' ? $5 : NaN) pt 7 lc 'blue' title 'displacement, manifold, p = 2, refined inside', \
     f skip 1 using 11:(strcol(1) eq 'fitted' ? $5 : NaN) pt 6 dt 2 lc 'blue' title 'displacement, fitted, p = 2 (deal.II)', \
     f skip 1 using 11:(strcol(1) eq 'uniform' && $2 == 1 ? $7 : NaN) pt 5 lc 'orange' title 'stress, manifold, p = 1', \
     f skip 1 using 11:(strcol(1) eq 'graded' ? $7 : NaN) pt 5 lc 'dark-red' title 'stress, manifold, p = 2, refined inside', \
     f skip 1 using 11:(strcol(1) eq 'fitted' ? $7 : NaN) pt 4 dt 2 lc 'dark-red' title 'stress, fitted, p = 2 (deal.II)'
)";
  } // namespace


  void
  draw_figures(const std::string &prefix)
  {
    Tutorial::draw_figures(prefix,
                           figures_script,
                           {"hoop.png", "error-against-time.png"});
  }
} // namespace StepNMM1
