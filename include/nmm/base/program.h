#ifndef nmm_base_program_h
#define nmm_base_program_h

#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

/// What programs share: MPI, exit codes, and the exit code and message of each exception.
namespace NMM
{
  /// The exit code of a program. The numbers are part of the interface of programs.
  enum class ExitCode : int
  {
    success           = 0,
    internal_error    = 1,
    input_error       = 2,
    numerical_failure = 3,
    stopped           = 4
  };


  /**
   * A result cannot be written, for example because the disk is full or the folder was removed.
   * Files that were completed before, checkpoints in particular, stay as they are.
   * Programs end with exit code 3.
   */
  class OutputFailure : public UserError
  {
  public:
    /// See UserError::UserError().
    using UserError::UserError;

    /// The message names the file and the reason that the system gives in `errno`.
    explicit OutputFailure(const std::string &file_name);
  };


  /// How a program ends after an exception.
  struct ProgramEnd
  {
    /// The exit code that the program returns.
    ExitCode code;
    /// The message to print, one sentence.
    std::string message;
  };

  /**
   * The exit code and message for the exception that is being handled; to be called in a catch
   * block. Programs leave this decision to this function. @p has_output says whether the program
   * has begun to write results. Exit code 2 promises that it has not: once it has, wrong input
   * and too little memory or disk space lead to the exit code 3.
   */
  ProgramEnd
  explain_exception(bool has_output);

  /// Runs @p action on rank 0 only. If it throws, all ranks throw: rank 0 the exception itself,
  /// the others one with the same exit code and message. Collective.
  void
  on_first_rank(MPI_Comm communicator, const std::function<void()> &action);

  /**
   * Whether all ranks call this function within @p seconds [s]. Ranks that failed find out with
   * it whether the others have failed, too, or are waiting for them in another call.
   */
  bool
  all_ranks_arrive(MPI_Comm communicator, double seconds);


  /**
   * Keeps MPI initialized from construction to destruction, with one thread. Libraries that
   * deal.II initializes along with it (PETSc) read the arguments of a program as options of their
   * own and report those that they do not know. Therefore they are given the name of the program
   * only.
   */
  class MPISession
  {
  public:
    /// Initializes MPI; @p program_name is the only argument that the libraries see.
    explicit MPISession(const char *program_name);

  private:
    std::string                              name;
    int                                      n_words = 1;
    char                                    *words[2];
    char                                   **first_word = words;
    dealii::Utilities::MPI::MPI_InitFinalize mpi;
  };
} // namespace NMM

#endif
