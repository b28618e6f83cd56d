#include "row.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/config.h>
#include <deal.II/base/utilities.h>

#include <Trilinos_version.h>
#include <cmath>
#include <ctime>
#include <dmumps_c.h>
#include <fstream>
#include <sstream>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      struct NameCollector
      {
        std::vector<std::string> *names;

        template <typename Member>
        void
        operator()(const char *name, const Member &) const
        {
          names->push_back(name);
        }
      };


      struct Writer
      {
        std::ostream *out;
        bool         *is_first;

        void
        separate() const
        {
          if (!*is_first)
            *out << ',';
          *is_first = false;
        }

        void
        operator()(const char *, const std::string &text) const
        {
          AssertThrow(text.find(',') == std::string::npos,
                      dealii::ExcMessage("a comma in " + text));
          separate();
          *out << text;
        }

        void
        operator()(const char *, const double number) const
        {
          separate();
          if (!std::isnan(number))
            *out << number;
        }
      };


      struct Reader
      {
        const std::vector<std::string> *cells;
        unsigned int                   *next;

        void
        operator()(const char *, std::string &text) const
        {
          text = (*cells)[(*next)++];
        }

        void
        operator()(const char *, double &number) const
        {
          const std::string &text = (*cells)[(*next)++];
          number                  = text.empty() ? none : std::stod(text);
        }
      };


      std::vector<std::string>
      split(const std::string &line)
      {
        std::vector<std::string> cells(1);
        for (const char c : line)
          if (c == ',')
            cells.emplace_back();
          else
            cells.back() += c;
        return cells;
      }


      std::string
      cpu_name()
      {
        std::ifstream in("/proc/cpuinfo");
        for (std::string line; std::getline(in, line);)
          if (line.compare(0, 10, "model name") == 0)
            return dealii::Utilities::trim(line.substr(line.find(':') + 1));
        return "unknown";
      }
    } // namespace


    std::vector<std::string>
    column_names()
    {
      std::vector<std::string> names;
      const Row                row;
      for_each_column(row, NameCollector{&names});
      return names;
    }


    void
    write_table(const std::string &file_name, const std::vector<Row> &rows)
    {
      std::ofstream out(file_name);
      AssertThrow(out,
                  InputError("the table cannot be written",
                             file_name,
                             "name a file in a folder that exists"));
      bool is_first = true;
      for (const std::string &name : column_names())
        Writer{&out, &is_first}("", name);
      out << '\n';
      out.precision(8);
      for (const Row &row : rows)
      {
        is_first = true;
        for_each_column(row, Writer{&out, &is_first});
        out << '\n';
      }
    }


    std::vector<Row>
    read_table(const std::string &file_name)
    {
      std::ifstream in(file_name);
      std::string   line;
      AssertThrow(std::getline(in, line) && split(line) == column_names(),
                  InputError("this is no table of measurements",
                             file_name,
                             "let nmm-bench measure write it anew"));
      std::vector<Row> rows;
      while (std::getline(in, line))
      {
        const std::vector<std::string> cells = split(line);
        AssertThrow(cells.size() == column_names().size(),
                    InputError("a row has too many or too few cells",
                               file_name + ": " + line,
                               "let nmm-bench measure write it anew"));
        rows.emplace_back();
        unsigned int next = 0;
        for_each_column(rows.back(), Reader{&cells, &next});
      }
      return rows;
    }


    void
    describe_machine(Row &row)
    {
      const std::time_t now      = std::time(nullptr);
      char              text[16] = {};
      std::strftime(text, sizeof(text), "%Y-%m-%d", std::localtime(&now));
      row.date = text;
      row.cpu  = cpu_name();
      std::ostringstream versions;
      versions << "deal.II " << DEAL_II_PACKAGE_VERSION << "; Trilinos "
               << TRILINOS_VERSION_STRING << "; MUMPS " << MUMPS_VERSION
               << "; g++ " << __VERSION__;
#ifndef NDEBUG
      versions << "; Debug";
#endif
      row.versions = versions.str();
    }
  } // namespace Bench
} // namespace NMM
