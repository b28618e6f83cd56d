#ifndef nmm_source_scene_crack_tips_h
#define nmm_source_scene_crack_tips_h

#include <nmm/fracture/intensity_factors.h>
#include <nmm/output/output_directory.h>
#include <nmm/output/progress.h>
#include <nmm/scene/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The crack tips of a scene that asks for their intensity factors, and tips.csv.
     *
     * Lifetime: the scene must outlive it.
     */
    class CrackTips
    {
    public:
      CrackTips(const Scene             &scene,
                const PhysicalMesh      &physical_mesh,
                const ElasticityProblem &problem);

      /// @throws InputError if there is no tip and no crack can start, if all tips lie on interfaces
      /// while cracks shall grow, or if a radius is larger than the free radius of a tip.
      void
      check() const;

      /// All tips with room for a singular field, also those whose stress has no intensity factors.
      const std::vector<CrackTip> &
      all_tips() const;

      /// Whether the stress at tip @p i has intensity factors, see has_intensity_factors().
      bool
      has_factors(unsigned int i) const;

      /// The intensity factors of all tips, which compute() has set; zero where there are none.
      const std::vector<IntensityFactors> &
      all_factors() const;

      /// Sentences for the user about tips that have no intensity factors, have no room, or cannot
      /// grow.
      std::vector<std::string>
      notices() const;

      /// Takes over what all_factors() of an earlier part of the run returned.
      void
      restore(std::vector<IntensityFactors> earlier);

      /// Computes the intensity factors of all tips that have some, in the scene's kinematics, from
      /// the solution under the loads of @p problem. Collective.
      void
      compute(const DisplacementField &field,
              const ElasticityProblem &problem,
              const TipLoading        &loading = {});

      /// Lines for the report with the intensity factors of the first few tips.
      std::vector<std::string>
      description() const;

      /// Adds the intensity factors of the tip with the largest energy release rate to the summary.
      void
      add_to(Summary &summary) const;

      /// Names of the columns of history.csv: K_I and K_II of each tip that has factors.
      std::vector<std::string>
      columns() const;

      /// The values of these columns, after compute().
      std::vector<double>
      numbers() const;

      /// Writes tips.csv; cells of tips without factors are empty. For use on one rank.
      void
      write(const OutputDirectory &directory) const;

    private:
      const Scene                  &scene;
      std::vector<CrackTip>         tips;
      std::vector<bool>             tip_has_factors;
      std::vector<IntensityFactors> factors;
      /// What the notices say.
      std::vector<std::string> tip_notices;
      /// Of tips that lie on an interface, or have no room: why cracks cannot grow there.
      std::string reason_at_rest;
      /// For all states of the solid.
      DiskRules rules;

      /// Unit of intensity factors.
      std::string
      intensity_unit() const;
    };
  } // namespace internal
} // namespace NMM

#endif
