#ifndef step_nmm_4_study_h
#define step_nmm_4_study_h

// What surrounds the method in step-nmm-4: parameters, tables, pictures.

#include <nmm/output/animation.h>
#include <nmm/output/output_directory.h>
#include <nmm/output/picture.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include "tutorial/table.h"
#include <memory>
#include <string>
#include <vector>

namespace StepNMM4
{
  /// The paper's numbers, and what it does not say.
  struct Parameters
  {
    /// [kg/m^3], [Pa], [-], [m/s^2]
    double density = 2500., youngs_modulus = 1e9, poissons_ratio = 0.2,
           gravity = 9.81;
    /// The paper's springs, 1,000,000 t/m, taken per length of a face [Pa/m].
    double spring = 1e6 * 9806.65;
    /// Dashpots, normal and along faces [Pa s/m].
    double dashpot = 2e7;
    /// Of the rock, times its stiffness [s]: a block's own vibrations, which steps do
    /// not resolve, end within a few milliseconds.
    double damping = 1e-3;

    /// Of layers [degrees], [m]; length of blocks along them [m].
    double dip = 30., layer = 2., block_length = 2.3;

    /// One run for each [degrees].
    std::vector<double> friction_angles = {35., 20.};
    /// Longest step [s], and whether what falls is computed with half of it, too.
    double step      = 0.01;
    bool   is_halved = true;
    /// What falls is computed once more with a friction angle that differs by this
    /// [degrees]; 0: it is not. Tells what of the end can be predicted at all.
    double perturbation = 1e-7;
    /// As many runs, with 1, 2, ... times this; if more than one, each with half of
    /// the step, too, to tell what the step does to their mean.
    unsigned int n_perturbed = 1;
    /// Runs end here, or at rest [s].
    double end_time = 12.;
    /// Rest: kinetic energy over what all would gain by falling as far as a block is
    /// wide, at most, for so long [s].
    double rest = 1e-7, rest_duration = 0.5;
    /// Of pictures besides the begin; the last one is at the end [s].
    std::vector<double> stages = {1., 2.};
    /// Between frames of the animation and rows of the table on the screen [s].
    double      frame_interval = 0.1, row_interval = 0.5;
    std::string output_directory = ".";
  };


  /// @throws NMM::InputError for an unreadable file, unknown keys or bad values.
  Parameters
  read_parameters(const std::string &file_name,
                  const std::string &output_directory);


  /// A row of the table: energies per unit thickness [J/m].
  struct Row
  {
    double           time = 0.;
    dealii::Point<2> center_of_mass;
    double           kinetic = 0., strain = 0., contact = 0., dissipated = 0.,
           external_work = 0., balance = 0.;
    unsigned int n_stick = 0, n_slip = 0;
    /// [m], and over the mean size of blocks [-].
    double penetration = 0., penetration_over_block = 0.;
    /// The same for how deep blocks are in each other, whether that presses or not.
    double overlap = 0., overlap_over_block = 0.;
  };


  /// What became of one run.
  struct Outcome
  {
    std::string      name;
    double           friction_angle = 0., step = 0.;
    unsigned int     n_blocks = 0, n_unknowns = 0;
    unsigned int     n_steps = 0, n_iterations = 0, n_cuts = 0;
    bool             is_at_rest = false;
    std::vector<Row> rows;
    /// Potential energy released until the end [J/m], and the largest error of the
    /// account over it [-].
    double released = 0., account_error = 0.;
    /// Largest and median of all steps, and of the last one, over the size of blocks [-].
    double largest_penetration = 0., median_penetration = 0.,
           penetration_at_rest = 0.;
    double largest_overlap = 0., median_overlap = 0., overlap_at_rest = 0.;
    /// Of the processor [s].
    double start_time = 0., motion_time = 0.;

    /// Fill in what follows from the rows.
    void
    finish();

    /// Is it at rest where it was, but for some settlement?
    bool
    stands() const;
  };


  /// The row in a table, whose first ten columns are for the screen.
  Tutorial::Row
  cells(const Row &row);

  /// Print a row per run, and what differs between runs that begin (nearly) the same; write a table of
  /// all steps of each run, and one of runs, as files whose names begin with @p prefix.
  void
  report_runs(const std::string &prefix, const std::vector<Outcome> &outcomes);

  /// For each friction angle and step: how far the centre of mass moves in the mean
  /// of all runs that begin (nearly) the same, and how much they scatter.
  void
  print_means(const std::vector<Outcome> &outcomes);


  /// Pictures of stages and the page that plays all frames, on the first rank.
  class Film
  {
  public:
    Film(const Parameters &parameters, const Outcome &outcome);

    /// How pictures are coloured.
    const NMM::PictureParameters &
    output() const;

    void
    add_frame(double time, const NMM::PictureData &data);

    void
    draw_stage(double time, const NMM::PictureData &data);

    void
    finish();

  private:
    NMM::PictureParameters          parameters;
    std::string                     prefix, title;
    std::unique_ptr<NMM::Animation> animation;
    unsigned int                    n_stages = 0;
  };
} // namespace StepNMM4

#endif
