#ifndef nmm_source_covers_element_order_h
#define nmm_source_covers_element_order_h

// Private: an order of elements that does not depend on their numbers.

#include <nmm/covers/manifold_mesh.h>

#include <array>
#include <cmath>

namespace NMM
{
  namespace internal
  {
    inline dealii::Point<2>
    cell_centroid(const ManifoldMesh &mesh, const unsigned int element)
    {
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      dealii::Point<2>        sum;
      for (const unsigned int v :
           mathematical_mesh.cell_vertices(mesh.cell(element)))
        sum += mathematical_mesh.vertices()[v];
      return dealii::Point<2>(sum / 3.);
    }


    /// Middle of the bounding box of the solid [m].
    inline dealii::Point<2>
    middle_of_solid(const PhysicalMesh &physical_mesh)
    {
      const auto &box = physical_mesh.bounding_box().get_boundary_points();
      return dealii::Point<2>(0.5 * (box.first + box.second));
    }


    /**
     * Direction of the first curve that was given, (1, 0) if it is a circle. Coordinates along it
     * turn with the solid, those along the axes do not.
     */
    inline dealii::Tensor<1, 2>
    direction_of_solid(const PhysicalMesh &physical_mesh)
    {
      const CurvePiece &first = physical_mesh.curves().front().pieces.front();
      const dealii::Tensor<1, 2> chord  = first.end - first.start;
      const double               length = chord.norm();
      return length > 0. ? chord / length : dealii::Tensor<1, 2>({1., 0.});
    }


    /**
     * Key by which elements are ordered, with lengths relative to the size of the cell: the
     * distances of the cell and the element from the middle of the solid, the position of the cell
     * and of the element relative to that middle, along direction_of_solid() and across it, and the
     * element's size. A symmetric solid on a symmetric mesh thus has a symmetric order, except for
     * elements on the axis, and the order neither depends on the origin nor on the axes.
     */
    struct ElementPlace
    {
      std::array<double, 7> values;
      double                cell_size;

      ElementPlace(const ManifoldMesh &mesh, const unsigned int element)
        : cell_size(mesh.mathematical_mesh().cell_diameter(mesh.cell(element)))
      {
        const dealii::Point<2> cell   = cell_centroid(mesh, element);
        const dealii::Point<2> here   = mesh.reference_point(element);
        const dealii::Point<2> middle = middle_of_solid(mesh.physical_mesh());
        const dealii::Tensor<1, 2> along =
          direction_of_solid(mesh.physical_mesh());
        const dealii::Tensor<1, 2> across({-along[1], along[0]});
        values = {{cell.distance(middle) / cell_size,
                   here.distance(middle) / cell_size,
                   (cell - middle) * along / cell_size,
                   (cell - middle) * across / cell_size,
                   (here - middle) * along / cell_size,
                   (here - middle) * across / cell_size,
                   mesh.area(element) / (cell_size * cell_size)}};
      }

      /// Compare by the first value that differs by more than a millionth of the cell.
      bool
      operator<(const ElementPlace &other) const
      {
        for (unsigned int i = 0; i < values.size(); ++i)
        {
          const double theirs = other.values[i] * other.cell_size / cell_size;
          if (std::abs(values[i] - theirs) > 1e-6)
            return values[i] < theirs;
        }
        return false;
      }
    };


    inline bool
    comes_first(const ManifoldMesh &mesh,
                const unsigned int  a,
                const unsigned int  b)
    {
      if (a == b)
        return false;
      // The first value decides in most cases.
      const dealii::Point<2> middle = middle_of_solid(mesh.physical_mesh());
      const double size  = mesh.mathematical_mesh().cell_diameter(mesh.cell(a));
      const double here  = cell_centroid(mesh, a).distance(middle) / size,
                   there = cell_centroid(mesh, b).distance(middle) / size;
      // The difference must be larger than the rounding of the numbers in ElementPlace.
      if (std::abs(here - there) > 1e-6 + 1e-12 * here)
        return here < there;
      return ElementPlace(mesh, a) < ElementPlace(mesh, b);
    }
  } // namespace internal
} // namespace NMM

#endif
