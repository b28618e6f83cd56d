#include "runs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace StepNMM4
{
  using namespace dealii;

  Point<2>
  Run::center_at(const double time) const
  {
    const auto i =
      std::lower_bound(times.begin(), times.end(), time) - times.begin();
    if (i == 0 || i == static_cast<int>(times.size()))
      return i == 0 ? centers.front() : centers.back();
    return centers[i - 1] + (time - times[i - 1]) / (times[i] - times[i - 1]) *
                              (centers[i] - centers[i - 1]);
  }


  double
  Run::way_at(const double time) const
  {
    return center_at(time).distance(centers.front());
  }


  Extent::Extent(std::vector<double> values)
    : last(values.back())
  {
    std::sort(values.begin(), values.end());
    largest = values.back();
    median  = values[values.size() / 2];
  }


  namespace
  {
    /// Of the centres of mass, each half of a second and where both end.
    void
    print_difference(const Run &first, const Run &other)
    {
      Tutorial::Table table("Centre of mass of the run '" + other.name +
                            "' against '" + first.name + "'");
      const auto      add = [&](const double time, const double difference) {
        table.add({{"time", time},
                   {"difference_m", difference},
                   {"of_its_way_%", 100. * difference / first.way_at(time)}});
      };
      double next = 0.5;
      for (const double time : first.times)
      {
        if (time < next && time < first.times.back())
          continue;
        next = std::floor(2. * time) / 2. + 0.5;
        add(time, other.center_at(time).distance(first.center_at(time)));
      }
      add(first.times.back(),
          other.centers.back().distance(first.centers.back()));
    }


    /// Ways of runs that begin the same.
    Tutorial::Row
    mean_way(const std::vector<const Run *> &runs, const double time)
    {
      const double        n = runs.size();
      std::vector<double> ways;
      for (const Run *run : runs)
        ways.push_back(run->way_at(time));
      const double mean    = std::accumulate(ways.begin(), ways.end(), 0.) / n;
      double       squares = 0.;
      for (const double way : ways)
        squares += (way - mean) * (way - mean);
      const double deviation = std::sqrt(squares / (n - 1.));
      const auto [least, largest] =
        std::minmax_element(ways.begin(), ways.end());
      return {{"time", time},
              {"mean", mean},
              {"its_error", deviation / std::sqrt(n)},
              {"deviation", deviation},
              {"least", *least},
              {"largest", *largest}};
    }


    void
    print_means(const std::vector<Run> &runs)
    {
      // those of a friction angle as it is in names and a step
      std::map<std::pair<std::string, double>, std::vector<const Run *>> groups;
      for (const Run &run : runs)
        groups[{run.name.substr(0, run.name.find('-')), run.step}].push_back(
          &run);
      for (const auto &[group, members] : groups)
      {
        if (members.size() < 3)
          continue;
        double end = 0.;
        for (const Run *run : members)
          end = std::max(end, run->times.back());
        std::ostringstream title;
        title << "Way of the centre of mass [m], friction angle " << group.first
              << " degrees, steps of " << group.second << " s, "
              << members.size() << " runs";
        Tutorial::Table table(title.str());
        for (double time = 1.; time < end; time += 1.)
          table.add(mean_way(members, time));
        table.add(mean_way(members, end));
      }
    }
  } // namespace


  void
  report_runs(const std::string &prefix, const std::vector<Run> &runs)
  {
    Tutorial::Table table("Runs", 12);
    for (const Run &run : runs)
    {
      table.add(run.row);
      run.history.write(prefix + run.name + ".csv");
    }
    table.write(prefix + "runs.csv");
    for (const Run &other : runs)
      for (const Run &first : runs)
        if (&other != &first && other.name.rfind(first.name + '-', 0) == 0)
          print_difference(first, other);
    print_means(runs);
  }
} // namespace StepNMM4
