#ifndef nmm_scene_parameter_tree_h
#define nmm_scene_parameter_tree_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * A value given for a parameter outside a .prm file: by `--set` or by a JSON
   * scene.
   */
  struct ParameterAssignment
  {
    /// Sections and, last, the key.
    std::vector<std::string> path;
    std::string              value;
    /// Where it was given, for messages.
    std::string source;
  };

  /// Split "Section/Key=value". @throws InputError if there is no key or no '='.
  ParameterAssignment
  parse_assignment(const std::string &text);

  /**
   * Those of @p candidates that @p word may be a misspelling of, nearest first
   * (edit distance, case ignored, about a third of the letters at most); all of them
   * if none is near.
   */
  std::vector<std::string>
  near_matches(const std::string              &word,
               const std::vector<std::string> &candidates);

  /**
   * Read a .prm or (by its extension) .json file into @p prm, then apply
   * @p assignments. With @p skip_undefined entries that are not declared are
   * passed over.
   * @throws InputError that names the file and line (a .prm file), the section
   * and key and its near matches, or the value and what it should be.
   */
  void
  read_parameters(const std::string                      &file_name,
                  const std::vector<ParameterAssignment> &assignments,
                  bool                                    skip_undefined,
                  dealii::ParameterHandler               &prm);

  /// All declared parameters as a Markdown document with a table per section.
  std::string
  parameter_reference(const dealii::ParameterHandler &prm);
} // namespace NMM

#endif
