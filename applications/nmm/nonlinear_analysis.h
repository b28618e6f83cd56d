#ifndef nmm_applications_nonlinear_analysis_h
#define nmm_applications_nonlinear_analysis_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/incremental_elasticity.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include "scene_analysis.h"
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/**
 * Large displacements under growing load, by FiniteElasticity and Newton's
 * method or by IncrementalElasticity. If a load step fails, the last one that
 * converged is what is written.
 */
class NonlinearAnalysis : public SceneAnalysis
{
public:
  using SceneAnalysis::SceneAnalysis;

  void
  solve() override;

  void
  verify() override;

private:
  using Vector = NMM::FiniteElasticity::Vector;
  using Stress = dealii::SymmetricTensor<2, 2>;

  /// A row of history.csv.
  struct HistoryRow
  {
    double       load_factor       = 0.;
    unsigned int n_iterations      = 0;
    unsigned int n_cuts            = 0;
    unsigned int n_lost_iterations = 0;
    /// NaN in incremental kinematics, which has none.
    double relative_residual = 0.;
    /// [J].
    double strain_energy = 0.;
    /// [m].
    double max_displacement = 0.;
    /// Of probes that are points [m].
    std::vector<dealii::Tensor<1, 2>> probe_displacements;
  };

  /// A solution to be written.
  struct State
  {
    double load_factor;
    Vector solution;
    /// IncrementalElasticity::stresses(); empty in finite kinematics.
    std::vector<Stress> stresses;
  };

  /// Stress of an element as a linear function of reference coordinates [Pa].
  struct LinearStress
  {
    Stress           mean, slope[2];
    dealii::Point<2> center;
  };

  std::unique_ptr<NMM::FiniteElasticity>      finite;
  std::unique_ptr<NMM::IncrementalElasticity> incremental;
  /// Why there are no equations: a block floats. Not an input error, so it waits
  /// until solve().
  std::exception_ptr        failure;
  std::vector<unsigned int> region_to_material;
  /// Where the largest displacement is looked for: elements and reference
  /// coordinates.
  std::vector<std::pair<unsigned int, dealii::Point<2>>> output_points;

  std::vector<HistoryRow> history;
  /// The last state, and those of the series of fields.
  std::unique_ptr<State> last_state;
  std::vector<State>     series;
  /// Of the state the evaluator shows, per owned element.
  std::vector<LinearStress> linear_stresses;

  void
  make_system() override;

  void
  run_finite();

  void
  run_incremental();

  /// Note a load step that converged, and say so.
  void
  add_step(HistoryRow row, const Vector &solution);

  /// Make field, recovery and evaluator those of @p state.
  void
  show(const State &state);

  void
  fit_stresses(const State &state);

  NMM::FieldSample::Stress
  finite_stress(unsigned int                element,
                const dealii::Tensor<2, 2> &gradient) const;

  NMM::FieldSample::Stress
  incremental_stress(unsigned int element, const dealii::Point<2> &xi) const;

  /// In incremental kinematics, of the stress carried along [J].
  double
  incremental_strain_energy() const;

  void
  write_more(const NMM::OutputDirectory &directory) override;

  void
  write_history(std::ostream &out) const;
};

#endif
