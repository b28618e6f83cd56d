#include "driver.h"

#include <nmm/base/memory.h>
#include <nmm/base/program.h>
#include <nmm/output/progress.h>
#include <nmm/scene/capabilities.h>
#include <nmm/scene/run_scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <boost/program_options.hpp>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{
  namespace po = boost::program_options;

  struct Options
  {
    std::string scene;
    std::string output;
    /// Checkpoint to continue from; empty: none.
    std::string              restart;
    std::vector<std::string> overrides;
    bool                     check_only       = false;
    bool                     is_confined      = false;
    unsigned int             n_threads        = 1;
    bool                     print_parameters = false;
    NMM::Scene::Format       format           = NMM::Scene::Format::prm;
    /// Text to print instead of running.
    std::string answer;
  };


  po::options_description
  visible_options()
  {
    po::options_description options("Options");
    auto                    add = options.add_options();
    add("output,o",
        po::value<std::string>(),
        "folder for the results, made if need be (default: the scene's name "
        "with '-output', in the current folder)");
    add("set,s",
        po::value<std::vector<std::string>>()->composing(),
        "Section/Key=value, replaces a value of the scene; may be repeated");
    add("restart,r",
        po::value<std::string>(),
        "continue a run from this checkpoint; histories and series "
        "in the folder for the results are continued");
    add(
      "threads,t",
      po::value<unsigned int>()->default_value(1),
      "threads of each process, at least 1; the results have the same bits for "
      "any number. The rules of cut elements and the assembly of small static "
      "and of finite kinematics use them");
    add("check,c",
        po::bool_switch(),
        "read, cut and report, but do not solve and write nothing");
    add("confined",
        po::bool_switch(),
        "for scenes of strangers: refuse files outside of the scene's folder "
        "that it names");
    add("print-parameters",
        po::value<std::string>()->implicit_value("prm"),
        "print all parameters, of the scene if one is given, and end; "
        "=prm, =json or =markdown");
    add("print-capabilities",
        po::bool_switch(),
        "print what can be combined, what cannot and why, and end");
    add("help,h", po::bool_switch(), "print this and end");
    add("version", po::bool_switch(), "print the version and end");
    return options;
  }


  std::string
  help_text()
  {
    std::ostringstream text;
    text << "nmm solves a scene with the second-order numerical manifold "
            "method.\n\n"
            "Usage: nmm [options] scene.prm\n\n"
         << visible_options()
         << "\nWrites summary.csv, probes.csv, fields.vtu and picture.png, and "
            "history.csv of\nsteps of load or time; with contact contacts.csv. "
            "Scene files are explained in "
            "doc/scene-format.md.\n\n"
            "Exit codes: 0 success, 1 internal error, 2 bad input (nothing "
            "is written),\n3 no solution (what is known is written), 4 "
            "stopped by Ctrl-C or SIGTERM at the end\nof a step (what is known "
            "is written).\n";
    return text.str();
  }


  NMM::Scene::Format
  parse_format(const std::string &word)
  {
    AssertThrow(word == "prm" || word == "json" || word == "markdown",
                NMM::InputError("'" + word + "' is no format of parameters",
                                "--print-parameters",
                                "choose prm, json or markdown"));
    return word == "prm"    ? NMM::Scene::Format::prm
           : word == "json" ? NMM::Scene::Format::json
                            : NMM::Scene::Format::markdown;
  }


  Options
  parse_command_line(const int argc, char **argv)
  {
    po::options_description hidden;
    hidden.add_options()("scene", po::value<std::vector<std::string>>());
    po::options_description all;
    all.add(visible_options()).add(hidden);
    po::positional_options_description positional;
    positional.add("scene", -1);

    po::variables_map variables;
    try
    {
      namespace style = po::command_line_style;
      po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(positional)
                  .style(style::unix_style & ~style::allow_guessing)
                  .run(),
                variables);
      po::notify(variables);
    }
    catch (const po::error &error)
    {
      AssertThrow(false,
                  NMM::InputError(error.what(),
                                  "the command line",
                                  "see nmm --help"));
    }

    Options options;
    if (variables["help"].as<bool>())
      options.answer = help_text();
    else if (variables["version"].as<bool>())
      options.answer = "nmm " NMM_VERSION "\n";
    else if (variables["print-capabilities"].as<bool>())
      options.answer = NMM::capabilities_page();

    std::vector<std::string> scenes;
    if (variables.count("scene") > 0)
      scenes = variables["scene"].as<std::vector<std::string>>();
    if (variables.count("restart") > 0)
    {
      options.restart = variables["restart"].as<std::string>();
      AssertThrow(!options.restart.empty(),
                  NMM::InputError("the checkpoint has no name",
                                  "--restart",
                                  "name the file to continue from"));
    }
    if (variables.count("set") > 0)
      options.overrides = variables["set"].as<std::vector<std::string>>();
    options.check_only  = variables["check"].as<bool>();
    options.is_confined = variables["confined"].as<bool>();
    options.n_threads   = variables["threads"].as<unsigned int>();
    AssertThrow(options.n_threads >= 1 && options.n_threads <= 1024,
                NMM::InputError("there cannot be " +
                                  std::to_string(options.n_threads) +
                                  " threads",
                                "--threads",
                                "give a number from 1 to 1024"));
    options.print_parameters = variables.count("print-parameters") > 0;
    if (options.print_parameters)
    {
      // "--print-parameters scene.prm": the next word is the scene.
      const auto word = variables["print-parameters"].as<std::string>();
      if (scenes.empty() && word.find('.') != std::string::npos)
        scenes.push_back(word);
      else
        options.format = parse_format(word);
    }

    const bool needs_scene =
      options.answer.empty() && !options.print_parameters;
    AssertThrow(scenes.size() <= 1 && (!scenes.empty() || !needs_scene),
                NMM::InputError(std::to_string(scenes.size()) +
                                  " scene files are given",
                                "the command line",
                                "give one; see nmm --help"));
    if (!scenes.empty())
      options.scene = scenes.front();
    options.output =
      variables.count("output") > 0
        ? variables["output"].as<std::string>()
        : std::filesystem::path(options.scene).stem().string() + "-output";
    return options;
  }


  /// @p has_output becomes true when results begin to be written.
  void
  run_scene(const Options &options,
            const MPI_Comm communicator,
            bool          &has_output)
  {
    // What mpirun collects from several ranks is no place for a moving display.
    const bool is_terminal =
      isatty(STDOUT_FILENO) != 0 &&
      dealii::Utilities::MPI::n_mpi_processes(communicator) == 1;
    NMM::Progress        progress(std::cout, is_terminal, communicator);
    const NMM::Scene     scene(options.scene,
                           options.overrides,
                           options.is_confined);
    NMM::SceneRunOptions run_options;
    run_options.output     = options.output;
    run_options.restart    = options.restart;
    run_options.check_only = options.check_only;
    NMM::run_scene(scene, run_options, progress, communicator, has_output);
  }


  void
  print_from_first_rank(const std::string &text, const MPI_Comm communicator)
  {
    NMM::on_first_rank(communicator, [&]() {
      errno = 0;
      std::cout << text << std::flush;
      AssertThrow(std::cout.good(), NMM::OutputFailure("standard output"));
    });
  }


  void
  run(const int      argc,
      char         **argv,
      const MPI_Comm communicator,
      bool          &has_output)
  {
    const Options options = parse_command_line(argc, argv);
    if (!options.answer.empty())
      return print_from_first_rank(options.answer, communicator);
    if (options.print_parameters)
    {
      std::ostringstream text;
      if (options.scene.empty())
        NMM::Scene::print_defaults(text, options.format);
      else
        NMM::Scene(options.scene, options.overrides)
          .print(text, options.format);
      return print_from_first_rank(text.str(), communicator);
    }
    dealii::MultithreadInfo::set_thread_limit(options.n_threads);
    NMM::reserve_work_space();
    run_scene(options, communicator, has_output);
  }


  /// In a catch block: say what happened and give the exit code. Not all ranks may
  /// have failed; those that have not are ended.
  int
  fail(const MPI_Comm communicator, const bool has_output)
  {
    constexpr double      patience = 5.; // [s]
    const NMM::ProgramEnd end      = NMM::explain_exception(has_output);
    const int             code     = static_cast<int>(end.code);
    const bool have_all_failed = NMM::all_ranks_arrive(communicator, patience);
    if (!have_all_failed ||
        dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      std::cerr << "nmm: " << end.message << std::endl;
    if (!have_all_failed)
      MPI_Abort(communicator, code);
    return code;
  }
} // namespace


int
run_driver(const int argc, char **argv, const MPI_Comm communicator)
{
  // Ranks that fail meet here, whatever else they exchange.
  MPI_Comm failing;
  MPI_Comm_dup(communicator, &failing);
  bool has_output = false;
  int  code       = static_cast<int>(NMM::ExitCode::success);
  try
  {
    run(argc, argv, communicator, has_output);
  }
  catch (...)
  {
    code = fail(failing, has_output);
  }
  MPI_Comm_free(&failing);
  return code;
}
