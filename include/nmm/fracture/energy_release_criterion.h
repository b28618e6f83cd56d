#ifndef nmm_fracture_energy_release_criterion_h
#define nmm_fracture_energy_release_criterion_h

#include <nmm/fracture/growth_criterion.h>

namespace NMM
{
  /**
   * A crack grows in the direction in which it releases most energy,
   * @f[ K_\mathrm{eq} = \max_\varphi \sqrt{K_I'^2+K_{II}'^2}, @f]
   * K' being that of a short kink under the angle phi (kink_factors()), of those that
   * open, K_I' > 0.
   * Source: M. Hussain, S. Pu, J. Underwood, ASTM STP 560 (1974), 2-28.
   */
  class EnergyReleaseCriterion : public GrowthCriterion
  {
  public:
    Verdict
    judge(double K_I, double K_II) const override;
  };
} // namespace NMM

#endif
