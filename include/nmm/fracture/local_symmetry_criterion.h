#ifndef nmm_fracture_local_symmetry_criterion_h
#define nmm_fracture_local_symmetry_criterion_h

#include <nmm/fracture/growth_criterion.h>

namespace NMM
{
  /**
   * The criterion of local symmetry: a crack grows so that its new tip has K_II' = 0, and K_I'
   * of the new tip is compared with the toughness. The angle that follows from kink_factors() is
   * only the first guess. Since is_implicit() is true, the increment is then turned until K_II
   * vanishes at the tip of the increment, whose length is finite. The path therefore converges
   * with the length of increments and does not zigzag.
   * Source: R. Goldstein, R. Salganik, Int. J. Fract. 10 (1974), 507-523.
   */
  class LocalSymmetryCriterion : public GrowthCriterion
  {
  public:
    Verdict
    judge(double K_I, double K_II) const override;

    bool
    is_implicit() const override
    {
      return true;
    }
  };
} // namespace NMM

#endif
