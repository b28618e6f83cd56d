#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <support/block_bars/block_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace BlockBars
  {
    namespace
    {
      constexpr unsigned int n_columns = 16, crest = 10;
      constexpr double       width = 10., step_height = 1., base_angle = 30.,
                       unit_weight = 25e3;
      // tops of neighbours differ by this below and above the crest [m]
      constexpr double below = 5., above = 5.2;


      double
      height(const unsigned int column)
      {
        return column <= crest
                 ? 4. * column
                 : 4. * crest - (above + step_height) * (column - crest);
      }


      /// Base planes along x, which points up the slope; the body on the left.
      std::vector<Point<2>>
      base()
      {
        std::vector<Point<2>> points;
        for (unsigned int i = n_columns; i > 0; --i)
        {
          points.emplace_back(i * width, (i - 1.) * step_height);
          points.emplace_back((i - 1.) * width, (i - 1.) * step_height);
        }
        points.emplace_back(-10. * width, 0.);
        // the step below the first column has no height
        points.erase(points.end() - 2);
        return points;
      }


      std::unique_ptr<MovingBodies>
      make_columns(const Toppling &toppling)
      {
        Geometry geometry;
        for (unsigned int i = 1; i <= n_columns; ++i)
        {
          const double x = (i - 1.) * width, y = (i - 1.) * step_height;
          add_block(geometry,
                    "column " + std::to_string(i),
                    {{x, y},
                     {x + width, y},
                     {x + width, y + height(i)},
                     {x, y + height(i)}});
        }
        Bodies::Options options;
        options.cell_size           = 100.;
        options.mesh_of_every_block = true;
        options.obstacles           = {obstacle("base", base())};
        auto columns =
          std::make_unique<MovingBodies>(std::move(geometry), options);
        columns->problem.materials = {material("rock",
                                               toppling.youngs_modulus,
                                               0.2,
                                               unit_weight / standard_gravity)};
        const double angle         = degrees(base_angle);
        columns->problem.gravity =
          standard_gravity * Tensor<1, 2>({-std::sin(angle), -std::cos(angle)});
        return columns;
      }


      /// Which columns move on from displacements before: 1 topples, 2 slides, 0 stands.
      /// Before that they have settled, and rocked.
      std::array<unsigned int, 16>
      modes_of(MovingBodies &columns, const Vector &before)
      {
        std::array<unsigned int, 16> modes;
        Vector                       u(columns.integrator->state().u);
        u -= before;
        const double largest = u.linfty_norm();
        for (unsigned int i = 1; i <= n_columns; ++i)
        {
          // corners belong to neighbours, too
          const double x = (i - 0.5) * width, y = (i - 1.) * step_height;
          const double at_base = columns.value_at(u, {x, y})[0];
          const double at_top  = columns.value_at(u, {x, y + height(i)})[0];
          // parts of the largest motion
          constexpr double stands = 0.02;
          const double     turns  = std::abs(at_top - at_base);
          modes[i - 1] =
            turns < stands * largest && std::abs(at_base) < stands * largest ? 0
            : turns > std::abs(at_base)                                      ? 1
                                        : 2;
        }
        return modes;
      }


      std::string
      to_text(const std::array<unsigned int, 16> &modes)
      {
        std::string text;
        for (const unsigned int mode : modes)
          text += mode == 0 ? '-' : mode == 1 ? 't' : 's';
        return text;
      }

      /// What a column needs from the one below it [N/m] lest it topples, and lest it slides,
      /// under @p force from the one above.
      struct Needs
      {
        double topples, slides;
      };

      Needs
      needs_of(const unsigned int column,
               const double       friction,
               const double       force)
      {
        const double angle = degrees(base_angle);
        const double s = std::sin(angle), c = std::cos(angle);
        const double y = height(column), weight = unit_weight * width * y;
        // where the neighbours above and below touch, over the base
        const double upper = column < crest ? y : y - above;
        const double lower = column == 1 || column > crest ? y : y - below;
        return {(force * (upper - friction * width) +
                 0.5 * weight * (y * s - width * c)) /
                  lower,
                force -
                  weight * (friction * c - s) / (1. - friction * friction)};
      }
    } // namespace


    double
    toe_force(const double friction, std::array<unsigned int, 16> &modes)
    {
      double force = 0.;
      for (unsigned int i = n_columns; i > 0; --i)
      {
        const auto [topples, slides] = needs_of(i, friction, force);
        modes[i - 1]                 = std::max(topples, slides) <= 0. ? 0
                                       : topples > slides              ? 1
                                                                       : 2;
        force                        = std::max({0., topples, slides});
      }
      return force;
    }


    bool
    can_move(const double friction, const std::array<unsigned int, 16> &modes)
    {
      double force = 0.;
      for (unsigned int i = n_columns; i > 0; --i)
      {
        const auto [topples, slides] = needs_of(i, friction, force);
        const double need = modes[i - 1] == 0   ? std::max(topples, slides)
                            : modes[i - 1] == 1 ? topples
                                                : slides;
        if ((need > 0.) != (modes[i - 1] != 0))
          return false;
        force = std::max(0., need);
      }
      return true;
    }


    double
    limit_friction_of_columns()
    {
      std::array<unsigned int, 16> modes;
      double                       moves = 0.6, stands = 0.95;
      for (unsigned int i = 0; i < 60; ++i)
      {
        const double friction = 0.5 * (moves + stands);
        (toe_force(friction, modes) > 0. ? moves : stands) = friction;
      }
      return stands;
    }


    void
    topple_columns(const Toppling &toppling, Measurements &measurements)
    {
      const auto        columns = make_columns(toppling);
      ContactParameters parameters =
        contact_parameters(toppling.stiffness * toppling.youngs_modulus / width,
                           0.02 * width);
      coulomb(parameters).friction = 1.;
      RelaxationParameters relaxation;
      relaxation.step             = toppling.step;
      relaxation.tolerance        = 1e-6;
      relaxation.max_displacement = 0.01 * width;
      SafetyFactorParameters search;
      search.ratio     = 1.2;
      search.tolerance = toppling.tolerance;

      Run                          run;
      dealii::Timer                timer;
      std::array<unsigned int, 16> modes{};
      const auto                   try_factor = [&](const double trial_factor) {
        columns->start(reduce_strength(parameters, trial_factor),
                       Kinematics::small);
        columns->integrate(TimeScheme::constant_acceleration());
        Vector              before = columns->zero();
        const StrengthTrial trial =
          try_to_stand(*columns->integrator,
                       relaxation,
                       trial_factor,
                       [&](const StepRecord &) {
                         const Vector &u = columns->integrator->state().u;
                         if (u.linfty_norm() <
                             0.5 * relaxation.max_displacement)
                           before = u;
                       });
        run.n_steps += trial.n_steps;
        if (!trial.stands())
          modes = modes_of(*columns, before);
        return trial;
      };
      const SafetyFactor factor = find_safety_factor(try_factor, search);
      // a little beyond the limit, and after a longer way, where no column hesitates
      constexpr double beyond     = 1.02;
      relaxation.max_displacement = 0.1 * width;
      relaxation.max_steps        = 10000;
      (void)try_factor(beyond * factor.moves_at);
      run.seconds = timer.wall_time();

      std::array<unsigned int, 16> expected;
      const double                 limit = limit_friction_of_columns();
      (void)toe_force((1. - 1e-9) * limit, expected);
      measurements.add(1,
                       "Goodman-Bray columns",
                       "limit friction [-]",
                       1. / factor.value(),
                       limit,
                       0.,
                       toppling.bound,
                       run);
      measurements.add(1,
                       "Goodman-Bray columns: " + to_text(modes) + " against " +
                         to_text(expected),
                       "is a possible mechanism (1) or not (0)",
                       can_move((1. - toppling.bound) * limit, modes),
                       1.,
                       1.,
                       0.5,
                       run);
    }
  } // namespace BlockBars
} // namespace NMM
