#ifndef nmm_source_scene_safety_factor_analysis_h
#define nmm_source_scene_safety_factor_analysis_h

#include <nmm/dynamics/elastic_models.h>
#include <nmm/dynamics/strength_reduction.h>

#include <memory>
#include <scene/scene_analysis.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The factor by which the strength of all contacts and materials can be divided before blocks move:
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
      using Vector = MechanicalModel::Vector;

      // Each object refers to those above it.
      std::unique_ptr<QuadratureCollection> mass_quadrature;
      std::unique_ptr<FiniteElasticity>     elasticity;
      std::unique_ptr<ElasticModel>         model;

      /// What each trial starts from, if not from nothing.
      Vector            settled;
      ContactHistory    settled_contact;
      std::vector<char> settled_materials;
      unsigned int      n_start_steps = 0;

      SafetyFactor result;
      /// Of trials so far.
      std::vector<StrengthTrial> trials;
      /// What is shown.
      StrengthTrial          shown;
      Vector                 shown_displacement;
      ContactAnalysis::State shown_contact;
      std::vector<char>      shown_materials;

      void
      make_system() override;

      /// Equilibrium under full strength.
      void
      settle();

      StrengthTrial
      try_factor(double factor);

      /// Shall this trial be shown, rather than the one that is?
      bool
      tells_more(const StrengthTrial &trial) const;

      /// No bracket was found, or a trial failed. @throws NumericalFailure.
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
  } // namespace internal
} // namespace NMM

#endif
