#include "lattice.h"

#include <nmm/base/exceptions.h>
#include <nmm/covers/point_location.h>

#include <deal.II/base/numbers.h>

#include "physical_edges.h"
#include <cmath>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    Lattice
    make_lattice(const BoundingBox<2>        &box,
                 const RegularMeshParameters &parameters)
    {
      const double h = parameters.cell_size;
      AssertThrow(std::isfinite(h) && h > 0.,
                  InputError("the cell size " + std::to_string(h) +
                               " m is not positive",
                             "Mathematical mesh/Cell size",
                             "give the edge length of a triangle"));
      // Longer offsets are refused, because nodes would be rounded and the mesh repeats itself with
      // the cell size anyway.
      constexpr double most_cells = 1e6;
      AssertThrow(parameters.offset.norm() <= most_cells * h,
                  InputError("the offset (" +
                               std::to_string(parameters.offset[0]) + ", " +
                               std::to_string(parameters.offset[1]) +
                               ") m is longer than a million cells of " +
                               std::to_string(h) + " m",
                             "Mathematical mesh/Offset",
                             "choose one within a cell: the mesh repeats "
                             "itself with the cell size"));
      const double angle     = parameters.rotation * numbers::PI / 180.;
      const bool equilateral = (parameters.pattern == MeshPattern::equilateral);

      // Rotations of 0 and 90 degrees are exact.
      const bool   turned = (parameters.rotation != 0.);
      const double c      = turned ? std::cos(angle) : 1.,
                   s      = turned ? std::sin(angle) : 0.;
      const Tensor<1, 2> e1({c, s}), e2({-s, c});

      Lattice lattice;
      lattice.a = h * e1;
      lattice.b =
        equilateral ? 0.5 * h * e1 + 0.5 * std::sqrt(3.) * h * e2 : h * e2;
      Tensor<2, 2> basis;
      for (unsigned int d = 0; d < 2; ++d)
      {
        basis[d][0] = lattice.a[d];
        basis[d][1] = lattice.b[d];
      }
      lattice.to_lattice = invert(basis);

      // Range of lattice coordinates of the box, with a margin so that rounding cannot leave a
      // point of the solid uncovered.
      const Point<2> node   = box.center() + parameters.offset;
      const double   margin = 1e-3;
      Tensor<1, 2>   low({1e300, 1e300}), high({-1e300, -1e300});
      for (unsigned int v = 0; v < 4; ++v)
      {
        const Tensor<1, 2> x = lattice.to_lattice * (box.vertex(v) - node);
        for (unsigned int d = 0; d < 2; ++d)
        {
          low[d]  = std::min(low[d], x[d] - margin);
          high[d] = std::max(high[d], x[d] + margin);
        }
      }
      std::array<double, 2> first;
      double                n_total = 1.;
      for (unsigned int d = 0; d < 2; ++d)
      {
        first[d]         = std::floor(low[d]);
        const double num = std::ceil(high[d]) - first[d];
        n_total *= num;
        AssertThrow(n_total < 1e9,
                    InputError("a cell size of " + std::to_string(h) +
                                 " m gives more than 1e9 cells",
                               "Mathematical mesh/Cell size",
                               "choose a larger one"));
        lattice.n[d] = static_cast<std::int64_t>(num);
      }
      lattice.origin = node + first[0] * lattice.a + first[1] * lattice.b;
      return lattice;
    }


    namespace
    {
      enum class ParallelogramState : unsigned char
      {
        unknown,
        near_curve,
        inside,
        outside
      };


      /// States of the parallelograms of a box.
      class ParallelogramStates
      {
      public:
        ParallelogramStates(const LatticeBox        &box,
                            const ParallelogramState initial)
          : box(box)
          , states((box.upper[0] - box.lower[0]) *
                     (box.upper[1] - box.lower[1]),
                   initial)
        {
        }

        ParallelogramState &
        operator()(const std::int64_t i, const std::int64_t j)
        {
          return states[(j - box.lower[1]) * (box.upper[0] - box.lower[0]) +
                        (i - box.lower[0])];
        }

        const LatticeBox box;

      private:
        std::vector<ParallelogramState> states;
      };


      /**
       * Mark the parallelograms within one lattice step of a curve. Samples are at most a quarter
       * of a step apart (in lattice coordinates), so that every point of the curve lies in the 3 x
       * 3 neighbourhood of some sample's parallelogram.
       */
      void
      mark_near_curves(const PhysicalMesh  &physical_mesh,
                       const Lattice       &lattice,
                       const double         cell_size,
                       ParallelogramStates &state)
      {
        for (const ElementEdge &edge : internal::solid_edges(physical_mesh))
          for_each_sample(edge, 0.25 * cell_size, [&](const Point<2> &x) {
            const Tensor<1, 2> s = lattice.coordinates(x);
            const auto         i = static_cast<std::int64_t>(std::floor(s[0])),
                       j         = static_cast<std::int64_t>(std::floor(s[1]));
            for (std::int64_t dj = -1; dj <= 1; ++dj)
              for (std::int64_t di = -1; di <= 1; ++di)
                if (state.box.contains({{i + di, j + dj}}))
                  state(i + di, j + dj) = ParallelogramState::near_curve;
          });
      }


      /// Determine the unmarked parallelograms. They form connected sets that no curve crosses, so
      /// that one point decides for each set.
      void
      classify_rest(const PhysicalMesh  &physical_mesh,
                    const Lattice       &lattice,
                    ParallelogramStates &state)
      {
        std::vector<LatticeNode> stack;
        for (std::int64_t j = state.box.lower[1]; j < state.box.upper[1]; ++j)
          for (std::int64_t i = state.box.lower[0]; i < state.box.upper[0]; ++i)
          {
            if (state(i, j) != ParallelogramState::unknown)
              continue;
            const Point<2> center =
              lattice.node(i, j) + 0.5 * (lattice.a + lattice.b);
            const ParallelogramState result = is_in_solid(physical_mesh, center)
                                                ? ParallelogramState::inside
                                                : ParallelogramState::outside;
            state(i, j)                     = result;
            stack.push_back({{i, j}});
            while (!stack.empty())
            {
              const auto [k, l] = stack.back();
              stack.pop_back();
              for (const LatticeNode &next : {LatticeNode{{k - 1, l}},
                                              LatticeNode{{k + 1, l}},
                                              LatticeNode{{k, l - 1}},
                                              LatticeNode{{k, l + 1}}})
                if (state.box.contains(next) &&
                    state(next[0], next[1]) == ParallelogramState::unknown)
                {
                  state(next[0], next[1]) = result;
                  stack.push_back(next);
                }
            }
          }
      }
    } // namespace


    std::vector<LatticeNode>
    find_needed_parallelograms(const PhysicalMesh          &physical_mesh,
                               const Lattice               &lattice,
                               const RegularMeshParameters &parameters,
                               const LatticeBox            &box)
    {
      ParallelogramStates state(box,
                                parameters.whole_box
                                  ? ParallelogramState::inside
                                  : ParallelogramState::unknown);
      if (!parameters.whole_box)
      {
        mark_near_curves(physical_mesh, lattice, parameters.cell_size, state);
        classify_rest(physical_mesh, lattice, state);
      }
      std::vector<LatticeNode> needed;
      for (std::int64_t j = box.lower[1]; j < box.upper[1]; ++j)
        for (std::int64_t i = box.lower[0]; i < box.upper[0]; ++i)
          if (state(i, j) != ParallelogramState::outside)
            needed.push_back({{i, j}});
      return needed;
    }


    std::vector<LatticeNode>
    find_needed_parallelograms(const PhysicalMesh          &physical_mesh,
                               const Lattice               &lattice,
                               const RegularMeshParameters &parameters)
    {
      return find_needed_parallelograms(physical_mesh,
                                        lattice,
                                        parameters,
                                        {{{0, 0}}, lattice.n});
    }
  } // namespace internal
} // namespace NMM
