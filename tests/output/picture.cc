#include <nmm/output/picture.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace NMM;
using dealii::Point;

namespace
{
  TEST(Picture, ColourMapGetsLighterSteadily)
  {
    const auto lightness = [](const double value) {
      const auto c = colour_map(value);
      return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    };
    for (unsigned int i = 0; i < 100; ++i)
      EXPECT_LT(lightness(i / 100.), lightness((i + 1) / 100.)) << i;
    // Beyond the ends and for no number at all the colours are still valid.
    for (const double value : {-1., 2., std::nan("")})
      for (const double part : colour_map(value))
      {
        EXPECT_GE(part, 0.);
        EXPECT_LE(part, 1.);
      }
  }


  TEST(Picture, TicksAreRoundAndInside)
  {
    const auto expect_ticks = [](const double              min,
                                 const double              max,
                                 const std::vector<double> expected) {
      const auto ticks = round_ticks(min, max, 5);
      ASSERT_EQ(ticks.size(), expected.size());
      for (unsigned int i = 0; i < ticks.size(); ++i)
        EXPECT_NEAR(ticks[i], expected[i], 1e-12 * std::abs(max)) << i;
    };
    expect_ticks(0., 10., {0., 2., 4., 6., 8., 10.});
    expect_ticks(-1.1, 0.9, {-1., -0.5, 0., 0.5});
    expect_ticks(1234., 1236., {1234., 1234.5, 1235., 1235.5, 1236.});
    expect_ticks(3., 3., {3.});
  }


  // Four digits would say 27.8 five times.
  TEST(Picture, LabelsTellNeighboursApart)
  {
    using Labels = std::vector<std::string>;
    EXPECT_EQ(tick_labels(round_ticks(27.8, 27.8008, 5)),
              (Labels{"27.8", "27.8002", "27.8004", "27.8006", "27.8008"}));
    EXPECT_EQ(tick_labels(round_ticks(0., 10., 5)),
              (Labels{"0", "2", "4", "6", "8", "10"}));
    EXPECT_EQ(tick_labels({1. / 3.}), Labels{"0.3333"});
    EXPECT_EQ(tick_labels({}), Labels{});
  }


  TEST(Picture, IsWrittenForDegenerateData)
  {
    const std::string     name = NMM_TEST_OUTPUT_DIR "/degenerate.png";
    PictureData           data;
    PictureData::Triangle flat;
    const double          x[6] = {0., 1., 2., 0.5, 1.5, 1.};
    for (unsigned int i = 0; i < 6; ++i)
      flat.vertices[i].position = Point<2>(x[i], 0.);
    flat.values = {{1., 1., 1., 1., 1., 1.}};
    for (const bool with_triangle : {false, true})
    {
      std::filesystem::remove(name);
      if (with_triangle)
        data.triangles.push_back(flat);
      draw_picture(data, PictureParameters(), "degenerate", name);
      char          signature[4] = {};
      std::ifstream file(name, std::ios::binary);
      file.read(signature, 4);
      EXPECT_EQ(std::string(signature + 1, 3), "PNG");
    }
  }


  /// A triangle with a right angle at @p corner and legs of this size [m].
  PictureData::Triangle
  triangle(const double    size,
           const double    value,
           const Point<2> &corner = Point<2>())
  {
    PictureData::Triangle result;
    const Point<2>        corners[3] = {corner,
                                        {corner[0] + size, corner[1]},
                                        {corner[0], corner[1] + size}};
    for (unsigned int i = 0; i < 3; ++i)
    {
      result.vertices[i].position = corners[i];
      result.vertices[i + 3].position =
        corners[i] + 0.5 * (corners[(i + 1) % 3] - corners[i]);
    }
    std::fill(std::begin(result.values), std::end(result.values), value);
    return result;
  }


  // The triangles have the same colours: a value beyond the range has that of its end.
  TEST(Picture, ColourBarShowsThatValuesLieBeyondIt)
  {
    PictureParameters parameters;
    parameters.picture_width = 300;
    parameters.range_max     = 1.;
    PictureData within, above, below;
    within.triangles = {triangle(1., 1.), triangle(1., 0., {2., 0.})};
    above.triangles  = {triangle(1., 1.5), triangle(1., 0., {2., 0.})};
    below.triangles  = {triangle(1., 1.), triangle(1., -2., {2., 0.})};
    const auto drawn = [&](const PictureData &data) {
      return draw_picture_in_memory(data, parameters, "");
    };
    EXPECT_TRUE(drawn(within) != drawn(above));
    EXPECT_TRUE(drawn(within) != drawn(below));
    EXPECT_TRUE(drawn(above) != drawn(below));
  }


  // What is outside of the window does not matter.
  TEST(Picture, WindowShowsAPart)
  {
    PictureParameters parameters;
    parameters.picture_width = 300;
    parameters.range_max     = 1.;
    PictureData one, two;
    one.triangles    = {triangle(1., 0.5)};
    two.triangles    = {triangle(1., 0.5), triangle(1., 0.5, {5., 3.})};
    const auto drawn = [&](const PictureData &data) {
      return draw_picture_in_memory(data, parameters, "");
    };
    const std::string whole = drawn(one);
    EXPECT_TRUE(drawn(two) != whole);
    parameters.window = {0., 0., 1., 1.};
    EXPECT_TRUE(drawn(one) == whole);
    EXPECT_TRUE(drawn(two) == whole);
  }


  TEST(Picture, MaterialsHaveNames)
  {
    PictureParameters parameters;
    parameters.picture_width = 300;
    parameters.quantity      = Quantity::material;
    PictureData data;
    data.triangles   = {triangle(1., 0.), triangle(1., 1., {2., 0.})};
    const auto drawn = [&](const std::vector<std::string> &names) {
      parameters.material_names = names;
      return draw_picture_in_memory(data, parameters, "");
    };
    EXPECT_TRUE(drawn({"granite", "clay"}) != drawn({"granite", "marl"}));
  }


  // About a crack tip values grow without bound in triangles too small to be seen.
  TEST(PictureExtents, RangeLeavesOutWhatIsTooSmallToBeSeen)
  {
    PictureData data;
    data.triangles = {triangle(1., 1.),
                      triangle(0.1, 2.),
                      triangle(5e-4, 100.)};
    PictureExtents extents;
    extents.add(data, 0.);
    EXPECT_EQ(extents.range(), std::make_pair(1., 2.));
  }
} // namespace
