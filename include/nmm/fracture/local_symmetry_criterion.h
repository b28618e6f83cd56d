#ifndef nmm_fracture_local_symmetry_criterion_h
#define nmm_fracture_local_symmetry_criterion_h

#include <nmm/fracture/growth_criterion.h>

namespace NMM
{
  /**
   * A crack grows so that its new tip has K_II' = 0; its K_I' is compared with the toughness.
   * The angle that kink_factors() give is the first guess: the increment is turned
   * until K_II vanishes at its own tip, of its own length (is_implicit()), so that the path
   * converges with the length of increments and has no zig-zag.
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
