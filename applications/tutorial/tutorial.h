#ifndef tutorial_tutorial_h
#define tutorial_tutorial_h

// What surrounds the method in every tutorial program: its parameter file, how it ends, its
// figures.

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <functional>
#include <memory>
#include <string>

namespace Tutorial
{
  /**
   * The body of main() for `PROGRAM [PARAMETER_FILE [OUTPUT_DIRECTORY]]`: starts MPI, makes the directory and calls
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
   * The parameters of a program. A class derived from this one has a member for each of them, which
   * reads its entry of the file when it is made, so that its name, default value, bounds and meaning are in one
   * place.
   *
   * @code
   *   struct Parameters : Tutorial::ParameterFile
   *   {
   *     using ParameterFile::ParameterFile;
   *     double radius = get("Radius", 1., positive); // [m]
   *   };
   * @endcode
   */
  class ParameterFile
  {
  public:
    /// Without a file all parameters have their default values. The path and the beginning of
    /// the names of all results are @p prefix. @throws NMM::InputError if the file cannot be read.
    explicit ParameterFile(const std::string &file_name = "",
                           const std::string &prefix    = "");

    /// @throws NMM::InputError if the file has an entry that no member reads.
    void
    check_that_all_is_known();

    std::string prefix;

  protected:
    static inline const dealii::Patterns::Double positive{1e-300};
    static inline const dealii::Patterns::Double not_negative{0.};
    static inline const dealii::Patterns::List   positive_list{positive, 1};

    /// The value of an entry. @throws NMM::InputError if it does not match the pattern.
    template <typename T>
    T
    get(const std::string                   &name,
        const T                             &standard,
        const dealii::Patterns::PatternBase &pattern =
          *dealii::Patterns::Tools::Convert<T>::to_pattern())
    {
      using Convert = dealii::Patterns::Tools::Convert<T>;
      const std::string words =
        Convert::to_string(standard, *Convert::to_pattern());
      const std::string value = read(name, words, pattern);
      // digits of the default value may not all be in its words
      return value == words ? standard : Convert::to_value(value);
    }

  private:
    std::string
    read(const std::string                   &name,
         const std::string                   &standard,
         const dealii::Patterns::PatternBase &pattern);

    void
    parse(bool skips_unknown);

    std::string                               file_name, text;
    std::shared_ptr<dealii::ParameterHandler> prm;
  };


  /// The body of main() of a program with parameters: @p study gets those of the file.
  template <typename Parameters>
  int
  run(const std::string                             &program,
      const int                                      argc,
      char                                         **argv,
      const std::function<void(const Parameters &)> &study)
  {
    return run(argc,
               argv,
               [&](const std::string &file, const std::string &directory) {
                 Parameters parameters(file, directory + "/" + program + "-");
                 parameters.check_that_all_is_known();
                 study(parameters);
               });
  }


  /**
   * Draw figures with gnuplot, on the first rank. @p script has the word PREFIX wherever @p prefix, the path and the
   * beginning of all files' names, belongs; it is written to "PREFIXfigures.gp", and the values of others to
   * "PREFIXreference.csv" if there are any. A sentence says
   * which figures were drawn, or that gnuplot is missing.
   */
  void
  draw_figures(const std::string &prefix,
               const std::string &script,
               const std::string &reference = "");
} // namespace Tutorial

#endif
