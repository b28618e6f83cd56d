#ifndef nmm_tests_support_same_elements_h
#define nmm_tests_support_same_elements_h

#include <nmm/covers/manifold_mesh.h>

#include <map>
#include <utility>

namespace NMM
{
  namespace Testing
  {
    /// Finds the elements of one mesh in another one with cells of the same lattice.
    class SameElements
    {
    public:
      explicit SameElements(const ManifoldMesh &mesh)
        : mesh(mesh)
      {
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          key_to_elements[key(mesh, e)].push_back(e);
      }

      /// In the same cell and region the nearest one of about the same area;
      /// invalid_index if there is none within a millionth of the cell.
      unsigned int
      find(const ManifoldMesh &other, const unsigned int element) const
      {
        const auto position = key_to_elements.find(key(other, element));
        if (position == key_to_elements.end())
          return invalid_index;
        const double size =
          other.mathematical_mesh().cell_diameter(other.cell(element));
        unsigned int best     = invalid_index;
        double       distance = 1e-6;
        for (const unsigned int e : position->second)
        {
          if (mesh.region(e) != other.region(element))
            continue;
          const double d =
            mesh.reference_point(e).distance(other.reference_point(element)) /
              size +
            std::abs(mesh.area(e) - other.area(element)) / (size * size);
          if (d < distance)
          {
            distance = d;
            best     = e;
          }
        }
        return best;
      }

    private:
      /// A corner of a cell has the same doubles on all ranks, and so has their sum in
      /// the same order.
      static std::pair<double, double>
      key(const ManifoldMesh &mesh, const unsigned int element)
      {
        dealii::Point<2> sum;
        for (const unsigned int v :
             mesh.mathematical_mesh().cell_vertices(mesh.cell(element)))
          sum += mesh.mathematical_mesh().vertices()[v];
        return {sum[0], sum[1]};
      }

      const ManifoldMesh &mesh;
      std::map<std::pair<double, double>, std::vector<unsigned int>>
        key_to_elements;
    };
  } // namespace Testing
} // namespace NMM

#endif
