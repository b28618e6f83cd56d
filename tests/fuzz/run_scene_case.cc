#include "driver.h"
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <fuzz/fuzz.h>
#include <iostream>
#include <mpi.h>
#include <sstream>
#include <stdexcept>
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

      const std::string time_is_up = "the time for a case is up";


      /**
       * What the driver writes to std::cout and std::cerr. A mutated scene may ask for
       * more steps than there is time for, which is no mistake: a line after more than
       * a second ends the run with an exception that no handler takes for one of the
       * program's. What says nothing for long is a hang, which is for nmm-fuzz to see.
       */
      class Output : public std::streambuf
      {
      public:
        Output()
          : start(std::chrono::steady_clock::now())
          , cout_buffer(std::cout.rdbuf(this))
          , cerr_buffer(std::cerr.rdbuf(this))
        {
          std::cout.exceptions(std::ios::badbit);
        }

        ~Output() override
        {
          std::cout.rdbuf(cout_buffer);
          std::cerr.rdbuf(cerr_buffer);
          std::cout.exceptions(std::ios::goodbit);
          std::cout.clear();
          std::cerr.clear();
        }

        std::string text;

      protected:
        int_type
        overflow(const int_type c) override
        {
          using Seconds = std::chrono::duration<double>;
          if (!is_up &&
              Seconds(std::chrono::steady_clock::now() - start).count() > 1.)
          {
            is_up = true;
            throw std::runtime_error(time_is_up);
          }
          if (c != traits_type::eof())
            text += traits_type::to_char_type(c);
          return traits_type::not_eof(c);
        }

      private:
        const std::chrono::steady_clock::time_point start;
        bool                                        is_up = false;
        std::streambuf                             *cout_buffer, *cerr_buffer;
      };


      /// The first table below @p folder with a value that is not finite, or "".
      std::string
      find_non_finite(const fs::path &folder)
      {
        for (const auto &entry : fs::recursive_directory_iterator(folder))
          if (entry.path().extension() == ".csv")
          {
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);)
            {
              std::istringstream fields(line);
              for (std::string field; std::getline(fields, field, ',');)
                if (field == "nan" || field == "-nan" || field == "inf" ||
                    field == "-inf")
                  return entry.path().filename().string() + ": " + line;
            }
          }
        return "";
      }
    } // namespace


    std::string
    run_scene_case(const Case &c)
    {
      const fs::path folder =
        fs::temp_directory_path() / ("nmm-fuzz-" + std::to_string(getpid()));
      fs::remove_all(folder);
      write(c, folder.string());
      const fs::path           results = folder / "results";
      std::vector<std::string> words   = {"nmm",
                                          "--output",
                                          results.string(),
                                          (folder / "case.prm").string()};
      std::vector<char *>      argv;
      for (std::string &word : words)
        argv.push_back(word.data());
      argv.push_back(nullptr);

      int         code;
      std::string output;
      {
        Output captured;
        code   = run_driver(words.size(), argv.data(), MPI_COMM_WORLD);
        output = captured.text;
      }
      std::string failure;
      if (code == 0)
      {
        if (const std::string value = find_non_finite(results); !value.empty())
          failure = "exit code 0, but " + value;
      }
      else if (code == 2)
      {
        if (fs::exists(results))
          failure = "exit code 2, but something is written: " + output;
      }
      else if (code != 3 && output.find(time_is_up) == std::string::npos)
        failure = "exit code " + std::to_string(code) + ": " + output;
      fs::remove_all(folder);
      return failure;
    }
  } // namespace Fuzz
} // namespace NMM
