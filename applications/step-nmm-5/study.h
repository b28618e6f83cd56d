#ifndef step_nmm_5_study_h
#define step_nmm_5_study_h

// What surrounds the method in step-nmm-5: parameters, the exact solution and figures.

#include <nmm/covers/crack_tip.h>
#include <nmm/materials/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <complex>
#include <string>
#include <vector>

namespace StepNMM5
{
  /// Parameters of the program.
  struct Parameters
  {
    /// Sizes of cells at the free radius of the tip over that radius [-].
    std::vector<double> gradings = {0.5, 0.35, 0.25, 0.175, 0.125};
    /// Sizes of cells of uniform meshes [m].
    std::vector<double> cell_sizes = {0.2, 0.1, 0.05, 0.025};
    /// Lengths of the increments in the beam [in].
    std::vector<double> increments = {0.4, 0.2, 0.1};
    /// Size of its cells [in].
    double beam_cell_size = 0.5;
    /// Like gradings, for the beam [-].
    double beam_grading = 0.25;
    /// Number of the wings' increments, 0 to leave that part out, and their length [m].
    unsigned int n_wing_increments = 6;
    double       wing_increment    = 0.05;
    /// Until when the slope is followed [s]; 0 to leave that part out.
    double      slope_end_time = 2.5;
    std::string output_directory;
  };

  /// @throws NMM::InputError for an unreadable file, unknown keys or bad values.
  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory);


  /**
   * Westergaard's solution: an infinite plane in equibiaxial tension sigma with a crack of length 2a,
   * in the frame of one of its tips, z = x_1 + i x_2 from there:
   * @f[ Z = \sigma\frac{z+a}{\sqrt{z(z+2a)}},\qquad K_I = \sigma\sqrt{\pi a},\qquad K_{II}=T=0,
       \qquad 2\mu u_1 = \tfrac{\kappa-1}{2}\mathrm{Re}\bar Z - x_2\,\mathrm{Im}Z,\qquad
       2\mu u_2 = \tfrac{\kappa+1}{2}\mathrm{Im}\bar Z - x_2\,\mathrm{Re}Z @f]
   * with the integral Zbar of Z.
   */
  class Westergaard
  {
  public:
    /// Half of the crack's length [m] and the tension [Pa].
    static constexpr double a = 1., sigma = 1.;

    /// The lifetime of neither argument matters.
    Westergaard(const NMM::CrackTip        &tip,
                const NMM::PlaneElasticity &elasticity);

    /// [m]
    dealii::Tensor<1, 2>
    displacement(const dealii::Point<2> &x) const;

    /// [Pa]
    dealii::SymmetricTensor<2, 2>
    stress(const dealii::Point<2> &x) const;

    /// K_I [Pa m^(1/2)]
    static double
    K_I();

  private:
    /// x in the frame of the tip.
    std::complex<double>
    local(const dealii::Point<2> &x) const;

    dealii::Point<2>     tip;
    dealii::Tensor<2, 2> frame;
    NMM::PlaneElasticity elasticity;
  };


  /// The way of the crack through the beam.
  struct CrackPath
  {
    std::string criterion;
    /// Length of an increment [in].
    double                        increment = 0.;
    std::vector<dealii::Point<2>> points;
    /// At which each increment grows, over that of the first one [-].
    std::vector<double> loads;
    /// Curve at which it ends; empty: it did not arrive anywhere.
    std::string end;

    /// Where it passes the height @p y [in]; not a number if it does not.
    double
    x_at(double y) const;
  };

  /// The increments in the slope and the states at which a crack arrives somewhere, from the tables in
  /// the folder @p directory.
  void
  print_slope(const std::string &directory);

  /// Write the paths as files whose names begin with @p prefix.
  void
  write_paths(const std::string &prefix, const std::vector<CrackPath> &paths);

  /// Draw figures of these files and of the table of errors, "PREFIXstudy.csv".
  void
  draw_figures(const std::string &prefix);
} // namespace StepNMM5

#endif
