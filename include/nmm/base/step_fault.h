#ifndef nmm_base_step_fault_h
#define nmm_base_step_fault_h

#include <string>

namespace NMM
{
  /// Why the result of a step must not be accepted.
  struct StepFault
  {
    /// The reason, as part of a message; empty if the result may be accepted.
    std::string reason = {};
    /// What the user can do if no shorter step helps; if empty, the general advice on steps is
    /// given.
    std::string remedy = {};
    /// Length of the next trial over that of this step [-]; 0 stands for the usual cut after a
    /// failure.
    double retry = 0.;
  };
} // namespace NMM

#endif
