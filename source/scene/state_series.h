#ifndef nmm_source_scene_state_series_h
#define nmm_source_scene_state_series_h

#include <nmm/covers/cover_system.h>
#include <nmm/output/animation.h>
#include <nmm/output/field_samples.h>
#include <nmm/output/output_directory.h>
#include <nmm/scene/scene.h>

#include <memory>
#include <scene/contact_analysis.h>
#include <string>

namespace NMM
{
  namespace internal
  {
    /// Draw picture.png or one of a series, as the scene says; without @p evaluator
    /// which block is which; with forces and obstacles of @p contact, if it is given.
    /// What was drawn is kept in @p drawn, on the first rank. Collective.
    void
    write_picture(const Scene           &scene,
                  const CoverSystem     &covers,
                  const ContactAnalysis *contact,
                  const FieldTriangles  &triangles,
                  const FieldEvaluator  *evaluator,
                  const std::string     &title,
                  const std::string     &file_name,
                  const OutputDirectory &directory,
                  PictureData           *drawn = nullptr);

    /**
     * Fields and pictures of states of a run, written as they come: fields-NNNN.vtu,
     * picture-NNNN.png, and fields.pvd, which at any time lists the fields that are
     * there; at the end animation.html, for which frames are kept in
     * animation.frames meanwhile. With contact its points as well: contacts.csv,
     * contacts-NNNN.vtp, contacts.pvd. All functions are collective.
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

      /// The solid was cut anew: states that follow are those of the arguments, which must
      /// outlive this object. @p contact is null if it was null at first.
      void
      follow(const CoverSystem &covers, const ContactAnalysis *contact);

      /// Keep the fields of an earlier run up to the state @p last (time or load
      /// factor).
      void
      resume(double last);

      /// State @p number at @p value (time or load factor), which
      /// @p description tells in the picture's title.
      void
      write(unsigned int          number,
            double                value,
            const std::string    &description,
            const FieldEvaluator &evaluator);

      /// The fields of the last state are in @p file_name.
      void
      finish(double value, const std::string &file_name);

      /// The last state's contact points, if there is contact.
      void
      finish_contact(double value);

      /// Write animation.html, if there are frames for it. Its last one is of the state
      /// at @p value, drawn as @p last, unless that is null.
      void
      write_animation(double value, const PictureData *last);

    private:
      /// Begin to keep frames, after those of an earlier run up to @p last.
      void
      open_animation(double last);

      const Scene           *scene;
      const CoverSystem     *covers;
      const ContactAnalysis *contact;
      const OutputDirectory *directory;
      /// On the first rank.
      FileSeries                     files;
      std::unique_ptr<Animation>     animation;
      std::unique_ptr<ContactSeries> contact_series;
    };
  } // namespace internal
} // namespace NMM

#endif
