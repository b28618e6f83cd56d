#include <nmm/fracture/kink_factors.h>
#include <nmm/fracture/local_symmetry_criterion.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace NMM
{
  GrowthCriterion::Verdict
  LocalSymmetryCriterion::judge(const double K_I, const double K_II) const
  {
    // The kink is on the side on which K_I' is not less than K_I. Its angle is found by
    // bisection, since K_II' is monotonic from the direction of the crack up to its zero.
    const double side  = K_II > 0. ? -1. : 1.;
    const double K_abs = std::abs(K_II);
    double       low = 0., high = 0.5 * dealii::numbers::PI;
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double      middle                          = 0.5 * (low + high);
      const KinkFactors F                               = kink_factors(-middle);
      (F.F_21 * K_I + F.F_22 * K_abs > 0. ? low : high) = middle;
    }
    const KinkFactors F = kink_factors(-low);
    Verdict           verdict;
    verdict.angle                = side * low;
    verdict.equivalent_intensity = F.F_11 * K_I + F.F_12 * K_abs;
    return verdict;
  }
} // namespace NMM
