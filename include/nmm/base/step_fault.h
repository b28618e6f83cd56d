#ifndef nmm_base_step_fault_h
#define nmm_base_step_fault_h

#include <string>

namespace NMM
{
  /// Why the result of a step must not be accepted.
  struct StepFault
  {
    /// Part of a message; empty if the result may be accepted.
    std::string reason;
    /// What the user can do if no shorter step helps; empty: the general advice on steps.
    std::string remedy;
    /// Length of the next trial as a fraction of this step; 0: as after any other failure.
    double retry = 0.;
  };
} // namespace NMM

#endif
