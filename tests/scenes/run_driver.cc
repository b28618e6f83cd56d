#include "run_driver.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <sys/wait.h>

DriverResult
run_driver(const std::vector<std::string> &arguments,
           const unsigned int              n_ranks)
{
  std::string command;
  if (n_ranks > 1)
    command = std::string(NMM_MPIEXEC) + " " + std::to_string(n_ranks) + " ";
  command += "'" NMM_DRIVER "'";
  for (const std::string &argument : arguments)
  {
    command += " '";
    for (const char c : argument)
      command += c == '\'' ? std::string("'\\''") : std::string(1, c);
    command += "'";
  }
  command += " 2>&1";

  DriverResult result{-1, ""};
  FILE        *pipe = popen(command.c_str(), "r");
  if (pipe == nullptr)
    return result;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status))
    result.exit_code = WEXITSTATUS(status);
  return result;
}


std::string
fresh_output_dir(const std::string &name)
{
  const std::filesystem::path path =
    std::filesystem::path(NMM_TEST_OUTPUT_DIR) / name;
  std::filesystem::remove_all(path);
  return path.string();
}
