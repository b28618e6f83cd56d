#ifndef step_nmm_4_runs_h
#define step_nmm_4_runs_h

// What is left of a run of step-nmm-4, and what differs between runs that begin the same.

#include <deal.II/base/point.h>

#include "tutorial/table.h"
#include <string>
#include <vector>

namespace StepNMM4
{
  struct Run
  {
    std::string name;
    /// The longest time step [s].
    double step = 0.;
    /// At rest where it was, but for some settlement.
    bool stands = false;
    /// Of all steps [s], and centres of mass then [m].
    std::vector<double>           times;
    std::vector<dealii::Point<2>> centers;
    /// A row per step, and the row in the table of runs.
    Tutorial::Table history;
    Tutorial::Row   row;

    /// Centre of mass between steps, or where the run ended [m].
    dealii::Point<2>
    center_at(double time) const;

    /// How far it is from where it began [m].
    double
    way_at(double time) const;
  };


  /// The greatest value of a column, that of half of its rows, and the last one.
  struct Extent
  {
    explicit Extent(std::vector<double> values);

    double largest, median, last;
  };


  /// Print a row per run, and what differs between runs that begin (nearly) the same: centres of mass, and, of three runs
  /// or more with the same friction angle and step, how far they move in the mean and how much they scatter. Write
  /// a table of all steps of each run, and one of runs, as files whose names begin with @p prefix.
  void
  report_runs(const std::string &prefix, const std::vector<Run> &runs);
} // namespace StepNMM4

#endif
