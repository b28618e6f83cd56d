#ifndef tutorial_table_h
#define tutorial_table_h

#include <deal.II/base/tensor.h>
#include <deal.II/base/timer.h>

#include <istream>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Tutorial
{
  /// A word or a number in a table.
  struct Value
  {
    Value(const char *text);
    Value(const std::string &text);
    Value(double number);

    /// Counts, and whether something is so (1 or 0).
    template <typename T, typename = std::enable_if_t<std::is_integral_v<T>>>
    Value(const T number)
      : Value(static_cast<double>(number))
    {
    }

    std::string text;
    /// Not a number for a word.
    double number;
  };

  /// Columns and their values, in the order of the table.
  using Row = std::vector<std::pair<std::string, Value>>;

  /// The columns of both.
  Row
  operator+(Row first, const Row &second);

  /// The number in a column. @throws std::out_of_range without such a column.
  double
  number(const Row &row, const std::string &column);


  /**
   * A table of results. Rows are printed as they are added, and written as CSV in the end. All rows
   * of a table have the same columns.
   *
   * @code
   *   Tutorial::Table table("Error of the force");
   *   table.add({{"springs", "penalty"}, {"unknowns", 1104}, {"error", 2e-3}});
   *   table.write("folder/study.csv");
   * @endcode
   */
  class Table
  {
  public:
    /// A table without a title is not printed; otherwise its first @p n_printed columns are.
    explicit Table(const std::string &title = "", unsigned int n_printed = 100);

    /// Add a row and print it; before the first one title and names of columns are printed.
    void
    add(const Row &row);

    /// Leave @p n lines empty in the file, where a curve that gnuplot draws ends.
    void
    add_break(unsigned int n = 1);

    /// The numbers in a column.
    std::vector<double>
    column(const std::string &name) const;

    /// Print the least and the largest values of columns in all rows.
    void
    print_ranges(const std::string              &title,
                 const std::vector<std::string> &columns) const;

    /// Write names of columns and rows as CSV with nine digits, on the first rank.
    /// @throws NMM::InputError if the file cannot be written.
    void
    write(const std::string &file_name) const;

  private:
    std::string  title;
    unsigned int n_printed;
    /// An empty row is an empty line.
    std::vector<Row> rows;
  };


  /// The words of a row of a CSV file, by column; "" where a row ends early.
  using Record = std::map<std::string, std::string>;

  /// Read rows below the one with the names of columns; lines that begin with # are skipped.
  std::vector<Record>
  read_csv(std::istream &in);


  /// The stages of a run and their wall times [s]; the first one begins with this object.
  class StageClock
  {
  public:
    /// The stage @p name ends here.
    void
    lap(const std::string &name);

    /// Until the last stage that has ended.
    double
    total() const;

    /// All stages as NAME=SECONDS.
    std::string
    to_text() const;

    const std::vector<std::pair<std::string, double>> &
    stages() const;

  private:
    dealii::Timer                               timer;
    std::vector<std::pair<std::string, double>> laps;
  };


  /// Where a mesh lies against the solid: its offset [m] and rotation [degrees].
  struct Placement
  {
    dealii::Tensor<1, 2> offset;
    double               rotation;
  };

  /// The same @p n placements at random for each @p seed, with offsets up to @p cell_size and
  /// rotations up to 60 degrees.
  std::vector<Placement>
  random_placements(unsigned int n, unsigned int seed, double cell_size);
} // namespace Tutorial

#endif
