#ifndef nmm_source_mechanics_point_terms_h
#define nmm_source_mechanics_point_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <mechanics/local_system.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The elements that contain the points of point forces (11) and fixed points (12), and the
     * springs of the latter.
     * @throws InputError for a point outside the solid.
     */
    class PointTerms
    {
    public:
      PointTerms(const CoverSystem &covers, const ElasticityProblem &problem);

      /// Element of each fixed point. If an element of another rank contains the point, this is no
      /// valid number of an element of this rank.
      const std::vector<unsigned int> &
      fixed_point_elements() const;

      /// Spring stiffness of a fixed point per unit thickness, the given one or the default
      /// [N/m^2].
      double
      stiffness(unsigned int fixed_point) const;

      /// Element of each point force, like fixed_point_elements().
      const std::vector<unsigned int> &
      point_force_elements() const;

      /// Add the spring of a fixed point, whose displacement is multiplied by @p factor, to the
      /// system of its element with the displacements @p u.
      void
      add_spring(unsigned int             fixed_point,
                 double                   factor,
                 const LocalDisplacement &u,
                 LocalSystem             &local) const;

    private:
      const CoverSystem        *covers;
      const ElasticityProblem  *problem;
      std::vector<unsigned int> force_elements, fixed_elements;
      double                    default_stiffness;
    };
  } // namespace internal
} // namespace NMM

#endif
