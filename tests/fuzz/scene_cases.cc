// Sample scenes with mistakes in them: values, keys, sections and geometries changed as
// people do by accident, and as nobody would.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <fuzz/fuzz.h>
#include <iterator>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      namespace fs = std::filesystem;

      /// Those that are solved in some tenths of a second.
      const char *const samples[] = {
        "tests/scenes/axial-bar/scene.prm",
        "tests/scenes/axial-bar-base-acceleration-file/scene.prm",
        "tests/scenes/base.prm",
        "tests/scenes/block-on-spring/scene.prm",
        "tests/scenes/contact-bond/scene.prm",
        "tests/scenes/contact-bond-of-domains/scene.prm",
        "tests/scenes/contact-dilation/scene.prm",
        "tests/scenes/contact-incline/scene.prm",
        "tests/scenes/contact-pushed-block/scene.prm",
        "tests/scenes/contact-stack/scene.prm",
        "tests/scenes/contact-two-laws/scene.prm",
        "tests/scenes/contact-vertex-springs/scene.prm",
        "tests/scenes/contact-wedges/scene.prm",
        "tests/scenes/finite-stretch/scene.prm",
        "tests/scenes/floating-block/scene.prm",
        "tests/scenes/free-fall/scene.prm",
        "tests/scenes/gravity-column/scene.prm",
        "tests/scenes/leaving-blocks/scene.prm",
        "tests/scenes/network-drawing/scene.prm",
        "tests/scenes/network-dropped-ends/scene.prm",
        "tests/scenes/network-regions/scene.prm",
        "tests/scenes/network-square/scene.prm",
        "tests/scenes/pushed-block/scene.prm",
        "tests/scenes/released-bar/scene.prm",
        "tests/scenes/restraint/scene.prm",
        "tests/scenes/safety-factor-incline/scene.prm",
        "tests/scenes/shaken-block/scene.prm",
        "tests/scenes/spinning-block/scene.prm",
        "tests/scenes/thin-layer/scene.prm",
        "applications/nmm/scenes/cantilever.prm",
        "applications/nmm/scenes/jointed-block.prm",
        "applications/nmm/scenes/sliding-block.prm",
        "applications/nmm/scenes/slope.prm",
        "applications/nmm/scenes/swing.prm"};

      const char *const values[] = {"",           "0",
                                    "-1",         "1e-300",
                                    "1e300",      "-1e300",
                                    "1e-12",      "1e12",
                                    "inf",        "-inf",
                                    "nan",        "1e400",
                                    "x",          "t",
                                    "1/0",        "sqrt(-1)",
                                    "0, 0",       "1, 2, 3",
                                    "true",       "; ;",
                                    "{",          "'",
                                    "0.5",        "1e",
                                    "file: none", "POLYGON ((0 0, 1 0, 0 1))",
                                    "2147483648", "-0",
                                    "rock",       "LINESTRING (0 0, 1 1)",
                                    "1e-160"};

      struct Word
      {
        const char *key, *value;
      };

      /// What decides which parts of the program run.
      const Word words[] = {{"Analysis", "static"},
                            {"Analysis", "dynamic"},
                            {"Analysis", "relaxation"},
                            {"Analysis", "safety factor"},
                            {"Kinematics", "small"},
                            {"Kinematics", "finite"},
                            {"Plane state", "plane strain"},
                            {"Plane state", "plane stress"},
                            {"Enforcement", "none"},
                            {"Enforcement", "penalty"},
                            {"Degree", "1"},
                            {"Start", "equilibrium"},
                            {"Start", "relaxation"},
                            {"Scheme", "newmark"},
                            {"Scheme", "generalized alpha"},
                            {"Scheme", "constant acceleration"},
                            {"Scheme", "energy momentum"},
                            {"Own meshes", "every region"},
                            {"Stabilization", "ghost penalty"},
                            {"Stabilization", "none"},
                            {"Dangling ends", "drop"}};


      std::string
      read(const fs::path &file)
      {
        std::ifstream      in(file);
        std::ostringstream text;
        text << in.rdbuf();
        return text.str();
      }


      std::string
      text_of(const double value)
      {
        char text[40];
        std::snprintf(text, sizeof(text), "%.17g", value);
        return text;
      }


      class SceneMaker
      {
      public:
        explicit SceneMaker(const std::uint64_t seed)
          : generator(seed)
        {
        }

        Case
        make();

      private:
        using Lines = std::vector<std::string>;

        unsigned int
        integer(const unsigned int low, const unsigned int high)
        {
          return low + generator() % (high - low + 1);
        }

        bool
        chance(const double probability)
        {
          return std::ldexp(generator() >> 11, -53) < probability;
        }

        template <std::size_t n, typename T>
        const T &
        any(const T (&list)[n])
        {
          return list[integer(0, n - 1)];
        }

        /// Where a line with one of these words is, at random; lines.size() if none is.
        std::size_t
        any_line(const std::string &word);
        /// First and last line of a section.
        std::pair<std::size_t, std::size_t>
        any_section();
        void
        set_value(std::size_t line, const std::string &value);

        /// Few steps and little output, so that a case is short.
        void
        shorten();

        void
        change_value();
        void
        change_number();
        void
        misspell();
        void
        drop_line();
        void
        double_line();
        void
        drop_section();
        void
        double_section();
        void
        swap_values();
        void
        exchange_word();
        void
        change_step();
        void
        damage_text();
        void
        move_geometry();
        void
        double_record();

        std::mt19937_64                    generator;
        Lines                              lines;
        std::map<std::string, std::string> files;
        std::string                        changes;
      };


      std::size_t
      SceneMaker::any_line(const std::string &word)
      {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < lines.size(); ++i)
          if (lines[i].find(word) != std::string::npos &&
              lines[i].find_first_not_of(' ') != lines[i].find('#'))
            found.push_back(i);
        return found.empty() ? lines.size()
                             : found[integer(0, found.size() - 1)];
      }


      std::pair<std::size_t, std::size_t>
      SceneMaker::any_section()
      {
        const std::size_t first = any_line("subsection ");
        std::size_t       last  = first;
        for (unsigned int depth = 0; last < lines.size(); ++last)
        {
          depth += lines[last].find("subsection ") != std::string::npos;
          depth -= std::regex_match(lines[last], std::regex(" *end *"));
          if (depth == 0)
            break;
        }
        return {first, last};
      }


      void
      SceneMaker::set_value(const std::size_t line, const std::string &value)
      {
        if (line < lines.size())
          lines[line] =
            lines[line].substr(0, lines[line].find('=') + 1) + " " + value;
      }


      void
      SceneMaker::shorten()
      {
        const auto first = [&](const std::string &key) {
          return std::find_if(lines.begin(),
                              lines.end(),
                              [&](const std::string &line) {
                                return line.find("set " + key) !=
                                       std::string::npos;
                              }) -
                 lines.begin();
        };
        const std::size_t n    = lines.size();
        const std::size_t step = first("Initial step"), end = first("End time");
        if (step < n && end < n)
          set_value(end,
                    text_of(4. * std::strtod(lines[step].c_str() +
                                               lines[step].find('=') + 1,
                                             nullptr)));
        if (chance(0.8))
          for (const char *line : {"subsection Output",
                                   "set Picture = false",
                                   "set Fields = false",
                                   "set Animation = false",
                                   "end"})
            lines.emplace_back(line);
      }


      void
      SceneMaker::change_value()
      {
        set_value(any_line(" = "), any(values));
      }


      void
      SceneMaker::change_number()
      {
        const std::size_t line = any_line(" = ");
        if (line == lines.size())
          return;
        const std::string text = lines[line];
        const std::regex  pattern("[-+]?[0-9]+\\.?[0-9]*(e[-+]?[0-9]+)?");
        const std::vector<std::smatch> found(
          std::sregex_iterator(text.begin() + text.find('='),
                               text.end(),
                               pattern),
          std::sregex_iterator());
        if (found.empty())
          return;
        const std::smatch &old   = found[integer(0, found.size() - 1)];
        double             value = std::strtod(old.str().c_str(), nullptr);
        // by little or by much: what lies between is a large problem, no mistake
        const double factors[] = {
          -1., 0., 1e-9, 1e9, 1e-30, 1e30, 0.7, 1.5, -1e-15, 1. + 1e-15};
        value *= any(factors);
        lines[line] = std::string(text.begin(), old[0].first) + text_of(value) +
                      std::string(old[0].second, text.end());
      }


      void
      SceneMaker::misspell()
      {
        const std::size_t line = any_line(chance(0.7) ? "set " : "subsection ");
        if (line < lines.size())
          lines[line].erase(integer(0, lines[line].size() - 1), 1);
      }


      void
      SceneMaker::drop_line()
      {
        if (!lines.empty())
          lines.erase(lines.begin() + integer(0, lines.size() - 1));
      }


      void
      SceneMaker::double_line()
      {
        if (lines.empty())
          return;
        const std::string line = lines[integer(0, lines.size() - 1)];
        lines.insert(lines.begin() + integer(0, lines.size()), line);
      }


      void
      SceneMaker::drop_section()
      {
        const auto [first, last] = any_section();
        if (last < lines.size())
          lines.erase(lines.begin() + first, lines.begin() + last + 1);
      }


      void
      SceneMaker::double_section()
      {
        const auto [first, last] = any_section();
        if (last < lines.size())
        {
          const Lines section(lines.begin() + first, lines.begin() + last + 1);
          lines.insert(chance(0.5) ? lines.begin() + last + 1 : lines.end(),
                       section.begin(),
                       section.end());
        }
      }


      void
      SceneMaker::swap_values()
      {
        const std::size_t a = any_line(" = "), b = any_line(" = ");
        if (a == lines.size())
          return;
        const std::string of_a = lines[a].substr(lines[a].find('=') + 1);
        set_value(a, lines[b].substr(lines[b].find('=') + 1));
        set_value(b, of_a);
      }


      void
      SceneMaker::exchange_word()
      {
        const Word       &word = any(words);
        const std::string key  = word.key;
        const std::size_t line = any_line("set " + key);
        if (line < lines.size())
        {
          set_value(line, word.value);
          return;
        }
        const std::string section =
          key == "Analysis" || key == "Kinematics" || key == "Plane state"
            ? "Model"
          : key == "Enforcement"                          ? "Contact"
          : key == "Degree"                               ? "Mathematical mesh"
          : key == "Start" || key == "Scheme"             ? "Time"
          : key == "Own meshes" || key == "Stabilization" ? "Covers"
                                                          : "Geometry";
        lines.push_back("subsection " + section);
        lines.push_back("  set " + key + " = " + word.value);
        lines.emplace_back("end");
      }


      void
      SceneMaker::change_step()
      {
        const char *const keys[] = {"step", "End time", "Gravity", "Spacing"};
        const std::size_t line   = any_line(any(keys));
        if (line == lines.size() || lines[line].find('=') == std::string::npos)
          return;
        const double factors[] = {1e-9, 0.1, 0.5, 2., 10., 1e3, 1e9, -1.};
        set_value(line,
                  text_of(
                    any(factors) *
                    std::strtod(lines[line].c_str() + lines[line].find('=') + 1,
                                nullptr)));
      }


      void
      SceneMaker::damage_text()
      {
        if (lines.empty())
          return;
        std::string &line = lines[integer(0, lines.size() - 1)];
        if (chance(0.3))
          lines.resize(integer(1, lines.size()));
        else if (!line.empty())
          line[integer(0, line.size() - 1)] =
            static_cast<char>(integer(1, 255));
      }


      void
      SceneMaker::move_geometry()
      {
        // scales between would make large problems of sets of joints, not mistakes
        static const int exponents[] = {-9, -6, -3, -1, 6, 9};
        const double scale = chance(0.5) ? 1. : std::pow(10., any(exponents)),
                     shift =
                       chance(0.5) ? 0. : std::pow(10., integer(0, 16) - 8.);
        const unsigned int digits = chance(0.5) ? integer(0, 8) : 17;
        const auto         move   = [&](const std::string &text) {
          // numbers in the parentheses of a record
          static const std::regex pattern(
            "[-+]?[0-9]+\\.?[0-9]*(e[-+]?[0-9]+)?(?=[ ,)])");
          std::string result;
          auto        last = text.begin();
          for (std::sregex_iterator it(text.begin(), text.end(), pattern), end;
               it != end;
               ++it)
          {
            const double x = std::strtod(it->str().c_str(), nullptr);
            const double factor = std::pow(10., digits);
            result.append(last, (*it)[0].first);
            result += text_of(
              (digits < 17 ? std::round(x * factor) / factor : x) * scale +
              shift);
            last = (*it)[0].second;
          }
          return result.append(last, text.end());
        };
        for (auto &[name, text] : files)
          if (fs::path(name).extension() == ".wkt")
            text = move(text);
        for (std::string &line : lines)
          if (line.find("((") != std::string::npos ||
              line.find("STRING") != std::string::npos)
            line = move(line);
      }


      void
      SceneMaker::double_record()
      {
        for (auto &[name, text] : files)
          if (fs::path(name).extension() == ".wkt")
          {
            text += text;
            return;
          }
        const std::size_t line = any_line("((");
        if (line < lines.size())
        {
          std::string copy = lines[line];
          if (copy.find("set Text = ") != std::string::npos)
            copy.erase(0, copy.find('=') + 1);
          lines.insert(lines.begin() + line + 1, copy);
        }
      }


      Case
      SceneMaker::make()
      {
        const fs::path scene = fs::path(NMM_SOURCE_DIR) / any(samples);
        for (const auto &entry : fs::directory_iterator(scene.parent_path()))
          if (const std::string type = entry.path().extension().string();
              type == ".wkt" || type == ".dxf" || type == ".txt")
            files[entry.path().filename().string()] = read(entry.path());
        std::istringstream text(read(scene));
        for (std::string line; std::getline(text, line);)
          lines.push_back(line);
        shorten();

        struct Mutation
        {
          const char *name;
          void (SceneMaker::*run)();
        };
        static const Mutation all[] = {
          {"value", &SceneMaker::change_value},
          {"value", &SceneMaker::change_value},
          {"number", &SceneMaker::change_number},
          {"number", &SceneMaker::change_number},
          {"number", &SceneMaker::change_number},
          {"misspelled", &SceneMaker::misspell},
          {"line dropped", &SceneMaker::drop_line},
          {"line twice", &SceneMaker::double_line},
          {"section dropped", &SceneMaker::drop_section},
          {"section twice", &SceneMaker::double_section},
          {"values swapped", &SceneMaker::swap_values},
          {"word", &SceneMaker::exchange_word},
          {"word", &SceneMaker::exchange_word},
          {"step", &SceneMaker::change_step},
          {"damaged", &SceneMaker::damage_text},
          {"geometry moved", &SceneMaker::move_geometry},
          {"geometry moved", &SceneMaker::move_geometry},
          {"record twice", &SceneMaker::double_record}};
        const unsigned int n = integer(1, 3);
        for (unsigned int i = 0; i < n; ++i)
        {
          const Mutation &mutation = any(all);
          (this->*mutation.run)();
          changes += std::string(", ") + mutation.name;
        }

        Case result;
        result.description =
          fs::relative(scene, NMM_SOURCE_DIR).string() + changes;
        std::string mutated;
        for (const std::string &line : lines)
          mutated += line + '\n';
        result.files             = files;
        result.files["case.prm"] = mutated;
        return result;
      }
    } // namespace


    Case
    make_scene_case(const std::uint64_t seed)
    {
      return SceneMaker(seed).make();
    }
  } // namespace Fuzz
} // namespace NMM
