#include <nmm/base/exceptions.h>
#include <nmm/materials/material.h>
#include <nmm/scene/scene_parameters.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <map>
#include <optional>
#include <scene/expression.h>
#include <scene/law_entries.h>
#include <scene/parsing.h>
#include <sstream>

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

    const Words<bool> in_situ_types = {{"none", false}, {"K0", true}};

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
      {"normal displacement", BoundaryCondition::Type::normal_displacement},
      {"absorbing", BoundaryCondition::Type::absorbing},
      {"free field", BoundaryCondition::Type::free_field}};

    /// The first word stands for no wave.
    const Words<std::optional<BoundaryCondition::Wave>> waves = {
      {"none", std::nullopt},
      {"velocity", BoundaryCondition::Wave::velocity},
      {"stress", BoundaryCondition::Wave::stress}};

    const Words<bool> holds_at_rest = {{"fixed", false}, {"normal", true}};

    const Words<std::array<bool, 2>> component_choices = {
      {"x, y", {{true, true}}},
      {"x", {{true, false}}},
      {"y", {{false, true}}}};


    /// Reads 3 or 4 numbers separated by commas, or else expressions of x and y separated by
    /// semicolons, into the initial stress of @p material. @throws InputError for another text.
    void
    read_initial_stress(const std::string &text, Material &material)
    {
      const std::string parameter =
        "Materials/" + material.name + "/Initial stress";
      const auto check_number = [&](const std::size_t n) {
        AssertThrow(n == 3 || n == 4,
                    InputError("'" + text + "' has " + std::to_string(n) +
                                 " component(s) instead of 3 or 4",
                               "parameter '" + parameter + "'",
                               "give sxx, syy, sxy as numbers separated by "
                               "commas, or as expressions of x and y separated "
                               "by semicolons, and szz if it is needed"));
      };
      if (text.find(';') != std::string::npos)
      {
        const auto parts = dealii::Utilities::split_string_list(text, ';');
        check_number(parts.size());
        material.varying_initial_stress =
          parse_expressions<2>(parts, "x,y", parameter);
        return;
      }
      const auto parts = dealii::Utilities::split_string_list(text, ',');
      check_number(parts.size());
      std::vector<double> components;
      for (const std::string &part : parts)
      {
        AssertThrow(Patterns::Double().match(part),
                    InputError("'" + part + "' is no number",
                               "parameter '" + parameter + "'",
                               "give numbers separated by commas, or "
                               "expressions of x and y separated by "
                               "semicolons"));
        components.push_back(dealii::Utilities::string_to_double(part));
      }
      material.initial_stress[0][0] = components[0];
      material.initial_stress[1][1] = components[1];
      material.initial_stress[0][1] = components[2];
      if (components.size() == 4)
        material.given_initial_stress_zz = components[3];
    }


    /// Reads a number; none if @p text is empty. @throws InputError.
    std::optional<double>
    read_optional(const std::string &text, const std::string &parameter)
    {
      if (text.empty())
        return std::nullopt;
      AssertThrow(Patterns::Double().match(text),
                  InputError("'" + text + "' is no number",
                             "parameter '" + parameter + "'",
                             "give a number, or leave it empty"));
      return dealii::Utilities::string_to_double(text);
    }


    std::string
    text_of(const std::optional<double> &value)
    {
      return value ? to_text(*value) : "";
    }


    std::string
    text_of(const std::vector<dealii::Point<2>> &line)
    {
      if (line.size() == 1 && line[0][0] == 0.)
        return to_text(line[0][1]);
      std::vector<std::string> points;
      for (const dealii::Point<2> &x : line)
        points.push_back(to_text(x[0]) + " " + to_text(x[1]));
      return join(points);
    }


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
    std::string wet_density = text_of(material.wet_density);
    entries.add("Wet density",
                wet_density,
                "Mass per volume below a water table, where it counts for the "
                "weight instead of 'Density' [kg/m^3]. Empty: the same.");
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

    const auto              &stress     = material.initial_stress;
    std::vector<std::string> components = {to_text(stress[0][0]),
                                           to_text(stress[1][1]),
                                           to_text(stress[0][1])};
    if (material.given_initial_stress_zz)
      components.push_back(to_text(*material.given_initial_stress_zz));
    std::string initial_stress = join(components);
    entries.add("Initial stress",
                initial_stress,
                "sigma_xx, sigma_yy, sigma_xy before any load, tension "
                "positive, and in plane strain sigma_zz; without it nu "
                "(sigma_xx + sigma_yy) [Pa]. Expressions of x and y, separated "
                "by semicolons, for a stress that varies.");
    if (!entries.are_parsed())
      return;
    material_law_entries().check(law_name, values, [&](const std::string &key) {
      return "parameter 'Materials/" + material.name + "/" + key + "'";
    });
    material.law = material_law_entries().make(law_name, values);
    material.wet_density =
      read_optional(wet_density, "Materials/" + material.name + "/Wet density");
    read_initial_stress(initial_stress, material);
  }


  void
  InSituStressParameters::list_entries(Entries &entries)
  {
    entries.add("Type",
                is_present,
                in_situ_types,
                "K0: materials begin with the stress of the weight above, "
                "sigma_yy, and sigma_xx = K0 sigma_yy; none: with their "
                "'Initial stress'.");
    std::string ratio = text_of(K0), across = text_of(K0_out_of_plane),
                line = text_of(ground_line);
    entries.add("K0",
                ratio,
                "sigma_xx / sigma_yy [-]. Empty: nu / (1 - nu) of each "
                "material, that of ground that was loaded without sideways "
                "strain; in plane stress nu.");
    entries.add("K0 out of plane",
                across,
                "sigma_zz / sigma_yy in plane strain [-]. Empty: K0.");
    entries.add("Ground line",
                line,
                "Elevation y of the ground, or points 'x y, x y' of it from "
                "left to right; what lies above it has no part in the stress "
                "[m]. Empty: the upper surface of the solid.");
    entries.add("Unit weight above",
                unit_weight_above,
                Patterns::Double(0),
                "Unit weight of what lies between the solid and the ground "
                "line [N/m^3].");
    if (!entries.are_parsed())
      return;
    K0              = read_optional(ratio, "In-situ stress/K0");
    K0_out_of_plane = read_optional(across, "In-situ stress/K0 out of plane");
    ground_line     = read_line(line, "In-situ stress/Ground line");
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
      "the boundary (0: a symmetry line); absorbing: waves leave through it in "
      "a dynamic analysis, and at rest it is held; free field: the same on a "
      "vertical side, beside a column of the ground that moves with the upward "
      "wave.");
    entries.add("Value",
                value,
                "Expression of x and y: one for pressures [Pa] and normal "
                "displacement [m], two separated by a semicolon for traction "
                "[Pa], displacement [m] and the upward wave. Empty: zero. pi, "
                "the usual functions and if(condition, a, b) are known.");
    add_components(entries, components);
    entries.add("Upward wave",
                wave,
                waves,
                "Absorbing: what comes in through the boundary, free field: "
                "through the base of its column; Value times Amplitude. "
                "velocity: that of the incoming wave itself, half "
                "of what an outcrop shows [m/s]; stress: the traction that "
                "this wave exerts on the solid, for shear rho c_s times its "
                "velocity [Pa]. Both are applied with the factor 2, since the "
                "dashpots take as much as the wave brings.");
    entries.add(
      "At rest",
      slides_at_rest,
      holds_at_rest,
      "Absorbing, free field: how it is held where nothing moves in "
      "time, and until a motion begins; fixed: in both directions; normal: "
      "free to slide along the boundary.");
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
    const bool is_absorbing = type == BoundaryCondition::Type::absorbing ||
                              type == BoundaryCondition::Type::free_field;
    AssertThrow(is_absorbing || (!wave && !slides_at_rest),
                InputError("'Upward wave' or 'At rest' is given for a "
                           "condition that absorbs no waves",
                           section,
                           "remove it, or set 'Type' to absorbing or free "
                           "field"));
    const bool has_value = value.find_first_not_of(" \t") != std::string::npos;
    AssertThrow(!is_absorbing || has_value == wave.has_value(),
                InputError(has_value ? "a value is given, but not of what"
                                     : "an upward wave without a value",
                           section,
                           has_value ? "set 'Upward wave' to velocity or stress"
                                     : "set 'Value' to its two components"));
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
