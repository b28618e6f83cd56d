#ifndef nmm_fracture_energy_release_criterion_h
#define nmm_fracture_energy_release_criterion_h

#include <nmm/fracture/growth_criterion.h>

namespace NMM
{
  /**
   * The criterion of the largest energy release: a crack grows in the direction in which it
   * releases most energy,
   * @f[ K_\mathrm{eq} = \max_\varphi \sqrt{K_I'^2+K_{II}'^2}, @f]
   * where K' are the intensity factors of a short kink at the angle phi (kink_factors()). Only
   * kinks that open, K_I' > 0, are considered.
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
