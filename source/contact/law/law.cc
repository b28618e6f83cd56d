#include <nmm/base/exceptions.h>
#include <nmm/contact/law/law.h>

#include <cmath>

namespace NMM
{
  void
  ContactLaw::check(const std::string &where) const
  {
    Assert(transmits_shear() || !is_bond,
           dealii::ExcMessage("The points of a bond need anchors."));
    check_law_value(
      normal_stiffness > 0. && std::isfinite(normal_stiffness),
      "the normal spring's stiffness",
      normal_stiffness,
      where,
      "give a positive one, such as ten times Young's modulus over "
      "the size of a cell");
    check_law_value(shear_stiffness >= 0. && std::isfinite(shear_stiffness),
                    "the shear spring's stiffness",
                    shear_stiffness,
                    where,
                    "give a positive one, or 0 for that of the normal spring");
    for (const double damping : {normal_damping, shear_damping})
      check_law_value(damping >= 0. && std::isfinite(damping),
                      "a dashpot's coefficient",
                      damping,
                      where,
                      "give a number that is at least 0");
    check_law_value(tensile_strength >= 0. && std::isfinite(tensile_strength),
                    "the tensile strength",
                    tensile_strength,
                    where,
                    "give a number that is at least 0");
    check_law_value(is_bond || tensile_strength == 0.,
                    "the tensile strength",
                    tensile_strength,
                    where,
                    "only bonded joints bear tension: say that it is a bond");
    check_law_value(dilation >= 0. && std::isfinite(dilation),
                    "the tangent of the dilation angle",
                    dilation,
                    where,
                    "give a number that is at least 0");
    check_law_value(dilation == 0. || !depends_on_slip(),
                    "the tangent of the dilation angle",
                    dilation,
                    where,
                    "leave it out: faces whose strength depends on the slip "
                    "have no angle of dilation here");
    check_law_value(dilation_limit >= 0. && std::isfinite(dilation_limit),
                    "the slip that dilates",
                    dilation_limit,
                    where,
                    "give a length, or 0 for no limit");
    check_law_value(dilation > 0. || dilation_limit == 0.,
                    "the slip that dilates",
                    dilation_limit,
                    where,
                    "give a dilation angle, too");
  }


  std::vector<ContactLaw::Parameter>
  ContactLaw::parameters()
  {
    constexpr auto number = Parameter::Kind::number;
    return {{"Normal stiffness",
             &normal_stiffness,
             number,
             "Of the springs that keep faces apart: pressure over penetration "
             "[Pa/m]. 0: that of section Contact; there 10 E/h, static penalty "
             "30 E/h, E of the softest block, h the cell size at faces.",
             "give a positive number, such as ten times Young's modulus over "
             "the cell size, or 0 to have it chosen"},
            {"Shear stiffness",
             &shear_stiffness,
             number,
             "Of the springs that hold faces which stick: shear over elastic "
             "slip [Pa/m]. 0: that of section Contact; there E/h, dynamic 10 "
             "E/h, but not more than the normal stiffness.",
             "give a positive number, or 0 to have it chosen"},
            {"Normal damping",
             &normal_damping,
             number,
             "Dynamic analysis, energy momentum: of dashpots beside these "
             "springs, stress over velocity; they never pull [Pa s/m].",
             "give a number that is at least 0"},
            {"Shear damping",
             &shear_damping,
             number,
             "Dynamic analysis, energy momentum: of dashpots beside these "
             "springs, stress over velocity; they never pull [Pa s/m].",
             "give a number that is at least 0"},
            {"Tensile strength",
             &tensile_strength,
             number,
             "Bonded: tension at which they break [Pa].",
             "give a stress of at least 0"}};
  }
} // namespace NMM
