#ifndef nmm_source_scene_bolts_h
#define nmm_source_scene_bolts_h

#include <nmm/analysis/further_terms.h>
#include <nmm/mechanics/bolt_term.h>
#include <nmm/output/output_directory.h>
#include <nmm/output/picture_data.h>
#include <nmm/scene/scene.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The bolts of a scene: their force term, and the tables bolts.csv and bolt-joints.csv with
     * what they bear in each step. In stages, bolts that a stage names are installed when it begins; all
     * others act from the first step on.
     */
    class SceneBolts
    {
    public:
      /// When the bolts that a stage names are installed: by that stage, or before the analysis, which
      /// follows the stages.
      enum class Installed
      {
        in_stages,
        before
      };

      /// The bolts of @p scene, which must outlive this object; null if it has none.
      static std::unique_ptr<SceneBolts>
      make(const Scene &scene);

      explicit SceneBolts(const Scene &scene);

      /// Makes the term whose states are taken from then on, until another one is made.
      TermMaker
      maker();

      /// The makers of terms that no table shows, one or none.
      static std::vector<TermMaker>
      makers(const Scene &scene, Installed installed);

      /// Notes what bolts bear at the accepted displacements @p u. Collective.
      void
      take_state(const ForceTerm::Vector &u);

      /// What the last state was, for a row of progress.
      std::string
      progress() const;

      /// Appends the last state to the tables, as of the step @p step at the time or load factor
      /// @p value. A step that is there already is not added again.
      void
      add_rows(unsigned int step, double value);

      /// Writes the tables. On one rank.
      void
      write(const OutputDirectory &directory) const;

      /// Adds the bolts of the last state to a picture.
      void
      add_to(PictureData &picture) const;

      /// Sentences about the last state, for the end of a run.
      std::vector<std::string>
      description() const;

      void
      add_to(Summary &summary) const;

    private:
      const Scene            *scene;
      const BoltTerm         *bolts = nullptr;
      std::vector<BoltReport> reports;
      std::string             rows, joint_rows;
      unsigned int            last_step = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
