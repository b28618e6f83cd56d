#ifndef nmm_fracture_hoop_stress_criterion_h
#define nmm_fracture_hoop_stress_criterion_h

#include <nmm/fracture/growth_criterion.h>

namespace NMM
{
  /**
   * The criterion of the largest hoop stress: a crack grows in the direction in which the hoop
   * stress about its tip is largest,
   * @f[ \theta = 2\arctan\frac{K_I-\sqrt{K_I^2+8K_{II}^2}}{4K_{II}}, \qquad
       K_\mathrm{eq} = \cos^2\tfrac\theta2
         \left(K_I\cos\tfrac\theta2 - 3K_{II}\sin\tfrac\theta2\right), @f]
   * where K_eq is that stress times (2 pi r)^(1/2).
   * Source: F. Erdogan, G. Sih, J. Basic Eng. 85 (1963), 519-525.
   */
  class HoopStressCriterion : public GrowthCriterion
  {
  public:
    Verdict
    judge(double K_I, double K_II) const override;
  };
} // namespace NMM

#endif
