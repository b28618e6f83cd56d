#include <nmm/base/exceptions.h>
#include <nmm/base/memory.h>

#include <deal.II/lac/full_matrix.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace NMM
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr double unlimited = std::numeric_limits<double>::max();


    /// The number that follows @p key in a file with a key and a number on each line; 0 if there
    /// is none.
    double
    number_in_file(const fs::path &file, const std::string &key)
    {
      std::ifstream in(file);
      for (std::string line; std::getline(in, line);)
      {
        std::istringstream words(line);
        std::string        word;
        double             number;
        if (words >> word && word == key && words >> number)
          return number;
      }
      return 0.;
    }


    double
    first_number(const fs::path &file, const double otherwise)
    {
      std::ifstream in(file);
      double        number;
      return in >> number ? number : otherwise;
    }


    double
    left_on_machine()
    {
      const fs::path   file      = "/proc/meminfo";
      constexpr double kilobyte  = 1024.;
      const double     available = number_in_file(file, "MemAvailable:");
      return available > 0.
               ? kilobyte * (available + number_in_file(file, "SwapFree:"))
               : unlimited;
    }


    /// Memory that the control group @p group and those above it leave [bytes]. The limit and
    /// the usage are in files of the names @p limit_name and @p usage_name.
    double
    left_in_groups(const fs::path    &root,
                   const std::string &group,
                   const std::string &limit_name,
                   const std::string &usage_name,
                   const std::string &cache_key)
    {
      double   left   = unlimited;
      fs::path folder = root / fs::path(group).relative_path();
      while (true)
      {
        // The kernel drops cached files when memory is needed, so these count as free.
        const double limit = first_number(folder / limit_name, unlimited);
        if (limit < unlimited)
          left = std::min(left,
                          limit - first_number(folder / usage_name, 0.) +
                            number_in_file(folder / "memory.stat", cache_key));
        if (folder == root || !folder.has_relative_path())
          return left;
        folder = folder.parent_path();
      }
    }


    double
    left_in_control_groups()
    {
      const fs::path root = "/sys/fs/cgroup";
      double         left = unlimited;
      std::ifstream  in("/proc/self/cgroup");
      // Lines are "0::/path" for version 2 of control groups, and "7:memory:/path" for version 1.
      for (std::string line; std::getline(in, line);)
      {
        const auto        first = line.find(':');
        const auto        last  = line.find(':', first + 1);
        const std::string names = line.substr(first + 1, last - first - 1);
        const std::string path  = line.substr(last + 1);
        if (first == std::string::npos || last == std::string::npos)
          continue;
        if (names.empty())
          left = std::min(left,
                          left_in_groups(root,
                                         path,
                                         "memory.max",
                                         "memory.current",
                                         "inactive_file"));
        else if (names == "memory")
          left = std::min(left,
                          left_in_groups(root / "memory",
                                         path,
                                         "memory.limit_in_bytes",
                                         "memory.usage_in_bytes",
                                         "total_inactive_file"));
      }
      return left;
    }


    double
    left_in_limit(const int limit, const char *used_key)
    {
      rlimit values;
      if (getrlimit(static_cast<__rlimit_resource>(limit), &values) != 0 ||
          values.rlim_cur == RLIM_INFINITY)
        return unlimited;
      constexpr double kilobyte = 1024.;
      return static_cast<double>(values.rlim_cur) -
             kilobyte * number_in_file("/proc/self/status", used_key);
    }


    std::string
    in_gigabytes(const double bytes)
    {
      std::ostringstream text;
      text.precision(3);
      text << bytes / 1e9 << " GB";
      return text.str();
    }
  } // namespace


  AvailableMemory
  available_memory(const unsigned int n_processes)
  {
    AvailableMemory result{unlimited, ""};
    const auto      bound_by = [&](const double bytes, const char *bound) {
      if (bytes < result.bytes)
        result = {std::max(0., bytes), bound};
    };
    bound_by(left_on_machine() / n_processes, "the machine");
    bound_by(left_in_control_groups() / n_processes,
             "the control group of the process");
    bound_by(left_in_limit(RLIMIT_AS, "VmSize:"),
             "the limit of the process's address space");
    bound_by(left_in_limit(RLIMIT_DATA, "VmData:"),
             "the limit of the process's data");
    return result;
  }


  AvailableMemory
  available_memory(const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    MPI_Comm on_machine;
    MPI_Comm_split_type(
      communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &on_machine);
    const unsigned int n_processes = MPI::n_mpi_processes(on_machine);
    MPI_Comm_free(&on_machine);
    AvailableMemory result = available_memory(n_processes);
    result.bytes           = MPI::min(result.bytes, communicator);
    return result;
  }


  void
  reserve_work_space()
  {
    // The buffer of OpenBLAS on 64-bit machines is 2^27 bytes, and a page more.
    constexpr double size = 134.3e6;
    require_memory(size,
                   available_memory(1u),
                   "the work space of the linear algebra",
                   "the start of the program",
                   [](double) { return "raise this limit"; });
    constexpr unsigned int     n = 64;
    dealii::FullMatrix<double> a(n, n), product(n, n);
    a.mmult(product, a);
  }


  void
  require_memory(const double                              needed,
                 const AvailableMemory                    &available,
                 const std::string                        &purpose,
                 const std::string                        &where,
                 const std::function<std::string(double)> &remedy)
  {
    if (needed <= available.bytes)
      return;
    AssertThrow(false,
                InputError("about " + in_gigabytes(needed) +
                             " of memory are needed for " + purpose + ", and " +
                             in_gigabytes(available.bytes) + " are left by " +
                             available.bound,
                           where,
                           remedy(needed / std::max(1., available.bytes))));
  }
} // namespace NMM
