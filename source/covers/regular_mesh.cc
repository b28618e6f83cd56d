#include <nmm/base/exceptions.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/covers/point_location.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    /**
     * The lattice of a regular mesh: node (i, j) lies at
     * origin + i a + j b, 0 <= i <= n[0], 0 <= j <= n[1]; its parallelograms
     * are halved along the diagonal from (i+1, j) to (i, j+1).
     */
    struct Lattice
    {
      Point<2>                    origin;
      Tensor<1, 2>                a, b;
      std::array<std::int64_t, 2> n;
      // rows of the inverse of (a b)
      Tensor<2, 2> to_lattice;

      Point<2>
      node(const std::int64_t i, const std::int64_t j) const
      {
        return origin + static_cast<double>(i) * a + static_cast<double>(j) * b;
      }

      /// Lattice coordinates of x [-].
      Tensor<1, 2>
      coordinates(const Point<2> &x) const
      {
        return to_lattice * (x - origin);
      }

      std::size_t
      index(const std::int64_t i, const std::int64_t j) const
      {
        return static_cast<std::size_t>(j * n[0] + i);
      }
    };


    Lattice
    make_lattice(const BoundingBox<2>        &box,
                 const RegularMeshParameters &parameters)
    {
      const double h         = parameters.cell_size;
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
      for (unsigned int d = 0; d < 2; ++d)
      {
        first[d]         = std::floor(low[d]);
        const double num = std::ceil(high[d]) - first[d];
        AssertThrow(num < 1e5,
                    InputError("a cell size of " + std::to_string(h) +
                                 " m gives a mesh of more than 100000 cells "
                                 "along one direction",
                               "Mathematical mesh/Cell size",
                               "choose a larger one"));
        lattice.n[d] = static_cast<std::int64_t>(num);
      }
      lattice.origin = node + first[0] * lattice.a + first[1] * lattice.b;
      return lattice;
    }


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


  MathematicalMesh
  make_regular_mesh(const PhysicalMesh          &physical_mesh,
                    const RegularMeshParameters &parameters,
                    const unsigned int           degree)
  {
    AssertThrow(std::isfinite(parameters.cell_size) &&
                  parameters.cell_size > 0.,
                InputError("the cell size " +
                             std::to_string(parameters.cell_size) +
                             " m is not positive",
                           "Mathematical mesh/Cell size",
                           "give the edge length of a triangle"));

    const Lattice lattice =
      make_lattice(physical_mesh.bounding_box(), parameters);

    std::vector<CellState> state(lattice.n[0] * lattice.n[1],
                                 parameters.whole_box ? CellState::inside
                                                      : CellState::unknown);
    if (!parameters.whole_box)
    {
      mark_near_curves(physical_mesh, lattice, parameters.cell_size, state);
      classify_rest(physical_mesh, lattice, state);
    }

    std::vector<unsigned int> node_to_vertex((lattice.n[0] + 1) *
                                               (lattice.n[1] + 1),
                                             invalid_index);
    std::vector<Point<2>>     vertices;
    std::vector<CellData<2>>  cells;
    const auto vertex = [&](const std::int64_t i, const std::int64_t j) {
      unsigned int &v = node_to_vertex[j * (lattice.n[0] + 1) + i];
      if (v == invalid_index)
      {
        v = vertices.size();
        vertices.push_back(lattice.node(i, j));
      }
      return v;
    };
    const auto add_cell =
      [&](const unsigned int v0, const unsigned int v1, const unsigned int v2) {
        CellData<2> cell(3);
        cell.vertices = {v0, v1, v2};
        cells.push_back(std::move(cell));
      };
    for (std::int64_t j = 0; j < lattice.n[1]; ++j)
      for (std::int64_t i = 0; i < lattice.n[0]; ++i)
        if (state[lattice.index(i, j)] != CellState::outside)
        {
          const unsigned int v00 = vertex(i, j), v10 = vertex(i + 1, j),
                             v01 = vertex(i, j + 1), v11 = vertex(i + 1, j + 1);
          add_cell(v00, v10, v01);
          add_cell(v10, v11, v01);
        }

    auto triangulation = std::make_unique<Triangulation<2>>();
    triangulation->create_triangulation(vertices, cells, SubCellData());
    return MathematicalMesh(std::move(triangulation), degree);
  }
} // namespace NMM
