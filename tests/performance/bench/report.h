#ifndef nmm_tests_performance_bench_report_h
#define nmm_tests_performance_bench_report_h

#include "row.h"
#include <ostream>

namespace NMM
{
  namespace Bench
  {
    /**
     * Write @p directory/performance.md and the figures it shows, all of it from
     * @p rows.
     */
    void
    write_report(const std::vector<Row> &rows, const std::string &directory);


    /// @name Pieces of it
    /// @{
    using Filter = std::function<bool(const Row &)>;

    std::vector<Row>
    select(const std::vector<Row> &rows, const Filter &filter);

    /// Rows of a case.
    std::vector<Row>
    select(const std::vector<Row> &rows, const std::string &name);

    /// A number with @p digits significant digits, with separators from 10,000 on; "-" for none.
    std::string
    text_of(double number, unsigned int digits = 3);

    /// In scientific notation, two digits.
    std::string
    error_text(double error);

    /// Requirements, what was measured, and whether it is enough.
    void
    write_bars(std::ostream &out, const std::vector<Row> &rows);

    /// Seconds of stages, of the slowest run of each kind.
    void
    write_stages(std::ostream           &out,
                 const std::vector<Row> &rows,
                 const std::string      &image_directory);

    /// Rings on ranks.
    void
    write_ranks(std::ostream           &out,
                const std::vector<Row> &rows,
                const std::string      &image_directory);

    /// Stages on one thread and on more.
    void
    write_threads(std::ostream &out, const std::vector<Row> &rows);
    /// @}
  } // namespace Bench
} // namespace NMM

#endif
