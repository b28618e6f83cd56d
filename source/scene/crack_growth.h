#ifndef nmm_source_scene_crack_growth_h
#define nmm_source_scene_crack_growth_h

#include <nmm/fracture/crack_start.h>
#include <nmm/fracture/growth_criterion.h>
#include <nmm/geometry/crack_extension.h>
#include <nmm/output/output_directory.h>

#include <optional>
#include <scene/crack_tips.h>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /// Reads or writes intensity factors, for checkpoints.
  template <typename Archive>
  void
  serialize(Archive          &archive,
            IntensityFactors &k,
            const unsigned int /*version*/)
  {
    archive &k.K_I &k.K_II &k.T &k.energy_release_rate &k.radius &k.spread;
  }


  namespace internal
  {
    /// The arguments of a call of extend_crack() or start_crack().
    struct CrackAdvance
    {
      /// The tip before [m], and the unit direction from there.
      dealii::Point<2>     tip;
      dealii::Tensor<1, 2> direction;
      /// Length of the increment [m].
      double length = 0.;
      /// Name of the crack.
      std::string name;
      /// Whether a new crack starts, by start_crack().
      bool is_new = false;

      CrackExtension
      extend(Geometry &geometry) const;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &tip &direction &length &name &is_new;
      }
    };


    /// A tip that grows, or a place at which a crack starts, with the reason and the result.
    struct GrowingTip
    {
      /// If a new crack starts here (CrackAdvance::is_new), the tip has a point, a direction and a
      /// region only, and neither factors nor verdict.
      CrackTip                 tip;
      IntensityFactors         factors;
      GrowthCriterion::Verdict verdict;
      /// Mean stress across a crack that starts, see find_crack_starts() [Pa].
      double mean_stress = 0.;
      /// K_eq / K_c, or of a crack that starts the mean stress over the strength [-].
      double drive = 0.;
      /// Of the increment, from the tip's direction [rad]; with an implicit criterion it is
      /// turned after each trial.
      double angle = 0.;
      /// How it grows; complete after extend_by_increment().
      CrackAdvance   advance;
      CrackExtension extension;
      /// Angle of the previous trial [rad] and its residual [rad], see
      /// CrackGrowthAnalysis::turn_increments(), if there was one.
      std::optional<std::pair<double, double>> last_trial;
    };


    /// The criterion that the scene asks for.
    const GrowthCriterion &
    growth_criterion(const FractureParameters &parameters);

    /// The tips of @p tips that can grow, since they do not lie on an interface, with what the scene's
    /// criterion says of their factors, which were computed.
    std::vector<GrowingTip>
    judge_tips(const CrackTips          &tips,
               const FractureParameters &parameters,
               const ElasticityProblem  &problem,
               const PhysicalMesh       &physical_mesh);

    /// Extends the crack of a tip in @p geometry by one increment at the tip's angle, or lets a
    /// new one start.
    void
    extend_by_increment(GrowingTip               &growing,
                        const FractureParameters &parameters,
                        Geometry                 &geometry);


    /// An increment that was made: all that is needed to make it again, and a row of growth.csv.
    struct Increment
    {
      /// Number of the step in which it was made. Increments of the same step were cut together.
      unsigned int step = 0;
      /// Load factor [-] or time [s].
      double       value = 0.;
      CrackAdvance advance;
      /// Intensity factors before; not those of a crack that started.
      IntensityFactors factors;
      /// From the direction of the tip before [rad].
      double angle = 0.;
      /// The tip after [m], and what the crack has met there; see CrackExtension.
      dealii::Point<2> end;
      std::string      met;
      /// Mean stress across a crack that started, see CrackStart [Pa].
      double start_stress = 0.;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &step &value &advance &factors &angle &end &met &start_stress;
      }
    };


    /// Checks increments of a checkpoint, from which cracks are to grow again. @throws InputError
    /// if their numbers cannot be those of an increment.
    void
    check_increments(const std::vector<Increment> &increments);


    /// The increments by which cracks have grown, and growth.csv.
    class GrowthTable
    {
    public:
      /// @p value_name is the name of the column for the load factor or time.
      explicit GrowthTable(std::string value_name);

      /// Adds an increment that was made in the step @p step, at the load factor [-] or time [s]
      /// @p value.
      void
      add(unsigned int step, double value, const GrowingTip &tip);

      /// Adds an increment that an earlier part of the run has made.
      void
      add(const Increment &increment);

      /// All increments in the order in which they were made.
      const std::vector<Increment> &
      increments() const;

      unsigned int
      n_increments() const;

      /// Sum of the lengths of all increments [m].
      double
      grown_length() const;

      /// Writes growth.csv. For use on one rank.
      void
      write(const OutputDirectory &directory) const;

    private:
      std::string            value_name;
      std::vector<Increment> rows;
      double                 length = 0.;
    };


    /**
     * Adds the places where cracks are most likely to start to @p judged.
     *
     * A crack takes the stress from the boundary beside it over a few times its length, but in
     * motion not at once. Therefore no crack starts within five increments of a tip, of a place
     * where another one has started, or of one that starts at the same time. @p earlier are the
     * increments that were made.
     */
    void
    add_new_tips(std::vector<GrowingTip>  &judged,
                 const CrackTips          &tips,
                 const GrowthTable        &earlier,
                 const FractureParameters &parameters,
                 const ElasticityProblem  &problem,
                 const CoverSystem        &covers,
                 const ElementStress      &stress);
  } // namespace internal
} // namespace NMM

#endif
