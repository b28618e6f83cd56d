#include "lattice.h"

#include <nmm/base/exceptions.h>
#include <nmm/covers/point_location.h>

#include <deal.II/base/numbers.h>

#include "physical_edges.h"
#include <algorithm>
#include <cmath>
#include <limits>

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
      /// For each row of the lattice, the parallelograms within one lattice step of a curve, ascending.
      /// Samples are at most a quarter of a step apart (in lattice coordinates), so that every
      /// point of the curve lies in the 3 x 3 neighbourhood of some sample's parallelogram.
      std::vector<std::vector<std::int64_t>>
      find_near_curves(const PhysicalMesh &physical_mesh,
                       const Lattice      &lattice,
                       const double        cell_size)
      {
        std::vector<std::vector<std::int64_t>> rows(lattice.n[1]);
        for (const ElementEdge &edge : internal::solid_edges(physical_mesh))
        {
          LatticeNode last = {{std::numeric_limits<std::int64_t>::max(), 0}};
          for_each_sample(edge, 0.25 * cell_size, [&](const Point<2> &x) {
            const Tensor<1, 2> s = lattice.coordinates(x);
            const LatticeNode  node{
              {static_cast<std::int64_t>(std::floor(s[0])),
                static_cast<std::int64_t>(std::floor(s[1]))}};
            if (node == last)
              return;
            last             = node;
            const auto first = [&](const unsigned int d) {
              return std::max<std::int64_t>(node[d] - 1, 0);
            };
            const auto end = [&](const unsigned int d) {
              return std::min(node[d] + 2, lattice.n[d]);
            };
            for (std::int64_t j = first(1); j < end(1); ++j)
              for (std::int64_t i = first(0); i < end(0); ++i)
                rows[j].push_back(i);
          });
        }
        for (auto &row : rows)
        {
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
        }
        return rows;
      }


      /// Neighbouring parallelograms of a row that no curve is near, first and past-the-end.
      struct Gap
      {
        std::int64_t begin, end;
        bool         is_inside;
      };
    } // namespace


    std::vector<LatticeNode>
    find_needed_parallelograms(const PhysicalMesh          &physical_mesh,
                               const Lattice               &lattice,
                               const RegularMeshParameters &parameters)
    {
      std::vector<LatticeNode> needed;
      const auto               add = [&](const std::int64_t begin,
                           const std::int64_t end,
                           const std::int64_t row) {
        for (std::int64_t i = begin; i < end; ++i)
          needed.push_back({{i, row}});
      };
      if (parameters.whole_box)
      {
        for (std::int64_t j = 0; j < lattice.n[1]; ++j)
          add(0, lattice.n[0], j);
        return needed;
      }
      const auto near_curves =
        find_near_curves(physical_mesh, lattice, parameters.cell_size);
      std::vector<Gap> gaps, gaps_of_last_row;
      for (std::int64_t j = 0; j < lattice.n[1]; ++j)
      {
        // No curve lies between parallelograms of gaps that have a common side, so that one
        // point decides for all of them.
        const auto is_inside = [&](const std::int64_t begin,
                                   const std::int64_t end) {
          const auto below = std::partition_point(gaps_of_last_row.begin(),
                                                  gaps_of_last_row.end(),
                                                  [&](const Gap &gap) {
                                                    return gap.end <= begin;
                                                  });
          if (below != gaps_of_last_row.end() && below->begin < end)
            return below->is_inside;
          return is_in_solid(physical_mesh,
                             lattice.node(begin, j) +
                               0.5 * (lattice.a + lattice.b));
        };
        std::int64_t begin   = 0;
        const auto   add_gap = [&](const std::int64_t end) {
          if (begin == end)
            return;
          gaps.push_back({begin, end, is_inside(begin, end)});
          if (gaps.back().is_inside)
            add(begin, end, j);
        };
        gaps.clear();
        for (const std::int64_t i : near_curves[j])
        {
          add_gap(i);
          add(i, i + 1, j);
          begin = i + 1;
        }
        add_gap(lattice.n[0]);
        std::swap(gaps, gaps_of_last_row);
      }
      return needed;
    }
  } // namespace internal
} // namespace NMM
