#include <deal.II/lac/full_matrix.h>

#include <support/contact_bars/contact_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      /// Amplitude of sin and cos of omega t in samples, beside a constant and a
      /// linear function of time.
      double
      fit_amplitude(const double               omega,
                    const std::vector<double> &times,
                    const std::vector<double> &values)
      {
        dealii::FullMatrix<double> normal(4, 4);
        dealii::Vector<double>     rhs(4), x(4);
        for (unsigned int i = 0; i < times.size(); ++i)
        {
          const double f[4] = {std::sin(omega * times[i]),
                               std::cos(omega * times[i]),
                               1.,
                               times[i] - times[0]};
          for (unsigned int a = 0; a < 4; ++a)
          {
            rhs(a) += f[a] * values[i];
            for (unsigned int b = 0; b < 4; ++b)
              normal(a, b) += f[a] * f[b];
          }
        }
        normal.gauss_jordan();
        normal.vmult(x, rhs);
        return std::hypot(x(0), x(1));
      }
    } // namespace


    /*
     * All lengths follow the wave length: the joint stays, the frequency changes.
     * Periods: 3 until the wave is there, 3 while it grows, 3 to measure; what the
     * joint throws back returns to it from the left end after 6, from the right end
     * later.
     */
    void
    transmit(const JointWave &wave, Measurements &measurements)
    {
      constexpr double E = 1e9, density = 2500., k = 1e9;
      const double     c = std::sqrt(E / density), Z = density * c;
      const double     omega  = wave.frequency * 2. * k / Z;
      const double     period = 2. * dealii::numbers::PI / omega;
      const double     length = c * period;
      const double     left = 3.25 * length, right = 3.5 * length;
      const double     width = 0.8 * length / wave.cells;

      Geometry geometry;
      add_named_box(geometry, "", {0., 0.}, {left + right, width});
      geometry.add_polyline({{left, 0.}, {left, width}},
                            "joint",
                            CurveRole::joint);
      Bodies::Options options;
      options.cell_size    = length / wave.cells;
      options.communicator = wave.communicator;
      MovingBodies bars(std::move(geometry), options);
      bars.problem.materials = {material("rock", E, 0., density)};
      // strains so large that gaps are more than rounding of coordinates
      const double velocity            = 2e-3 * c;
      bars.problem.boundary_conditions = {condition(
        BoundaryCondition::Type::pressure, "left", constant(Z * velocity))};
      Loading loading;
      loading.amplitudes = [=](const double t) {
        const double   ramp = std::min(1., t / (3. * period));
        LoadAmplitudes amplitudes;
        amplitudes.boundary_conditions = {
          std::sin(omega * t) * 0.5 *
          (1. - std::cos(dealii::numbers::PI * ramp))};
        return amplitudes;
      };
      ContactParameters joint         = contact_parameters(k, 0.06 * length);
      coulomb(joint).is_bond          = true;
      coulomb(joint).tensile_strength = coulomb(joint).cohesion =
        1e3 * Z * velocity;
      bars.start(joint, Kinematics::small, loading);
      bars.integrate(TimeScheme::energy_momentum());

      const double        begin = left / c + 3.25 * period;
      const Point<2>      probe(left + 0.1 * length, 0.5 * width);
      std::vector<double> times, values;
      const Run run = bars.run(period / wave.steps, begin + 3. * period, [&]() {
        const DynamicState &state = bars.integrator->state();
        if (state.time >= begin)
        {
          times.push_back(state.time);
          values.push_back(bars.value_at(state.v, probe)[0] / velocity);
        }
        return true;
      });
      std::ostringstream name;
      name << "omega Z / 2k = " << wave.frequency << "; " << wave.cells
           << " cells and " << wave.steps << " steps a period";
      measurements.add(6,
                       name.str(),
                       "transmission [-]",
                       fit_amplitude(omega, times, values),
                       1. / std::sqrt(1. + wave.frequency * wave.frequency),
                       0.,
                       wave.bound,
                       run);
      measurements.add(6,
                       name.str(),
                       "worst balance [J/m]",
                       run.worst_balance,
                       0.,
                       bars.integrator->account().kinetic,
                       1e-6,
                       run);
    }
  } // namespace ContactBars
} // namespace NMM
