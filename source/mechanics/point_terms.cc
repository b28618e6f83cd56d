#include <algorithm>
#include <mechanics/element_near.h>
#include <mechanics/point_terms.h>

namespace NMM
{
  namespace internal
  {
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
    }


    const std::vector<unsigned int> &
    PointTerms::fixed_point_elements() const
    {
      return fixed_elements;
    }


    const std::vector<unsigned int> &
    PointTerms::point_force_elements() const
    {
      return force_elements;
    }


    double
    PointTerms::stiffness(const unsigned int fixed_point) const
    {
      const double given = problem->fixed_points[fixed_point].stiffness;
      return given > 0. ? given : default_stiffness;
    }


    void
    PointTerms::add_spring(const unsigned int       fixed_point,
                           const double             factor,
                           const LocalDisplacement &u,
                           LocalSystem             &local) const
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const FixedPoint       &fixed  = problem->fixed_points[fixed_point];
      const double            spring = stiffness(fixed_point);
      double                  w[WeightFunctions::max_per_cell];
      WeightFunctions::values(mathematical_mesh.degree(),
                              mathematical_mesh.real_to_reference(
                                mesh.cell(fixed_elements[fixed_point]),
                                fixed.point),
                              w);
      for (unsigned int c = 0; c < 2; ++c)
      {
        if (!fixed.components[c])
          continue;
        double distance = -factor * fixed.displacement[c];
        for (unsigned int i = 0; i < local.n_covers; ++i)
          distance += w[i] * u.values[i][c];
        local.energy += 0.5 * spring * distance * distance;
        for (unsigned int i = 0; i < local.n_covers; ++i)
        {
          local.rhs[unknown_of(i, c)] += spring * w[i] * distance;
          if (local.with_matrix)
            for (unsigned int j = 0; j < local.n_covers; ++j)
              local.row(i, c)[unknown_of(j, c)] += spring * w[i] * w[j];
        }
      }
    }
  } // namespace internal
} // namespace NMM
