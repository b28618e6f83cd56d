#include <nmm/base/program.h>
#include <nmm/scene/time_table.h>

#include <cstdio>
#include <iomanip>
#include <sstream>

namespace NMM
{
  namespace
  {
    /// Rows of an earlier run up to a step.
    std::string
    read_rows(const std::string &filename,
              const std::string &head,
              const int          last_step)
    {
      std::ifstream      in(filename);
      std::istringstream expected(head);
      std::string        line, expected_line;
      while (std::getline(expected, expected_line))
        AssertThrow(std::getline(in, line) && line == expected_line,
                    InputError("this is no table to continue: its columns "
                               "are others",
                               filename,
                               "continue with the scene it was written with, "
                               "or in another folder"));
      std::string rows;
      while (std::getline(in, line))
      {
        std::istringstream row(line);
        double             time;
        char               comma;
        int                step;
        // A row that was cut off by a kill has no end.
        if ((row >> time >> comma >> step) && step <= last_step && !in.eof())
          rows += line + "\n";
      }
      return rows;
    }
  } // namespace


  TimeTable::TimeTable(const std::string              &filename,
                       const std::string              &comment,
                       const std::vector<std::string> &columns,
                       const MPI_Comm                  communicator,
                       const int                       continue_after)
    : filename(filename)
    , n_columns(columns.size())
    , writes(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    if (!writes)
      return;
    std::string text = comment.empty() ? "" : comment + "\n";
    text += "time,step";
    for (const std::string &column : columns)
      text += "," + column;
    text += "\n";
    if (continue_after >= 0)
      text += read_rows(filename, text, continue_after);

    const std::string temporary = filename + ".part";
    {
      std::ofstream file(temporary, std::ios::trunc);
      file << text << std::flush;
      AssertThrow(file.good() &&
                    std::rename(temporary.c_str(), filename.c_str()) == 0,
                  OutputFailure(filename));
    }
    out.open(filename, std::ios::app);
    AssertThrow(out.good(), OutputFailure(filename));
  }


  void
  TimeTable::write(const double               time,
                   const unsigned int         step,
                   const std::vector<double> &values)
  {
    if (!writes)
      return;
    AssertDimension(values.size(), n_columns);
    out << std::setprecision(17) << time << ',' << step;
    for (const double value : values)
      out << ',' << value;
    out << std::endl;
    AssertThrow(out.good(), OutputFailure(filename));
  }
} // namespace NMM
