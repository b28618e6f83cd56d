#include <nmm/dynamics/dynamic_state.h>

#include <algorithm>

namespace NMM
{
  bool
  ClosingForces::act_at(const double t) const
  {
    return forces.size() > 0 && t < end;
  }


  double
  ClosingForces::share(const double t) const
  {
    return act_at(t) ? std::min(1., (end - t) / (end - begin)) : 0.;
  }


  double
  ClosingForces::mean_share(const double t_0, const double t_1) const
  {
    if (!act_at(t_0) || t_1 <= t_0)
      return share(t_0);
    // The share is linear up to the end and zero afterwards.
    const double last = std::min(t_1, end);
    return 0.5 * (share(t_0) + share(last)) * (last - t_0) / (t_1 - t_0);
  }
} // namespace NMM
