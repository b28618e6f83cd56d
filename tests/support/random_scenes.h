#ifndef nmm_tests_support_random_scenes_h
#define nmm_tests_support_random_scenes_h

#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/geometry.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace NMM
{
  namespace Testing
  {
    /// Seeded numbers; the seed belongs into a SCOPED_TRACE.
    class Random
    {
    public:
      explicit Random(const unsigned int seed)
        : engine(seed)
      {
      }

      double
      uniform(const double low, const double high)
      {
        return low + (high - low) * (engine() / 4294967296.);
      }

      unsigned int
      below(const unsigned int n)
      {
        return engine() % n;
      }

    private:
      std::mt19937 engine;
    };


    /// [0, width] x [0, height] as a boundary called "box".
    inline Geometry
    make_box(const double width, const double height)
    {
      Geometry geometry;
      geometry.add_polygon({dealii::Point<2>(0., 0.),
                            dealii::Point<2>(width, 0.),
                            dealii::Point<2>(width, height),
                            dealii::Point<2>(0., height)},
                           "box");
      return geometry;
    }


    /**
     * Random joints over the unit square. Every second network has coordinates
     * snapped to a coarse grid, so that coincidences abound: shared ends, joints
     * along the boundary, through mesh nodes, on top of each other.
     */
    inline void
    add_random_joints(Geometry          &geometry,
                      Random            &random,
                      const unsigned int n_joints,
                      const bool         snapped)
    {
      const auto point = [&]() {
        dealii::Point<2> x(random.uniform(-0.1, 1.1),
                           random.uniform(-0.1, 1.1));
        if (snapped)
          for (unsigned int d = 0; d < 2; ++d)
            x[d] = std::round(x[d] * 8.) / 8.;
        return x;
      };
      for (unsigned int j = 0; j < n_joints; ++j)
      {
        dealii::Point<2> a, b;
        bool             meets_box = false;
        do
        {
          a = point();
          b = point();
          // its middle inside: surely not wholly outside
          const dealii::Point<2> middle(0.5 * (a + b));
          meets_box = middle[0] > 0.01 && middle[0] < 0.99 &&
                      middle[1] > 0.01 && middle[1] < 0.99;
        } while (a == b || !meets_box);
        geometry.add_polyline({a, b},
                              "joint " + std::to_string(j),
                              CurveRole::joint);
      }
    }


    /// A mesh at a random place and angle, or aligned with round coordinates.
    inline RegularMeshParameters
    random_mesh(Random &random, const double cell_size, const bool aligned)
    {
      RegularMeshParameters parameters;
      parameters.cell_size = cell_size;
      if (aligned)
        parameters.pattern = MeshPattern::right_angled;
      else
      {
        parameters.offset[0] = random.uniform(0., cell_size);
        parameters.offset[1] = random.uniform(0., cell_size);
        parameters.rotation  = random.uniform(0., 60.);
      }
      return parameters;
    }


    /// A mesh that has nothing in common with round coordinates.
    inline RegularMeshParameters
    skew_mesh(const double cell_size)
    {
      RegularMeshParameters parameters;
      parameters.cell_size = cell_size;
      parameters.offset    = dealii::Tensor<1, 2>({0.0123, 0.0321});
      parameters.rotation  = 13.;
      return parameters;
    }
  } // namespace Testing
} // namespace NMM

#endif
