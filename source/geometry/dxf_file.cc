#include "geometry/dxf_file.h"

#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>

#include <algorithm>
#include <boost/locale/encoding_utf.hpp>
#include <charconv>
#include <cwctype>
#include <iconv.h>
#include <locale.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// The integer that a text begins with; false if the text is something else.
      bool
      parse_integer(const std::string &text, int &value, const int base = 10)
      {
        const char *last = text.data() + text.size();
        const auto [end, error] =
          std::from_chars(text.data(), last, value, base);
        return error == std::errc() && end == last;
      }


      /// Converts a text to UTF-8; characters that cannot be converted become question marks.
      std::string
      convert(std::string text, const std::string &encoding)
      {
        std::string   result(4 * text.size(), '\0');
        char         *in = text.data(), *out = result.data();
        std::size_t   n_in = text.size(), n_out = result.size();
        const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
        const bool    is_known  = converter != iconv_t(-1);
        while (n_in > 0)
          if (!is_known ||
              iconv(converter, &in, &n_in, &out, &n_out) == std::size_t(-1))
          {
            const bool is_ascii = static_cast<unsigned char>(*in) < 0x80;
            *out++              = is_ascii ? *in : '?';
            ++in;
            --n_in;
            --n_out;
          }
        if (is_known)
          iconv_close(converter);
        result.resize(out - result.data());
        return result;
      }


      /// Name by which iconv knows a code page of DXF: "ANSI_1252" and "dos850" are CP1252, CP850.
      std::string
      encoding_of(std::string code_page)
      {
        std::transform(code_page.begin(),
                       code_page.end(),
                       code_page.begin(),
                       [](const unsigned char c) { return std::toupper(c); });
        for (const std::string prefix : {"ANSI_", "DOS"})
          if (code_page.rfind(prefix, 0) == 0)
            return "CP" + code_page.substr(prefix.size());
        return code_page.empty() ? "CP1252" : code_page;
      }
    } // namespace


    std::string
    decode_dxf_text(const std::string &text, const std::string &code_page)
    {
      const std::string utf8 =
        is_utf8(text) ? text : convert(text, encoding_of(code_page));
      std::string result;
      for (std::size_t i = 0; i < utf8.size(); ++i)
      {
        int code = 0;
        if (utf8.compare(i, 3, "\\U+") == 0 && i + 7 <= utf8.size() &&
            parse_integer(utf8.substr(i + 3, 4), code, 16) && code >= ' ')
        {
          const auto letter = static_cast<char32_t>(code);
          result += boost::locale::conv::utf_to_utf<char>(&letter, &letter + 1);
          i += 6;
        }
        else
          result += utf8[i];
      }
      return result;
    }


    std::string
    lower_case(const std::string &utf8)
    {
      // The locale of the program is not changed, since that would affect numbers.
      static const locale_t locale =
        newlocale(LC_CTYPE_MASK, "C.UTF-8", locale_t(0));
      std::wstring letters = boost::locale::conv::utf_to_utf<wchar_t>(utf8);
      for (wchar_t &letter : letters)
        letter = locale == locale_t(0) ? std::towlower(letter)
                                       : towlower_l(letter, locale);
      return boost::locale::conv::utf_to_utf<char>(letters);
    }


    std::string
    DxfRecord::place() const
    {
      return file_name + ":" + std::to_string(line);
    }


    std::string
    DxfRecord::place(const DxfGroup &group) const
    {
      return file_name + ":" + std::to_string(group.line);
    }


    const DxfGroup *
    DxfRecord::find(const int code) const
    {
      for (const DxfGroup &group : groups)
        if (group.code == code)
          return &group;
      return nullptr;
    }


    std::string
    DxfRecord::text(const int code) const
    {
      const DxfGroup *group = find(code);
      return group == nullptr ? "" : group->value;
    }


    int
    DxfRecord::integer(const int code) const
    {
      const DxfGroup *group = find(code);
      int             value = 0;
      AssertThrow(group == nullptr || parse_integer(group->value, value),
                  InputError("'" + excerpt(group->value) + "' is no integer",
                             place(*group),
                             "save the drawing as a DXF text file again"));
      return value;
    }


    double
    DxfRecord::number(const DxfGroup &group) const
    {
      return to_coordinate(group.value, place(group));
    }


    double
    DxfRecord::number(const int code) const
    {
      const DxfGroup *group = find(code);
      AssertThrow(group != nullptr,
                  InputError("the " + kind + " lacks a number (group " +
                               std::to_string(code) + ")",
                             place(),
                             "save the drawing as a DXF text file again"));
      return number(*group);
    }


    double
    DxfRecord::number(const int code, const double value) const
    {
      const DxfGroup *group = find(code);
      return group == nullptr ? value : number(*group);
    }


    DxfFile::DxfFile(const std::string &text, const std::string &file_name)
      : text(text)
      , file_name(file_name)
    {
      bool is_dxf = false;
      try
      {
        // Comments (code 999) may precede the first section.
        while ((is_dxf = read_group()) && group.code == 999)
          ;
      }
      catch (const InputError &)
      {
        is_dxf = false;
      }
      AssertThrow(is_dxf && group.code == 0 && group.value == "SECTION",
                  InputError("this is no DXF drawing",
                             file_name,
                             "save the drawing as a DXF text file, not a "
                             "binary one"));
    }


    bool
    DxfFile::read_line(std::string &result)
    {
      if (position >= text.size())
        return false;
      const std::size_t end  = std::min(text.find('\n', position), text.size());
      std::size_t       last = end;
      const auto        is_blank = [](const char c) {
        return c == ' ' || c == '\t' || c == '\r';
      };
      while (position < last && is_blank(text[position]))
        ++position;
      while (last > position && is_blank(text[last - 1]))
        --last;
      result   = text.substr(position, last - position);
      position = end + 1;
      ++n_lines;
      return true;
    }


    bool
    DxfFile::read_group()
    {
      std::string code;
      if (!read_line(code))
        return false;
      AssertThrow(parse_integer(code, group.code),
                  InputError("'" + excerpt(code) + "' is no group code",
                             file_name + ":" + std::to_string(n_lines),
                             "save the drawing as a DXF text file again"));
      const bool has_value = read_line(group.value);
      group.line           = n_lines;
      return has_value;
    }


    bool
    DxfFile::next(DxfRecord &record)
    {
      record.file_name = file_name;
      record.line      = group.line;
      record.kind      = group.value;
      record.groups.clear();
      if (record.kind == "EOF")
        return false;
      while (read_group())
      {
        if (group.code == 0)
          return true;
        record.groups.push_back(group);
      }
      AssertThrow(false,
                  InputError("the drawing ends early, after " +
                               std::to_string(n_lines) + " lines",
                             file_name,
                             "save it again"));
      return false;
    }
  } // namespace internal
} // namespace NMM
