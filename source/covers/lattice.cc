#include "lattice.h"

#include <nmm/base/exceptions.h>
#include <nmm/covers/point_location.h>

#include <deal.II/base/numbers.h>

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
      const double angle     = parameters.rotation * numbers::PI / 180.;
      const bool equilateral = (parameters.pattern == MeshPattern::equilateral);

      // 0 and 90 degrees are meant exactly
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

      // the range of lattice coordinates of the box, with a margin so that
      // rounding cannot leave a point of the solid uncovered
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
      enum class CellState : unsigned char
      {
        unknown,
        near_curve,
        inside,
        outside
      };


      /**
     * Mark the parallelograms within one lattice step of a curve. Samples are
     * at most a quarter of a step apart (in lattice coordinates), so that every point of the
     * curve lies in the 3 x 3 neighbourhood of some sample's parallelogram.
     */
      void
      mark_near_curves(const PhysicalMesh     &physical_mesh,
                       const Lattice          &lattice,
                       const double            cell_size,
                       std::vector<CellState> &state)
      {
        for (const CurvePiece &piece : physical_mesh.pieces())
          for_each_sample(piece, 0.25 * cell_size, [&](const Point<2> &x) {
            const Tensor<1, 2> s = lattice.coordinates(x);
            const auto         i = static_cast<std::int64_t>(std::floor(s[0])),
                       j         = static_cast<std::int64_t>(std::floor(s[1]));
            for (std::int64_t dj = -1; dj <= 1; ++dj)
              for (std::int64_t di = -1; di <= 1; ++di)
                if (i + di >= 0 && i + di < lattice.n[0] && j + dj >= 0 &&
                    j + dj < lattice.n[1])
                  state[lattice.index(i + di, j + dj)] = CellState::near_curve;
          });
      }


      /// The unmarked parallelograms form connected sets no curve crosses: one
      /// point decides for each.
      void
      classify_rest(const PhysicalMesh     &physical_mesh,
                    const Lattice          &lattice,
                    std::vector<CellState> &state)
      {
        std::vector<std::array<std::int64_t, 2>> stack;
        for (std::int64_t j = 0; j < lattice.n[1]; ++j)
          for (std::int64_t i = 0; i < lattice.n[0]; ++i)
          {
            if (state[lattice.index(i, j)] != CellState::unknown)
              continue;
            const Point<2> center =
              lattice.node(i, j) + 0.5 * (lattice.a + lattice.b);
            const CellState result     = is_in_solid(physical_mesh, center)
                                           ? CellState::inside
                                           : CellState::outside;
            state[lattice.index(i, j)] = result;
            stack.push_back({{i, j}});
            while (!stack.empty())
            {
              const auto [k, l] = stack.back();
              stack.pop_back();
              const std::array<std::array<std::int64_t, 2>, 4> neighbors = {
                {{{k - 1, l}}, {{k + 1, l}}, {{k, l - 1}}, {{k, l + 1}}}};
              for (const auto &[p, q] : neighbors)
                if (p >= 0 && p < lattice.n[0] && q >= 0 && q < lattice.n[1] &&
                    state[lattice.index(p, q)] == CellState::unknown)
                {
                  state[lattice.index(p, q)] = result;
                  stack.push_back({{p, q}});
                }
            }
          }
      }
    } // namespace


    std::vector<LatticeNode>
    find_needed_parallelograms(const PhysicalMesh          &physical_mesh,
                               const Lattice               &lattice,
                               const RegularMeshParameters &parameters)
    {
      std::vector<CellState> state(lattice.n[0] * lattice.n[1],
                                   parameters.whole_box ? CellState::inside
                                                        : CellState::unknown);
      if (!parameters.whole_box)
      {
        mark_near_curves(physical_mesh, lattice, parameters.cell_size, state);
        classify_rest(physical_mesh, lattice, state);
      }
      std::vector<LatticeNode> needed;
      for (std::int64_t j = 0; j < lattice.n[1]; ++j)
        for (std::int64_t i = 0; i < lattice.n[0]; ++i)
          if (state[lattice.index(i, j)] != CellState::outside)
            needed.push_back({{i, j}});
      return needed;
    }
  } // namespace internal
} // namespace NMM
