#ifndef nmm_source_output_wrapped_h
#define nmm_source_output_wrapped_h

#include <algorithm>
#include <sstream>
#include <string>

namespace NMM
{
  namespace internal
  {
    /// Breaks @p text between words, so that no line has more than @p width characters, unless a
    /// word has. Further lines are indented by two spaces more than the first one.
    inline std::string
    wrapped(const std::string &text, const std::size_t width)
    {
      const auto length = [](const std::string &word) {
        // Bytes that continue a character in UTF-8 do not count.
        return static_cast<std::size_t>(
          std::count_if(word.begin(), word.end(), [](const char c) {
            return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
          }));
      };
      if (length(text) <= width)
        return text;
      const std::string  indent(std::min(text.find_first_not_of(' '),
                                        text.size()),
                               ' ');
      std::istringstream words(text);
      std::string        result, line = indent;
      for (std::string word; words >> word;)
      {
        const bool is_first = line.find_first_not_of(' ') == std::string::npos;
        if (!is_first && length(line) + 1 + length(word) > width)
        {
          result += line + '\n';
          line = indent + "  " + word;
        }
        else
          line += (is_first ? "" : " ") + word;
      }
      return result + line;
    }
  } // namespace internal
} // namespace NMM

#endif
