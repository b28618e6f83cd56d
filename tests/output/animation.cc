#include <nmm/base/program.h>
#include <nmm/output/animation.h>
#include <nmm/output/crack_output.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;
using dealii::Point;
using dealii::Tensor;

namespace
{
  const std::string spool = NMM_TEST_OUTPUT_DIR "/animation.frames";


  /// A unit square of two triangles at (1000, 1000), displaced by
  /// @p displacement; values from 0 to @p largest.
  PictureData
  square(const double largest, const Tensor<1, 2> &displacement)
  {
    const Point<2> corner(1000., 1000.);
    PictureData    data;
    for (const bool upper : {false, true})
    {
      const Point<2>        p[3] = {Point<2>(upper ? 1. : 0., upper ? 1. : 0.),
                                    Point<2>(upper ? 0. : 1., upper ? 1. : 0.),
                                    Point<2>(upper ? 0. : 1., upper ? 0. : 1.)};
      PictureData::Triangle triangle;
      for (unsigned int i = 0; i < 6; ++i)
      {
        const Point<2> x =
          i < 3 ? p[i] : Point<2>(0.5 * (p[i - 3] + p[(i - 2) % 3]));
        triangle.vertices[i] = {corner + x, displacement};
        triangle.values[i]   = largest * x[0];
      }
      data.triangles.push_back(triangle);
      data.outlines.push_back({triangle.vertices[0], triangle.vertices[1]});
    }
    return data;
  }


  Tensor<1, 2>
  shift(const double x, const double y)
  {
    Tensor<1, 2> d;
    d[0] = x;
    d[1] = y;
    return d;
  }


  struct Frame
  {
    double      time;
    std::string label, png;
    /// All pictures of the frame, png is the first one; and in its own range, empty
    /// where that makes no difference.
    std::vector<std::string> pictures, own;
  };


  std::string
  decode(const std::string &text)
  {
    const auto bytes = dealii::Utilities::decode_base64(text);
    return {bytes.begin(), bytes.end()};
  }


  /// Strings in quotes, separated by commas.
  std::vector<std::string>
  decode_list(const std::string &text)
  {
    std::vector<std::string> result;
    for (std::size_t first = 0; first < text.size();)
    {
      const auto last = text.find('"', first + 1);
      result.push_back(decode(text.substr(first + 1, last - first - 1)));
      first = last + 2;
    }
    return result;
  }


  /// What the page holds, by the form that its documentation promises.
  std::vector<Frame>
  frames_of(const std::string &page)
  {
    std::vector<Frame> frames;
    const std::string  start = "<script>frame({\"time\":",
                      label = ",\"label\":\"", png = "\",\"png\":[",
                      own = "],\"own\":[", end = "]})</script>\n";
    for (auto i = page.find(start); i != std::string::npos;
         i      = page.find(start, i + 1))
    {
      const auto a = i + start.size(), b = page.find(label, a),
                 c = page.find(png, b), d = page.find(end, c);
      EXPECT_NE(d, std::string::npos);
      const auto first = c + png.size(), last = std::min(page.find(own, c), d);
      const auto pictures = decode_list(page.substr(first, last - first));
      EXPECT_FALSE(pictures.empty());
      frames.push_back({std::stod(page.substr(a, b - a)),
                        page.substr(b + label.size(), c - b - label.size()),
                        pictures.front(),
                        pictures,
                        {}});
      if (last < d)
        frames.back().own =
          decode_list(page.substr(last + own.size(), d - last - own.size()));
    }
    return frames;
  }


  std::string
  write(const Animation           &animation,
        const PictureParameters   &parameters = {},
        const AnimationParameters &how        = {})
  {
    std::ostringstream page;
    animation.write(page, "a <title> & \"more\"", parameters, how);
    return page.str();
  }


  TEST(Animation, PageHoldsAllFramesInOneSize)
  {
    std::filesystem::remove(spool);
    Animation animation(spool);
    for (unsigned int k = 0; k < 7; ++k)
      animation.add_frame(0.125 * k, square(1. + k, shift(0.5 * k, 0.)));
    EXPECT_EQ(animation.n_frames(), 7u);
    const std::string page   = write(animation);
    const auto        frames = frames_of(page);
    ASSERT_EQ(frames.size(), 7u);
    for (unsigned int k = 0; k < 7; ++k)
    {
      EXPECT_EQ(frames[k].time, 0.125 * k);
      EXPECT_EQ(frames[k].png.substr(1, 3), "PNG");
      EXPECT_EQ(frames[k].png.substr(frames[k].png.size() - 8, 4), "IEND");
      // width and height
      EXPECT_EQ(frames[k].png.substr(16, 8), frames[0].png.substr(16, 8));
      if (k > 0)
      {
        EXPECT_NE(frames[k].png, frames[k - 1].png);
      }
    }
    // two places tell 0.125 from 0.25
    EXPECT_EQ(frames[1].label, "t = 0.12 s");
    // at most the width asked for, and not much less
    const auto width = static_cast<unsigned char>(frames[0].png[18]) * 256 +
                       static_cast<unsigned char>(frames[0].png[19]);
    EXPECT_LE(width, 801);
    EXPECT_GE(width, 780);

    // offline: nothing is loaded; the title is text
    for (const char *forbidden : {"http:", "https:", "src=", "<title> &"})
      EXPECT_EQ(page.find(forbidden), std::string::npos) << forbidden;
    EXPECT_NE(page.find("a &lt;title&gt; &amp;"), std::string::npos);
    animation.discard();
    EXPECT_FALSE(std::filesystem::exists(spool));
  }


  TEST(Animation, ViewColoursAndScaleSuitAllFrames)
  {
    std::filesystem::remove(spool);
    Animation         animation(spool);
    PictureParameters parameters;
    parameters.deformation_scale = 1.;
    animation.add_frame(0., square(1., shift(0., 0.)));
    animation.add_frame(1., square(1., shift(0., 0.)));
    animation.add_frame(2., square(4., shift(9., 2.)));
    const auto all = frames_of(write(animation, parameters));

    // the same by hand
    PictureFrame frame;
    frame.view  = {{Point<2>(999.9, 999.9), Point<2>(1010.1, 1003.1)}};
    frame.range = {{0., 4.}};
    frame.note  = "t = 2.0 s";

    PictureData data             = square(4., shift(9., 2.));
    data.deformation_scale       = 1.;
    PictureParameters of_frames  = parameters;
    of_frames.picture_width      = 800;
    const std::string title      = "a <title> & \"more\"";
    const auto        same_as_by = [&](const std::size_t k) {
      return all[k].png ==
             draw_picture_in_memory(data, of_frames, title, frame, 256);
    };
    ASSERT_EQ(all.size(), 3u);
    EXPECT_TRUE(same_as_by(2));
    frame.range = {{0., 1.}};
    EXPECT_FALSE(same_as_by(2));

    // given ones win
    AnimationParameters how;
    how.view         = {{Point<2>(0., 0.), Point<2>(2000., 3000.)}};
    how.range        = {{-1., 1.}};
    how.time_name    = "load factor";
    how.time_unit    = "";
    const auto given = frames_of(write(animation, parameters, how));
    frame.view       = how.view;
    frame.range      = how.range;
    frame.note       = "load factor = 2.0";
    EXPECT_EQ(given[2].label, frame.note);
    EXPECT_EQ(given[2].png,
              draw_picture_in_memory(data, of_frames, title, frame, 256));

    // a chosen factor: 5 % of the box of the solid at rest
    parameters.deformation_scale = -1.;
    const auto scaled            = frames_of(write(animation, parameters));
    data.deformation_scale =
      choose_deformation_scale(std::hypot(9., 2.), std::sqrt(2.));
    EXPECT_EQ(data.deformation_scale, 0.005);
    PictureExtents extents;
    extents.add(data, 0.);
    extents.add(data, data.deformation_scale);
    frame.view  = extents.view(0.01);
    frame.range = {{0., 4.}};
    frame.note  = "t = 2.0 s";
    EXPECT_EQ(scaled[2].png,
              draw_picture_in_memory(data, of_frames, title, frame, 256));
    animation.discard();
  }


  // Obstacles and forces in contact, all frames with bars of one scale.
  TEST(Animation, KeepsContact)
  {
    std::filesystem::remove(spool);
    Animation   animation(spool);
    PictureData data[2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      data[k] = square(1., shift(0., 0.));
      data[k].obstacles.push_back({{Point<2>(1002., 1000.), shift(0., 0.)},
                                   {Point<2>(999., 1000.), shift(0., 0.)}});
      data[k].contacts.push_back({{Point<2>(1000.5, 1000.), shift(0., 0.)},
                                  shift(0.25, 1. + k),
                                  PictureData::Bar::bonded});
      animation.add_frame(k, data[k]);
    }
    PictureParameters parameters;
    parameters.deformation_scale = 1.;
    const auto frames            = frames_of(write(animation, parameters));
    ASSERT_EQ(frames.size(), 2u);

    PictureExtents extents;
    extents.add(data[0], 1.);
    extents.add(data[1], 1.);
    PictureFrame frame;
    frame.view                  = extents.view(0.01);
    frame.range                 = {{0., 1.}};
    frame.bar_scale             = std::hypot(0.25, 2.);
    frame.note                  = "t = 0.0 s";
    data[0].deformation_scale   = 1.;
    PictureParameters of_frames = parameters;
    of_frames.picture_width     = 800;
    const auto same_as_by       = [&]() {
      return frames[0].png == draw_picture_in_memory(data[0],
                                                     of_frames,
                                                     "a <title> & \"more\"",
                                                     frame,
                                                     256);
    };
    EXPECT_TRUE(same_as_by());
    frame.bar_scale.reset();
    EXPECT_FALSE(same_as_by());
    animation.discard();
  }


  // Tips and grown faces are drawn in pictures and in frames.
  TEST(Animation, KeepsCracks)
  {
    std::filesystem::remove(spool);
    Animation         animation(spool);
    PictureParameters parameters;
    PictureData       plain = square(1., shift(0., 0.)), cracked = plain;
    // The first outline is part of the increment, the second one only touches it.
    CrackSample cracks;
    cracks.tips.push_back(
      {Point<2>(1000.5, 1000.5), shift(0., 0.), shift(1., 0.), {}});
    cracks.increments = {{Point<2>(999., 1000.), Point<2>(1001., 1000.)}};
    add_cracks(cracks, cracked);
    ASSERT_EQ(cracked.grown_faces.size(), 1u);
    ASSERT_EQ(cracked.outlines.size(), 1u);
    EXPECT_EQ(cracked.grown_faces[0][0].position, Point<2>(1000., 1000.));

    animation.add_frame(0., plain);
    animation.add_frame(0., cracked);
    const auto drawn = [&](const PictureData &data) {
      return draw_picture_in_memory(data, parameters, "cracks");
    };
    PictureData only_tips = plain;
    only_tips.tips        = cracked.tips;
    EXPECT_NE(drawn(plain), drawn(only_tips));
    EXPECT_NE(drawn(only_tips), drawn(cracked));
    const auto frames = frames_of(write(animation, parameters));
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_NE(frames[0].png, frames[1].png);
    animation.discard();
  }


  // A frame with small values and forces before one with large ones: a picture in its
  // own range, too, where that differs.
  TEST(Animation, OffersTheRangeOfTheFrame)
  {
    std::filesystem::remove(spool);
    Animation   animation(spool);
    PictureData data[3];
    for (unsigned int k = 0; k < 3; ++k)
    {
      data[k] = square(k == 0 ? 0.01 : 1., shift(0., 0.));
      data[k].contacts.push_back({{Point<2>(1000.5, 1000.), shift(0., 0.)},
                                  shift(0., k == 1 ? 0.5 : 100.),
                                  PictureData::Bar::sticks});
      animation.add_frame(k, data[k]);
    }
    PictureParameters parameters;
    parameters.deformation_scale = 1.;
    const auto frames            = frames_of(write(animation, parameters));
    ASSERT_EQ(frames.size(), 3u);

    PictureExtents extents;
    extents.add(data[0], 1.);
    PictureFrame frame;
    frame.view                  = extents.view(0.01);
    PictureParameters of_frames = parameters;
    of_frames.picture_width     = 800;
    const auto drawn            = [&](const unsigned int k,
                           const double       largest_value,
                           const double       bar_scale) {
      data[k].deformation_scale = 1.;
      frame.range               = {{0., largest_value}};
      frame.bar_scale           = bar_scale;
      frame.note                = frames[k].label;
      return draw_picture_in_memory(
        data[k], of_frames, "a <title> & \"more\"", frame, 256);
    };
    EXPECT_EQ(frames[0].png, drawn(0, 1., 100.));
    ASSERT_EQ(frames[0].own.size(), 1u);
    EXPECT_EQ(frames[0].own[0], drawn(0, 0.01, 100.));
    ASSERT_EQ(frames[1].own.size(), 1u);
    EXPECT_EQ(frames[1].own[0], drawn(1, 1., 0.5));
    // the same as in the range of the run
    EXPECT_TRUE(frames[2].own.empty());

    // a range that is given holds for all frames; bars are still the frame's
    parameters.range_min = 0.;
    parameters.range_max = 1.;
    const auto given     = frames_of(write(animation, parameters));
    EXPECT_TRUE(given[0].own.empty());
    EXPECT_EQ(given[1].own, frames[1].own);
    AnimationParameters how;
    how.range = {{0., 1.}};
    EXPECT_TRUE(frames_of(write(animation, parameters, how))[0].own.empty());
    animation.discard();
  }


  // The reader chooses between quantities, each in the colours of its own range
  // and all in one view.
  TEST(Animation, SeveralQuantities)
  {
    std::filesystem::remove(spool);
    Animation   animation(spool);
    PictureData data[2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      data[k] = square(1. + k, shift(0., 0.));
      for (const Quantity quantity :
           {Quantity::velocity, Quantity::displacement_x})
      {
        data[k].layers.push_back({quantity, {}});
        for (const PictureData::Triangle &triangle : data[k].triangles)
        {
          auto values = triangle.values;
          for (double &value : values)
            value = (quantity == Quantity::velocity ? 7. : -3.) * value * value;
          data[k].layers.back().values.push_back(values);
        }
      }
      animation.add_frame(k, data[k]);
    }
    PictureParameters parameters;
    parameters.deformation_scale    = 1.;
    parameters.quantity             = Quantity::displacement;
    parameters.animation_quantities = {Quantity::displacement_x,
                                       Quantity::velocity};
    const std::string page          = write(animation, parameters);
    const auto        frames        = frames_of(page);
    EXPECT_NE(page.find("<script>choices([\"displacement\",\"displacement x\","
                        "\"velocity\"])</script>"),
              std::string::npos);
    ASSERT_EQ(frames.size(), 2u);
    ASSERT_EQ(frames[1].pictures.size(), 3u);

    PictureFrame frame;
    frame.view      = {{Point<2>(999.99, 999.99), Point<2>(1001.01, 1001.01)}};
    frame.range     = {{0., 28.}};
    frame.note      = "t = 1.0 s";
    frame.bar_scale = 0.;
    PictureData by_hand         = data[1];
    by_hand.deformation_scale   = 1.;
    by_hand.triangles[0].values = data[1].layers[0].values[0];
    by_hand.triangles[1].values = data[1].layers[0].values[1];
    PictureParameters of_frames = parameters;
    of_frames.picture_width     = 800;
    of_frames.quantity          = Quantity::velocity;
    const auto drawn            = [&]() {
      return draw_picture_in_memory(
        by_hand, of_frames, "a <title> & \"more\"", frame, 256);
    };
    EXPECT_EQ(frames[1].pictures[2], drawn());
    EXPECT_NE(frames[1].pictures[1], drawn());
    by_hand.triangles  = data[1].triangles;
    of_frames.quantity = Quantity::displacement;
    frame.range        = {{0., 2.}};
    EXPECT_EQ(frames[1].pictures[0], drawn());

    // a continued run in which another quantity is wanted: what all frames have
    data[1].layers.erase(data[1].layers.begin());
    animation.add_frame(2., data[1]);
    const auto common = frames_of(write(animation, parameters));
    ASSERT_EQ(common.size(), 3u);
    EXPECT_EQ(common[0].pictures.size(), 2u);
    EXPECT_EQ(common[1].pictures[1], frames[1].pictures[1]);
    animation.discard();
  }


  TEST(Animation, GoesOnWhereItWasKilled)
  {
    std::filesystem::remove(spool);
    std::string whole;
    {
      Animation animation(spool);
      for (unsigned int k = 0; k < 6; ++k)
        animation.add_frame(k, square(1., shift(0.1 * k, 0.)));
      whole = write(animation);
    }
    // killed in the middle of the sixth frame; the last checkpoint is of time 3
    std::filesystem::resize_file(spool, std::filesystem::file_size(spool) - 7);
    {
      Animation animation(spool, 3.);
      EXPECT_EQ(animation.n_frames(), 4u);
      for (unsigned int k = 4; k < 6; ++k)
        animation.add_frame(k, square(1., shift(0.1 * k, 0.)));
      EXPECT_EQ(write(animation), whole);
    }
    {
      // the damaged one is dropped
      std::filesystem::resize_file(spool,
                                   std::filesystem::file_size(spool) - 7);
      Animation animation(spool, 10.);
      EXPECT_EQ(animation.n_frames(), 5u);
    }
    {
      Animation animation(spool);
      EXPECT_EQ(animation.n_frames(), 0u);
      animation.discard();
    }
  }


  TEST(Animation, ManyFramesAreThinnedOut)
  {
    std::filesystem::remove(spool);
    Animation animation(spool);
    for (unsigned int k = 0; k <= 100; ++k)
      animation.add_frame(k, square(1., shift(0., 0.)));
    AnimationParameters how;
    how.max_frames    = 11;
    how.width         = 200;
    const auto frames = frames_of(write(animation, {}, how));
    ASSERT_EQ(frames.size(), 11u);
    for (unsigned int k = 0; k <= 10; ++k)
      EXPECT_EQ(frames[k].time, 10. * k);

    // a frame that is not kept, unless its time is that of the last one
    const PictureData  end = square(1., shift(0.5, 0.));
    std::ostringstream page, unchanged;
    animation.write(page, "", {}, how, {110., &end});
    EXPECT_EQ(frames_of(page.str()).back().time, 110.);
    animation.write(unchanged, "a <title> & \"more\"", {}, how, {100., &end});
    EXPECT_TRUE(unchanged.str() == write(animation, {}, how));
    animation.discard();
  }


  TEST(Animation, BadInputIsRefused)
  {
    std::filesystem::remove(spool);
    Animation animation(spool);
    EXPECT_THROW(write(animation), InputError);
    animation.add_frame(1., square(1., shift(0., 0.)));
    EXPECT_THROW(animation.add_frame(0.5, square(1., shift(0., 0.))),
                 InputError);
    AnimationParameters how;
    how.range = {{1., 1.}};
    EXPECT_THROW(write(animation, {}, how), InputError);
    how       = {};
    how.width = 10;
    EXPECT_THROW(write(animation, {}, how), InputError);
    EXPECT_THROW(Animation("/nowhere/at/all"), OutputFailure);
    animation.discard();
  }
} // namespace
