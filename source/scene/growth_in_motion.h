#ifndef nmm_source_scene_growth_in_motion_h
#define nmm_source_scene_growth_in_motion_h

#include <nmm/covers/graded_mesh.h>
#include <nmm/materials/material.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <scene/crack_growth.h>
#include <vector>

namespace NMM
{
  /// Reads or writes the size of cells at a point, for checkpoints.
  template <typename Archive>
  void
  serialize(Archive &archive, LocalSize &size, const unsigned int /*version*/)
  {
    archive &size.point &size.size &size.growth &size.exponent &size.length;
  }


  namespace internal
  {
    /// What a checkpoint holds of cracks that grow while the solid moves, beside the state.
    struct SavedGrowth
    {
      std::vector<Increment> increments;
      /// See GrowthInMotion.
      std::vector<dealii::Point<2>> running_tips;
      double                        arrival = 0.;
      /// Sizes of cells where tips have been.
      std::vector<LocalSize> sizes;
      /// Intensity factors of all tips in the present state.
      std::vector<IntensityFactors> factors;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &increments &running_tips &arrival &sizes &factors;
      }
    };


    /**
     * Cracks that grow while the solid moves: which tips grow next, and what has grown.
     *
     * A tip grows by one increment at the end of a time step in which its K_eq reaches the
     * toughness. The increment takes the time that a crack at the speed of growth v needs for it,
     * @f[ \tau = \Delta a / v, @f]
     * in which the closing forces of its faces fade, see ClosingForces. The intensity
     * factors of the new tip mean something only afterwards, and it grows again then at the
     * earliest. Hence v is the largest speed of a crack. Without a value from the scene it is
     * half of the speed of Rayleigh waves: cracks are not observed to run much faster.
     * Source: K. Ravi-Chandar, W. Knauss, Int. J. Fract. 26 (1984), 141-154.
     */
    class GrowthInMotion
    {
    public:
      explicit GrowthInMotion(const FractureParameters &parameters);

      /// The tips that grow at the time @p t [s], and the new ones that start, of those that were
      /// judged.
      std::vector<GrowingTip>
      find_growing_tips(std::vector<GrowingTip> judged, double t) const;

      /// Whether cracks may grow further.
      bool
      has_increments_left() const;

      /// Longest time that one of the increments takes [s]; the closing forces of all of them fade
      /// in this time.
      double
      travel_time(const std::vector<GrowingTip> &tips,
                  const ElasticityProblem       &problem,
                  const PhysicalMesh            &physical_mesh) const;

      /// Takes note of increments that were made in the step @p step at the time @p t [s] and take
      /// the time @p duration [s].
      void
      add(unsigned int                   step,
          double                         t,
          double                         duration,
          const std::vector<GrowingTip> &tips);

      const GrowthTable &
      table() const;

      /// Whether an increment was made at the end of the step @p step.
      bool
      has_grown_in(unsigned int step) const;

      /// Writes all members to @p saved.
      void
      save(SavedGrowth &saved) const;

      /// Takes over what save() has written in an earlier part of the run. @pre No increment was
      /// made yet.
      void
      restore(const SavedGrowth &saved);

    private:
      const FractureParameters *parameters;
      GrowthTable               increments;
      /// The tips of the last increments, and the time at which they arrive there [s].
      std::vector<dealii::Point<2>> running_tips;
      double                        arrival = 0.;

      /// The speed of growth in @p material [m/s].
      double
      speed(const Material &material) const;
    };
  } // namespace internal
} // namespace NMM

#endif
