#include <nmm/base/exceptions.h>
#include <nmm/fracture/growth_criterion.h>
#include <nmm/scene/scene_parameters_fracture.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>

// This file has the parameters of crack tips and their growth.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<FractureParameters::Tips> tip_treatments = {
      {"automatic", FractureParameters::Tips::automatic},
      {"graded", FractureParameters::Tips::graded},
      {"as meshed", FractureParameters::Tips::as_meshed}};
  } // namespace


  bool
  FractureParameters::grades_mesh() const
  {
    return tips == Tips::graded ||
           (tips == Tips::automatic && intensity_factors);
  }


  void
  FractureParameters::list_entries(Entries &entries)
  {
    entries.add("Intensity factors",
                intensity_factors,
                "Compute the stress intensity factors, the T-stress and the "
                "energy release rate of all crack tips and write tips.csv.");
    entries.add("Tips",
                tips,
                tip_treatments,
                "graded: cells become small towards crack tips; as meshed: "
                "they do not; automatic: if intensity factors are asked for, "
                "functions for the stress at the tip are added in a disk "
                "around it (linear statics, straight cracks), elsewhere "
                "graded.");
    entries.add("Grading",
                grading,
                Patterns::Double(0, 1),
                "Size of cells over the distance from the tip, where another "
                "curve or tip or the circle of a cover is reached [-]; the "
                "error of intensity factors falls with its fourth power.");
    entries.add("Radius",
                radius,
                Patterns::Double(0),
                "Radius of the disk about each tip that intensity factors are "
                "computed from [m]; 0: 0.9 times the distance to what "
                "is nearest.");
    entries.add("Increments",
                n_increments,
                Patterns::Integer(0),
                "How often cracks grow; 0: they do not. Needs the Toughness of "
                "the materials.");
    entries.add("Increment",
                increment,
                Patterns::Double(0),
                "Length by which a crack grows each time, > 0 [m].");
    std::string        text;
    Words<std::string> names;
    for (const auto &named : growth_criteria())
    {
      text +=
        (text.empty() ? "" : "; ") + named.name + ": " + named.documentation;
      names.emplace_back(named.name, named.name);
    }
    if (criterion.empty())
      criterion = names.front().first;
    entries.add("Criterion",
                criterion,
                names,
                "Where cracks grow to. " + text + ".");
    entries.add("Tolerance",
                tolerance,
                Patterns::Double(0, 1),
                "Tips grow together with the one that is driven most if the "
                "ratio of their equivalent intensity factor to the toughness "
                "is less by this at most [-].");
    entries.add("Speed",
                speed,
                Patterns::Double(0),
                "Largest speed of cracks in a dynamic analysis [m/s]; 0: half "
                "of the speed of Rayleigh waves.");
  }


  void
  FractureParameters::check() const
  {
    const std::string section = "section 'Fracture'";
    AssertThrow(grading > 0. && std::isfinite(grading),
                InputError("'Grading' is " + to_text(grading),
                           section,
                           "choose it in (0, 1], such as 0.25"));
    const FractureParameters standard;
    AssertThrow(grades_mesh() || grading == standard.grading,
                InputError("'Grading' would not be used by a mesh that is not "
                           "graded towards crack tips",
                           section,
                           "remove it, or set 'Tips = graded'"));
    const bool grows = n_increments > 0;
    AssertThrow(intensity_factors || !grows,
                InputError("cracks cannot grow without intensity factors",
                           "parameter 'Fracture/Increments'",
                           "set 'Fracture/Intensity factors = true'"));
    AssertThrow(grows == (increment > 0.) && std::isfinite(increment),
                InputError(grows ? "the length by which cracks grow is " +
                                     to_text(increment) + " m"
                                 : "'Increment' would not be used by cracks "
                                   "that do not grow",
                           "parameter 'Fracture/Increment'",
                           grows ? "give a positive length, a tenth of the "
                                   "crack's or so"
                                 : "remove it, or set 'Increments'"));
    AssertThrow(grows || (criterion == growth_criteria().front().name &&
                          tolerance == standard.tolerance),
                InputError("'Criterion' and 'Tolerance' would not be used by "
                           "cracks that do not grow",
                           section,
                           "remove them, or set 'Increments'"));
    AssertThrow(std::isfinite(speed) && (grows || speed == 0.),
                InputError("'Speed' is " + to_text(speed) +
                             " m/s and would not be used by cracks that do "
                             "not grow",
                           section,
                           "remove it, or set 'Increments'"));
    AssertThrow(intensity_factors || radius == 0.,
                InputError("'Radius' would not be used without intensity "
                           "factors",
                           section,
                           "remove it, or set 'Intensity factors = true'"));
  }


  bool
  FractureParameters::can_start_cracks(
    const std::vector<Material> &materials) const
  {
    return n_increments > 0 &&
           std::any_of(materials.begin(),
                       materials.end(),
                       [](const Material &material) {
                         return material.fracture_strength > 0.;
                       });
  }


  double
  FractureParameters::smallest_at_tips(const bool in_motion) const
  {
    return in_motion && n_increments > 0 ? 1e-3 : 1e-6;
  }
} // namespace NMM
