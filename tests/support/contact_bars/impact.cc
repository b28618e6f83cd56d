#include <support/contact_bars/contact_bars.h>

namespace NMM
{
  namespace ContactBars
  {
    void
    run_into_each_other(const Impact &impact, Measurements &measurements)
    {
      constexpr double L = 10., c = 100., V = 0.1, opening = 0.01, E = 100.;
      // without lateral strain the width means nothing
      const double width = 2. * impact.cell_size;
      Geometry     geometry;
      add_block(geometry, "left", {{0., 0.}, {L, 0.}, {L, width}, {0., width}});
      add_block(geometry,
                "right",
                {{L + opening, 0.},
                 {2. * L + opening, 0.},
                 {2. * L + opening, width},
                 {L + opening, width}});
      Bodies::Options options;
      options.cell_size    = impact.cell_size;
      options.rotation     = 6.;
      options.communicator = impact.communicator;
      MovingBodies bars(std::move(geometry), options);
      bars.problem.materials = {material("rock", E, 0., E / c / c)};
      bars.start(contact_parameters(impact.penalty * E / impact.cell_size,
                                    2. * opening),
                 impact.kinematics);
      bars.integrate(impact.scheme,
                     bars.zero(),
                     bars.values(
                       [&](const Point<2> &, const unsigned int block) {
                         return Tensor<1, 2>({block == 0 ? V : -V, 0.});
                       }));

      const double energy    = bars.integrator->account().kinetic;
      const double first     = 0.5 * opening / V;
      const double theory    = 2. * L / c;
      double       last      = 0.;
      const auto   is_closed = [&]() {
        if (bars.contact->report().n_slip > 0)
          last = bars.integrator->state().time;
        return true;
      };
      Run run = bars.run(impact.step, first + 1.2 * theory, is_closed);
      // contact ends between this step and the next one
      const double duration = last + 0.5 * impact.step - first;
      const double rebound  = bars.velocity(1)[0];
      const double balance  = bars.integrator->account().balance;

      std::ostringstream name;
      name << "bars in impact: h " << impact.cell_size << "; step "
           << impact.step << "; penalty " << impact.penalty << "; "
           << impact.scheme.name
           << (impact.kinematics == Kinematics::small ? "" : "; finite");
      measurements.add(3,
                       name.str(),
                       "duration of contact [s]",
                       duration,
                       theory,
                       0.,
                       impact.bound,
                       run);
      measurements.add(
        3, name.str(), "rebound [m/s]", rebound, V, 0., impact.bound, run);
      measurements.add(3,
                       name.str(),
                       "worst balance [J/m]",
                       run.worst_balance,
                       0.,
                       energy,
                       impact.energy_bound,
                       run);
      run = bars.run(impact.step,
                     bars.integrator->state().time +
                       impact.n_further_steps * impact.step);
      measurements.add(3,
                       name.str(),
                       "energy gained later [J/m]",
                       bars.integrator->account().balance - balance,
                       0.,
                       energy,
                       1e-8,
                       run);
    }
  } // namespace ContactBars
} // namespace NMM
