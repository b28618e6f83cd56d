#ifndef nmm_base_input_file_h
#define nmm_base_input_file_h

#include <string>

namespace NMM
{
  /**
   * The text of a file that a scene names, without the byte order mark that some editors write.
   * Messages call it @p what, as in "the mesh file".
   * @throws InputError unless the file is an ordinary one (a pipe or a device may never end), can
   * be read, is not empty, and has at most 256 MB.
   */
  std::string
  read_input_file(const std::string &file_name, const std::string &what);

  /**
   * The first few characters of @p text, for messages about a file that may be somebody else's.
   * Characters that cannot be printed are replaced by question marks.
   */
  std::string
  excerpt(const std::string &text);

  /// Whether @p text is valid UTF-8.
  bool
  is_utf8(const std::string &text);

  /**
   * The number that @p text spells, for coordinates: rounded correctly, and independent of the
   * locale. @p where is the place for messages.
   * @throws InputError unless the whole text is one number that is 0 or from 1e-75 to 1e75 in size,
   * with which all further computations are safe: they contain at most squares of products of two
   * coordinates.
   */
  double
  to_coordinate(const std::string &text, const std::string &where);
} // namespace NMM

#endif
