#include <nmm/contact/law/slip_weakening_law.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  std::vector<ContactLaw::Parameter>
  SlipWeakeningLaw::parameters()
  {
    std::vector<Parameter> list = CoulombLaw::parameters();
    list.push_back({"Residual friction angle",
                    &residual_friction,
                    Parameter::Kind::tangent,
                    "slip weakening: what is left of the friction angle "
                    "[degrees].",
                    "give an angle from 0 to the friction angle"});
    list.push_back({"Residual cohesion",
                    &residual_cohesion,
                    Parameter::Kind::number,
                    "slip weakening: what is left of the cohesion [Pa].",
                    "give a stress from 0 to the cohesion"});
    list.push_back({"Weakening length",
                    &weakening_length,
                    Parameter::Kind::number,
                    "slip weakening: slip within which the strength falls to "
                    "its residual value [m].",
                    "give a positive length"});
    return list;
  }


  ContactLaw::Strength
  SlipWeakeningLaw::strength(const double pressure, const double slip) const
  {
    const double left  = std::max(0., 1. - slip / weakening_length);
    const double slope = left > 0. ? -1. / weakening_length : 0.;
    const double tangent =
      residual_friction + left * (friction - residual_friction);
    const Response peak     = cohesion_under(pressure, cohesion);
    const Response residual = cohesion_under(pressure, residual_cohesion);
    const double   drop =
      pressure * (friction - residual_friction) + peak.value - residual.value;
    return {pressure * tangent + residual.value +
              left * (peak.value - residual.value),
            tangent + residual.derivative +
              left * (peak.derivative - residual.derivative),
            slope * drop};
  }


  void
  SlipWeakeningLaw::reduce_strength(const double factor)
  {
    CoulombLaw::reduce_strength(factor);
    residual_friction /= factor;
    residual_cohesion /= factor;
  }


  void
  SlipWeakeningLaw::check(const std::string &where) const
  {
    CoulombLaw::check(where);
    check_law_value(residual_friction >= 0. && residual_friction <= friction,
                    "the residual friction coefficient",
                    residual_friction,
                    where,
                    "give a number from 0 to the peak's");
    check_law_value(residual_cohesion >= 0. && residual_cohesion <= cohesion,
                    "the residual cohesion",
                    residual_cohesion,
                    where,
                    "give a number from 0 to the peak's");
    check_law_value(weakening_length > 0. && std::isfinite(weakening_length),
                    "the slip within which the strength falls",
                    weakening_length,
                    where,
                    "give a positive length");
  }
} // namespace NMM
