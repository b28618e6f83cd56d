// What the page of an animation shows, in a browser without a window or, of what its
// script does, in node. Where there is neither, as they are no dependencies, the test
// is skipped.

#include <nmm/output/animation.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

using namespace NMM;
using dealii::Point;

namespace
{
  const std::string page_file = NMM_TEST_OUTPUT_DIR "/animation-page.html";


  /// A wide triangle with values up to @p largest.
  std::string
  picture(const double largest)
  {
    PictureData           data;
    PictureData::Triangle triangle;
    const Point<2>        corners[3] = {{0., 0.}, {4., 0.}, {0., 1.}};
    for (unsigned int i = 0; i < 3; ++i)
    {
      const unsigned int j          = (i + 1) % 3;
      triangle.vertices[i].position = corners[i];
      triangle.vertices[i + 3].position =
        Point<2>(0.5 * (corners[i] + corners[j]));
    }
    for (unsigned int i = 0; i < 6; ++i)
      triangle.values[i] = largest * triangle.vertices[i].position[0];
    data.triangles = {triangle};
    PictureParameters parameters;
    parameters.picture_width = 400;
    PictureFrame frame;
    frame.range = {{0., 4.}};
    return draw_picture_in_memory(data, parameters, "", frame, 16);
  }


  /// Two frames of two quantities; the first one of the second quantity has a picture
  /// of its own, and so has the second one of the first.
  std::string
  page(const bool with_own)
  {
    std::ostringstream out;
    AnimationPage      page(out, "title", {"a", "b"});
    const auto         own = [&](const std::string &a, const std::string &b) {
      return with_own ? std::vector<std::string>{a, b}
                              : std::vector<std::string>{};
    };
    page.add_frame(0.,
                   "first",
                   {picture(0.1), picture(0.2)},
                   own("", picture(0.3)));
    page.add_frame(1.,
                   "second",
                   {picture(0.4), picture(0.5)},
                   own(picture(0.6), ""));
    return out.str();
  }


  /// What is shown for each range, quantity and frame, becomes the title: r for that of
  /// the run, o for the frame's own; then whether ranges are offered, and the part
  /// of the window's width that the picture takes.
  const std::string probe = R"(<script>
window.onload = () => {
  let seen = "";
  for (const range of [0, 1])
    for (const quantity of [0, 1])
      for (const k of [0, 1]) {
        at("range").selectedIndex = range;
        at("range").onchange();
        at("quantity").selectedIndex = quantity;
        at("quantity").onchange();
        show(k);
        const f = frames[k], shown = at("picture").src.split(",")[1];
        seen += shown === f.png[quantity] ? "r"
              : f.own && shown === f.own[quantity] ? "o" : "?";
      }
  document.title = seen + (at("ranges").hidden ? " hidden " : " offered ")
    + (at("picture").clientWidth / window.innerWidth).toFixed(2);
};
</script>
)";


  std::string
  output_of(const std::string &command)
  {
    std::string             output;
    std::array<char, 65536> buffer;
    FILE *pipe = popen((command + " 2>/dev/null").c_str(), "r");
    if (pipe == nullptr)
      return output;
    while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe))
      output.append(buffer.data(), n);
    pclose(pipe);
    return output;
  }


  bool
  is_there(const std::string &program)
  {
    return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
  }


  std::string
  title_in_browser(const std::string &html)
  {
    std::ofstream(page_file) << html << probe << "</body></html>\n";
    const std::string document = output_of(
      "timeout 60 chromium --headless --no-sandbox --disable-gpu "
      "--user-data-dir=" NMM_TEST_OUTPUT_DIR
      "/chromium --window-size=1600,900 --dump-dom 'file://" +
      page_file + "'");
    const auto first = document.find("<title>"),
               last  = document.find("</title>");
    return last == std::string::npos
             ? document
             : document.substr(first + 7, last - first - 7);
  }


  /// The scripts alone, with what they need of a document.
  std::string
  title_in_node(const std::string &html)
  {
    std::ostringstream script;
    script << R"(const elements = {}, window = { innerWidth: 1 };
const document = { getElementById: id => elements[id] ??= { selectedIndex: 0,
  hidden: id === "choice" || id === "ranges", clientWidth: 1, add() {} } };
class Option {}
)";
    const std::string all   = html + probe;
    const std::string start = "<script>", end = "</script>";
    for (auto i = all.find(start); i != std::string::npos;
         i      = all.find(start, i + 1))
      script << all.substr(i + start.size(),
                           all.find(end, i) - i - start.size())
             << '\n';
    script << "window.onload(); console.log(document.title);\n";
    const std::string file = NMM_TEST_OUTPUT_DIR "/animation-page.js";
    std::ofstream(file) << script.str();
    const std::string output = output_of("timeout 60 node '" + file + "'");
    return output.substr(0, output.find('\n'));
  }
} // namespace


TEST(AnimationPage, ShowsTheRangeThatIsChosen)
{
  if (!is_there("node"))
    GTEST_SKIP() << "there is no node to run the page's script";
  EXPECT_EQ(title_in_node(page(true)), "rrrrroor offered 1.00");
  EXPECT_EQ(title_in_node(page(false)), "rrrrrrrr hidden 1.00");
}


// The picture has 400 pixels and is wider than it is high: the window's width, but for
// margins.
TEST(AnimationPage, TakesTheWidthOfTheWindow)
{
  if (!is_there("chromium"))
    GTEST_SKIP() << "there is no chromium to show the page";
  const std::string title = title_in_browser(page(true));
  EXPECT_EQ(title.substr(0, 17), "rrrrroor offered ") << title;
  EXPECT_GT(std::stod("0" + title.substr(title.rfind(' ') + 1)), 0.95) << title;
}
