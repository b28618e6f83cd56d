#ifndef nmm_source_scene_crack_growth_analysis_h
#define nmm_source_scene_crack_growth_analysis_h

#include <cstdint>
#include <limits>
#include <optional>
#include <scene/crack_growth.h>
#include <scene/load_path.h>
#include <scene/static_analysis.h>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The growth of cracks in equilibrium, in elastic materials.
     *
     * The drive d of a tip is the ratio of its equivalent intensity factor to the toughness. The
     * crack with the largest d grows first, at the load factor lambda at which d = 1. This gives
     * the equilibrium path for cracks of all lengths, also where the load or the displacement
     * decreases. Without contact and finite displacements everything is proportional to the loads, so that
     * @f[ \lambda = \min_\mathrm{tips} \frac{K_c}{K_\mathrm{eq}(1)}, @f]
     * and fields, pictures, probes and tips are those of the last state under the given loads. Otherwise
     * the secant method finds lambda up to an error of a thousandth in d, and fields,
     * pictures, probes and tips are those at that load factor.
     *
     * After each increment the solid is cut and meshed again. Unless everything is proportional, its
     * displacements and the history of contact are carried over, and the load continues from the load factor of the
     * shorter crack, upwards or downwards. Slip that locks or reverses while the crack grows is a
     * part of the path therefore.
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
      /// @throws InputError if this run is to continue that of another solid.
      void
      make_system() override;

      void
      clear() override;

      std::vector<Increment>
      earlier_increments() override;

      void
      open_files() override;

      /// Finds the last state before the checkpoint again. @throws InputError if that is another
      /// one now.
      void
      continue_path();

      /// A state of equilibrium, at the load factor at which the next increment grows.
      struct State
      {
        double              load_factor, crack_length, strain_energy;
        std::vector<double> probes;

        template <typename Archive>
        void
        serialize(Archive &archive, const unsigned int /*version*/)
        {
          archive &load_factor &crack_length &strain_energy &probes;
        }
      };

      /// What a checkpoint holds. The equations of the last state are made again from the
      /// increments.
      struct SavedPath
      {
        std::vector<Increment> increments;
        std::vector<State>     states;
        unsigned int           n_unturned = 0;
        /// That of the last state's solid, see CrackGrowthAnalysis::fingerprint().
        std::uint64_t fingerprint = 0;
        /// @{
        /// Along a load path, the state that was carried over to that solid, see LoadingState.
        double              carried_factor = 0., friction_work = 0.;
        std::vector<double> displacement;
        ContactHistory      history;
        /// @}

        template <typename Archive>
        void
        serialize(Archive &archive, const unsigned int /*version*/)
        {
          archive &increments &states &n_unturned &fingerprint &carried_factor
            &friction_work &displacement &history;
        }
      };

      /// @throws InputError if the parts of @p path do not fit each other, or numbers are not finite.
      static void
      check(const SavedPath &path);

      /// Null if everything is proportional to the loads.
      std::unique_ptr<LoadPath> load_path;
      /// Along a load path, the solid before the increments that are tried, and its state.
      std::optional<std::pair<FormerSolid, LoadingState>> former;
      /// Along a load path, the state that was carried over to the present solid; without loads before
      /// any increment.
      LoadingState       carried;
      std::vector<State> states;
      GrowthTable        increments{"load_factor"};
      /// The tips that grow next from the last state.
      std::vector<GrowingTip> growing_tips;
      /// Load factor at which they grow [-]; not a number if no load makes a tip grow.
      double load_factor = std::numeric_limits<double>::quiet_NaN();
      /// Why growth came to an end; empty if it did not.
      std::string end_reason;
      /// The fingerprint() of the last state, if the scene asks for checkpoints.
      std::uint64_t state_fingerprint = 0;
      /// Number of increments whose direction was not found.
      unsigned int n_unturned = 0;
      /// The path before the checkpoint from which this run continues, if it does.
      std::optional<SavedPath> earlier_path;

      /// Carries the state of the former solid over.
      LoadingState
      carry_over() const;

      /// The solid and its materials as one number, by which a checkpoint recognizes them.
      std::uint64_t
      fingerprint() const;

      /// Writes a checkpoint of the last state, if the scene asks for any.
      void
      write_checkpoint() const;

      /// Finds the equilibrium, the tips that grow next, and the load factor at which they do.
      void
      equilibrate();

      /// The same along a load path.
      void
      equilibrate_on_path();

      /// Whether displacements are not proportional to the loads.
      bool
      has_load_path() const;

      bool
      can_have_tip_covers() const override;

      ElasticityProblem
      problem_now() const override;

      void
      show(const dealii::TrilinosWrappers::MPI::Vector &solution) override;

      /// Sets growing_tips to the tips that grow next. Returns the largest K_eq / K_c of all
      /// tips; 0 if no tip is driven.
      double
      find_growing_tips();

      /// Load factor of the fields over that at which cracks grow [-].
      double
      scale_of_fields() const;

      void
      take_state();

      /// Writes fields and a picture of this state, if the scene asks for them.
      void
      show_state();

      double
      last_value() const override;

      /// Extends each tip that grows by one increment. Returns false if there is none, or if a
      /// block was separated; end_reason says so.
      bool
      grow();

      /// Extends all tips at their angles, cuts the solid and solves.
      void
      try_increments(std::vector<GrowingTip> &tips);

      /// Returns to a geometry that was solved before.
      void
      restore(const Geometry &before);

      /**
       * Turns increments that are not chords of a path of local symmetry yet; false if there is
       * none. Along such a path K_II vanishes. An increment is straight, so its direction is the
       * mean of the path's directions at both of its ends (the trapezoidal rule): that in which the
       * crack leaves its tip before, at the angle alpha_0, and that in which it would go on at the
       * end of the increment, turned by delta from it,
       * @f[ \alpha = \tfrac12(\alpha_0 + \alpha + \delta(\alpha))
           \quad\Leftrightarrow\quad \delta(\alpha) - (\alpha-\alpha_0) = 0. @f]
       * If K_II vanished at the end of each increment, their directions would be those of their
       * ends, and the path would converge with order one, as it does with explicit
       * criteria. This one has the order 3/2: a chord shifts the faces near the tip by the
       * square of its length, to which the T-stress adds shear in proportion to the power 3/2.
       */
      bool
      turn_increments(std::vector<GrowingTip> &tips) const;

      void
      write_tables() const;
    };
  } // namespace internal
} // namespace NMM

#endif
