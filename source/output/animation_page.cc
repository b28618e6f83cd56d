#include <nmm/output/animation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace NMM
{
  namespace
  {
    constexpr const char *style_and_controls = R"html(<style>
body { margin: 0; font: 15px/1.4 system-ui, sans-serif; color: #1a1a1a;
       background: #f4f4f4; }
main { margin: 8px; padding: 8px 12px; background: #fff; border-radius: 8px;
       box-shadow: 0 1px 4px #0003; }
img { display: block; width: 100%; height: auto;
      max-height: calc(100vh - 150px); min-height: 200px; object-fit: contain; }
.row { display: flex; gap: 10px; align-items: center; flex-wrap: wrap;
       margin-top: 10px; }
#position { flex: 1 1 260px; accent-color: #35608d; }
button { min-width: 2.6em; padding: 4px 10px; font: inherit; cursor: pointer;
         border: 1px solid #bbb; border-radius: 5px; background: #fafafa; }
button:hover { background: #eaeaea; }
#label { min-width: 11em; text-align: right;
         font-variant-numeric: tabular-nums; }
.hint { color: #666; font-size: 13px; margin: 8px 0 0; }
</style>
</head>
<body>
<main>
<img id="picture" alt="">
<div class="row">
<button id="back" title="One frame back (left arrow)">&minus;1</button>
<button id="play" title="Play or stop (space)">Play</button>
<button id="next" title="One frame on (right arrow)">+1</button>
<input id="position" type="range" min="0" max="0" value="0" step="1"
       aria-label="Frame">
<span id="label"></span>
</div>
<div class="row">
<label id="choice" hidden>Colour <select id="quantity"></select></label>
<label id="ranges" hidden>Range of colours and bars <select id="range">
<option selected>whole run</option>
<option>this frame</option>
</select></label>
<label>Speed <select id="speed">
<option value="0.25">&times; &frac14;</option>
<option value="0.5">&times; &frac12;</option>
<option value="1" selected>&times; 1</option>
<option value="2">&times; 2</option>
<option value="4">&times; 4</option>
</select></label>
<label><input id="loop" type="checkbox" checked> Loop</label>
<span id="count"></span>
</div>
<p class="hint">Space: play or stop. Arrow keys: one frame. Home and End: first
and last.</p>
</main>
)html";

    constexpr const char *script = R"html(<script>
"use strict";
const frames = [], at = id => document.getElementById(id);
let current = 0, playing = false, clock = 0, elapsed = 0;

function choices(names) {
  for (const name of names) at("quantity").add(new Option(name));
  at("choice").hidden = names.length < 2;
}

// Of the chosen quantity: in its range of the whole run or, if that is asked for
// and differs, in the frame's own.
function picture(f) {
  const q = at("quantity").selectedIndex;
  const own = at("range").selectedIndex === 1 && f.own && f.own[q];
  return own || f.png[q];
}
function frame(data) {
  frames.push(data);
  if (data.own) at("ranges").hidden = false;
  at("position").max = frames.length - 1;
  if (frames.length === 1) show(0);
}
function show(k) {
  const n = frames.length;
  if (n === 0) return;
  current = Math.max(0, Math.min(n - 1, k));
  const f = frames[current];
  at("picture").src = "data:image/png;base64," + picture(f);
  at("picture").alt = f.label;
  at("position").value = current;
  at("label").textContent = f.label;
  at("count").textContent = "Frame " + (current + 1) + " of " + n;
}
// Seconds for all frames, and when a frame is due: in proportion to its time.
function duration() {
  return Math.max(2, Math.min(20, frames.length / 20));
}
function due(k) {
  const n = frames.length, first = frames[0].time;
  const span = frames[n - 1].time - first;
  const part = span > 0 ? (frames[k].time - first) / span : k / (n - 1 || 1);
  return part * duration();
}
function play(on) {
  playing = on && frames.length > 1;
  at("play").textContent = playing ? "Stop" : "Play";
  if (!playing) return;
  if (current === frames.length - 1) show(0);
  elapsed = due(current);
  clock = performance.now();
  requestAnimationFrame(advance);
}
function advance(now) {
  if (!playing) return;
  elapsed += Math.max(0, now - clock) / 1000 * Number(at("speed").value);
  clock = now;
  const pause = 0.7; // the last frame is held before it starts again
  let k = current;
  if (elapsed > duration() + pause) {
    if (!at("loop").checked) {
      show(frames.length - 1);
      play(false);
      return;
    }
    elapsed = 0;
    k = 0;
  }
  while (k + 1 < frames.length && due(k + 1) <= elapsed) ++k;
  if (k !== current) show(k);
  requestAnimationFrame(advance);
}
function go(k) { play(false); show(k); }
at("play").onclick = () => play(!playing);
at("back").onclick = () => go(current - 1);
at("next").onclick = () => go(current + 1);
at("position").oninput = () => go(Number(at("position").value));
at("quantity").onchange = at("range").onchange = () => show(current);
document.onkeydown = e => {
  const keys = { " ": () => play(!playing), ArrowLeft: () => go(current - 1),
                 ArrowRight: () => go(current + 1), Home: () => go(0),
                 End: () => go(frames.length - 1) };
  if (!(e.key in keys) || e.target.tagName === "SELECT") return;
  e.preventDefault();
  keys[e.key]();
};
window.onload = () => { show(0); play(true); };
</script>
)html";


    std::string
    html(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        switch (c)
        {
          case '&':
            result += "&amp;";
            break;
          case '<':
            result += "&lt;";
            break;
          case '>':
            result += "&gt;";
            break;
          default:
            result += c;
        }
      return result;
    }


    /// @p text as a JSON string that is safe within a script element.
    std::string
    json(const std::string &text)
    {
      std::ostringstream result;
      result << '"';
      for (const char c : text)
        if (c == '"' || c == '\\')
          result << '\\' << c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == '<')
          result << "\\u" << std::hex << std::setw(4) << std::setfill('0')
                 << static_cast<int>(c) << std::dec;
        else
          result << c;
      result << '"';
      return result.str();
    }

  } // namespace


  AnimationPage::AnimationPage(std::ostream                   &out,
                               const std::string              &title,
                               const std::vector<std::string> &choices)
    : out(&out)
    , n_choices(choices.size())
  {
    out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
           "<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>"
        << html(title) << "</title>\n"
        << style_and_controls << script << "<script>choices([";
    for (std::size_t c = 0; c < choices.size(); ++c)
      out << (c > 0 ? "," : "") << json(choices[c]);
    out << "])</script>\n";
  }


  void
  AnimationPage::add_frame(const double                    time,
                           const std::string              &label,
                           const std::vector<std::string> &png,
                           const std::vector<std::string> &own)
  {
    AssertDimension(png.size(), n_choices);
    Assert(own.empty() || own.size() == n_choices,
           dealii::ExcDimensionMismatch(own.size(), n_choices));
    *out << "<script>frame({\"time\":"
         << std::setprecision(std::numeric_limits<double>::max_digits10) << time
         << ",\"label\":" << json(label) << ",\"png\":";
    write_pictures(png);
    const bool has_own =
      std::any_of(own.begin(), own.end(), [](const std::string &picture) {
        return !picture.empty();
      });
    if (has_own)
    {
      *out << ",\"own\":";
      write_pictures(own);
    }
    *out << "})</script>\n";
  }


  void
  AnimationPage::write_pictures(const std::vector<std::string> &pictures)
  {
    *out << '[';
    for (std::size_t c = 0; c < pictures.size(); ++c)
      *out << (c > 0 ? ",\"" : "\"")
           << dealii::Utilities::encode_base64(
                {pictures[c].begin(), pictures[c].end()})
           << '"';
    *out << ']';
  }

} // namespace NMM
