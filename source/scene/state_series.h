#ifndef nmm_source_scene_state_series_h
#define nmm_source_scene_state_series_h

#include <nmm/covers/cover_system.h>
#include <nmm/output/animation.h>
#include <nmm/output/crack_output.h>
#include <nmm/output/field_samples.h>
#include <nmm/output/output_directory.h>
#include <nmm/scene/scene.h>

#include <memory>
#include <scene/bolts.h>
#include <scene/contact_analysis.h>
#include <string>

namespace NMM
{
  namespace internal
  {
    /**
     * Writes the fields and pictures of the states of a run, one after the other:
     * fields-NNNN.vtu, picture-NNNN.png, and fields.pvd, which always lists the fields that
     * exist. At the end it writes animation.html, for which frames are stored in
     * animation.frames during the run. With contact it also writes the contact points:
     * contacts.csv, contacts-NNNN.vtp, contacts.pvd, and with intensity factors the crack tips:
     * tips-NNNN.vtu, tips.pvd. All functions are collective.
     *
     * Lifetime: the arguments of the constructor must outlive this object.
     */
    class StateSeries
    {
    public:
      /// @p contact may be null.
      StateSeries(const Scene           &scene,
                  const CoverSystem     &covers,
                  const ContactAnalysis *contact,
                  const OutputDirectory &directory);

      /// Uses the arguments for all further states, after the solid was cut again. They must
      /// outlive this object. @p contact is null if it was null in the constructor.
      void
      follow(const CoverSystem &covers, const ContactAnalysis *contact);

      /// Draws the last state of @p bolts in all further pictures, unless it is null.
      void
      show_bolts(const SceneBolts *shown)
      {
        bolts = shown;
      }

      /// Continues an earlier run, whose states up to the time or load factor @p last are kept.
      void
      resume(double last);

      /// Writes the state @p number at the time or load factor @p value. @p description is added to
      /// the title of the picture. @p cracks is null without intensity factors.
      void
      write(unsigned int          number,
            double                value,
            const std::string    &description,
            const FieldEvaluator &evaluator,
            const CrackSample    *cracks);

      /// Adds the final state to the list, whose fields are in @p file_name, and writes its tips
      /// to tips.vtu unless @p cracks is null.
      void
      finish(double             value,
             const std::string &file_name,
             const CrackSample *cracks);

      /// Writes the contact points of the final state, if there is contact.
      void
      finish_contact(double value);

      /// Draws picture.png or a picture of the series, with the settings of the scene, and returns
      /// its content on rank 0. If @p evaluator is null, the picture shows the blocks, otherwise
      /// contact tractions and obstacles as well; and if @p cracks is not null, crack tips and cracks
      /// that have grown.
      PictureData
      draw(const CrackSample    *cracks,
           const FieldTriangles &triangles,
           const FieldEvaluator *evaluator,
           const std::string    &title,
           const std::string    &file_name) const;

      /// Writes animation.html, if there are frames for it. @p last is the picture of the final
      /// state at @p value, as a further frame, unless it is null.
      void
      write_animation(double value, const PictureData *last);

    private:
      /// Opens the file of frames, and keeps those of an earlier run up to @p last.
      void
      open_animation(double last);

      const Scene           *scene;
      const CoverSystem     *covers;
      const ContactAnalysis *contact;
      const OutputDirectory *directory;
      const SceneBolts      *bolts = nullptr;
      /// The writers, which are used on rank 0 only.
      FileSeries                     files;
      std::unique_ptr<FileSeries>    tip_files;
      std::unique_ptr<Animation>     animation;
      std::unique_ptr<ContactSeries> contact_series;
    };
  } // namespace internal
} // namespace NMM

#endif
