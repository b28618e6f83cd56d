#include <nmm/base/exceptions.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <algorithm>
#include <sstream>

namespace NMM
{
  namespace
  {
    std::string
    history(const NewtonReport &report)
    {
      std::ostringstream out;
      out.precision(2);
      out << std::scientific;
      constexpr std::size_t n_shown = 5;
      const std::size_t     n       = report.iterations.size();
      for (std::size_t i = n - std::min(n, n_shown); i < n; ++i)
        out << report.iterations[i].relative_residual
            << (i + 1 < n ? ", " : "");
      return out.str();
    }


    /// Search by Newton's method.
    class PlainSearch : public EquilibriumSearch
    {
    public:
      PlainSearch(StaticSystem &system, const NewtonParameters &parameters)
        : system(&system)
        , newton(parameters)
      {
      }

      StepFault
      find(LoadStep &step, Vector &u, const Vector *change) override
      {
        step.newton =
          newton.solve(*system,
                       system->solid().elasticity().affine_constraints(),
                       u,
                       change);
        step.n_iterations      = step.newton.iterations.size();
        step.relative_residual = step.newton.relative_residual;
        if (step.newton.converged)
          return {};
        return {step.newton.reason,
                "the solid may have reached its limit load or be unstable; "
                "else allow smaller steps"};
      }

    private:
      StaticSystem *system;
      NewtonSolver  newton;
    };
  } // namespace


  struct NonlinearStatics::Data
  {
    struct State
    {
      double load_factor;
      Vector solution;
    };

    /// Initial guess of the step to @p load_factor: the extrapolation of previous solutions by a
    /// polynomial of at most the given degree.
    Vector
    predict(double load_factor, unsigned int degree) const;

    StepFault
    try_step(const LoadSteps &steps, LoadStep &step, Vector &u);

    std::unique_ptr<SolidTerm>         own_solid;
    std::unique_ptr<StaticSystem>      own_system;
    std::unique_ptr<EquilibriumSearch> own_search;
    StaticSystem                      *system = nullptr;
    EquilibriumSearch                 *search = nullptr;
    std::vector<State>                 states;
    LoadStep                           current;
    Vector                             iterate;
    double                             dissipated = 0.;
    /// Whether the first state is no equilibrium, and must not be used for extrapolation: the
    /// undeformed state with initial stress, or that of a solid that was cut since.
    bool begins_out_of_balance = false;
    /// Whether a step was accepted since the first state.
    bool has_equilibrium = false;

    void
    initialize(StaticSystem &used_system, EquilibriumSearch &used_search)
    {
      system                             = &used_system;
      search                             = &used_search;
      const FiniteElasticity &elasticity = system->solid().elasticity();
      states.push_back({0., elasticity.initial_solution()});
      for (const Material &material : elasticity.elasticity_problem().materials)
        begins_out_of_balance =
          begins_out_of_balance || material.has_initial_stress();
    }

    /// In small displacements the potential is convex, and hence no solution is spurious.
    bool
    is_finite() const
    {
      return system->solid().kinematics() == Kinematics::finite;
    }

    /// Begin with Newton's method for the forces of @p solid and @p others.
    void
    initialize(SolidTerm                      &solid,
               const NewtonParameters         &parameters,
               const std::vector<ForceTerm *> &others)
    {
      own_system = std::make_unique<StaticSystem>(solid, others);
      own_search = std::make_unique<PlainSearch>(*own_system, parameters);
      initialize(*own_system, *own_search);
    }
  };


  NonlinearStatics::NonlinearStatics(StaticSystem      &system,
                                     EquilibriumSearch &search)
    : data(std::make_unique<Data>())
  {
    data->initialize(system, search);
  }


  NonlinearStatics::NonlinearStatics(SolidTerm                      &solid,
                                     const NewtonParameters         &parameters,
                                     const std::vector<ForceTerm *> &others)
    : data(std::make_unique<Data>())
  {
    data->initialize(solid, parameters, others);
  }


  NonlinearStatics::NonlinearStatics(FiniteElasticity       &elasticity,
                                     const NewtonParameters &parameters)
    : data(std::make_unique<Data>())
  {
    data->own_solid = make_solid_at_rest(elasticity, Kinematics::finite);
    data->initialize(*data->own_solid, parameters, {});
  }


  NonlinearStatics::~NonlinearStatics() = default;


  NonlinearStatics::Vector
  NonlinearStatics::Data::predict(const double       load_factor,
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


  StepFault
  NonlinearStatics::Data::try_step(const LoadSteps &steps,
                                   LoadStep        &step,
                                   Vector          &u)
  {
    // a step that was cut deviates from the extrapolation of the last ones
    const unsigned int degree =
      step.n_cuts == 0 ? steps.extrapolation_degree : 0;
    u = predict(step.load_factor, degree);
    Vector     change(u);
    const bool is_extrapolated = degree > 0 && states.size() > 1;
    if (is_extrapolated)
      change -= states.back().solution;
    system->begin_step(states.back().solution,
                       states.back().load_factor,
                       u,
                       step.load_factor);

    StepFault fault =
      search->find(step, u, is_extrapolated ? &change : nullptr);
    if (fault.reason.empty() && is_finite() &&
        system->solid().elasticity().largest_jump() > steps.max_jump)
      fault.reason =
        "displacement conditions or ties are missed by a good part of an "
        "element";
    if (!fault.reason.empty())
      fault.reason +=
        "; relative residuals of the last iterations: " + history(step.newton);
    return fault;
  }


  void
  NonlinearStatics::continue_from(const double load_factor, const Vector &u)
  {
    Data      &d     = *data;
    SolidTerm &solid = d.system->solid();
    Assert(solid.inelastic_terms() == nullptr, dealii::ExcNotImplemented());
    Vector admissible(u);
    solid.elasticity().affine_constraints().distribute(admissible);
    Vector solution(d.states.back().solution);
    solution = admissible;
    d.states.clear();
    d.states.push_back({load_factor, solution});
    d.begins_out_of_balance = true;
    d.has_equilibrium       = false;
  }


  void
  NonlinearStatics::begin_stage(const StageChange &change, const double end)
  {
    Data &d = *data;
    d.system->begin_stage(change,
                          d.states.back().solution,
                          d.states.back().load_factor,
                          end);
    // what came before says nothing about the way on
    d.states.erase(d.states.begin(), d.states.end() - 1);
  }


  std::vector<LoadStep>
  NonlinearStatics::run(
    const LoadSteps                                             &steps,
    const std::function<void(const LoadStep &, const Vector &)> &after_step)
  {
    Data &d = *data;
    if (d.own_search != nullptr && !steps.load_factors.empty() &&
        d.states.back().load_factor >= steps.load_factors.front())
    {
      d.states.clear();
      d.has_equilibrium = false;
      d.system->begin_anew();
      d.states.push_back(
        {0., d.system->solid().elasticity().initial_solution()});
    }

    std::vector<LoadStep> report;
    d.current          = LoadStep();
    const auto attempt = [&](LoadStep &step) {
      // where loads turn round or stay, what came before says nothing about the way on
      const std::size_t n = d.states.size();
      if (n > 1 &&
          ((step.load_factor > d.states[n - 1].load_factor) !=
             (d.states[n - 1].load_factor > d.states[n - 2].load_factor) ||
           d.states[n - 1].load_factor == d.states[n - 2].load_factor))
        d.states.erase(d.states.begin(), d.states.end() - 1);
      Vector          u(d.states.back().solution);
      const StepFault fault = d.try_step(steps, step, u);
      if (!fault.reason.empty())
      {
        d.iterate = u;
        d.search->reject();
        return StepVerdict::rejected(fault);
      }
      d.dissipated = d.system->commit(u).dissipated;
      d.search->accept(u);
      if (d.begins_out_of_balance && !d.has_equilibrium)
        d.states.clear();
      d.has_equilibrium = true;
      d.states.push_back({step.load_factor, u});
      if (d.states.size() > steps.extrapolation_degree + 1)
        d.states.erase(d.states.begin());
      if (d.is_finite())
        d.system->solid().elasticity().adapt_penalties(u);
      report.push_back(step);
      if (after_step)
        after_step(step, u);
      return StepVerdict::accepted();
    };
    take_load_steps(steps, d.states.back().load_factor, attempt, d.current);
    return report;
  }


  const NonlinearStatics::Vector &
  NonlinearStatics::solution() const
  {
    return data->states.back().solution;
  }


  double
  NonlinearStatics::load_factor() const
  {
    return data->states.back().load_factor;
  }


  const LoadStep &
  NonlinearStatics::last_attempt() const
  {
    return data->current;
  }


  const NonlinearStatics::Vector &
  NonlinearStatics::last_iterate() const
  {
    return data->iterate;
  }


  double
  NonlinearStatics::dissipated() const
  {
    return data->dissipated;
  }
} // namespace NMM
