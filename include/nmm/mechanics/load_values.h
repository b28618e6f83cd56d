#ifndef nmm_mechanics_load_values_h
#define nmm_mechanics_load_values_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

namespace NMM
{
  /**
   * Evaluate body force and boundary conditions where the equations will.
   * @throws InputError that names the expression and the place if a value is not
   * finite. Collective, all ranks throw.
   */
  void
  check_load_values(const CoverSystem          &covers,
                    const QuadratureCollection &quadrature,
                    const ElasticityProblem    &problem);
} // namespace NMM

#endif
