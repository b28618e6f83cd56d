#ifndef tutorial_tutorial_h
#define tutorial_tutorial_h

// What surrounds the method in every tutorial program: its parameter file, how it ends, its
// figures.

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <string>
#include <vector>

namespace Tutorial
{
  /**
   * The body of main() for `PROGRAM [PARAMETER_FILE [OUTPUT_DIRECTORY]]`: starts MPI and calls
   * @p study with both names. Without a file its name is empty; without a directory it is ".". Ranks
   * but the first print nothing. An exception is explained on the standard error output. Returns
   * the exit code, see NMM::ExitCode.
   */
  int
  run(int                                                             argc,
      char                                                          **argv,
      const std::function<void(const std::string &parameter_file,
                               const std::string &output_directory)> &study);

  /// @throws NMM::InputError on more than one rank: tables of @p program are times of one core.
  void
  check_that_there_is_one_rank(const std::string &program);

  /**
   * Read @p file_name into the entries of @p prm; without a name the defaults are left.
   * @throws NMM::InputError for a file that cannot be read or has errors; @p example is the file that
   * the message names as an example.
   */
  void
  read_parameter_file(dealii::ParameterHandler &prm,
                      const std::string        &file_name,
                      const std::string        &example);

  /// Bind the entries "Offset" [m] and "Rotation" [degrees] of the mesh, and the number and the seed of
  /// "Placements" at random, to the variables.
  void
  add_placements(dealii::ParameterHandler &prm,
                 dealii::Tensor<1, 2>     &offset,
                 double                   &rotation,
                 unsigned int             &n_placements,
                 unsigned int             &seed);

  /// Make the folder for results before anything is computed. @throws NMM::InputError.
  void
  make_output_directory(const std::string &name);

  /**
   * Draw figures with gnuplot, on the first rank. @p script has the word PREFIX wherever @p prefix, the path and the
   * beginning of all files' names, belongs; it is written to "PREFIXfigures.gp". A sentence says
   * which of @p figures (names without the prefix) were drawn, or that gnuplot is missing.
   */
  void
  draw_figures(const std::string              &prefix,
               const std::string              &script,
               const std::vector<std::string> &figures);
} // namespace Tutorial

#endif
