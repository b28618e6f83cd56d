#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters_contact.h>
#include <nmm/scene/scene_parameters_dynamics.h>

#include <algorithm>
#include <cmath>
#include <scene/law_entries.h>
#include <scene/parsing.h>

// This file has the parameters of contact: faces, laws and obstacles.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<Enforcement> enforcements = {
      {"none", Enforcement::none},
      {"penalty", Enforcement::penalty},
      {"augmented Lagrangian", Enforcement::augmented_lagrangian}};

    const LawEntries<ContactLaw> &
    contact_law_entries()
    {
      static const LawEntries<ContactLaw> entries(contact_laws());
      return entries;
    }


    const Words<ContactIntegration> integrations = {
      {"length", ContactIntegration::length},
      {"points", ContactIntegration::points}};

    constexpr const char *any_face = "any";
  } // namespace


  // Bounds are checked in check(), whose messages say what to do.
  void
  ContactLawParameters::list_entries(Entries &entries)
  {
    if (!name.empty())
    {
      std::vector<std::string> names;
      entries.add("Between",
                  names,
                  "Two names of boundaries, holes, joints or obstacles, or "
                  "any. Both may be the same: the faces of a joint.");
      AssertThrow(
        !entries.are_parsed() || names.size() == 2,
        InputError("'" + join(names) + "' is " + std::to_string(names.size()) +
                     " name(s) instead of two",
                   place("Between"),
                   "name the two faces the law holds between, or write any"));
      for (unsigned int i = 0; i < names.size(); ++i)
        between[i] = names[i] == any_face ? "" : names[i];
    }

    contact_law_entries().list(entries, law_name, values);
    entries.add("Bonded",
                is_bonded,
                "Faces that touch at the start hold together until tension or "
                "shear exceeds their strength.");
  }


  std::unique_ptr<ContactLaw>
  ContactLawParameters::parsed_law() const
  {
    std::unique_ptr<ContactLaw> law =
      contact_law_entries().make(law_name, values);
    law->is_bond = is_bonded;
    return law;
  }


  std::shared_ptr<const ContactLaw>
  ContactLawParameters::make_law(const ContactLaw &springs) const
  {
    std::unique_ptr<ContactLaw> law = parsed_law();
    if (law->normal_stiffness == 0.)
      law->normal_stiffness = springs.normal_stiffness;
    if (law->shear_stiffness == 0.)
      law->shear_stiffness =
        std::min(springs.shear_stiffness, law->normal_stiffness);
    return law;
  }


  std::string
  ContactLawParameters::place(const std::string &key) const
  {
    return "parameter 'Contact/" + (name.empty() ? "" : name + "/") + key + "'";
  }


  void
  ContactLawParameters::check() const
  {
    const std::unique_ptr<ContactLaw> law = parsed_law();
    contact_law_entries().check(
      law_name, values, [this](const std::string &key) { return place(key); });
    AssertThrow(is_bonded || law->tensile_strength == 0.,
                InputError("a tensile strength of " +
                             to_text(law->tensile_strength) +
                             " Pa is given for faces that are not bonded",
                           place("Tensile strength"),
                           "set 'Bonded = true', or remove it"));
    AssertThrow(values.at("Dilation angle") <= values.at("Friction angle"),
                InputError("the dilation angle is " +
                             to_text(values.at("Dilation angle")) + " degrees",
                           place("Dilation angle"),
                           "give an angle from 0 to the friction angle, which "
                           "is " +
                             to_text(values.at("Friction angle")) +
                             " degrees"));
    AssertThrow(law->dilation > 0. || law->dilation_limit == 0.,
                InputError("a dilation limit of " +
                             to_text(law->dilation_limit) +
                             " m is given for faces that do not dilate",
                           place("Dilation limit"),
                           "set 'Dilation angle', or remove it"));
    // Stiffnesses that are left open are chosen later, so they pass the check.
    if (law->normal_stiffness == 0.)
      law->normal_stiffness = 1.;
    law->check("section 'Contact" + (name.empty() ? "" : "/" + name) + "'");
  }


  void
  ContactSectionParameters::list_entries(
    Entries                        &entries,
    const std::vector<std::string> &law_names)
  {
    entries.add(
      "Enforcement",
      enforcement,
      enforcements,
      "none: faces do not feel each other; penalty: springs keep them apart, "
      "all analyses; augmented Lagrangian: static analysis, pressures on top "
      "of the springs until the penetration is below its tolerance.");
    entries.add("Penetration tolerance",
                penetration_tolerance,
                Patterns::Double(),
                "augmented Lagrangian: mean penetration that is allowed [m]; "
                "0: 1e-5 of the cell size at faces.");
    entries.add("Reach",
                reach,
                Patterns::Double(),
                "Distance within which faces are looked at [m]; 0: a tenth of "
                "the longest edge of an element. Time steps look further where "
                "something moves fast.");
    entries.add("Largest penetration",
                max_penetration,
                Patterns::Double(),
                "A step fails in which faces are deeper in each other [m]; 0: "
                "the cell size at faces.");
    entries.add("Corner rounding",
                corner_rounding,
                Patterns::Double(0.),
                "Length of its faces within which the corner of a block gives "
                "way that would slide into a face ahead [m]; 0: safety factor "
                "1.5 times the largest displacement, otherwise a hundredth of "
                "the cell size at faces.");
    entries.add("Number of points",
                n_points,
                Patterns::Integer(2, 20),
                "Contact points on each piece of an edge (Gauss-Lobatto); "
                "round faces are divided into short pieces.");
    entries.add(
      "Integration",
      integration,
      integrations,
      "length: springs along faces; points: springs at vertices, whose "
      "stiffness is a force over a length per thickness [N/m^2] (0: chosen "
      "with h = 1 m), cohesion and strength forces per thickness [N/m].");
    entries.add("Open joints",
                open_joints,
                "Joints whose faces are in contact here, though the geometry "
                "says closed (tied).");
    entries.add("Tied joints",
                tied_joints,
                "Joints that are tied here, though the geometry says open.");
    law.list_entries(entries);
    entries.subsections(law_names,
                        laws,
                        "Names of laws between certain faces, each with a "
                        "subsection of its own; the first one that fits holds, "
                        "and the values of this section for all other faces.",
                        [&](ContactLawParameters &one,
                            const std::string    &name) {
                          one.name = name;
                          one.list_entries(entries);
                        });
  }


  void
  ContactSectionParameters::check() const
  {
    if (!is_present())
    {
      ContactSectionParameters standard;
      Entries given(Entries::Stage::note), defaults(Entries::Stage::note);
      std::vector<std::string> law_names;
      for (const ContactLawParameters &other : laws)
        law_names.push_back(other.name);
      ContactSectionParameters(*this).list_entries(given, law_names);
      standard.list_entries(defaults, {});
      expect_defaults("Contact",
                      given,
                      defaults,
                      "a scene without contact",
                      "remove it, or set 'Contact/Enforcement = penalty'");
      return;
    }
    const bool is_augmented = enforcement == Enforcement::augmented_lagrangian;
    if (!is_augmented)
      expect_default("Contact",
                     "Penetration tolerance",
                     penetration_tolerance,
                     0.,
                     "the penalty method",
                     "remove it, or set 'Enforcement = augmented Lagrangian'");
    if (integration == ContactIntegration::points)
    {
      const ContactSectionParameters defaults;
      expect_default("Contact",
                     "Number of points",
                     n_points,
                     defaults.n_points,
                     "springs at vertices",
                     "remove it, or set 'Integration = length'");
    }
    for (const auto &[key, value] :
         {std::make_pair("Penetration tolerance", penetration_tolerance),
          std::make_pair("Reach", reach),
          std::make_pair("Largest penetration", max_penetration)})
      AssertThrow(value >= 0. && std::isfinite(value),
                  InputError(std::string("'") + key + "' is " + to_text(value),
                             std::string("parameter 'Contact/") + key + "'",
                             "give a length, or 0 to have it chosen"));
    law.check();
    for (const ContactLawParameters &other : laws)
      other.check();
  }


  void
  ObstacleParameters::list_entries(Entries &entries)
  {
    entries.add("Shape",
                shape,
                "A shape as in geometry files: LINESTRING (...), "
                "CIRCULARSTRING (...), COMPOUNDCURVE (...) with the rigid body "
                "on the left, or POLYGON (...), CURVEPOLYGON (...), CIRCLE "
                "(...), which is rigid inside. Either this or File.");
    entries.add("File",
                file,
                "Geometry file, relative to the folder of the scene file, with "
                "a record of one curve.");
    entries.add(
      "Displacement",
      displacement,
      "'ux; uy' [m], each an expression of t, or 'file: name'; t is the time "
      "[s], or the load factor of a static analysis. Empty: at rest.");
    entries.add(
      "Release time",
      release_time,
      Patterns::Double(),
      "Dynamic analysis: it is gone from this time on [s]. Negative: never.");
  }


  void
  ObstacleParameters::check() const
  {
    AssertThrow(shape.empty() != file.empty(),
                InputError("the obstacle '" + name + "' has " +
                             (shape.empty() ? "no" : "more than one") +
                             " shape",
                           "section 'Obstacles/" + name + "'",
                           "set either 'Shape' or 'File'"));
  }
} // namespace NMM
