#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>
#include <nmm/mechanics/loading.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <mechanics/load_amplitudes.h>
#include <memory>
#include <sstream>

namespace NMM
{
  Loading
  proportional_loading(const ElasticityProblem &problem,
                       const LoadAmplitudes    &full)
  {
    const LoadAmplitudes at_one = internal::completed(problem, full);
    Loading              loading;
    loading.amplitudes = [at_one](const double t) {
      LoadAmplitudes amplitudes = at_one;
      for (std::vector<double> *list : {&amplitudes.boundary_conditions,
                                        &amplitudes.point_forces,
                                        &amplitudes.fixed_points})
        for (double &amplitude : *list)
          amplitude *= t;
      amplitudes.gravity *= t;
      amplitudes.body_force *= t;
      return amplitudes;
    };
    return loading;
  }


  LoadAmplitudes
  product(const LoadAmplitudes &a, const LoadAmplitudes &b)
  {
    LoadAmplitudes result = a;
    for (const auto list : {&LoadAmplitudes::boundary_conditions,
                            &LoadAmplitudes::point_forces,
                            &LoadAmplitudes::fixed_points})
    {
      const std::vector<double> &factors = b.*list;
      if ((result.*list).empty())
        (result.*list).assign(factors.size(), 1.);
      for (std::size_t i = 0; i < factors.size(); ++i)
        (result.*list)[i] *= factors[i];
    }
    for (const auto list : {&LoadAmplitudes::released_conditions,
                            &LoadAmplitudes::released_fixed_points})
    {
      const std::vector<bool> &gone = b.*list;
      if ((result.*list).empty())
        (result.*list).assign(gone.size(), false);
      for (std::size_t i = 0; i < gone.size(); ++i)
        (result.*list)[i] = (result.*list)[i] || gone[i];
    }
    result.gravity *= b.gravity;
    result.body_force *= b.body_force;
    return result;
  }


  Loading
  loading_after_stage(const Loading &loading, const LoadAmplitudes &stage)
  {
    Loading result    = loading;
    result.amplitudes = [before = loading.amplitudes, stage](const double t) {
      return before ? product(before(t), stage) : stage;
    };
    return result;
  }


  namespace
  {
    /// @p function times @p factor; null stays null.
    std::shared_ptr<const dealii::Function<2>>
    scaled(const std::shared_ptr<const dealii::Function<2>> &function,
           const double                                      factor)
    {
      if (!function || factor == 1.)
        return function;
      std::vector<std::function<double(const dealii::Point<2> &)>> components;
      for (unsigned int c = 0; c < function->n_components; ++c)
        components.emplace_back(
          [function, factor, c](const dealii::Point<2> &x) {
            return factor * function->value(x, c);
          });
      return std::make_shared<dealii::FunctionFromFunctionObjects<2>>(
        components);
    }
  } // namespace


  ElasticityProblem
  problem_at(const ElasticityProblem &problem, const LoadAmplitudes &amplitudes)
  {
    ElasticityProblem now = problem;
    now.gravity *= amplitudes.gravity;
    now.body_force = scaled(problem.body_force, amplitudes.body_force);
    for (unsigned int i = 0; i < amplitudes.boundary_conditions.size(); ++i)
      now.boundary_conditions[i].value =
        scaled(problem.boundary_conditions[i].value,
               amplitudes.boundary_conditions[i]);
    for (unsigned int i = 0; i < amplitudes.point_forces.size(); ++i)
      now.point_forces[i].force *= amplitudes.point_forces[i];
    for (unsigned int i = 0; i < amplitudes.fixed_points.size(); ++i)
      now.fixed_points[i].displacement *= amplitudes.fixed_points[i];
    return now;
  }


  TimeHistory::TimeHistory(std::vector<double> times_in,
                           std::vector<double> values_in)
    : times(std::move(times_in))
    , values(std::move(values_in))
  {
    AssertThrow(!times.empty() && times.size() == values.size(),
                InputError(std::to_string(times.size()) + " times and " +
                             std::to_string(values.size()) + " values",
                           "a time history",
                           "give as many of both, at least one"));
    for (unsigned int i = 0; i < times.size(); ++i)
    {
      AssertThrow(std::isfinite(times[i]) && std::isfinite(values[i]),
                  InputError("A number is not finite",
                             "point " + std::to_string(i + 1) +
                               " of a time history",
                             "correct it"));
      AssertThrow(i == 0 || times[i - 1] < times[i],
                  InputError("Times do not ascend: " +
                               std::to_string(times[i]) + " s after " +
                               std::to_string(times[i == 0 ? 0 : i - 1]) + " s",
                             "point " + std::to_string(i + 1) +
                               " of a time history",
                             "sort the points"));
    }
  }


  TimeHistory
  TimeHistory::read(const std::string &filename)
  {
    std::istringstream in(read_input_file(filename, "the time history"));
    return read(in, filename);
  }


  TimeHistory
  TimeHistory::read(std::istream &in, const std::string &name)
  {
    std::vector<double> times, values;
    std::string         line;
    for (unsigned int n = 1; std::getline(in, line); ++n)
    {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      std::string        first;
      if (!(words >> first) || first[0] == '#')
        continue;
      words.seekg(0);
      double      time, value;
      std::string rest;
      const auto  where = [&] { return name + ", line " + std::to_string(n); };
      AssertThrow(
        (words >> time >> value) && !(words >> rest),
        InputError("Expected two numbers, time and value, instead of '" +
                     excerpt(line) + "'",
                   where(),
                   "correct the line"));
      AssertThrow(times.empty() || times.back() < time,
                  InputError("Times do not ascend: " + std::to_string(time) +
                               " s after " + std::to_string(times.back()) +
                               " s",
                             where(),
                             "sort the lines"));
      times.push_back(time);
      values.push_back(value);
    }
    AssertThrow(!times.empty(),
                InputError("There are no points",
                           name,
                           "give lines of two numbers, time and value"));
    return TimeHistory(std::move(times), std::move(values));
  }


  double
  TimeHistory::operator()(const double t) const
  {
    if (!(t >= times.front()) || t > times.back())
      return 0.;
    const auto next = std::upper_bound(times.begin(), times.end(), t);
    if (next == times.end())
      return values.back();
    const std::size_t i     = next - times.begin();
    const double      share = (t - times[i - 1]) / (times[i] - times[i - 1]);
    return (1. - share) * values[i - 1] + share * values[i];
  }
} // namespace NMM
