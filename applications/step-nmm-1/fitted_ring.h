#ifndef step_nmm_1_fitted_ring_h
#define step_nmm_1_fitted_ring_h

#include "parameters.h"
#include <string>

namespace StepNMM1
{
  /// What is measured in one run.
  struct Run
  {
    std::string  method;
    unsigned int degree    = 2;
    double       cell_size = 0.;
    /// Unknowns of the linear system; values that aggregation expresses through them come on
    /// top.
    unsigned int n_unknowns = 0;
    /// Of fitted elements only.
    unsigned int n_elements = 0, n_nonzeros = 0;
    /// Relative errors [-]: L2 of displacement and stress, largest of the hoop stress.
    double error_u = 0., error_stress = 0.;
    double error_hoop = 0., error_hoop_recovered = 0.;
    /// From the curves to the displacements.
    Tutorial::StageClock clock;
  };


  /**
   * The same problem with nothing but deal.II: a polar mesh of curved six-node
   * triangles that fits the quarter ring, with edges of about @p cell_size along the radius and along the
   * mean circle, unknowns on the symmetry lines eliminated, MUMPS.
   */
  Run
  run_fitted_elements(const Parameters &parameters, double cell_size);
} // namespace StepNMM1

#endif
