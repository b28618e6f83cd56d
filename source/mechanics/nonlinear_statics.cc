#include <nmm/base/exceptions.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NMM
{
  namespace
  {
    /// The elasticity at one load factor.
    class AtLoadFactor : public NonlinearSystem
    {
    public:
      AtLoadFactor(FiniteElasticity &elasticity, const double load_factor)
        : elasticity(&elasticity)
        , load_factor(load_factor)
      {
      }

      Deformation
      assemble(const Vector &u,
               const Tangent tangent,
               const Vector *increment) override
      {
        return elasticity->assemble(u, load_factor, tangent, increment);
      }

      const Vector &
      residual() const override
      {
        return elasticity->residual();
      }

      const dealii::TrilinosWrappers::SparseMatrix &
      tangent() const override
      {
        return elasticity->tangent();
      }

      bool
      tangent_is_symmetric() const override
      {
        return elasticity->tangent_is_symmetric();
      }

      double
      force_scale() const override
      {
        return elasticity->force_scale();
      }

    private:
      FiniteElasticity *elasticity;
      double            load_factor;
    };


    std::string
    history(const NewtonReport &report)
    {
      std::ostringstream out;
      out.precision(2);
      out << std::scientific;
      for (const NewtonReport::Iteration &i : report.iterations)
        out << (&i == report.iterations.data() ? "" : ", ")
            << i.relative_residual;
      return out.str();
    }
  } // namespace


  LoadSteps
  LoadSteps::equal(const unsigned int n, const double last)
  {
    LoadSteps steps;
    steps.load_factors.clear();
    for (unsigned int k = 1; k <= n; ++k)
      steps.load_factors.push_back(last * k / n);
    return steps;
  }


  void
  LoadSteps::check() const
  {
    AssertThrow(!load_factors.empty(),
                InputError("There is no load factor",
                           "the load steps",
                           "give at least one"));
    double last = 0.;
    for (const double factor : load_factors)
    {
      AssertThrow(std::isfinite(factor) && factor > last,
                  InputError("The load factor " + std::to_string(factor) +
                               " follows " + std::to_string(last),
                             "the load steps",
                             "give factors that ascend from above 0"));
      last = factor;
    }
    AssertThrow(min_step > 0. && min_step <= 1.,
                InputError("The smallest step is " + std::to_string(min_step),
                           "the load steps",
                           "give a number above 0 and at most 1"));
  }


  NonlinearStatics::NonlinearStatics(FiniteElasticity       &elasticity,
                                     const NewtonParameters &parameters)
    : elasticity(&elasticity)
    , newton(parameters)
  {
    states.push_back({0., elasticity.initial_solution()});
  }


  NonlinearStatics::Vector
  NonlinearStatics::predict(const double       load_factor,
                            const unsigned int degree) const
  {
    const unsigned int n = std::min<std::size_t>(degree + 1, states.size());
    if (n < 2)
      return states.back().solution;
    const auto *last = states.data() + states.size() - n;
    Vector      sum(states.back().solution.locally_owned_elements(),
               states.back().solution.get_mpi_communicator());
    Vector      part(sum);
    for (unsigned int a = 0; a < n; ++a)
    {
      double weight = 1.;
      for (unsigned int b = 0; b < n; ++b)
        if (b != a)
          weight *= (load_factor - last[b].load_factor) /
                    (last[a].load_factor - last[b].load_factor);
      part = last[a].solution;
      sum.add(weight, part);
    }
    Vector result(states.back().solution);
    result = sum;
    return result;
  }


  std::vector<LoadStep>
  NonlinearStatics::run(
    const LoadSteps                                             &steps,
    const std::function<void(const LoadStep &, const Vector &)> &after_step)
  {
    steps.check();
    if (states.back().load_factor >= steps.load_factors.front())
    {
      states.clear();
      states.push_back({0., elasticity->initial_solution()});
    }

    std::vector<LoadStep> report;
    const double          min_step = steps.min_step * steps.load_factors.back();
    double                step     = steps.load_factors.back();
    current                        = LoadStep();
    auto wanted                    = steps.load_factors.begin();
    while (wanted != steps.load_factors.end())
    {
      const double from   = states.back().load_factor;
      current.is_asked    = from + step >= *wanted * (1. - 1e-12);
      current.load_factor = current.is_asked ? *wanted : from + step;
      Vector     u = predict(current.load_factor, steps.extrapolation_degree);
      Vector     change(u);
      const bool is_extrapolated =
        steps.extrapolation_degree > 0 && states.size() > 1;
      if (is_extrapolated)
        change -= states.back().solution;
      AtLoadFactor system(*elasticity, current.load_factor);
      current.newton = newton.solve(system,
                                    elasticity->affine_constraints(),
                                    u,
                                    is_extrapolated ? &change : nullptr);
      if (current.newton.converged &&
          elasticity->largest_jump() > steps.max_jump)
      {
        current.newton.converged = false;
        current.newton.reason =
          "displacement conditions or ties are missed by a good part of an "
          "element";
      }
      if (!current.newton.converged)
      {
        step = 0.5 * (current.load_factor - from);
        ++current.n_cuts;
        current.n_lost_iterations += current.newton.iterations.size();
        AssertThrow(
          step >= min_step,
          NumericalFailure(
            "No equilibrium: " + current.newton.reason +
              "; relative residuals of the last iterations: " +
              history(current.newton),
            "load factor " + std::to_string(current.load_factor) + ", after " +
              std::to_string(from),
            "the solid may have reached its limit load or be unstable; else "
            "allow smaller steps"));
        continue;
      }

      states.push_back({current.load_factor, u});
      elasticity->adapt_penalties(u);
      if (states.size() > steps.extrapolation_degree + 1)
        states.erase(states.begin());
      report.push_back(current);
      if (after_step)
        after_step(current, u);
      current.n_cuts = current.n_lost_iterations = 0;
      step *= 2.;
      if (report.back().is_asked)
        ++wanted;
    }
    return report;
  }


  const NonlinearStatics::Vector &
  NonlinearStatics::solution() const
  {
    return states.back().solution;
  }


  double
  NonlinearStatics::load_factor() const
  {
    return states.back().load_factor;
  }


  const LoadStep &
  NonlinearStatics::last_attempt() const
  {
    return current;
  }
} // namespace NMM
