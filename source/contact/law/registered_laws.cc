#include <nmm/contact/law/barton_bandis_law.h>
#include <nmm/contact/law/coulomb_law.h>
#include <nmm/contact/law/slip_weakening_law.h>

namespace NMM
{
  const std::vector<NamedContactLaw> &
  contact_laws()
  {
    static const std::vector<NamedContactLaw> laws = {
      {"Coulomb",
       "friction and cohesion, with dilation",
       std::make_shared<CoulombLaw>()},
      {"slip weakening",
       "Coulomb's, falling to a residual strength within a length of slip",
       std::make_shared<SlipWeakeningLaw>()},
      {"Barton-Bandis",
       "rough rock joints: strength by JRC and JCS, closure by a hyperbola",
       std::make_shared<BartonBandisLaw>()}};
    return laws;
  }
} // namespace NMM
