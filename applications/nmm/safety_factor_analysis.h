#ifndef nmm_applications_safety_factor_analysis_h
#define nmm_applications_safety_factor_analysis_h

#include <nmm/dynamics/elastic_models.h>
#include <nmm/dynamics/strength_reduction.h>

#include "scene_analysis.h"
#include <memory>
#include <string>
#include <vector>

/**
 * The factor by which the strength of all contacts can be divided before blocks move:
 * trials of relaxation, each from the same state, between which the factor is
 * bracketed and bisected. What is shown is how it goes: the displacements of the
 * trial with the smallest factor that moves; if none moves, those at the largest
 * factor; if a trial fails, which ends the search, its last good state.
 *
 * safety_factor.csv has a row per trial and is complete after each of them.
 */
class SafetyFactorAnalysis : public SceneAnalysis
{
public:
  using SceneAnalysis::SceneAnalysis;

  void
  solve() override;

  void
  verify() override;

private:
  using Vector = NMM::MechanicalModel::Vector;

  // Each object refers to those above it.
  std::unique_ptr<NMM::QuadratureCollection> mass_quadrature;
  std::unique_ptr<NMM::FiniteElasticity>     elasticity;
  std::unique_ptr<NMM::ElasticModel>         model;

  /// What each trial starts from, if not from nothing.
  Vector              settled;
  std::vector<double> settled_contact;
  unsigned int        n_start_steps = 0;

  NMM::SafetyFactor result;
  /// Of trials so far.
  std::vector<NMM::StrengthTrial> trials;
  /// What is shown.
  NMM::StrengthTrial     shown;
  Vector                 shown_displacement;
  ContactAnalysis::State shown_contact;

  void
  make_system() override;

  /// Equilibrium under full strength.
  void
  settle();

  NMM::StrengthTrial
  try_factor(double factor);

  /// Shall this trial be shown, rather than the one that is?
  bool
  tells_more(const NMM::StrengthTrial &trial) const;

  /// No bracket was found, or a trial failed. @throws NMM::NumericalFailure.
  void
  give_up();

  /// Part of a message: what the trials that did not fail have shown.
  std::string
  what_is_known() const;

  void
  write_trials() const;

  /// Make field, recovery and evaluator those of what is shown.
  void
  show();

  double
  last_value() const override;

  std::string
  unsolved_note() const override;
};

#endif
