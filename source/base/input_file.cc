#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace NMM
{
  std::string
  read_input_file(const std::string &file_name, const std::string &what)
  {
    constexpr std::size_t largest = 256u << 20;
    namespace fs                  = std::filesystem;
    std::error_code       error;
    const fs::file_status status = fs::status(file_name, error);
    AssertThrow(fs::exists(status),
                InputError(what + " cannot be read: it does not exist",
                           file_name,
                           "correct its name"));
    AssertThrow(fs::is_regular_file(status),
                InputError(what + " cannot be read: it is no ordinary file",
                           file_name,
                           "name a file, not a folder, a pipe or a device"));
    errno = 0;
    std::ifstream in(file_name, std::ios::binary);
    AssertThrow(in,
                InputError(what + " cannot be read (" + std::strerror(errno) +
                             ")",
                           file_name,
                           "check its permissions"));
    // The size that the file system tells is not relied upon: files of the kernel have the size 0.
    std::string text;
    char        buffer[1 << 16];
    while (in.read(buffer, sizeof(buffer)) || in.gcount() > 0)
    {
      text.append(buffer, in.gcount());
      AssertThrow(text.size() <= largest,
                  InputError(what + " has more than 256 MB",
                             file_name,
                             "give a smaller one"));
    }
    AssertThrow(!in.bad(),
                InputError(what + " cannot be read to its end",
                           file_name,
                           "check the disk"));
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
      text.erase(0, 3);
    AssertThrow(!text.empty(),
                InputError(what + " is empty", file_name, "name another file"));
    return text;
  }


  std::string
  excerpt(const std::string &text)
  {
    constexpr std::size_t n_shown = 12;
    std::string           result;
    for (const char c : text.substr(0, n_shown))
      result += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    if (text.size() > n_shown)
    {
      // A character of several bytes is not cut in two.
      while (!result.empty() &&
             (static_cast<unsigned char>(text[result.size()]) & 0xc0) == 0x80)
        result.pop_back();
      result += "...";
    }
    if (is_utf8(result))
      return result;
    for (char &c : result)
      if (static_cast<unsigned char>(c) >= 0x80)
        c = '?';
    return result;
  }


  bool
  is_utf8(const std::string &text)
  {
    for (std::size_t i = 0; i < text.size();)
    {
      const auto         byte     = static_cast<unsigned char>(text[i]);
      const unsigned int n_others = byte < 0x80                    ? 0
                                    : byte >= 0xc2 && byte <= 0xdf ? 1
                                    : byte >= 0xe0 && byte <= 0xef ? 2
                                    : byte >= 0xf0 && byte <= 0xf4 ? 3
                                                                   : 4;
      if (n_others == 4)
        return false;
      ++i;
      for (unsigned int k = 0; k < n_others; ++k, ++i)
        if (i >= text.size() ||
            (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80)
          return false;
    }
    return true;
  }


  double
  to_coordinate(const std::string &text, const std::string &where)
  {
    constexpr double smallest = 1e-75, largest = 1e75;
    const char      *first = text.data();
    const char      *last  = first + text.size();
    if (text.size() > 1 && *first == '+' && first[1] != '-')
      ++first;
    double value            = 0.;
    const auto [end, error] = std::from_chars(first, last, value);
    AssertThrow(error != std::errc::invalid_argument && end == last,
                InputError("'" + excerpt(text) + "' is not a number",
                           where,
                           "write numbers like 1, -0.5 or 2.5e-3"));
    AssertThrow(error == std::errc() && std::isfinite(value),
                InputError("the number '" + excerpt(text) +
                             "' is not finite, or too small to compute with",
                           where,
                           "give a finite coordinate"));
    AssertThrow(value == 0. ||
                  (std::abs(value) >= smallest && std::abs(value) <= largest),
                InputError("the number '" + excerpt(text) +
                             "' is too large or too small to compute with",
                           where,
                           "give 0 or one from 1e-75 to 1e75 in size"));
    return value;
  }
} // namespace NMM
