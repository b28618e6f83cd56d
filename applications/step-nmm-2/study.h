#ifndef step_nmm_2_study_h
#define step_nmm_2_study_h

// What surrounds the method in step-nmm-2: parameters, reference values, tables
// and figures.

#include <nmm/covers/graded_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include "tutorial/table.h"
#include <array>
#include <map>
#include <string>
#include <vector>

namespace StepNMM2
{
  enum class Load
  {
    /// Keeps its direction.
    dead,
    /// Pressure on top, suction below.
    follower
  };

  constexpr Load loads[] = {Load::dead, Load::follower};

  std::string
  name(Load load);


  struct Parameters
  {
    /// [m], [m], [Pa], [-]
    double length = 10., height = 1.;
    double youngs_modulus = 120000., poissons_ratio = 0.2;
    /// K = P L^3 / (E I) at the end.
    double last_load = 10.;

    /// Edge lengths of the triangles far from the clamped corners [m].
    std::vector<double> cell_sizes = {0.6, 0.33, 0.22, 0.139, 0.09};
    /// Edge length at the corners over the one far away, and its growth per
    /// distance.
    double corner_ratio = 0.3, corner_growth = 0.3;
    /// Where the mesh lies against the beam [m], [degrees].
    dealii::Tensor<1, 2> offset{{0.03, 0.02}};
    double               rotation = 7.;

    unsigned int              n_load_steps = 5;
    std::vector<unsigned int> increments   = {10, 20, 50, 100, 200, 500, 1000};
    /// Cell size of the runs by increments, the random placements and the figures
    /// [m].
    double       cell_size    = 0.33;
    unsigned int n_placements = 5, seed = 1;

    /// I of the section [m^3 per unit thickness].
    double
    section() const;

    /// P [Pa m / m] at load factor 1.
    double
    force() const;
  };


  /// @throws NMM::InputError for an unreadable file, unknown keys or bad values.
  Parameters
  read_parameters(const std::string &file_name);


  /// -v / L and -u / L of the point (L, H/2) by K: Euler's elastica, Reissner's
  /// beam, the solid (NaN where not given).
  struct Reference
  {
    std::array<double, 2> euler, reissner, solid;
  };

  /// @throws NMM::InputError if the built-in table is damaged.
  std::map<double, Reference>
  read_reference(Load load);


  /// One row of the tables.
  struct Measurement
  {
    Load         load = Load::dead;
    std::string  kinematics, mesh;
    unsigned int degree     = 2;
    double       cell_size  = 0.;
    unsigned int n_unknowns = 0;
    unsigned int n_steps = 0, n_iterations = 0;
    /// K -> -v / L.
    std::map<double, double> deflection;
    /// Largest error of it relative to the solid's [-].
    double largest_error = 0.;
    /// From the curves to the last answer; per Newton iteration (or
    /// increment): assembly, factorization, solution; one linear problem on the same
    /// covers [s].
    double total_time = 0., iteration_time = 0., linear_time = 0.;
  };

  /// Fill in largest_error.
  void
  compare(Measurement &measurement);

  /// A row of the table.
  Tutorial::Row
  row(const Measurement &measurement);


  /// For the figures: the tip by K, and outlines of the deformed beam.
  struct Curves
  {
    /// K -> (-v, -u) / L.
    std::map<double, std::array<double, 2>> tip;
    /// K -> points along the boundary [m].
    std::map<double, std::vector<dealii::Point<2>>> outlines;
  };

  /// Write the curves as files whose names begin with @p prefix.
  void
  write_curves(const std::string &prefix, const std::map<Load, Curves> &curves);

  /// PNG files by gnuplot; says so if it is not there.
  void
  draw_figures(const std::string &prefix);
} // namespace StepNMM2

#endif
