#include <nmm/contact/law/coulomb_law.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  std::vector<ContactLaw::Parameter>
  CoulombLaw::parameters()
  {
    std::vector<Parameter> list = ContactLaw::parameters();
    list.push_back({"Friction angle",
                    &friction,
                    Parameter::Kind::tangent,
                    "Faces slide when shear exceeds pressure times its tangent "
                    "plus the cohesion; in [0, 90) [degrees].",
                    "give an angle from 0 up to below 90 degrees"});
    list.push_back({"Cohesion",
                    &cohesion,
                    Parameter::Kind::number,
                    "Shear strength in addition to friction; acts in full from "
                    "a thousandth of it in pressure on, in bonded faces until "
                    "they break [Pa].",
                    "give a stress of at least 0"});
    list.push_back({"Dilation angle",
                    &dilation,
                    Parameter::Kind::tangent,
                    "Faces that slide part by its tangent times the way they "
                    "slide; from 0 to the friction angle [degrees].",
                    "give an angle from 0 to the friction angle"});
    list.push_back({"Dilation limit",
                    &dilation_limit,
                    Parameter::Kind::number,
                    "Way of sliding after which they part no further [m]; 0: "
                    "no limit.",
                    "give a length, or 0 for no limit"});
    return list;
  }


  CoulombLaw::Response
  CoulombLaw::cohesion_under(const double pressure, const double c) const
  {
    constexpr double slope = 1000.;

    if (is_bond)
      return {};
    return slope * pressure < c ? Response{slope * pressure, slope}
                                : Response{c, 0.};
  }


  void
  CoulombLaw::reduce_strength(const double factor)
  {
    friction /= factor;
    cohesion /= factor;
    tensile_strength /= factor;
    // A dilation angle above the friction angle would create energy.
    dilation = std::min(dilation, friction);
  }


  void
  CoulombLaw::check(const std::string &where) const
  {
    ContactLaw::check(where);
    check_law_value(friction >= 0. && std::isfinite(friction),
                    "the friction coefficient",
                    friction,
                    where,
                    "give a number that is at least 0");
    check_law_value(cohesion >= 0. && std::isfinite(cohesion),
                    "the cohesion",
                    cohesion,
                    where,
                    "give a number that is at least 0");
    check_law_value(dilation <= friction,
                    "the tangent of the dilation angle",
                    dilation,
                    where,
                    "give that of an angle from 0 to the friction angle, " +
                      std::to_string(friction) + " at most");
  }
} // namespace NMM
