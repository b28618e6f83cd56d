#ifndef nmm_base_program_h
#define nmm_base_program_h

#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

/// What programs share: MPI, exit codes, and what each exception means for them.
namespace NMM
{
  /// Part of a program's interface.
  enum class ExitCode : int
  {
    success           = 0,
    internal_error    = 1,
    input_error       = 2,
    numerical_failure = 3
  };


  /**
   * A result cannot be written, because the disk is full or a folder has gone.
   * Files that were complete before stay as they are, checkpoints above all.
   * Programs end with exit code 3.
   */
  class OutputFailure : public UserError
  {
  public:
    using UserError::UserError;

    /// Says which file, and the system's reason (errno).
    explicit OutputFailure(const std::string &file_name);
  };


  /// How a program ends after an exception.
  struct ProgramEnd
  {
    ExitCode code;
    /// The message to print: one sentence.
    std::string message;
  };

  /**
   * What the exception being handled means; to be called in a catch block. This is
   * the only place that knows. @p has_output: has the program begun to write
   * results? Exit code 2 promises that it has not: wrong input, and too little memory
   * or space, end with 3 afterwards.
   */
  ProgramEnd
  explain_exception(bool has_output);

  /// Let the first rank do something that may throw: all ranks throw then.
  /// Collective.
  void
  on_first_rank(MPI_Comm communicator, const std::function<void()> &action);

  /**
   * Do all ranks come here within @p seconds? Those that failed find out with it
   * whether the others failed, too, or wait for them elsewhere.
   */
  bool
  all_ranks_arrive(MPI_Comm communicator, double seconds);


  /**
   * MPI from construction to destruction, with one thread. Libraries that deal.II
   * initializes with it (PETSc) take a program's arguments for options of theirs,
   * and report those they do not know, so they get the program's name alone.
   */
  class MPISession
  {
  public:
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
