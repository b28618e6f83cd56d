#ifndef nmm_output_animation_h
#define nmm_output_animation_h

#include <nmm/output/picture.h>

#include <cstdint>
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

    /// @p png are the bytes of PNG files, one for each choice, of the same size
    /// in pixels as the first frame's; @p time must not be less than the last
    /// one's. @p own: the same in the frame's own range of values, empty where that
    /// makes no difference. @throws InputError otherwise.
    void
    add_frame(double                          time,
              const std::string              &label,
              const std::vector<std::string> &png,
              const std::vector<std::string> &own = {});

    unsigned int
    n_frames() const;

  private:
    void
    write_pictures(const std::vector<std::string> &pictures);

    std::ostream *out;
    std::size_t   n_choices;
    unsigned int  n_written = 0;
    double        last_time = -std::numeric_limits<double>::infinity();
    std::pair<std::uint32_t, std::uint32_t> size;
  };


  struct AnimationParameters
  {
    /// Of the pictures, at most [pixels].
    unsigned int width = 800;
    /// Where there are more, so many are chosen, evenly; the last one is kept.
    unsigned int max_frames = 300;
    /// Steps of the colour map: with fewer the page is smaller.
    unsigned int n_colours = 256;
    /// Of the smallest hole, which displacements drawn at a scale of their own must
    /// not close; infinity: there is none [m].
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
   * them are known only at the end. In single precision: about 0.1 kB per
   * triangle and frame. Memory: one frame.
   *
   * For use on one rank.
   */
  class Animation
  {
  public:
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

    /// There must be one.
    double
    last_time() const;

    /// Take the last frame away.
    void
    remove_last_frame();

    /**
     * Draw all frames: displacements times `parameters.deformation_scale` or, if
     * that is negative, the factor for the largest one in any frame; colours of
     * `animation.range`, the range in @p parameters or that of all frames.
     * `parameters.picture_width` is not used. To choose from: the quantity in
     * @p parameters and its `animation_quantities`, as far as all frames have
     * them, each of these in the range of all frames; and, for each frame, the range
     * of its own values, if none is given, and of its own contact bars.
     * @throws InputError if there are no frames.
     */
    void
    write(std::ostream              &out,
          const std::string         &title,
          const OutputParameters    &parameters,
          const AnimationParameters &animation = {}) const;

    /// Remove the file. No more calls after that.
    void
    discard();

  private:
    struct Record
    {
      double         time;
      std::streamoff position;
      std::uint64_t  n_bytes;
    };

    void
    find_records(double keep_until);

    PictureData
    read(const Record &record) const;

    /// Of @p quantities those that all of @p records have.
    std::vector<Quantity>
    common_quantities(const std::vector<Record>   &records,
                      const std::vector<Quantity> &quantities) const;

    /// The records that write() shows.
    std::vector<Record>
    chosen_records(unsigned int max_frames) const;

    std::string         file_name;
    std::vector<Record> records;
    std::streamoff      end = 0;
  };
} // namespace NMM

#endif
