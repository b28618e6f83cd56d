#ifndef step_nmm_1_study_h
#define step_nmm_1_study_h

// What surrounds the method in step-nmm-1: parameters, measurements and figures.

#include <nmm/covers/aggregation.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/thick_ring.h>

#include <deal.II/base/timer.h>

#include "tutorial/table.h"
#include <functional>
#include <string>
#include <vector>

namespace StepNMM1
{
  enum class RingShape
  {
    quarter,
    half,
    full
  };


  struct Parameters
  {
    RingShape shape = RingShape::quarter;
    /// [m], [m], [Pa], [Pa], [-]
    double inner_radius = 1., outer_radius = 2., pressure = 1.;
    double youngs_modulus = 1000., poissons_ratio = 0.25;

    /// Edge lengths of the regular triangles [m].
    std::vector<double> cell_sizes =
      {0.23, 0.12, 0.0603, 0.0301, 0.01505, 0.0076};
    double aggregation_threshold = NMM::default_aggregation_threshold;
    /// Width of the zone of smaller triangles at the inner circle [m].
    double refined_width = 0.3;
    /// Where the mesh lies against the ring [m], [degrees].
    dealii::Tensor<1, 2> offset{{0.003, 0.002}};
    double               rotation = 7.;

    unsigned int n_placements        = 10;
    unsigned int seed                = 1;
    double       placement_cell_size = 0.0575;

    NMM::Material
    material() const;
  };


  /// @throws NMM::InputError for an unreadable file, unknown keys or bad values.
  Parameters
  read_parameters(const std::string &file_name);


  /// One row of the table.
  struct Measurement
  {
    std::string  method;
    unsigned int degree    = 2;
    double       cell_size = 0.;
    /// Unknowns of the linear system; values that aggregation expresses through
    /// them come on top.
    unsigned int n_unknowns = 0, n_elements = 0;
    /// Of the matrix; fitted elements only.
    std::size_t n_nonzeros = 0;
    /// Relative errors [-]: L2 of displacement and stress, largest of the hoop
    /// stress along the radius, direct and recovered.
    double error_u = 0., error_stress = 0.;
    double error_hoop = 0., error_hoop_recovered = 0.;
    /// Wall time from the curves to the displacements, and per stage [s].
    double                                      total = 0.;
    std::vector<std::pair<std::string, double>> stages;
    /// Largest resident size of the process so far [MB].
    double memory = 0.;
  };


  /// Laps of wall time, written into a measurement.
  class StageClock
  {
  public:
    explicit StageClock(Measurement &measurement);

    /// The stage @p name ends here.
    void
    lap(const std::string &name);

    /// The total ends here.
    void
    stop();

  private:
    Measurement  *measurement;
    dealii::Timer timer;
    double        last = 0.;
  };


  using StressAt =
    std::function<dealii::SymmetricTensor<2, 2>(const dealii::Point<2> &)>;

  /// Hoop stress along the radius at 45 degrees [Pa].
  Tutorial::Table
  sample_hoop(const NMM::ThickRing &exact,
              const Parameters     &parameters,
              const StressAt       &direct,
              const StressAt       &recovered);

  /// Largest |sigma_theta - exact| / exact on three radii (15, 45 and 75
  /// degrees), 101 points each from the inner to the outer circle inclusive.
  double
  largest_hoop_error(const NMM::ThickRing &exact,
                     const Parameters     &parameters,
                     const StressAt       &stress);

  /// A row of the table, with orders of convergence from the next coarser mesh of the method, if
  /// there is one.
  Tutorial::Row
  row(const Measurement &measurement, const Measurement *coarse = nullptr);

  /// PNG files by gnuplot; says so if it is not there.
  void
  draw_figures(const std::string &prefix);
} // namespace StepNMM1

#endif
