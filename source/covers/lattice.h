#ifndef nmm_source_covers_lattice_h
#define nmm_source_covers_lattice_h

// Private: the lattice that regular meshes and their refinements are made on.

#include <nmm/covers/mathematical_mesh.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cstdint>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Memory that meshing, cutting and the cheapest analysis with linear covers use for each
    /// triangle, measured on squares with 1e5 triangles [bytes].
    constexpr double least_memory_per_cell = 2000.;

    /// Lattice coordinates of a node.
    using LatticeNode = std::array<std::int64_t, 2>;

    /**
     * A lattice of parallelograms. Node (i, j) lies at origin + i a + j b, 0 <= i <= n[0],
     * 0 <= j <= n[1]; parallelograms are halved along the diagonal from (i+1, j) to (i, j+1).
     */
    struct Lattice
    {
      dealii::Point<2>     origin;
      dealii::Tensor<1, 2> a, b;
      LatticeNode          n;
      /// Inverse of (a b).
      dealii::Tensor<2, 2> to_lattice;

      dealii::Point<2>
      node(const std::int64_t i, const std::int64_t j) const
      {
        return origin + static_cast<double>(i) * a + static_cast<double>(j) * b;
      }

      /// Lattice coordinates of x [-].
      dealii::Tensor<1, 2>
      coordinates(const dealii::Point<2> &x) const
      {
        return to_lattice * (x - origin);
      }

      std::size_t
      index(const std::int64_t i, const std::int64_t j) const
      {
        return static_cast<std::size_t>(j * n[0] + i);
      }
    };


    /**
     * The lattice over the solid's bounding box.
     * @throws InputError for a cell size that is not positive or too small.
     */
    Lattice
    make_lattice(const dealii::BoundingBox<2> &box,
                 const RegularMeshParameters  &parameters);

    /**
     * Parallelograms (i, j) that can touch the solid, row by row; all of them
     * if the parameters ask for the whole box.
     */
    std::vector<LatticeNode>
    find_needed_parallelograms(const PhysicalMesh          &physical_mesh,
                               const Lattice               &lattice,
                               const RegularMeshParameters &parameters);
  } // namespace internal
} // namespace NMM

#endif
