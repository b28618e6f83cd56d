// nmm-fuzz: run random cases of a generator, report those that fail and write them out.

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fuzz/fuzz.h>
#include <iomanip>
#include <iostream>
#include <thread>
#include <unistd.h>

namespace
{
  const char *const usage =
    "Usage: nmm-fuzz GENERATOR N [SEED [FOLDER]]\n\n"
    "Runs N cases of a generator (geometry, scene, growth, contact-growth,\n"
    "growth-in-motion, blocks, networks)\n"
    "with the seeds SEED (1), SEED + 1, ... A case that fails, crashes or "
    "takes\n"
    "more than 10 s (contact-growth, growth-in-motion, blocks: 60 s, networks: "
    "600 s) is written to "
    "FOLDER/GENERATOR-SEED\n"
    "(output/fuzz) as a scene.\n\n"
    "Exit codes: 0 nothing failed, 1 something did, 2 wrong arguments.\n";

  NMM::Fuzz::Case current;
  std::string     current_folder;

  void
  report(const std::string &what)
  {
    std::cout << current_folder << ": " << what << " (" << current.description
              << ")" << std::endl;
    NMM::Fuzz::write(current, current_folder);
    _exit(1);
  }


  // Not everything in here may be done in a signal handler by the letter; all that can be
  // lost is the message about a failure.
  void
  report_signal(const int signal)
  {
    std::signal(signal, SIG_DFL);
    report("signal " + std::to_string(signal));
  }


  /// Tenths of a second since the case began, while this process was not stopped.
  std::atomic<unsigned int> tenths(0);

  std::atomic<unsigned int> seconds_at_most(0);

  /// A thread, as memory may be allocated in one, which a signal handler must not.
  void
  watch()
  {
    while (true)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      if (++tenths > 10 * seconds_at_most)
        report("no end after " + std::to_string(seconds_at_most) + " s");
    }
  }
} // namespace


int
main(int argc, char **argv)
{
  if (argc < 3)
  {
    std::cerr << usage;
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  for (const int signal : {SIGSEGV, SIGFPE, SIGABRT, SIGBUS})
    std::signal(signal, report_signal);

  const std::string   name  = argv[1];
  const unsigned long n     = std::strtoul(argv[2], nullptr, 10);
  const unsigned long first = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1;
  const std::string   folder   = argc > 4 ? argv[4] : "output/fuzz";
  unsigned long       n_failed = 0;
  try
  {
    const NMM::Fuzz::Generator &generator = NMM::Fuzz::find_generator(name);
    seconds_at_most                       = generator.seconds_at_most;
    std::thread(watch).detach();
    for (unsigned long seed = first; seed < first + n; ++seed)
    {
      current        = generator.make(seed);
      current_folder = folder + "/" + name + "-" + std::to_string(seed);
      tenths         = 0;
      const std::string failure = NMM::Fuzz::check(generator, current);
      if (failure.empty())
        continue;
      ++n_failed;
      std::cout << current_folder << ": " << failure << " ("
                << current.description << ")" << std::endl;
      NMM::Fuzz::write(current, current_folder);
    }
  }
  catch (const std::exception &exception)
  {
    std::cerr << "nmm-fuzz: " << exception.what() << '\n' << usage;
    return 2;
  }
  const std::chrono::duration<double> elapsed =
    std::chrono::steady_clock::now() - start;
  std::cout << name << ", seeds " << first << " to " << first + n - 1 << ": "
            << n_failed << " of " << n << " cases failed, "
            << std::setprecision(3) << elapsed.count() << " s" << std::endl;
  return n_failed > 0 ? 1 : 0;
}
