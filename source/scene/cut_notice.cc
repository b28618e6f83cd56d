#include <algorithm>
#include <scene/cut_notice.h>
#include <string>

namespace NMM
{
  namespace internal
  {
    void
    CutNotice::note(const LostSteps &lost)
    {
      constexpr double most = 20.;

      n_cuts = std::max(0., n_cuts - 0.5) + lost.n_cuts;
      if (is_silent || n_cuts <= most)
        return;
      is_silent                 = true;
      const std::string &remedy = lost.last_fault.remedy;
      progress->message(
        "  notice: steps are cut again and again, the last time because of " +
        lost.last_fault.reason + ": " +
        (remedy.empty()
           ? "look there for slivers, small blocks ('Geometry/Small blocks = "
             "merge') or corners that lock, or set a lower 'Contact/Normal "
             "stiffness'"
           : remedy));
    }
  } // namespace internal
} // namespace NMM
