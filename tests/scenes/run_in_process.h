#ifndef nmm_tests_scenes_run_in_process_h
#define nmm_tests_scenes_run_in_process_h

#include <string>
#include <vector>

/// What a run of the driver said.
struct DriverResult
{
  int         exit_code;
  std::string output;
};

/// Call the driver with @p arguments in this process, on all ranks of it. The
/// exit code of main() for what the driver throws is 1.
DriverResult
run_in_process(const std::vector<std::string> &arguments);

/// A folder of that name for results, which does not exist. Collective.
std::string
fresh_output_dir(const std::string &name);

/// Number of ranks of this process's run.
unsigned int
n_ranks();

/// Whether messages are this process's to write.
bool
is_first_rank();

#endif
