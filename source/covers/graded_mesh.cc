#include <nmm/base/exceptions.h>
#include <nmm/base/memory.h>
#include <nmm/covers/crack_tip.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/point_location.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/grid/tria_description.h>

#include "cutting.h"
#include "lattice.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <unordered_map>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    using internal::LatticeNode;

    /**
     * Red-green refinement of lattice triangles. Nodes have integer coordinates on the lattice that
     * is refined 2^n_levels times, so that midpoints are exact and are found by number.
     */
    class RedGreenRefinement
    {
    public:
      RedGreenRefinement(const internal::Lattice        &lattice,
                         const std::vector<LatticeNode> &parallelograms,
                         unsigned int                    n_levels);

      /// @throws InputError if there is not enough memory for so many triangles.
      void
      check_memory(std::size_t n_triangles) const;

      /// Halve the edges of triangles until no edge is longer than the size field at the triangle's
      /// centre.
      void
      refine(const SizeField &size, double cell_size);

      /// Refine until the levels of neighbours differ by at most one, and at most one edge of a
      /// triangle has a node in its middle.
      void
      balance();

      /// All triangles; those with a node in the middle of an edge are halved.
      std::vector<std::array<unsigned int, 3>>
      close() const;

      std::vector<Point<2>> vertices;

    private:
      struct Triangle
      {
        std::array<unsigned int, 3> corners;
        unsigned int                level;
      };

      /// Vertex at a node; it is made if it does not exist.
      unsigned int
      vertex(const LatticeNode &node);

      /// Node in the middle between two vertices.
      LatticeNode
      middle(unsigned int v, unsigned int w) const;

      /// Vertex in the middle between two others, if there is one.
      unsigned int
      find_middle(unsigned int v, unsigned int w) const;

      struct HashOfNode
      {
        std::size_t
        operator()(const LatticeNode &node) const
        {
          // The multiplication mixes the digits of one coordinate (Knuth, The Art of Computer
          // Programming, volume 3, section 6.4).
          return static_cast<std::uint64_t>(node[0]) * 0x9E3779B97F4A7C15u ^
                 static_cast<std::uint64_t>(node[1]);
        }
      };

      void
      split(const Triangle &triangle, std::vector<Triangle> &children);

      bool
      needs_balancing(const Triangle &triangle) const;

      /// Split triangles, and their children, as long as @p condition holds.
      template <typename Condition>
      bool
      split_while(const Condition &condition);

      AvailableMemory          available = available_memory(1u);
      const internal::Lattice *lattice;
      std::int64_t             scale;
      std::vector<Triangle>    triangles;
      std::vector<LatticeNode> vertex_to_node;
      std::unordered_map<LatticeNode, unsigned int, HashOfNode> node_to_vertex;
    };


    RedGreenRefinement::RedGreenRefinement(
      const internal::Lattice        &lattice,
      const std::vector<LatticeNode> &parallelograms,
      const unsigned int              n_levels)
      : lattice(&lattice)
      , scale(std::int64_t(1) << n_levels)
    {
      node_to_vertex.reserve(4 * parallelograms.size());
      const auto at = [&](const std::int64_t i, const std::int64_t j) {
        return vertex({{scale * i, scale * j}});
      };
      for (const auto &[i, j] : parallelograms)
      {
        const unsigned int v00 = at(i, j), v10 = at(i + 1, j),
                           v01 = at(i, j + 1), v11 = at(i + 1, j + 1);
        triangles.push_back({{{v00, v10, v01}}, 0});
        triangles.push_back({{{v10, v11, v01}}, 0});
      }
    }


    unsigned int
    RedGreenRefinement::vertex(const LatticeNode &node)
    {
      const auto [position, is_new] =
        node_to_vertex.emplace(node, vertices.size());
      if (is_new)
      {
        vertex_to_node.push_back(node);
        // A coarse node has the same coordinates as without refinement.
        vertices.push_back(lattice->origin +
                           (static_cast<double>(node[0]) / scale) * lattice->a +
                           (static_cast<double>(node[1]) / scale) * lattice->b);
      }
      return position->second;
    }


    LatticeNode
    RedGreenRefinement::middle(const unsigned int v, const unsigned int w) const
    {
      const LatticeNode &a = vertex_to_node[v], &b = vertex_to_node[w];
      return {{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}};
    }


    unsigned int
    RedGreenRefinement::find_middle(const unsigned int v,
                                    const unsigned int w) const
    {
      const LatticeNode &a = vertex_to_node[v], &b = vertex_to_node[w];
      if ((a[0] + b[0]) % 2 != 0 || (a[1] + b[1]) % 2 != 0)
        return invalid_index;
      const auto found = node_to_vertex.find(middle(v, w));
      return found == node_to_vertex.end() ? invalid_index : found->second;
    }


    void
    RedGreenRefinement::split(const Triangle        &triangle,
                              std::vector<Triangle> &children)
    {
      const auto        &v     = triangle.corners;
      const unsigned int m01   = vertex(middle(v[0], v[1])),
                         m12   = vertex(middle(v[1], v[2])),
                         m20   = vertex(middle(v[2], v[0]));
      const unsigned int level = triangle.level + 1;
      children.push_back({{{v[0], m01, m20}}, level});
      children.push_back({{{m01, v[1], m12}}, level});
      children.push_back({{{m20, m12, v[2]}}, level});
      children.push_back({{{m01, m12, m20}}, level});
    }


    void
    RedGreenRefinement::check_memory(const std::size_t n_triangles) const
    {
      require_memory(internal::least_memory_per_cell * n_triangles,
                     available,
                     "more than " + std::to_string(n_triangles) + " cells",
                     "the local sizes of the mathematical mesh",
                     [](double) {
                       return "choose larger sizes, or let them grow faster";
                     });
    }


    template <typename Condition>
    bool
    RedGreenRefinement::split_while(const Condition &condition)
    {
      constexpr std::size_t check_every = 1 << 20;
      bool                  changed     = false;
      std::size_t           next_check  = check_every;
      std::vector<Triangle> result, stack;
      result.reserve(triangles.size());
      for (const Triangle &triangle : triangles)
      {
        if (result.size() > next_check)
        {
          check_memory(result.size());
          next_check = result.size() + check_every;
        }
        stack.assign(1, triangle);
        while (!stack.empty())
        {
          const Triangle t = stack.back();
          stack.pop_back();
          if (condition(t))
          {
            split(t, stack);
            changed = true;
          }
          else
            result.push_back(t);
        }
      }
      triangles.swap(result);
      return changed;
    }


    void
    RedGreenRefinement::refine(const SizeField &size, const double cell_size)
    {
      split_while([&](const Triangle &t) {
        const Point<2> center((vertices[t.corners[0]] + vertices[t.corners[1]] +
                               vertices[t.corners[2]]) /
                              3.);
        const auto divisor = static_cast<double>(std::int64_t(1) << t.level);
        // An edge that is halved exactly to the wanted length must not count as too long by
        // rounding.
        return (std::int64_t(1) << t.level) < scale &&
               cell_size / divisor > (1. + 1e-10) * size(center);
      });
    }


    bool
    RedGreenRefinement::needs_balancing(const Triangle &triangle) const
    {
      unsigned int n_halved = 0;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int v = triangle.corners[i],
                           w = triangle.corners[(i + 1) % 3];
        const unsigned int m = find_middle(v, w);
        if (m == invalid_index)
          continue;
        ++n_halved;
        if (find_middle(v, m) != invalid_index ||
            find_middle(m, w) != invalid_index)
          return true;
      }
      return n_halved > 1;
    }


    void
    RedGreenRefinement::balance()
    {
      while (split_while([&](const Triangle &t) { return needs_balancing(t); }))
      {
      }
    }


    std::vector<std::array<unsigned int, 3>>
    RedGreenRefinement::close() const
    {
      std::vector<std::array<unsigned int, 3>> result;
      result.reserve(triangles.size());
      for (const Triangle &t : triangles)
      {
        bool is_halved = false;
        for (unsigned int i = 0; i < 3 && !is_halved; ++i)
        {
          const unsigned int v = t.corners[i], w = t.corners[(i + 1) % 3],
                             opposite = t.corners[(i + 2) % 3];
          const unsigned int m        = find_middle(v, w);
          if (m == invalid_index)
            continue;
          result.push_back({{v, m, opposite}});
          result.push_back({{m, w, opposite}});
          is_halved = true;
        }
        if (!is_halved)
          result.push_back(t.corners);
      }
      return result;
    }


    /// Triangles that can touch the solid, with the vertices they use.
    std::unique_ptr<Triangulation<2>>
    make_triangulation(
      const std::vector<Point<2>>                    &vertices,
      const std::vector<std::array<unsigned int, 3>> &triangles,
      const PhysicalMesh                             &physical_mesh,
      const bool                                      all)
    {
      std::vector<unsigned char> near;
      if (!all)
        near = internal::find_triangles_near_curves(vertices,
                                                    triangles,
                                                    physical_mesh);
      std::vector<unsigned int> new_vertex(vertices.size(), invalid_index);
      std::vector<Point<2>>     used;
      std::vector<CellData<2>>  cells;
      for (std::size_t c = 0; c < triangles.size(); ++c)
      {
        const auto &v = triangles[c];
        if (!all && !near[c] &&
            !is_in_solid(physical_mesh,
                         Point<2>(
                           (vertices[v[0]] + vertices[v[1]] + vertices[v[2]]) /
                           3.)))
          continue;
        CellData<2> cell(3);
        for (unsigned int i = 0; i < 3; ++i)
        {
          if (new_vertex[v[i]] == invalid_index)
          {
            new_vertex[v[i]] = used.size();
            used.push_back(vertices[v[i]]);
          }
          cell.vertices[i] = new_vertex[v[i]];
        }
        cells.push_back(cell);
      }
      auto result = std::make_unique<Triangulation<2>>();
      result->create_triangulation(used, cells, SubCellData());
      return result;
    }
  } // namespace


  MathematicalMesh
  make_graded_mesh(const PhysicalMesh         &physical_mesh,
                   const GradedMeshParameters &parameters,
                   const unsigned int          degree)
  {
    const internal::Lattice lattice =
      internal::make_lattice(physical_mesh.bounding_box(), parameters);
    const SizeField size(physical_mesh, parameters);

    const double least    = least_cell_size(physical_mesh);
    double       smallest = parameters.cell_size;
    for (const LocalSize &local : parameters.local_sizes)
      smallest = std::min(smallest, local.size);
    std::ostringstream what, remedy;
    what << "a local size of " << smallest
         << " m is so small that coordinates cannot tell the corners of cells "
            "apart";
    remedy << "choose at least " << least << " m";
    AssertThrow(smallest >= least,
                InputError(what.str(),
                           "Mathematical mesh/Local sizes",
                           remedy.str()));
    unsigned int n_levels = 0;
    while (std::ldexp(parameters.cell_size, -int(n_levels)) >
           (1. + 1e-10) * smallest)
      ++n_levels;

    RedGreenRefinement refinement(
      lattice,
      internal::find_needed_parallelograms(physical_mesh, lattice, parameters),
      n_levels);
    refinement.refine(size, parameters.cell_size);
    refinement.balance();
    return MathematicalMesh(make_triangulation(refinement.vertices,
                                               refinement.close(),
                                               physical_mesh,
                                               parameters.whole_box),
                            degree);
  }
} // namespace NMM
