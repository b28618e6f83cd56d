#ifndef step_nmm_3_study_h
#define step_nmm_3_study_h

// What surrounds the method in step-nmm-3: parameters, Hertz's formulas, reference
// values, tables and figures.

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include "tutorial/table.h"
#include <map>
#include <string>
#include <vector>

namespace StepNMM3
{
  enum class Enforcement
  {
    penalty,
    augmented
  };

  std::string
  name(Enforcement enforcement);


  /// Table 1 of the paper, and what the study varies.
  struct Parameters
  {
    /// [m], [Pa], [-]
    double radius = 1., youngs_modulus = 1e6, poissons_ratio = 0.25;
    double plate_modulus = 1e9;
    /// The paper's springs, 200,000 t/m, taken per length of contact [Pa/m].
    double spring = 200000. * 9806.65;
    /// Of the top plate at the end [m], and its speed [m/s].
    double approach = 0.4, speed = 0.01;

    /// Of Hertz's contact [m].
    std::vector<double> half_widths = {0.1, 0.05};
    /// Edge length of triangles at the contact over the half-width.
    std::vector<double> contact_ratios = {0.4, 0.3, 0.2, 0.1, 0.05};
    /// Edge length far from it [m], growth per distance [-].
    double cell_size = 0.2, growth = 0.2;
    /// Where the mesh lies [m], [degrees].
    dealii::Tensor<1, 2> offset{{0.0123, 0.0321}};
    double               rotation = 6.;

    unsigned int n_placements = 10, seed = 1, n_repetitions = 3;
    /// Edge lengths at the contact, quarter disk to 0.4 m and the press [m].
    std::vector<double> compression_sizes = {0.08, 0.04, 0.02};
    double              press_size        = 0.05;
    unsigned int        n_load_steps      = 20;

    /// E / (1 - nu^2) [Pa].
    double
    plane_strain_modulus() const;
  };


  /// @throws NMM::InputError for an unreadable file, unknown keys or bad values.
  Parameters
  read_parameters(const std::string &file_name);


  /// Hertz's line contact of a cylinder with a rigid plane, per unit thickness.
  struct Hertz
  {
    /// [m], [N/m], [Pa]
    double half_width, force, peak;
    /// Of the two plates that press the cylinder, from the far field of both
    /// contacts [m].
    double approach;

    static Hertz
    from_half_width(const Parameters &parameters, double half_width);

    static Hertz
    from_force(const Parameters &parameters, double force);

    /// [Pa]
    double
    pressure(double x) const;
  };


  /// A point of the contact: distance from the axis [m], pressure [Pa], length it
  /// stands for [m].
  struct PressurePoint
  {
    double x = 0., pressure = 0., weight = 0.;
  };


  /// One row of the tables.
  struct Measurement
  {
    Enforcement  enforcement = Enforcement::augmented;
    double       half_width = 0., contact_size = 0.;
    unsigned int n_unknowns = 0;
    unsigned int n_steps = 0, n_iterations = 0, n_augmentations = 0, n_cuts = 0;
    /// Relative to Hertz's solution [-].
    double force_error = 0., peak_error = 0., half_width_error = 0.,
           last_point_error = 0., pressure_error = 0., ripple = 0.;
    /// [m]
    double penetration = 0.;
    /// Geometry and cutting; covers and quadrature; solution; all of it [s].
    double cutting_time = 0., setup_time = 0., solution_time = 0.,
           total_time = 0.;
    std::vector<PressurePoint> pressure;
    /// Approach [m] -> force [N/m].
    std::map<double, double> forces;
    /// Largest error of the force against the reference where that is converged
    /// (from half the approach on), and below [-].
    double converged_error = 0., early_error = 0.;
  };

  /// Fill in the errors from the pressure and the force.
  void
  compare(const Hertz &hertz, double force, Measurement &measurement);

  /// Fill in the errors against disk_compression.csv.
  void
  compare_forces(const Parameters &parameters, Measurement &measurement);

  /// Approach over R -> F / (E R), neo-Hookean.
  /// @throws NMM::InputError if the built-in table is damaged.
  std::map<double, double>
  read_reference();


  /// The press at one stage.
  struct Stage
  {
    /// [m], [N/m]: mean of both contacts, and their difference.
    double approach = 0., force = 0., force_difference = 0.;
    /// Cauchy pressure at the lower contact.
    std::vector<PressurePoint> pressure;
    /// Deformed lines, each a list of points [m].
    std::vector<std::vector<dealii::Point<2>>> outlines, material_lines;
  };

  struct PressResult
  {
    Measurement        measurement;
    std::vector<Stage> stages;
  };


  /// Rows of the tables.
  Tutorial::Row
  hertz_row(const Measurement &measurement);

  Tutorial::Row
  compression_row(const Measurement &measurement);

  void
  print_press(const Parameters &parameters, const PressResult &result);

  /// Write what the figures show as files whose names begin with @p prefix.
  void
  write_results(const Parameters               &parameters,
                const std::vector<Measurement> &hertz,
                const std::vector<Measurement> &compression,
                const std::vector<PressResult> &press,
                const std::string              &prefix);

  /// PNG files by gnuplot; says so if it is not there.
  void
  draw_figures(const std::string &prefix);
} // namespace StepNMM3

#endif
