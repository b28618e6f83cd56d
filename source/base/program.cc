#include <nmm/base/program.h>
#include <nmm/base/stop.h>

#include <boost/serialization/utility.hpp>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

namespace NMM
{
  OutputFailure::OutputFailure(const std::string &file_name)
    : UserError("the file cannot be written" +
                  (errno != 0 ? " (" + std::string(std::strerror(errno)) + ")"
                              : std::string()),
                file_name,
                "see whether the disk is full and the folder still there; what "
                "was written before is whole, the last checkpoint, too")
  {
  }


  ProgramEnd
  explain_exception(const bool has_output)
  {
    const ExitCode input =
      has_output ? ExitCode::numerical_failure : ExitCode::input_error;
    const auto memory = [&]() -> ProgramEnd {
      return {input,
              "memory ran out: choose larger cells, or a machine or limit with "
              "more memory"};
    };
    try
    {
      throw;
    }
    catch (const NumericalFailure &error)
    {
      return {ExitCode::numerical_failure, error.message()};
    }
    catch (const OutputFailure &error)
    {
      return {ExitCode::numerical_failure, error.message()};
    }
    catch (const Stopped &error)
    {
      return {ExitCode::stopped, error.message()};
    }
    catch (const UserError &error)
    {
      return {input, error.message()};
    }
    catch (const std::bad_alloc &)
    {
      return memory();
    }
    catch (const std::length_error &)
    {
      return memory();
    }
    catch (const dealii::StandardExceptions::ExcOutOfMemory &)
    {
      return memory();
    }
    catch (const std::system_error &error)
    {
      // The standard library throws this for files and streams.
      return {input,
              std::string("a file or folder cannot be used (") + error.what() +
                "): see whether the disk is full, and whether the file system "
                "allows what is asked for"};
    }
    catch (const std::exception &error)
    {
      return {ExitCode::internal_error,
              std::string("internal error: ") + error.what()};
    }
    catch (...)
    {
      return {ExitCode::internal_error, "internal error"};
    }
  }


  void
  on_first_rank(const MPI_Comm               communicator,
                const std::function<void()> &action)
  {
    std::pair<int, std::string> end(static_cast<int>(ExitCode::success), "");
    std::exception_ptr          exception;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
      {
        action();
      }
      catch (...)
      {
        exception                = std::current_exception();
        const ProgramEnd of_here = explain_exception(/* has_output = */ false);
        end = {static_cast<int>(of_here.code), of_here.message};
      }
    end = dealii::Utilities::MPI::broadcast(communicator, end);
    if (exception)
      std::rethrow_exception(exception);
    switch (static_cast<ExitCode>(end.first))
    {
      case ExitCode::success:
        return;
      case ExitCode::input_error:
        throw InputError(end.second, "", "");
      case ExitCode::numerical_failure:
        throw NumericalFailure(end.second, "", "");
      case ExitCode::stopped:
        throw Stopped(end.second, "", "");
      case ExitCode::internal_error:
        throw std::runtime_error(end.second);
    }
  }


  bool
  all_ranks_arrive(const MPI_Comm communicator, const double seconds)
  {
    using Clock     = std::chrono::steady_clock;
    const auto  end = Clock::now() + std::chrono::duration<double>(seconds);
    MPI_Request request;
    MPI_Ibarrier(communicator, &request);
    for (int are_here = 0; are_here == 0;)
    {
      MPI_Test(&request, &are_here, MPI_STATUS_IGNORE);
      if (are_here == 0 && Clock::now() > end)
        return false;
      if (are_here == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }


  namespace
  {
    /// Lets a process that no launcher has started initialize MPI without the daemon that Open MPI
    /// starts beside it otherwise, which takes longer than a small scene. Its only use is to start
    /// further processes. Under a launcher this has no effect. Returns its argument.
    const char *
    without_daemon(const char *program_name)
    {
      setenv("OMPI_MCA_ess_singleton_isolated", "1", /* overwrite = */ 0);
      return program_name;
    }
  } // namespace


  MPISession::MPISession(const char *program_name)
    : name(without_daemon(program_name))
    , words{name.data(), nullptr}
    , mpi(n_words, first_word, 1)
  {
  }
} // namespace NMM
