#include "tutorial/table.h"

#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>

namespace Tutorial
{
  namespace
  {
    std::string
    to_text(const Value &value, const unsigned int n_digits)
    {
      if (std::isnan(value.number))
        return value.text;
      std::ostringstream text;
      // counts have all their digits
      const bool is_count = std::abs(value.number) < 1e9 &&
                            value.number == std::round(value.number);
      text << std::setprecision(is_count ? 10 : n_digits) << value.number;
      return text.str();
    }


    /// Width of a column on the screen.
    int
    width(const std::string &column)
    {
      return std::max<int>(column.size(), 10);
    }
  } // namespace


  Value::Value(const char *text)
    : Value(std::string(text))
  {
  }


  Value::Value(const std::string &text)
    : text(text)
    , number(std::numeric_limits<double>::quiet_NaN())
  {
  }


  Value::Value(const double number)
    : text("nan")
    , number(number)
  {
  }


  Row
  operator+(Row first, const Row &second)
  {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }


  double
  number(const Row &row, const std::string &column)
  {
    for (const auto &[name, value] : row)
      if (name == column)
        return value.number;
    throw std::out_of_range("no column " + column);
  }


  Table::Table(const std::string &title, const unsigned int n_printed)
    : title(title)
    , n_printed(n_printed)
  {
  }


  void
  Table::add(const Row &row)
  {
    const auto print = [&](const auto &text) {
      for (unsigned int i = 0; i < row.size() && i < n_printed; ++i)
        std::cout << ' ' << std::setw(width(row[i].first)) << text(row[i]);
      std::cout << std::endl;
    };
    if (!title.empty() && rows.empty())
    {
      std::cout << '\n' << title << '\n';
      print([](const auto &cell) { return cell.first; });
    }
    if (!title.empty())
      print([](const auto &cell) { return to_text(cell.second, 4); });
    rows.push_back(row);
  }


  void
  Table::add_break(const unsigned int n)
  {
    rows.resize(rows.size() + n);
  }


  std::vector<double>
  Table::column(const std::string &name) const
  {
    std::vector<double> result;
    for (const Row &row : rows)
      if (!row.empty())
        result.push_back(number(row, name));
    return result;
  }


  void
  Table::print_ranges(const std::string              &title,
                      const std::vector<std::string> &columns) const
  {
    if (rows.empty())
      return;
    std::cout << '\n' << title << '\n';
    for (const std::string &name : columns)
    {
      const std::vector<double> values = column(name);
      const auto [low, high] =
        std::minmax_element(values.begin(), values.end());
      std::cout << std::setw(30) << name << ": " << to_text(*low, 3) << " to "
                << to_text(*high, 3) << std::endl;
    }
  }


  void
  Table::write(const std::string &file_name) const
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    std::ofstream file(file_name);
    const auto    write_line = [&](const Row &row, const auto &text) {
      for (unsigned int i = 0; i < row.size(); ++i)
        file << (i > 0 ? "," : "") << text(row[i]);
      file << '\n';
    };
    if (!rows.empty())
      write_line(rows.front(), [](const auto &cell) { return cell.first; });
    for (const Row &row : rows)
      write_line(row, [](const auto &cell) { return to_text(cell.second, 9); });
    AssertThrow(file.flush().good(),
                NMM::InputError("results cannot be written",
                                file_name,
                                "name a folder that can be written to"));
  }


  std::vector<Record>
  read_csv(std::istream &in)
  {
    std::vector<std::string> columns;
    std::vector<Record>      records;
    for (std::string line; std::getline(in, line);)
    {
      if (line.empty() || line[0] == '#')
        continue;
      const std::vector<std::string> cells =
        dealii::Utilities::split_string_list(line, ',');
      if (columns.empty())
      {
        columns = cells;
        continue;
      }
      records.emplace_back();
      for (unsigned int i = 0; i < columns.size(); ++i)
        records.back()[columns[i]] = i < cells.size() ? cells[i] : "";
    }
    return records;
  }


  void
  StageClock::lap(const std::string &name)
  {
    laps.emplace_back(name, timer.wall_time() - total());
  }


  double
  StageClock::total() const
  {
    double sum = 0.;
    for (const auto &[name, seconds] : laps)
      sum += seconds;
    return sum;
  }


  std::string
  StageClock::to_text() const
  {
    std::ostringstream text;
    text << std::setprecision(3);
    for (const auto &[name, seconds] : laps)
      text << name << '=' << seconds << ' ';
    return text.str();
  }


  const std::vector<std::pair<std::string, double>> &
  StageClock::stages() const
  {
    return laps;
  }


  std::vector<Placement>
  random_placements(const unsigned int n,
                    const unsigned int seed,
                    const double       cell_size)
  {
    std::mt19937 engine(seed);
    const auto   uniform = [&](const double high) {
      return high * (engine() / 4294967296.);
    };
    std::vector<Placement> placements(n);
    for (Placement &placement : placements)
    {
      placement.offset[0] = uniform(cell_size);
      placement.offset[1] = uniform(cell_size);
      placement.rotation  = uniform(60.);
    }
    return placements;
  }
} // namespace Tutorial
