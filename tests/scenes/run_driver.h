#ifndef nmm_tests_scenes_run_driver_h
#define nmm_tests_scenes_run_driver_h

#include <string>
#include <vector>

/// What a run of the driver said.
struct DriverResult
{
  int         exit_code;
  std::string output;
};

/// Run the driver with @p arguments (quoted here), on @p n_ranks ranks.
DriverResult
run_driver(const std::vector<std::string> &arguments, unsigned int n_ranks = 1);

/// A folder of that name for results, which does not exist.
std::string
fresh_output_dir(const std::string &name);

#endif
