#ifndef step_nmm_3_hertz_h
#define step_nmm_3_hertz_h

// The parameters of step-nmm-3, and what its results are compared with.

#include "tutorial/table.h"
#include "tutorial/tutorial.h"
#include <array>
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
  struct Parameters : Tutorial::ParameterFile
  {
    using ParameterFile::ParameterFile;

    /// [m], [Pa], [-]
    double radius = 1., youngs_modulus = 1e6, poissons_ratio = 0.25;
    double plate_modulus = 1e9;
    /// The paper's springs, 200,000 t/m, taken per length of contact [Pa/m].
    double spring = 200000. * 9806.65;
    /// Of the top plate at the end [m].
    double approach = 0.4;

    /// Of Hertz's contact over the radius [-].
    std::vector<double> half_widths = get<std::vector<double>>(
      "Half-widths",
      {0.1, 0.05},
      dealii::Patterns::List(dealii::Patterns::Double(1e-3, 0.2), 1));
    /// Edge length of triangles at the contact over the half-width.
    std::vector<double> contact_ratios =
      get<std::vector<double>>("Contact ratios",
                               {0.4, 0.3, 0.2, 0.1, 0.05},
                               positive_list);
    /// Edge length far from it [m], growth per distance [-].
    double cell_size = get("Cell size", 0.2, positive);
    double growth    = get("Growth", 0.2, dealii::Patterns::Double(1e-3, 1.));
    /// Where the mesh lies.
    Tutorial::Placement placement = {
      get("Offset", dealii::Tensor<1, 2>({0.0123, 0.0321})),
      get("Rotation", 6.)};
    unsigned int n_placements =
      get("Placements", 10u, dealii::Patterns::Integer(0));
    unsigned int seed = get("Seed", 1u, dealii::Patterns::Integer(0));
    /// Of timed runs, of which the fastest counts.
    unsigned int n_repetitions =
      get("Repetitions", 3u, dealii::Patterns::Integer(1));

    /// Edge lengths at the contact, quarter disk to 0.4 m and the press [m].
    std::vector<double> compression_sizes =
      get<std::vector<double>>("Compression sizes",
                               {0.08, 0.04, 0.02},
                               positive_list);
    double press_size = get("Press size", 0.05, positive);
    /// Equal ones up to the whole approach.
    unsigned int n_load_steps =
      get("Load steps", 20u, dealii::Patterns::Integer(1, 1000));

    /// E / (1 - nu^2) [Pa].
    double
    plane_strain_modulus() const;
  };


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


  /// Errors of the force and of the pressure relative to Hertz's [%].
  Tutorial::Row
  compare(const Hertz                      &hertz,
          double                            force,
          const std::vector<PressurePoint> &points);

  /// A load step of the press beside Hertz at the same force: forces from below and from above [N/m],
  /// largest pressure and half-width of all points.
  Tutorial::Row
  stage_row(double                            approach,
            const std::array<double, 2>      &forces,
            const Hertz                      &hertz,
            const std::vector<PressurePoint> &points);

  /// Add the pressure by place, and Hertz's, as a block for gnuplot.
  void
  add_stage(std::vector<PressurePoint> points,
            const Hertz               &hertz,
            Tutorial::Table           &pressure,
            Tutorial::Table           &hertz_pressure);

  /// Largest errors of forces by approach against disk_compression.csv [-]: where that is
  /// converged, from half of the largest approach on, and below.
  Tutorial::Row
  compare_forces(const Parameters               &parameters,
                 const std::map<double, double> &forces);
} // namespace StepNMM3

#endif
