#include <nmm/fracture/hoop_stress_criterion.h>

#include <cmath>

namespace NMM
{
  GrowthCriterion::Verdict
  HoopStressCriterion::judge(const double K_I, const double K_II) const
  {
    Verdict verdict;
    // (K_I - root) / (4 K_II) in a form without cancellation that is also valid for K_II = 0.
    const double root = std::sqrt(K_I * K_I + 8. * K_II * K_II);
    if (root + K_I > 0.)
      verdict.angle = -2. * std::atan(2. * K_II / (root + K_I));
    const double c               = std::cos(0.5 * verdict.angle),
                 s               = std::sin(0.5 * verdict.angle);
    verdict.equivalent_intensity = c * c * (K_I * c - 3. * K_II * s);
    return verdict;
  }
} // namespace NMM
