#ifndef nmm_tests_contact_random_polygons_h
#define nmm_tests_contact_random_polygons_h

#include <contact/contact_model.h>
#include <random>

namespace NMM
{
  namespace Test
  {
    /// Displacements of the surface: a motion of each block, rigid unless stretch is not 1.
    struct Motion
    {
      Point<2>     center;
      double       angle = 0., stretch = 1.;
      Tensor<1, 2> shift;

      Tensor<1, 2>
      operator()(const Point<2> &X) const
      {
        const Tensor<1, 2> d = X - center;
        const double       c = stretch * std::cos(angle),
                     s       = stretch * std::sin(angle);
        return Tensor<1, 2>({c * d[0] - s * d[1], s * d[0] + c * d[1]}) - d +
               shift;
      }
    };


    inline std::vector<Tensor<1, 2>>
    move(Bodies &bodies, const std::vector<Motion> &motions)
    {
      std::vector<Tensor<1, 2>> nodal(bodies.covers.n_covers());
      for (unsigned int e = 0; e < bodies.mesh.n_elements(); ++e)
        for (const unsigned int cover : bodies.covers.covers(e))
          nodal[cover] =
            motions[bodies.mesh.block(e)](bodies.covers.node(cover));
      return nodal;
    }


    /// A star (or a convex polygon) about a centre.
    inline std::vector<Point<2>>
    random_polygon(std::mt19937 &generator, const Point<2> &center)
    {
      std::uniform_real_distribution<double> random(0., 1.);
      const unsigned int                     n         = 4 + generator() % 5;
      const bool                             is_convex = generator() % 2 == 0;
      const double phase = 2. * dealii::numbers::PI * random(generator);
      std::vector<Point<2>> corners;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double angle =
          phase + 2. * dealii::numbers::PI * (i + 0.3 * random(generator)) / n;
        const double radius = is_convex ? 0.4 : 0.2 + 0.2 * random(generator);
        corners.push_back(
          center + radius * Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
      }
      return corners;
    }


    /// Nine polygons next to each other.
    inline Bodies
    random_bodies(std::mt19937      &generator,
                  const unsigned int seed,
                  const double       cell_size = 0.25)
    {
      Geometry geometry;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          geometry.add_polygon(random_polygon(generator,
                                              Point<2>(0.81 * i, 0.81 * j)),
                               "body" + std::to_string(3 * i + j));
      Bodies::Options options;
      options.degree    = 1 + seed % 2;
      options.cell_size = cell_size;
      options.rotation  = 11. * seed;
      return Bodies(std::move(geometry), options);
    }


    /// Each body moves by up to 0.1 m; some turn about a corner of theirs.
    inline std::vector<Motion>
    random_motions(const Bodies &bodies, std::mt19937 &generator)
    {
      std::uniform_real_distribution<double> random(-1., 1.);
      std::vector<Motion> motions(bodies.physical_mesh.n_blocks());
      for (Motion &motion : motions)
      {
        const double x = 0.1 * random(generator), y = 0.1 * random(generator);
        motion.shift = Tensor<1, 2>({x, y});
      }
      for (const auto &edge : bodies.surface.edges())
        if (generator() % 3 == 0)
        {
          motions[edge.body].center = edge.start;
          motions[edge.body].angle  = 0.5 * random(generator);
        }
      return motions;
    }
  } // namespace Test
} // namespace NMM

#endif
