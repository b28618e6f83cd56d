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
     * The terms of point forces (11) and fixed points (12), each in the element that contains its
     * point.
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

      /// Elements with point terms, ascending.
      const std::vector<unsigned int> &
      elements() const;

      /// Add the terms of all points in an element.
      void
      add(unsigned int element, LocalSystem &system) const;

    private:
      const CoverSystem        *covers;
      const ElasticityProblem  *problem;
      std::vector<unsigned int> force_elements, fixed_elements, all_elements;
      double                    default_stiffness;
    };
  } // namespace internal
} // namespace NMM

#endif
