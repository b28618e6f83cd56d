#include "geometry/geometry_scanner.h"

#include <nmm/base/input_file.h>

#include <utility>

namespace NMM
{
  namespace internal
  {
    GeometryScanner::GeometryScanner(const std::string &text,
                                     std::string        source_name)
      : text(text)
      , source_name(std::move(source_name))
    {
      // Skip the byte order mark that some editors write.
      if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
        position = 3;
      advance();
    }


    const GeometryScanner::Token &
    GeometryScanner::peek() const
    {
      return current;
    }


    GeometryScanner::Token
    GeometryScanner::next()
    {
      Token token = current;
      advance();
      return token;
    }


    bool
    GeometryScanner::next_is_key() const
    {
      const std::size_t next = text.find_first_not_of(" \t", position);
      return current.kind == Kind::word && next != std::string::npos &&
             text[next] == '=';
    }


    std::string
    GeometryScanner::place() const
    {
      return source_name + ":" + std::to_string(current.line);
    }


    void
    GeometryScanner::expect(const Kind         kind,
                            const std::string &spelled,
                            const std::string &remedy)
    {
      if (current.kind == Kind::end_of_text && depth > 0)
        AssertThrow(false,
                    InputError("a parenthesis is never closed",
                               source_name + ":" + std::to_string(opening_line),
                               "add the missing ')'"));
      AssertThrow(current.kind == kind,
                  InputError("expected " + spelled + " but found " +
                               (current.text.empty()
                                  ? std::string("the end of the line")
                                  : "'" + excerpt(current.text) + "'"),
                             place(),
                             remedy));
      advance();
    }


    double
    GeometryScanner::number()
    {
      const Token       token = current;
      const std::string where = place();
      expect(Kind::word,
             "a number",
             "separate the numbers of a point by blanks and points by commas");

      return to_coordinate(token.text, where);
    }


    void
    GeometryScanner::skip_blanks()
    {
      while (position < text.size())
      {
        const char c = text[position];
        if (c == '#')
          while (position < text.size() && text[position] != '\n')
            ++position;
        else if (c == '\n' && depth > 0)
        {
          ++line;
          ++position;
        }
        else if (c == ' ' || c == '\t' || c == '\r')
          ++position;
        else
          break;
      }
    }


    void
    GeometryScanner::advance()
    {
      skip_blanks();
      current.line = line;
      current.text.clear();
      if (position == text.size())
      {
        current.kind = Kind::end_of_text;
        return;
      }

      const char c = text[position];
      if (c == '"' || c == '\'')
      {
        const std::size_t end =
          text.find_first_of(std::string{c, '\n'}, position + 1);
        AssertThrow(end != std::string::npos && text[end] == c,
                    InputError("a quotation mark is never closed",
                               place(),
                               std::string("add the missing ") + c));
        current.kind = Kind::quoted;
        current.text = text.substr(position + 1, end - position - 1);
        position     = end + 1;
        return;
      }

      const std::string single = "(),=\n";
      if (single.find(c) == std::string::npos)
      {
        const std::size_t end =
          std::min(text.find_first_of("(),=\n\r\t #\"'", position),
                   text.size());
        current.kind = Kind::word;
        current.text = text.substr(position, end - position);
        position     = end;
        return;
      }

      ++position;
      if (c != '\n')
        current.text = c;
      switch (c)
      {
        case '(':
          if (depth++ == 0)
            opening_line = line;
          current.kind = Kind::open_parenthesis;
          break;
        case ')':
          AssertThrow(depth > 0,
                      InputError("a ')' closes nothing",
                                 place(),
                                 "remove it or add the missing '('"));
          --depth;
          current.kind = Kind::close_parenthesis;
          break;
        case ',':
          current.kind = Kind::comma;
          break;
        case '=':
          current.kind = Kind::equals;
          break;
        default:
          ++line;
          current.kind = Kind::end_of_line;
      }
    }
  } // namespace internal
} // namespace NMM
