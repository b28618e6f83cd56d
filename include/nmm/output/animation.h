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
   * A page that shows a series of pictures in any browser, without a network: all
   * is in one file, the pictures as base64. Buttons and keys play, stop and step,
   * a slider goes anywhere; frames follow each other in proportion to their times.
   * Where each frame has several pictures, e.g. in the colours of several
   * quantities, the reader chooses which ones are shown; and where frames also have
   * pictures in a range of their own, whether these are.
   *
   * Each frame is a script element of its own,
   * `<script>frame({"time":0.1,"label":"t = 0.1 s","png":["iVBOR..."]})</script>`,
   * perhaps with `"own":["iVBOR..."]` after `png`, so that a page that ends after any
   * frame is a whole one.
   *
   * Lifetime: the stream must outlive this object. Memory: one frame.
   */
  class AnimationPage
  {
  public:
    /// Writes all but the frames. @p choices: what the pictures of a frame are
    /// called; if there is only one, nothing is to be chosen.
    AnimationPage(std::ostream                   &out,
                  const std::string              &title,
                  const std::vector<std::string> &choices = {""});

    /// @p png are the bytes of PNG files, one for each choice, all frames' of the same
    /// size in pixels; @p time must not be less than the last one's, see Animation.
    /// @p own: none, or the same in the frame's own range of values, empty where that
    /// makes no difference.
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


  struct AnimationParameters
  {
    /// Largest width of the pictures [pixels].
    unsigned int width = 800;
    /// Where there are more, so many are chosen, evenly; the last one is kept.
    unsigned int max_frames = 300;
    /// Steps of the colour map: with fewer the page is smaller.
    unsigned int n_colours = 256;
    /// Size of the smallest hole [m], which displacements must not close when their scale is
    /// chosen; infinity if there is none.
    double smallest_hole = std::numeric_limits<double>::infinity();
    /// What frames follow each other by: "t = 0.25 s".
    std::string time_name = "t", time_unit = "s";
    /// As in PictureFrame, for all frames; else what contains all of them.
    std::optional<std::pair<dealii::Point<2>, dealii::Point<2>>> view;
    std::optional<std::pair<double, double>>                     range;

    /// @throws InputError naming the value.
    void
    check() const;
  };


  /**
   * A moving picture in the making. Frames are kept in a file while the analysis
   * goes on, as view, colours and the factor on displacements that suit all of
   * them are known only at the end: a CsvSeries with a row per frame, its time and its
   * PictureData as Boost's archive, compressed and in base64. Memory: one frame.
   *
   * For use on one rank.
   */
  class Animation
  {
  public:
    /// Time and picture; null: there is none.
    using LastFrame = std::pair<double, const PictureData *>;

    /**
     * Keeps frames in @p file_name. If there are such already, of times up to
     * @p keep_until, they are the first ones (a run that continues); a frame that
     * was not written to its end and all later ones are dropped.
     * @throws OutputFailure.
     */
    explicit Animation(
      std::string file_name,
      double      keep_until = -std::numeric_limits<double>::infinity());

    /// @p time must not be less than that of the last frame.
    void
    add_frame(double time, const PictureData &data);

    unsigned int
    n_frames() const;

    /**
     * Draw all frames: displacements times `parameters.deformation_scale` or, if
     * that is negative, the factor for the largest one in any frame; colours of
     * `animation.range`, the range in @p parameters or that of all frames.
     * `parameters.picture_width` is not used. To choose from: the quantity in
     * @p parameters and its `animation_quantities`, as far as all frames have
     * them, each of these in the range of all frames; and, for each frame, the range
     * of its own values, if none is given, and of its own contact bars.
     * @p last: a further frame at the end, if its time is later than that of the last
     * one that is kept.
     * @throws InputError if there are no frames.
     */
    void
    write(std::ostream              &out,
          const std::string         &title,
          const PictureParameters   &parameters,
          const AnimationParameters &animation = {},
          const LastFrame           &last      = {}) const;

    /// Remove the file. No more calls after that.
    void
    discard();

  private:
    struct Record
    {
      double time;
      /// Position of the record in the file; or the data of a record that is not in the file.
      std::streamoff     position;
      const PictureData *data = nullptr;
    };

    PictureData
    read(const Record &record) const;

    /// Those of @p quantities that all of @p records have.
    std::vector<Quantity>
    common_quantities(const std::vector<Record>   &records,
                      const std::vector<Quantity> &quantities) const;

    std::string              file_name;
    std::optional<CsvSeries> rows;
    std::vector<Record>      records;
  };
} // namespace NMM

#endif
