#include <nmm/fracture/energy_release_criterion.h>
#include <nmm/fracture/growth_criterion.h>
#include <nmm/fracture/hoop_stress_criterion.h>
#include <nmm/fracture/local_symmetry_criterion.h>

namespace NMM
{
  const std::vector<NamedLaw<GrowthCriterion>> &
  growth_criteria()
  {
    static const std::vector<NamedLaw<GrowthCriterion>> criteria = {
      {"hoop stress",
       "in the direction of the largest hoop stress",
       std::make_shared<HoopStressCriterion>()},
      {"local symmetry",
       "so that there is no shear along the path, for which each increment is "
       "turned",
       std::make_shared<LocalSymmetryCriterion>()},
      {"energy release",
       "in the direction in which most energy is released",
       std::make_shared<EnergyReleaseCriterion>()}};
    return criteria;
  }
} // namespace NMM
