#ifndef nmm_fracture_growth_criterion_h
#define nmm_fracture_growth_criterion_h

#include <nmm/base/named_law.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * A growth criterion: it gives the direction in which a crack grows, and the driving force,
   * from the intensity factors of its tip. To add a criterion, derive a class in a file of its
   * own, and name it in growth_criteria().
   */
  class GrowthCriterion
  {
  public:
    virtual ~GrowthCriterion() = default;

    /// The direction of growth and the driving force.
    struct Verdict
    {
      /// Angle from the tip's direction, counter-clockwise [rad]; in [-pi/2, pi/2] if K_I >= 0.
      double angle = 0.;
      /// The intensity factor that is compared with the toughness [Pa m^(1/2)]; it is K_I if K_II
      /// vanishes. If it is 0 or negative, the crack is closed and does not grow.
      double equivalent_intensity = 0.;
    };

    /// The verdict for the intensity factors of the tip before the crack grows [Pa m^(1/2)].
    virtual Verdict
    judge(double K_I, double K_II) const = 0;

    /// Whether the increment must be turned until its direction is the mean of the verdicts at both
    /// of its ends.
    virtual bool
    is_implicit() const
    {
      return false;
    }
  };


  /// All growth criteria that scenes can choose; the first one is the default.
  const std::vector<NamedLaw<GrowthCriterion>> &
  growth_criteria();
} // namespace NMM

#endif
