#include <nmm/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <covers/find_on_ranks.h>
#include <mechanics/point_terms.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Element of a point of the solid. If the point is not found, because rounding has moved it
      /// from the boundary to the outside, points very close to it are tried.
      unsigned int
      find_element_near(const ManifoldMesh     &mesh,
                        const dealii::Point<2> &point,
                        const std::string      &what)
      {
        unsigned int element = find_on_ranks(mesh, point);
        const auto  &box =
          mesh.physical_mesh().bounding_box().get_boundary_points();
        const double size = box.first.distance(box.second);
        for (const double distance : {1e-12 * size, 1e-9 * size})
          for (unsigned int k = 0; k < 8 && element == invalid_index; ++k)
          {
            const double angle = (k + 0.5) * dealii::numbers::PI_4;
            element            = find_on_ranks(mesh,
                                    point + distance * dealii::Tensor<1, 2>(
                                                         {std::cos(angle),
                                                                     std::sin(angle)}));
          }
        AssertThrow(element != invalid_index,
                    InputError(what + " lies outside the solid",
                               to_string(point),
                               "move it into the solid"));
        return element;
      }
    } // namespace


    PointTerms::PointTerms(const CoverSystem       &covers,
                           const ElasticityProblem &problem)
      : covers(&covers)
      , problem(&problem)
      , default_stiffness(0.)
    {
      const ManifoldMesh &mesh = covers.manifold_mesh();
      for (const PointForce &force : problem.point_forces)
        force_elements.push_back(
          find_element_near(mesh, force.point, "A point force"));
      for (const FixedPoint &fixed : problem.fixed_points)
        fixed_elements.push_back(
          find_element_near(mesh, fixed.point, "A fixed point"));
      for (const Material &material : problem.materials)
        default_stiffness =
          std::max(default_stiffness, 1000. * material.youngs_modulus);

      all_elements = force_elements;
      all_elements.insert(all_elements.end(),
                          fixed_elements.begin(),
                          fixed_elements.end());
      std::sort(all_elements.begin(), all_elements.end());
      all_elements.erase(std::unique(all_elements.begin(), all_elements.end()),
                         all_elements.end());
    }


    const std::vector<unsigned int> &
    PointTerms::fixed_point_elements() const
    {
      return fixed_elements;
    }


    const std::vector<unsigned int> &
    PointTerms::elements() const
    {
      return all_elements;
    }


    double
    PointTerms::stiffness(const unsigned int fixed_point) const
    {
      const double given = problem->fixed_points[fixed_point].stiffness;
      return given > 0. ? given : default_stiffness;
    }


    void
    PointTerms::add(const unsigned int element, LocalSystem &system) const
    {
      const MathematicalMesh &mesh =
        covers->manifold_mesh().mathematical_mesh();
      const unsigned int cell   = covers->manifold_mesh().cell(element);
      const unsigned int degree = mesh.degree();
      const unsigned int n      = WeightFunctions::n_per_cell(degree);
      double             w[WeightFunctions::max_per_cell];

      for (unsigned int f = 0; f < force_elements.size(); ++f)
        if (force_elements[f] == element)
        {
          const PointForce &force = problem->point_forces[f];
          WeightFunctions::values(degree,
                                  mesh.real_to_reference(cell, force.point),
                                  w);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int c = 0; c < 2; ++c)
              system.rhs[2 * i + c] += w[i] * force.force[c];
        }

      for (unsigned int f = 0; f < fixed_elements.size(); ++f)
        if (fixed_elements[f] == element)
        {
          const FixedPoint &fixed = problem->fixed_points[f];
          WeightFunctions::values(degree,
                                  mesh.real_to_reference(cell, fixed.point),
                                  w);
          for (unsigned int c = 0; c < 2; ++c)
            if (fixed.components[c])
              for (unsigned int i = 0; i < n; ++i)
              {
                const double spring = stiffness(f) * w[i];
                for (unsigned int j = 0; j < n; ++j)
                  system.row(i, c)[2 * j + c] += spring * w[j];
                system.rhs[2 * i + c] += spring * fixed.displacement[c];
              }
        }
    }
  } // namespace internal
} // namespace NMM
