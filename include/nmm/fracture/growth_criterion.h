#ifndef nmm_fracture_growth_criterion_h
#define nmm_fracture_growth_criterion_h

#include <nmm/base/named_law.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * Where a crack grows to, and how strongly it is driven, from the intensity factors of its
   * tip. To add a criterion: derive a class in a file of its own, and name it in
   * growth_criteria().
   */
  class GrowthCriterion
  {
  public:
    virtual ~GrowthCriterion() = default;

    struct Verdict
    {
      /// From the tip's direction, counter-clockwise [rad], in (-pi/2, pi/2).
      double angle = 0.;
      /// The intensity factor that is compared with the toughness [Pa m^(1/2)]; K_I if K_II
      /// vanishes. 0 or negative: the crack does not grow, since it is closed.
      double equivalent_intensity = 0.;
    };

    /// @p K_I and @p K_II at the tip as it is, before it grows [Pa m^(1/2)].
    virtual Verdict
    judge(double K_I, double K_II) const = 0;

    /// Is the increment to be turned until K_II vanishes at its own tip?
    virtual bool
    is_implicit() const
    {
      return false;
    }
  };


  /// All criteria that scenes can choose; the first one is the default.
  const std::vector<NamedLaw<GrowthCriterion>> &
  growth_criteria();
} // namespace NMM

#endif
