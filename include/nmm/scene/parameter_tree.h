#ifndef nmm_scene_parameter_tree_h
#define nmm_scene_parameter_tree_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * A value that is given to a parameter outside a .prm file: by `--set` or by a JSON
   * scene.
   */
  struct ParameterAssignment
  {
    /// The names of the sections and, last, the key.
    std::vector<std::string> path;
    /// The value as text, as in a .prm file.
    std::string value;
    /// The place where it was given, for messages.
    std::string source;
  };

  /// Splits "Section/Key=value". @throws InputError if there is no key or no '='.
  ParameterAssignment
  parse_assignment(const std::string &text);

  /**
   * The words among @p candidates of which @p word may be a misspelling, nearest first. The
   * measure is the edit distance without regard to case, at most about a third of the letters.
   * If none is near, all candidates are returned.
   */
  std::vector<std::string>
  near_matches(const std::string              &word,
               const std::vector<std::string> &candidates);

  /**
   * Reads a .prm file, or by its extension a .json file, into @p prm, and then applies
   * @p assignments. If @p skip_undefined is true, entries that are not declared are
   * ignored; otherwise they are errors.
   * @throws InputError that names the file and line (of a .prm file), the section
   * and key and its near matches, or the value and what it should be.
   */
  void
  read_parameters(const std::string                      &file_name,
                  const std::vector<ParameterAssignment> &assignments,
                  bool                                    skip_undefined,
                  dealii::ParameterHandler               &prm);

  /// Gives the parameter @p path (names of its sections and, last, its key) its default.
  void
  set_default(const std::vector<std::string> &path,
              dealii::ParameterHandler       &prm);

  /// All declared parameters as a Markdown document with a table per section.
  std::string
  parameter_reference(const dealii::ParameterHandler &prm);
} // namespace NMM

#endif
