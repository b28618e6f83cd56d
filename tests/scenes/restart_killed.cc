#include "cases.h"
#include "result_files.h"
#include "run_driver.h"
#include <chrono>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

// Runs that are killed, and are continued from their checkpoint.
namespace
{
  namespace fs = std::filesystem;

  /// Start the driver and come back at once.
  pid_t
  start(Arguments arguments)
  {
    arguments.insert(arguments.begin(), NMM_DRIVER);
    std::vector<char *> words;
    for (std::string &argument : arguments)
      words.push_back(argument.data());
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0)
    {
      const int null = ::open("/dev/null", O_WRONLY);
      dup2(null, STDOUT_FILENO);
      dup2(null, STDERR_FILENO);
      execv(words[0], words.data());
      _exit(127);
    }
    return child;
  }


  /// Let it run until it has written a checkpoint and a little longer, then
  /// SIGKILL. False if it had ended before.
  bool
  kill_after_checkpoint(const pid_t                     child,
                        const fs::path                 &checkpoint,
                        const fs::file_time_type        not_before,
                        const std::chrono::milliseconds longer)
  {
    const auto      deadline = time(nullptr) + 60;
    std::error_code none;
    while (time(nullptr) < deadline &&
           !(fs::exists(checkpoint) &&
             fs::last_write_time(checkpoint, none) > not_before))
    {
      int status = 0;
      if (waitpid(child, &status, WNOHANG) == child)
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(longer);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  }


  /// Let it run until the file @p awaited is there, then send @p signal. Returns the exit code, or
  /// minus the signal that has ended the program.
  int
  stop_after(const pid_t child, const fs::path &awaited, const int signal)
  {
    const auto deadline = time(nullptr) + 120;
    int        status   = 0;
    while (time(nullptr) < deadline && !fs::exists(awaited))
    {
      if (waitpid(child, &status, WNOHANG) == child)
        return WEXITSTATUS(status);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, signal);
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }


  // Ctrl-C and SIGTERM end a run at the end of a step, with a checkpoint although the scene asks
  // for none.
  TEST(Driver, StoppedRunsGoOnWithTheSameBits)
  {
    const Arguments   settings{"--set",
                             "Output/Fields every=20",
                             "--set",
                             "Time/Initial step=0.002",
                             "--set",
                             "Time/Largest step=0.004",
                             "--set",
                             "Time/Largest displacement=0.015",
                             "--set",
                             "Time/End time=2",
                             cases_dir + "spinning-block/scene.prm"};
    const std::string straight = fresh_output_dir("not-stopped");
    EXPECT_EQ(run_driver(settings + Arguments{"-o", straight}).exit_code, 0);
    const std::string stopped = fresh_output_dir("stopped");
    const fs::path    series  = stopped + "/fields-0001.vtu";
    EXPECT_EQ(stop_after(start(settings + Arguments{"-o", stopped}),
                         series,
                         SIGINT),
              4);
    const Arguments restart{"-o",
                            stopped,
                            "--restart",
                            stopped + "/checkpoint.nmm"};
    EXPECT_TRUE(fs::exists(stopped + "/summary.csv"));
    EXPECT_EQ(stop_after(start(settings + restart),
                         stopped + "/fields-0003.vtu",
                         SIGTERM),
              4);
    EXPECT_EQ(run_driver(settings + restart).exit_code, 0);
    expect_same_histories(straight, stopped);
  }


  // Where nothing can be continued, what is known is written.
  TEST(Driver, StoppedRelaxationsSayWhatIsKnown)
  {
    const std::string folder = fresh_output_dir("stopped-relaxation");
    EXPECT_EQ(stop_after(start({"--set",
                                "Relaxation/Tolerance=1e-30",
                                "--set",
                                "Relaxation/Maximum steps=100000000",
                                "--set",
                                "Output/Fields every=1",
                                "-o",
                                folder,
                                "--set",
                                "Model/Analysis=relaxation",
                                "--set",
                                "Relaxation/Step=0.01",
                                cases_dir + "contact-stack/scene.prm"}),
                         folder + "/fields-0002.vtu",
                         SIGTERM),
              4);
    EXPECT_TRUE(fs::exists(folder + "/summary.csv"));
    EXPECT_FALSE(fs::exists(folder + "/checkpoint.nmm"));
  }


  TEST(Driver, KilledRunsGoOnWithTheSameBits)
  {
    const unsigned int seed = std::random_device()();
    std::cout << "seed " << seed << std::endl;
    std::mt19937                       generator(seed);
    std::uniform_int_distribution<int> milliseconds(0, 150);
    const Arguments                    settings{"--set",
                             "Output/Checkpoint every=5",
                             "--set",
                             "Output/Fields every=20",
                             "--set",
                             "Time/Initial step=0.002",
                             "--set",
                             "Time/Largest step=0.004",
                             "--set",
                             "Time/Largest displacement=0.015",
                             "--set",
                             "Time/End time=2",
                             cases_dir + "spinning-block/scene.prm"};
    const std::string                  straight = fresh_output_dir("unbroken");
    const std::string                  killed   = fresh_output_dir("killed");
    const auto                         run = [](const Arguments &arguments) {
      const DriverResult result = run_driver(arguments);
      EXPECT_EQ(result.exit_code, 0) << result.output;
    };
    run(settings + Arguments{"-o", straight});

    const std::string  checkpoint = killed + "/checkpoint.nmm";
    unsigned int       n_kills    = 0;
    Arguments          restart;
    fs::file_time_type last = fs::file_time_type::min();
    for (unsigned int i = 0; i < 3; ++i)
    {
      const pid_t child = start(settings + Arguments{"-o", killed} + restart);
      n_kills += kill_after_checkpoint(child,
                                       checkpoint,
                                       last,
                                       std::chrono::milliseconds(
                                         milliseconds(generator)));
      ASSERT_TRUE(fs::exists(checkpoint));
      last    = fs::last_write_time(checkpoint);
      restart = {"--restart", checkpoint};
      // What a run leaves in its last moments, see CsvSeries.
      std::ofstream(killed + "/history.csv", std::ios::app) << "1.99,99999,0.0";
      std::ofstream(killed + "/probes-history.csv", std::ios::app) << "1.9";
    }
    ASSERT_GE(n_kills, 1u);
    EXPECT_FALSE(fs::exists(killed + "/summary.csv"));
    run(settings + Arguments{"-o", killed} + restart);
    expect_same_histories(straight, killed);
    check_series(killed);
    for (const auto &entry : fs::directory_iterator(killed))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();

    // The same fields, numbers and times.
    const auto list = [](const std::string &folder) {
      const std::string pvd = read_text(folder + "/fields.pvd");
      return pvd.substr(pvd.find("<VTKFile"));
    };
    EXPECT_EQ(list(straight), list(killed));
  }
} // namespace
