#include <nmm/base/exceptions.h>

#include <cmath>
#include <mechanics/element_near.h>

namespace NMM
{
  namespace internal
  {
    unsigned int
    find_element_near(const ManifoldMesh     &mesh,
                      const dealii::Point<2> &point,
                      const std::string      &what)
    {
      unsigned int element = mesh.find_element(point);
      const auto  &box =
        mesh.physical_mesh().bounding_box().get_boundary_points();
      const double size = box.first.distance(box.second);
      for (const double distance : {1e-12 * size, 1e-9 * size})
        for (unsigned int k = 0; k < 8 && element == invalid_index; ++k)
        {
          const double angle = (k + 0.5) * dealii::numbers::PI_4;
          element            = mesh.find_element(
            point + distance *
                      dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
        }
      AssertThrow(element != invalid_index,
                  InputError(what + " lies outside the solid",
                             to_string(point),
                             "move it into the solid"));
      return element;
    }
  } // namespace internal
} // namespace NMM
