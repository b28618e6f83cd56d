#ifndef nmm_source_geometry_dxf_file_h
#define nmm_source_geometry_dxf_file_h

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Two lines of a DXF file: a code, which says what the value means, and the value.
    struct DxfGroup
    {
      int         code;
      std::string value;
      /// Line of the value, counted from 1.
      unsigned int line;
    };


    /// A record of a DXF file: the groups from one with the code 0, which names its kind, up to the
    /// next one.
    struct DxfRecord
    {
      /// File and line of the kind, for messages.
      std::string           file_name;
      unsigned int          line = 0;
      std::string           kind;
      std::vector<DxfGroup> groups;

      /// Place of the record, or of one of its groups, as "file:line".
      std::string
      place() const;
      std::string
      place(const DxfGroup &group) const;

      /// Value of the first group of that code; empty if there is none.
      std::string
      text(int code) const;

      /// The same as an integer, 0 if there is none. @throws InputError if it is no integer.
      int
      integer(int code) const;

      /// The same as a number. @throws InputError if there is none, or if it is no number.
      double
      number(int code) const;

      /// The same, or @p value if there is none.
      double
      number(int code, double value) const;

      /// The number of a group. @throws InputError as to_coordinate().
      double
      number(const DxfGroup &group) const;

    private:
      const DxfGroup *
      find(int code) const;
    };


    /**
     * Divides the text of a DXF file into records.
     *
     * dxflib is not used, because it hides what decides whether something is drawn (flags of
     * vertices, kinds of entities that it does not know), reads "nan" as 0 and "0x10" as 16, and
     * allocates as many vertices as a file says it has.
     */
    class DxfFile
    {
    public:
      /// Neither argument is copied. @throws InputError if the text is not that of a DXF file.
      DxfFile(const std::string &text, const std::string &file_name);

      /// Reads the next record. Returns false after the record "EOF", which ends a drawing.
      /// @throws InputError if the text ends without it, or has a code that is no integer.
      bool
      next(DxfRecord &record);

    private:
      /// Reads the next line without blanks around it; false at the end.
      bool
      read_line(std::string &result);
      bool
      read_group();

      const std::string &text;
      const std::string &file_name;
      std::size_t        position = 0;
      unsigned int       n_lines  = 0;
      /// The group that was read last.
      DxfGroup group;
    };


    /**
     * The names of layers of a drawing as UTF-8. @p code_page is the drawing's `$DWGCODEPAGE`, as
     * in "ANSI_1252", which counts for names that are not UTF-8 already. The escapes `\U+00DC` are
     * replaced, too.
     */
    std::string
    decode_dxf_text(const std::string &text, const std::string &code_page);

    /// The same text in lower case, for comparisons.
    std::string
    lower_case(const std::string &utf8);
  } // namespace internal
} // namespace NMM

#endif
