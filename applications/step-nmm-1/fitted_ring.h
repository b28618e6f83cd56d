#ifndef step_nmm_1_fitted_ring_h
#define step_nmm_1_fitted_ring_h

#include "study.h"

namespace StepNMM1
{
  /**
   * The same problem with nothing but deal.II: a polar mesh of curved six-node
   * triangles that fits the quarter ring, with edges of about @p cell_size along the radius and along the
   * mean circle, unknowns on the symmetry lines eliminated, MUMPS.
   */
  Measurement
  run_fitted_elements(const Parameters &parameters, double cell_size);
} // namespace StepNMM1

#endif
