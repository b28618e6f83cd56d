#include <nmm/base/program.h>
#include <nmm/output/csv_series.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <sstream>

namespace NMM
{
  namespace
  {
    /// Whether a spreadsheet would compute a cell with this text.
    bool
    is_formula(const std::string &text)
    {
      if (text.size() < 2 ||
          std::string("=+-@\t\r").find(text.front()) == std::string::npos)
        return false;
      char *end = nullptr;
      (void)std::strtod(text.c_str(), &end);
      return *end != '\0';
    }
  } // namespace


  std::string
  quoted(const std::string &text)
  {
    const std::string cell = is_formula(text) ? "'" + text : text;
    if (cell.find_first_of(",\"\n\r") == std::string::npos)
      return cell;
    return '"' + std::regex_replace(cell, std::regex("\""), "\"\"") + '"';
  }


  std::string
  shortest_text(const double number)
  {
    // 17 digits, a sign, a point and an exponent are 24 characters.
    std::array<char, 32> text;
    const auto           end =
      std::to_chars(text.data(), text.data() + text.size(), number);
    return std::string(text.data(), end.ptr);
  }


  std::string
  time_text(const double time)
  {
    std::array<char, 32> text;
    const auto           end = std::to_chars(text.data(),
                                   text.data() + text.size(),
                                   time,
                                   std::chars_format::general,
                                   14);
    return std::string(text.data(), end.ptr);
  }


  namespace
  {
    std::string
    head_of_steps(const std::vector<std::string> &columns)
    {
      std::string head = "time,step";
      for (const std::string &column : columns)
        head += "," + quoted(column);
      return head + "\n";
    }


    std::function<bool(const std::string &)>
    rows_up_to(const int last_step)
    {
      if (last_step < 0)
        return {};
      return [last_step](const std::string &text) {
        std::istringstream row(text);
        double             time;
        char               comma;
        int                step;
        return (row >> time >> comma >> step) && step <= last_step;
      };
    }


    /// Opens the file @p file_name and reads it up to the end of @p head.
    std::ifstream
    open_below(const std::string &file_name, const std::string &head)
    {
      std::ifstream      in(file_name);
      std::istringstream expected(head);
      std::string        line, expected_line;
      while (std::getline(expected, expected_line))
        AssertThrow(std::getline(in, line) && line == expected_line,
                    InputError("this is no table to continue: its columns "
                               "are others",
                               file_name,
                               "continue with the scene it was written with, "
                               "or in another folder"));
      return in;
    }
  } // namespace


  CsvSeries::CsvSeries(std::string                                     name,
                       const std::string                              &head,
                       const std::function<bool(const std::string &)> &is_kept)
    : file_name(std::move(name))
  {
    std::ifstream earlier;
    if (is_kept)
      earlier = open_below(file_name, head);
    const std::string temporary = file_name + ".part";
    // If there is a link of this name, what it points to must not be overwritten.
    std::remove(temporary.c_str());
    std::ofstream file(temporary, std::ios::trunc);
    file << head;
    for (std::string line; is_kept && std::getline(earlier, line);)
      if (!earlier.eof() && is_kept(line))
        file << line << '\n';
    file.close();
    AssertThrow(file.good() &&
                  std::rename(temporary.c_str(), file_name.c_str()) == 0,
                OutputFailure(file_name));
    out.open(file_name, std::ios::app);
    AssertThrow(out.good(), OutputFailure(file_name));
  }


  CsvSeries::CsvSeries(std::string                     file_name,
                       const std::vector<std::string> &columns,
                       const int                       continue_after)
    : CsvSeries(std::move(file_name),
                head_of_steps(columns),
                rows_up_to(continue_after))
  {
  }


  void
  CsvSeries::append(const std::string &rows)
  {
    out << rows << std::flush;
    AssertThrow(out.good(), OutputFailure(file_name));
  }


  void
  CsvSeries::append(const double               time,
                    const unsigned int         step,
                    const std::vector<double> &values)
  {
    std::string row = time_text(time) + ',' + std::to_string(step);
    for (const double value : values)
      row += ',' + shortest_text(value);
    append(row + '\n');
  }
} // namespace NMM
