#ifndef nmm_mechanics_load_values_h
#define nmm_mechanics_load_values_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

namespace NMM
{
  /**
   * Check that body force and boundary conditions have finite values at the quadrature points, at
   * which the equations evaluate them.
   * @throws InputError on all ranks, naming the expression and the point, if a value is not
   * finite. Collective.
   */
  void
  check_load_values(const CoverSystem          &covers,
                    const QuadratureCollection &quadrature,
                    const ElasticityProblem    &problem);
} // namespace NMM

#endif
