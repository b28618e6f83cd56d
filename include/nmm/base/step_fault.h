#ifndef nmm_base_step_fault_h
#define nmm_base_step_fault_h

#include <string>

namespace NMM
{
  /// Why the result of a step must not be accepted.
  struct StepFault
  {
    /// For people; empty: it may be accepted.
    std::string reason;
    /// What helps if no shorter step does; empty: what helps with steps in general.
    std::string remedy;
    /// Share of the step that is to be tried next; 0: as with any other step that fails.
    double retry = 0.;
  };
} // namespace NMM

#endif
