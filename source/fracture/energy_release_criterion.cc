#include <nmm/fracture/energy_release_criterion.h>
#include <nmm/fracture/kink_factors.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace NMM
{
  GrowthCriterion::Verdict
  EnergyReleaseCriterion::judge(const double K_I, const double K_II) const
  {
    // E' times the energy release rate; where the kink is closed, the negative K_I' instead.
    const auto release = [&](const double angle) {
      const KinkFactors F   = kink_factors(angle);
      const double      K_1 = F.F_11 * K_I + F.F_12 * K_II,
                   K_2      = F.F_21 * K_I + F.F_22 * K_II;
      return K_1 > 0. ? K_1 * K_1 + K_2 * K_2 : K_1;
    };
    // The maximum is the peak of the parabola through the best of many angles and its neighbours.
    constexpr int    n    = 180;
    constexpr double step = 0.5 * dealii::numbers::PI / n;
    int              best = 0;
    for (int i = -n; i <= n; ++i)
      if (release(i * step) > release(best * step))
        best = i;
    Verdict      verdict;
    const double before = release((best - 1) * step), at = release(best * step),
                 after     = release((best + 1) * step);
    const double curvature = before - 2. * at + after;
    verdict.angle          = best * step;
    if (curvature < 0. && std::abs(best) < n)
      verdict.angle += 0.5 * (before - after) / curvature * step;
    const double most            = release(verdict.angle);
    verdict.equivalent_intensity = most > 0. ? std::sqrt(most) : most;
    return verdict;
  }
} // namespace NMM
