#include <nmm/base/exceptions.h>
#include <nmm/materials/material.h>
#include <nmm/scene/scene_parameters.h>

#include <cmath>
#include <map>
#include <optional>
#include <scene/law_entries.h>
#include <scene/parsing.h>

// This file has the parameters of the physics: materials, model, loads and supports.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    /// The last word stands for no kinematics of scenes.
    const Words<std::optional<Kinematics>> kinematics_choices = {
      {"small", Kinematics::small},
      {"finite", Kinematics::finite},
      {"incremental", std::nullopt}};

    const Words<PlaneState> plane_states = {
      {"plane stress", PlaneState::plane_stress},
      {"plane strain", PlaneState::plane_strain}};

    const LawEntries<MaterialLaw> &
    material_law_entries()
    {
      static const LawEntries<MaterialLaw> entries(material_laws());
      return entries;
    }


    const Words<BoundaryCondition::Type> condition_types = {
      {"traction", BoundaryCondition::Type::traction},
      {"pressure", BoundaryCondition::Type::pressure},
      {"follower pressure", BoundaryCondition::Type::follower_pressure},
      {"displacement", BoundaryCondition::Type::displacement},
      {"normal displacement", BoundaryCondition::Type::normal_displacement}};

    const Words<std::array<bool, 2>> component_choices = {
      {"x, y", {{true, true}}},
      {"x", {{true, false}}},
      {"y", {{false, true}}}};


    void
    add_components(Entries &entries, std::array<bool, 2> &components)
    {
      entries.add("Components",
                  components,
                  component_choices,
                  "Which components are prescribed; the others are free.");
    }
  } // namespace


  const std::string &
  to_string(const Kinematics kinematics)
  {
    return word_of(std::optional<Kinematics>(kinematics), kinematics_choices);
  }


  void
  MaterialParameters::list_entries(Entries &entries, Material &material)
  {
    entries.add("Young's modulus",
                material.youngs_modulus,
                Patterns::Double(0),
                "E, > 0, must be set [Pa].");
    entries.add("Poisson's ratio",
                material.poissons_ratio,
                Patterns::Double(-1, 0.5),
                "nu, larger than -1 and less than 0.5 [-].");
    entries.add("Density",
                material.density,
                Patterns::Double(0),
                "rho, the mass per volume that gravity acts on [kg/m^3].");
    entries.add("Toughness",
                material.toughness,
                Patterns::Double(0),
                "K_c: cracks grow where their intensity factor reaches it; 0: "
                "not known, cracks must not grow in it [Pa m^0.5].");
    entries.add("Fracture strength",
                material.fracture_strength,
                Patterns::Double(0),
                "f_t: where cracks grow, new ones start at boundaries and "
                "holes where the mean stress over the length 2/pi (K_c/f_t)^2 "
                "reaches it; 0: none start [Pa].");
    std::map<std::string, double> values;
    std::string law_name = material_law_entries().read(*material.law, values);
    material_law_entries().list(entries, law_name, values);

    const auto         &stress     = material.initial_stress;
    std::vector<double> components = {stress[0][0], stress[1][1], stress[0][1]};
    if (material.given_initial_stress_zz)
      components.push_back(*material.given_initial_stress_zz);
    entries.add("Initial stress",
                components,
                Patterns::List(Patterns::Double(), 3, 4, ","),
                "sigma_xx, sigma_yy, sigma_xy before any load, tension "
                "positive, and in plane strain sigma_zz; without it nu "
                "(sigma_xx + sigma_yy) [Pa].");
    if (!entries.are_parsed())
      return;
    material_law_entries().check(law_name, values, [&](const std::string &key) {
      return "parameter 'Materials/" + material.name + "/" + key + "'";
    });
    material.law = material_law_entries().make(law_name, values);
    material.initial_stress[0][0] = components[0];
    material.initial_stress[1][1] = components[1];
    material.initial_stress[0][1] = components[2];
    if (components.size() == 4)
      material.given_initial_stress_zz = components[3];
  }


  void
  ModelParameters::list_entries(Entries &entries)
  {
    list_entry(entries, analysis);
    std::optional<Kinematics> choice = kinematics;
    entries.add(
      "Kinematics",
      choice,
      kinematics_choices,
      "small: displacements so small that one linear problem tells all; "
      "finite: displacements and rotations of any size, by Newton's method; "
      "incremental: not for scenes, see step-nmm-2.");
    AssertThrow(choice,
                InputError("'incremental', the paper's step-by-step scheme, is "
                           "compared in the tutorial program step-nmm-2 and "
                           "not available in scenes",
                           "parameter 'Model/Kinematics'",
                           "set it to small or finite"));
    kinematics = *choice;
    entries.add(
      "Plane state",
      plane_state,
      plane_states,
      "plane stress: a thin plate; plane strain: a slice of a long body.");
    entries.add("Thickness",
                thickness,
                Patterns::Double(0),
                "Thickness of the plate or slice, > 0 [m].");
    entries.add("Gravity",
                gravity,
                "Acceleration of gravity gx, gy; acts on the materials' "
                "densities [m/s^2].");
    entries.add("Body force",
                body_force,
                "Further force per volume: expressions 'fx; fy' of x and y "
                "[N/m^3]. Empty: none.");
    const auto add_amplitude = [&entries](const std::string &key,
                                          std::string       &amplitude) {
      entries.add(
        key,
        amplitude,
        "Dynamic analysis: factor on it, an expression of the time t, or "
        "'file: name' of a file with lines of time and factor. Empty: 1.");
    };
    add_amplitude("Gravity amplitude", gravity_amplitude);
    add_amplitude("Body force amplitude", body_force_amplitude);
    entries.add(
      "Base acceleration",
      base_acceleration,
      "Dynamic analysis: acceleration 'ax; ay' of the ground, e.g. in an "
      "earthquake [m/s^2], each an expression of the time t or 'file: name'. "
      "Displacements are then those relative to the ground. Empty: at rest.");
    AssertThrow(!entries.are_parsed() || thickness > 0.,
                InputError("the thickness is 0 m",
                           "parameter 'Model/Thickness'",
                           "give a positive length"));
  }


  void
  BoundaryConditionParameters::list_entries(Entries &entries)
  {
    entries.add("Boundary",
                boundaries,
                "Names of the boundary or hole curves it holds on.");
    entries.add(
      "Type",
      type,
      condition_types,
      "traction: force per area; pressure: force per area along the inward "
      "normal of the undeformed solid; follower pressure: pressure that turns "
      "with the surface and acts on its current area (small kinematics: the "
      "same as pressure); displacement: prescribed by component; normal "
      "displacement: prescribed along the outward normal, free to slide along "
      "the boundary (0: a symmetry line).");
    entries.add("Value",
                value,
                "Expression of x and y: one for pressures [Pa] and normal "
                "displacement [m], two separated by a semicolon for traction "
                "[Pa] and displacement [m]. Empty: zero. pi, the usual "
                "functions and if(condition, a, b) are known.");
    add_components(entries, components);
    time.name = name;
    time.list_entries(entries, /* may_be_released = */ true);
  }


  void
  BoundaryConditionParameters::check() const
  {
    const std::string section = "section 'Boundary conditions/" + name + "'";
    AssertThrow(!boundaries.empty(),
                InputError("a condition without a boundary",
                           section,
                           "set 'Boundary' to a curve of the geometry"));
    AssertThrow(
      type == BoundaryCondition::Type::displacement ||
        (components[0] && components[1]),
      InputError(
        "components are chosen for a condition that has none to choose",
        section,
        "remove 'Components', or set 'Type = displacement'"));
  }


  void
  PointForceParameters::list_entries(Entries &entries)
  {
    entries.add("Point",
                force.point,
                "Point of the solid it acts at, x, y [m].");
    entries.add("Force", force.force, "Fx, Fy per unit thickness [N/m].");
    time.name = name;
    time.list_entries(entries, /* may_be_released = */ false);
  }


  void
  FixedPointParameters::list_entries(Entries &entries)
  {
    entries.add("Point",
                point.point,
                "Point of the solid that is held, x, y [m].");
    entries.add("Displacement",
                point.displacement,
                "Displacement it is held at, ux, uy [m].");
    entries.add("Stiffness",
                point.stiffness,
                Patterns::Double(0),
                "Stiffness of the spring that holds it, per unit thickness "
                "[N/m per m]; 0: 1000 times the largest Young's modulus.");
    std::array<bool, 2> components = {
      {point.components[0], point.components[1]}};
    add_components(entries, components);
    point.components[0] = components[0];
    point.components[1] = components[1];
    time.name           = name;
    time.list_entries(entries, /* may_be_released = */ true);
  }
} // namespace NMM
