#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <support/block_bars/block_bars.h>
#include <support/coulomb.h>

namespace NMM
{
  namespace BlockBars
  {
    namespace
    {
      enum class Fate
      {
        stable,
        slides,
        topples
      };

      constexpr char letters[] = {'.', 's', 't'};


      /// Of a block on an incline; both over its tangent (Sagaseta, Int. J. Rock Mech.
      /// Min. Sci. 23 (1986) 261): a block that slides has friction only at
      /// its limit and topples only if it is more slender than that.
      Fate
      expected_fate(const double friction, const double width)
      {
        if (width < std::min(friction, 1.))
          return Fate::topples;
        return friction < 1. ? Fate::slides : Fate::stable;
      }


      Fate
      find_fate(const InclineMap &map,
                const double      friction,
                const double      width,
                Run              &run)
      {
        const double tangent = std::tan(degrees(map.angle));
        const double b       = width * tangent;
        Geometry     geometry;
        add_block(geometry, "block", {{0., 0.}, {b, 0.}, {b, 1.}, {0., 1.}});
        Bodies::Options options;
        options.cell_size           = 5.;
        options.mesh_of_every_block = true;
        options.obstacles = {obstacle("floor", {{99., 0.}, {-99., 0.}})};
        MovingBodies block(std::move(geometry), options);
        block.problem.materials = {material("rock", 1e9, 0.2, 2500.)};
        const double angle      = degrees(map.angle);
        block.problem.gravity =
          standard_gravity * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
        ContactParameters parameters = contact_parameters(1e10, 0.05);
        coulomb(parameters).friction = friction * tangent;
        block.start(parameters, Kinematics::finite);
        block.integrate(TimeScheme::generalized_alpha(0.));
        run += block.run(map.step, 1.);
        const Vector      &u      = block.integrator->state().u;
        const Tensor<1, 2> pivot  = block.value_at(u, {b, 0.});
        const Tensor<1, 2> corner = block.value_at(u, {0., 0.});
        const double       turn   = std::abs(corner[1] - pivot[1]) / b;
        // what moves by less has settled on its springs only
        constexpr double moves = 0.01;
        if (turn > moves)
          return Fate::topples;
        return pivot[0] > moves ? Fate::slides : Fate::stable;
      }
    } // namespace


    void
    map_incline(const InclineMap &map, Measurements &measurements)
    {
      const double       size = (map.highest - map.lowest) / map.n;
      Run                run;
      unsigned int       n_wrong = 0, n_cells = 0;
      std::ostringstream picture;
      for (unsigned int i = map.n; i > 0; --i)
      {
        for (unsigned int j = 0; j < map.n; ++j)
        {
          const double width    = map.lowest + (i - 0.5) * size;
          const double friction = map.lowest + (j + 0.5) * size;
          const Fate   expected = expected_fate(friction, width);
          // boundaries: friction 1, width 1 right of it, the diagonal left of it
          const bool is_near =
            (width > 1. && std::abs(friction - 1.) < map.margin) ||
            (friction > 1. && std::abs(width - 1.) < map.margin) ||
            (friction < 1. && std::abs(width - friction) < map.margin);
          if (is_near)
          {
            picture << ' ';
            continue;
          }
          ++n_cells;
          const Fate found = find_fate(map, friction, width, run);
          n_wrong += found != expected;
          picture << (found == expected
                        ? letters[static_cast<int>(found)]
                        : static_cast<char>(letters[static_cast<int>(found)] -
                                            'a' + 'A'));
        }
        picture << '/';
      }
      measurements.add(2,
                       "map of " + std::to_string(n_cells) +
                         " cells: " + picture.str(),
                       "cells that are wrong",
                       n_wrong,
                       0.,
                       1.,
                       0.5,
                       run);
    }
  } // namespace BlockBars
} // namespace NMM
