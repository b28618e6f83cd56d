#ifndef nmm_fracture_local_symmetry_criterion_h
#define nmm_fracture_local_symmetry_criterion_h

#include <nmm/fracture/growth_criterion.h>

namespace NMM
{
  /**
   * The criterion of local symmetry: a crack grows along a path on which K_II vanishes, and K_I
   * is compared with the toughness. The angle is the one at which a short kink has K_II' = 0, see
   * kink_factors(). Since is_implicit() is true, a straight increment of finite length is then turned
   * until it is the chord of such a path.
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
