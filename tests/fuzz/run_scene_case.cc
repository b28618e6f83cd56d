#include <nmm/base/program.h>
#include <nmm/output/progress.h>
#include <nmm/scene/run_scene.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <fuzz/fuzz.h>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <unistd.h>
#include <vector>

namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      namespace fs = std::filesystem;

      /// A mutated scene may ask for more steps than there is time for, which is no
      /// mistake.
      class TimeIsUp
      {
      };


      /**
       * A terminal that shows nothing. After some seconds the next report of how far a
       * stage has come ends the run with TimeIsUp; what reports nothing for long is a
       * hang, which is for nmm-fuzz to see. Reports begin by emptying the line and what
       * destructors say does not. The exception leaves by way of a stream that is tied
       * to the terminal's, since that one must stay good for destructors.
       */
      class Terminal : public std::streambuf
      {
      public:
        explicit Terminal(const double seconds)
          : stream(this)
          , clock(*this, seconds)
          , clock_stream(&clock)
        {
          clock_stream.exceptions(std::ios::badbit);
          stream.tie(&clock_stream);
        }

        std::ostream &
        out()
        {
          return stream;
        }

      protected:
        std::streamsize
        xsputn(const char *text, const std::streamsize n) override
        {
          line_is_empty = std::string(text, n) == "\r\033[K";
          return n;
        }

        int_type
        overflow(const int_type c) override
        {
          line_is_empty = false;
          return traits_type::not_eof(c);
        }

      private:
        class Clock : public std::streambuf
        {
        public:
          Clock(Terminal &terminal, const double seconds)
            : terminal(terminal)
            , seconds(seconds)
          {
          }

        protected:
          int
          sync() override
          {
            using Seconds = std::chrono::duration<double>;
            if (terminal.line_is_empty &&
                Seconds(std::chrono::steady_clock::now() - start).count() >
                  seconds)
            {
              terminal.stream.tie(nullptr);
              throw TimeIsUp();
            }
            return 0;
          }

        private:
          Terminal                                   &terminal;
          const double                                seconds;
          const std::chrono::steady_clock::time_point start =
            std::chrono::steady_clock::now();
        };

        bool         line_is_empty = false;
        std::ostream stream;
        Clock        clock;
        std::ostream clock_stream;
      };


      bool
      is_finite(const std::vector<std::string> &row)
      {
        return std::none_of(row.begin(),
                            row.end(),
                            [](const std::string &word) {
                              return word == "nan" || word == "-nan" ||
                                     word == "inf" || word == "-inf";
                            });
      }


      /// The first row of a table in @p folder with a value that is not finite, or "".
      std::string
      find_non_finite(const fs::path &folder)
      {
        for (const auto &entry : fs::recursive_directory_iterator(folder))
          if (entry.path().extension() == ".csv")
          {
            std::ifstream in(entry.path());
            std::size_t   inside = 0;
            for (std::string line; std::getline(in, line);)
            {
              std::vector<std::string> row;
              std::istringstream       fields(line);
              for (std::string field; std::getline(fields, field, ',');)
                row.push_back(field);
              if (inside == 0 && row.size() > 5 && row[5] == "inside")
                inside = 5;
              // a probe may be called so
              if (entry.path().filename() == "probes.csv" && !row.empty())
                row.front().clear();
              const bool is_outside =
                inside > 0 && row.size() > inside && row[inside] == "0";
              if (!is_outside && !is_finite(row))
                return entry.path().filename().string() + ": " + line;
            }
          }
        return "";
      }


      /// How a scene ended: what is wrong, what the program says, its exit code (-1: there was no time),
      /// and the number of iterations with those that were in vain.
      struct End
      {
        std::string failure, message;
        int         code         = 0;
        double      n_iterations = 0.;
      };


      /// Sum of the columns `iterations` and `lost_iterations` of history.csv in @p folder.
      double
      count_iterations(const fs::path &folder)
      {
        double        sum = 0.;
        std::ifstream in(folder / "history.csv");
        for (std::string line; std::getline(in, line);)
        {
          std::istringstream       fields(line);
          std::vector<std::string> row;
          for (std::string field; std::getline(fields, field, ',');)
            row.push_back(field);
          // the first row has names, and a second one may have units
          if (row.size() > 4 &&
              row[3].find_first_not_of("0123456789") == std::string::npos)
            sum += std::stod(row[3]) + std::stod(row[4]);
        }
        return sum;
      }


      End
      run_scene_file(const Case        &c,
                     const std::string &file,
                     const double       seconds = 2.)
      {
        const fs::path folder =
          fs::temp_directory_path() / ("nmm-fuzz-" + std::to_string(getpid()));
        fs::remove_all(folder);
        write(c, folder.string());
        SceneRunOptions options;
        options.output          = (folder / "results").string();
        bool         has_output = false;
        End          end;
        std::string &failure = end.failure;
        try
        {
          Terminal    terminal(seconds);
          Progress    progress(terminal.out(), true, MPI_COMM_WORLD);
          const Scene scene((folder / file).string(), {});
          run_scene(scene, options, progress, MPI_COMM_WORLD, has_output);
          if (const std::string row = find_non_finite(options.output);
              !row.empty())
            failure = "exit code 0, but " + row;
        }
        catch (const TimeIsUp &)
        {
          end.code = -1;
        }
        catch (...)
        {
          const ProgramEnd what = explain_exception(has_output);
          end.code              = static_cast<int>(what.code);
          end.message           = what.message;
          if (what.code == ExitCode::input_error && fs::exists(options.output))
            failure = "exit code 2, but results are written: " + what.message;
          else if (what.code != ExitCode::input_error &&
                   what.code != ExitCode::numerical_failure)
            failure =
              "exit code " + std::to_string(end.code) + ": " + what.message;
        }
        end.n_iterations = count_iterations(options.output);
        fs::remove_all(folder);
        return end;
      }
    } // namespace


    std::string
    run_scene_case(const Case &c)
    {
      return run_scene_file(c, "case.prm").failure;
    }


    std::string
    run_network_case(const Case &c)
    {
      const End end = run_scene_file(c, "case.prm", 500.);
      if (!end.failure.empty())
        return end.failure;
      for (const char *words : {"No step of at least", "No rest after"})
        if (end.message.find(words) != std::string::npos)
          return end.message;
      return end.code < 0 ? "no end in time" : "";
    }


    std::string
    run_block_case(const Case &c)
    {
      const End here = run_scene_file(c, "origin.prm"),
                far  = run_scene_file(c, "case.prm");
      if (!here.failure.empty() || !far.failure.empty())
        return here.failure + far.failure;
      if (here.code < 0 || far.code < 0)
        return "";
      std::ostringstream text;
      if (here.code != far.code)
        text << "exit code " << far.code << ", at the origin " << here.code;
      else if (far.n_iterations > 1.5 * here.n_iterations + 20.)
        text << far.n_iterations << " iterations, at the origin "
             << here.n_iterations;
      return text.str();
    }
  } // namespace Fuzz
} // namespace NMM
