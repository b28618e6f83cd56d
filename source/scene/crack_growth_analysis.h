#ifndef nmm_source_scene_crack_growth_analysis_h
#define nmm_source_scene_crack_growth_analysis_h

#include <nmm/fracture/growth_criterion.h>
#include <nmm/geometry/crack_extension.h>

#include <limits>
#include <optional>
#include <scene/contact_loading.h>
#include <scene/static_analysis.h>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Cracks that grow in equilibrium: small displacements, elastic materials.
     *
     * A tip is driven by the ratio of its equivalent intensity factor to the toughness. The crack
     * whose ratio d is largest grows first, at the load factor at which d = 1. That is the
     * equilibrium path for cracks of all lengths, also where the load that it takes, or the
     * displacement, goes back. Without contact everything is proportional to the loads, so that
     * @f[ \lambda = \min_\mathrm{tips} \frac{K_c}{K_\mathrm{eq}(1)}; @f]
     * fields, pictures, probes and tips are those of the last state under the loads as given. With
     * contact the secant method finds it to a thousandth of d, and they are those at
     * that load factor.
     *
     * After each increment the solid is cut and meshed anew and loaded from zero. With friction
     * that is the path of a crack whose faces slide in one direction only; slip that
     * would go back, or lock, while the crack grows is not followed.
     */
    class CrackGrowthAnalysis : public StaticAnalysis
    {
    public:
      using StaticAnalysis::StaticAnalysis;

      void
      solve() override;

      void
      verify() override;

    private:
      void
      make_system() override;

      void
      clear() override;

      /// A tip that grows, and how.
      struct GrowingTip
      {
        CrackTip                 tip;
        IntensityFactors         factors;
        GrowthCriterion::Verdict verdict;
        /// K_eq / K_c
        double         drive = 0.;
        CrackExtension extension;
        /// Angle of the trial before and K_II / K_I at its end, if there was one.
        std::optional<std::pair<double, double>> last_trial;
      };

      /// A state of equilibrium, at the load factor at which the next increment grows.
      struct State
      {
        double              load_factor, crack_length, strain_energy;
        std::vector<double> probes;
      };

      /// A row of growth.csv.
      struct Increment
      {
        unsigned int step;
        double       load_factor;
        GrowingTip   tip;
      };

      /// Null without contact.
      std::unique_ptr<ContactLoading> contact_loading;
      std::vector<State>              states;
      std::vector<Increment>          increments;
      /// Of the last state.
      std::vector<GrowingTip> growing_tips;
      /// At which they grow; not a number if no load makes one grow.
      double load_factor  = std::numeric_limits<double>::quiet_NaN();
      double grown_length = 0.;
      /// Why it came to an end; empty: it did not.
      std::string end_reason;
      /// Increments of which turning did not take away the shear.
      unsigned int n_with_shear = 0;

      const GrowthCriterion &
      criterion() const;

      /// Equilibrium at the load factor at which a crack grows, or of the linear problem; the
      /// tips that do, and that load factor.
      void
      equilibrate();

      /// The same with contact.
      void
      equilibrate_contact();

      /// The tips that grow next, into growing_tips. Returns the largest K_eq / K_c of all
      /// tips, 0 if none is driven.
      double
      find_growing_tips();

      /// That of the fields over the load factor at which cracks grow.
      double
      scale_of_fields() const;

      void
      take_state();

      /// Fields and a picture of this state, if it is one of those that the scene asks for.
      void
      show_state();

      double
      last_value() const override;

      /// One increment of each tip that grows. False if there is none, or a block
      /// came free; end_reason says so.
      bool
      grow();

      /// Cut and solve with all tips grown by their angles.
      void
      try_increments(std::vector<GrowingTip> &tips);

      /// Back to a geometry that was solved before.
      void
      restore(const Geometry &before);

      /// Turn increments at whose tips there is shear. False if there are none.
      bool
      turn_increments(std::vector<GrowingTip> &tips) const;

      void
      write_tables() const;
    };
  } // namespace internal
} // namespace NMM

#endif
