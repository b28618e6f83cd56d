#ifndef nmm_source_geometry_geometry_scanner_h
#define nmm_source_geometry_geometry_scanner_h

#include <nmm/base/exceptions.h>

#include <string>

namespace NMM
{
  namespace internal
  {
    /**
     * Divides the text of a geometry file into tokens. Blanks separate them, comments are skipped,
     * and line ends are tokens only outside of parentheses.
     */
    class GeometryScanner
    {
    public:
      enum class Kind
      {
        word,
        quoted,
        open_parenthesis,
        close_parenthesis,
        comma,
        equals,
        end_of_line,
        end_of_text
      };

      struct Token
      {
        Kind         kind = Kind::end_of_text;
        std::string  text;
        unsigned int line = 1;
      };

      GeometryScanner(const std::string &text, std::string source_name);

      /// The token that next() will return.
      const Token &
      peek() const;

      Token
      next();

      /// Whether the next tokens are a word and "=", as in "name=left".
      bool
      next_is_key() const;

      /// Place of the next token as "file:line".
      std::string
      place() const;

      /// Skip the next token. @throws InputError unless it is of the kind @p kind.
      void
      expect(Kind kind, const std::string &spelled, const std::string &remedy);

      /// Read the next token as a number. @throws InputError as to_coordinate().
      double
      number();

    private:
      void
      advance();
      void
      skip_blanks();

      const std::string &text;
      std::string        source_name;
      std::size_t        position = 0;
      unsigned int       line     = 1;
      unsigned int       depth    = 0;
      /// Line of the outermost open parenthesis.
      unsigned int opening_line = 1;
      Token        current;
    };
  } // namespace internal
} // namespace NMM

#endif
