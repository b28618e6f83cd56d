#ifndef nmm_output_animation_h
#define nmm_output_animation_h

#include <nmm/output/csv_series.h>
#include <nmm/output/picture.h>

#include <ios>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * An HTML page that plays a series of pictures in any browser. It needs no network, since
   * the pictures are part of the file, in base64. Buttons and keys play, stop and step,
   * and a slider selects a frame; the time between frames is in proportion to their times.
   * Each frame can have several pictures, e.g. in the colours of several
   * quantities, from which the reader chooses. The reader can also switch to pictures in the
   * range of values of each frame, where there are such.
   *
   * Each frame is a script element of its own,
   * `<script>frame({"time":0.1,"label":"t = 0.1 s","png":["iVBOR..."]})</script>`,
   * with `"own":["iVBOR..."]` after `png` if there are pictures in its own range. A page that was
   * cut off after any frame is therefore valid.
   *
   * Lifetime: the stream must outlive this object. Memory: one frame.
   */
  class AnimationPage
  {
  public:
    /// Writes the page without frames to @p out. @p choices are the names of the pictures of a
    /// frame, among which the reader chooses if there is more than one.
    AnimationPage(std::ostream                   &out,
                  const std::string              &title,
                  const std::vector<std::string> &choices = {""});

    /// Writes a frame. @p png holds the bytes of a PNG file for each choice; pictures of all
    /// frames must have the same size in pixels. @p time must not be less than that of the last
    /// frame. @p own is empty, or holds the same pictures in the frame's own range of values,
    /// each empty where that makes no difference.
    void
    add_frame(double                          time,
              const std::string              &label,
              const std::vector<std::string> &png,
              const std::vector<std::string> &own = {});

  private:
    void
    write_pictures(const std::vector<std::string> &pictures);

    std::ostream *out;
    std::size_t   n_choices;
  };


  /// How an animation shows its frames, beside PictureParameters.
  struct AnimationParameters
  {
    /// Largest width of the pictures [pixels].
    unsigned int width = 800;
    /// Largest number of frames. If there are more, as many are selected evenly, and the last one
    /// is always kept.
    unsigned int max_frames = 300;
    /// Number of steps of the colour map; fewer steps make the page smaller.
    unsigned int n_colours = 256;
    /// Size of the smallest hole [m], which displacements must not close when their scale is
    /// chosen; infinity if there is none.
    double smallest_hole = std::numeric_limits<double>::infinity();
    /// Name of the variable in the label of a frame, "t = 0.25 s".
    std::string time_name = "t";
    /// Unit of this variable; empty if it has none.
    std::string time_unit = "s";
    /// Part of the plane that all frames show, lower and upper corner [m]; if not given, the
    /// smallest box that contains all frames.
    std::optional<std::pair<dealii::Point<2>, dealii::Point<2>>> view;
    /// Values at the ends of the colour bar of all frames; if not given, those of
    /// PictureParameters or the range of all frames.
    std::optional<std::pair<double, double>> range;

    /// Checks the numbers. @throws InputError naming the value.
    void
    check() const;
  };


  /**
   * Collects the frames of an animation and draws them at the end. View, colours and the factor
   * on displacements that suit all frames are known only at the end, so frames are stored in a
   * file while the analysis runs. It is a CsvSeries with a row per frame: its time, and its
   * PictureData as an archive of Boost, compressed and in base64. Memory: one frame.
   *
   * For use on one rank.
   */
  class Animation
  {
  public:
    /// Time and picture of a further frame; null means that there is none.
    using LastFrame = std::pair<double, const PictureData *>;

    /**
     * Stores frames in the file @p file_name. Frames of an earlier run that are in it, with times
     * up to @p keep_until, are the first ones (for a run that continues). A frame that
     * is incomplete, and all later ones, are dropped.
     * @throws OutputFailure if the file cannot be written.
     */
    explicit Animation(
      std::string file_name,
      double      keep_until = -std::numeric_limits<double>::infinity());

    /// Stores a frame. @p time must not be less than that of the last frame.
    void
    add_frame(double time, const PictureData &data);

    /// Number of frames in the file.
    unsigned int
    n_frames() const;

    /**
     * Draws all frames and writes the page to @p out. Displacements are multiplied by
     * `parameters.deformation_scale` or, if that is negative, by a factor that suits the largest
     * displacement in any frame. The range of colours is `animation.range`, else that in
     * @p parameters, else that of all frames. `parameters.picture_width` is not used.
     *
     * The reader can choose between the quantity in @p parameters and those of its
     * `animation_quantities` that all frames have; each of the latter is shown in the range of
     * all frames. The reader can also choose that each frame is shown in the range of its own
     * contact tractions and, if no range is given, of its own values.
     *
     * @p last is a further frame at the end. It is left out if its time is not later than that of
     * the last stored frame.
     * @throws InputError if there are no frames.
     */
    void
    write(std::ostream              &out,
          const std::string         &title,
          const PictureParameters   &parameters,
          const AnimationParameters &animation = {},
          const LastFrame           &last      = {}) const;

    /// Removes the file. No other function may be called afterwards.
    void
    discard();

  private:
    struct Record
    {
      double time;
      /// Position of the record in the file, or the data of a record that is not in the file.
      std::streamoff     position;
      const PictureData *data = nullptr;
    };

    PictureData
    read(const Record &record) const;

    /// The elements of @p quantities for which all @p records have values.
    std::vector<Quantity>
    common_quantities(const std::vector<Record>   &records,
                      const std::vector<Quantity> &quantities) const;

    std::string              file_name;
    std::optional<CsvSeries> rows;
    std::vector<Record>      records;
  };
} // namespace NMM

#endif
