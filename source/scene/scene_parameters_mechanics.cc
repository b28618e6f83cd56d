#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <cmath>
#include <scene/parsing.h>

// Materials, model, loads and supports: the physics of a scene.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const std::vector<std::pair<std::string, Kinematics>> kinematics_choices = {
      {"small", Kinematics::small},
      {"finite", Kinematics::finite},
      {"incremental", Kinematics::incremental}};

    const std::vector<std::pair<std::string, PlaneState>> plane_states = {
      {"plane stress", PlaneState::plane_stress},
      {"plane strain", PlaneState::plane_strain}};

    const std::vector<std::pair<std::string, MaterialLaw>> laws = {
      {"linear", MaterialLaw::linear},
      {"St. Venant-Kirchhoff", MaterialLaw::st_venant_kirchhoff},
      {"neo-Hookean", MaterialLaw::neo_hookean}};

    const std::vector<std::pair<std::string, BoundaryCondition::Type>>
      condition_types = {
        {"traction", BoundaryCondition::Type::traction},
        {"pressure", BoundaryCondition::Type::pressure},
        {"follower pressure", BoundaryCondition::Type::follower_pressure},
        {"displacement", BoundaryCondition::Type::displacement},
        {"normal displacement", BoundaryCondition::Type::normal_displacement}};

    const std::vector<std::pair<std::string, std::array<bool, 2>>>
      component_choices = {{"x, y", {{true, true}}},
                           {"x", {{true, false}}},
                           {"y", {{false, true}}}};
  } // namespace


  namespace internal
  {
    void
    declare_components(ParameterHandler &prm)
    {
      prm.declare_entry("Components",
                        "x, y",
                        selection(component_choices),
                        "Which components are prescribed; the others are "
                        "free.");
    }


    std::array<bool, 2>
    get_components(const ParameterHandler &prm)
    {
      return get_selection(prm, "Components", component_choices);
    }
  } // namespace internal


  const std::string &
  to_string(const Kinematics kinematics)
  {
    for (const auto &choice : kinematics_choices)
      if (choice.second == kinematics)
        return choice.first;
    AssertThrow(false, dealii::ExcInternalError());
    return kinematics_choices.front().first;
  }


  void
  MaterialParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Young's modulus",
                      "0",
                      Patterns::Double(0),
                      "E, > 0, must be set [Pa].");
    prm.declare_entry("Poisson's ratio",
                      "0",
                      Patterns::Double(-1, 0.5),
                      "nu, larger than -1 and less than 0.5 [-].");
    prm.declare_entry("Density",
                      "0",
                      Patterns::Double(0),
                      "rho, the mass per volume that gravity acts on "
                      "[kg/m^3].");
    prm.declare_entry("Law",
                      "linear",
                      selection(laws),
                      "Finite kinematics: stress from deformation. linear and "
                      "St. Venant-Kirchhoff: the second Piola-Kirchhoff stress "
                      "is linear in the Green-Lagrange strain; neo-Hookean: "
                      "for large strains. Small and incremental kinematics are "
                      "linear.");
    prm.declare_entry("Initial stress",
                      "0, 0, 0",
                      Patterns::List(Patterns::Double(), 3, 3, ","),
                      "sigma_xx, sigma_yy, sigma_xy before any load, tension "
                      "positive [Pa].");
  }


  Material
  MaterialParameters::parse(ParameterHandler &prm, const std::string &name)
  {
    Material material;
    material.name             = name;
    material.youngs_modulus   = prm.get_double("Young's modulus");
    material.poissons_ratio   = prm.get_double("Poisson's ratio");
    material.density          = prm.get_double("Density");
    material.law              = get_selection(prm, "Law", laws);
    const auto initial_stress = dealii::Utilities::string_to_double(
      dealii::Utilities::split_string_list(prm.get("Initial stress"), ','));
    material.initial_stress[0][0] = initial_stress[0];
    material.initial_stress[1][1] = initial_stress[1];
    material.initial_stress[0][1] = initial_stress[2];
    return material;
  }


  void
  ModelParameters::declare(ParameterHandler &prm)
  {
    declare_analysis(prm);
    prm.declare_entry("Kinematics",
                      "small",
                      selection(kinematics_choices),
                      "small: displacements so small that one linear problem "
                      "tells all; finite: displacements and rotations of any "
                      "size, by Newton's method; incremental: one linear "
                      "problem per step, stress and geometry carried "
                      "along, accurate to first order in the step.");
    prm.declare_entry("Plane state",
                      "plane stress",
                      selection(plane_states),
                      "plane stress: a thin plate; plane strain: a slice of a "
                      "long body.");
    prm.declare_entry("Thickness",
                      "1",
                      Patterns::Double(0),
                      "Thickness of the plate or slice, > 0 [m].");
    prm.declare_entry("Gravity",
                      "0, 0",
                      vector_pattern(),
                      "Acceleration of gravity gx, gy; acts on the materials' "
                      "densities [m/s^2].");
    prm.declare_entry("Body force",
                      "",
                      Patterns::Anything(),
                      "Further force per volume: expressions 'fx; fy' of x and "
                      "y [N/m^3]. Empty: none.");
    for (const char *load : {"Gravity", "Body force"})
      prm.declare_entry(std::string(load) + " amplitude",
                        "",
                        Patterns::Anything(),
                        "Dynamic analysis: factor on it, an expression of the "
                        "time t, or 'file: name' of a file with lines of time "
                        "and factor. Empty: 1.");
    prm.declare_entry(
      "Base acceleration",
      "",
      Patterns::Anything(),
      "Dynamic analysis: acceleration 'ax; ay' of the ground, e.g. in an "
      "earthquake [m/s^2], each an expression of the time t or 'file: name'. "
      "Displacements are then those relative to the ground. Empty: at rest.");
  }


  void
  ModelParameters::parse(ParameterHandler &prm)
  {
    kinematics           = get_selection(prm, "Kinematics", kinematics_choices);
    plane_state          = get_selection(prm, "Plane state", plane_states);
    thickness            = prm.get_double("Thickness");
    gravity              = get_point(prm, "Gravity");
    body_force           = prm.get("Body force");
    analysis             = get_analysis(prm);
    gravity_amplitude    = prm.get("Gravity amplitude");
    body_force_amplitude = prm.get("Body force amplitude");
    base_acceleration    = prm.get("Base acceleration");
    AssertThrow(thickness > 0.,
                InputError("the thickness is 0 m",
                           "parameter 'Model/Thickness'",
                           "give a positive length"));
  }


  void
  BoundaryConditionParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Boundary",
                      "",
                      Patterns::List(Patterns::Anything(), 0),
                      "Names of the boundary or hole curves it holds on.");
    prm.declare_entry(
      "Type",
      "traction",
      selection(condition_types),
      "traction: force per area; pressure: force per area along "
      "the inward normal of the undeformed solid; follower pressure: pressure "
      "that turns with the surface and acts on its current area (small "
      "kinematics: the same as pressure); displacement: prescribed by "
      "component; "
      "normal displacement: prescribed along the outward normal, "
      "free to slide along the boundary (0: a symmetry line).");
    prm.declare_entry(
      "Value",
      "",
      Patterns::Anything(),
      "Expression of x and y: one for pressures [Pa] and normal "
      "displacement [m], two separated by a semicolon for "
      "traction [Pa] and displacement [m]. Empty: zero. pi, the "
      "usual functions and if(condition, a, b) are known.");
    declare_components(prm);
    TimeDependence::declare(prm, /* may_be_released = */ true);
  }


  void
  BoundaryConditionParameters::parse(ParameterHandler &prm)
  {
    boundaries = get_names(prm, "Boundary");
    type       = get_selection(prm, "Type", condition_types);
    value      = prm.get("Value");
    components = get_components(prm);
    time.name  = name;
    time.parse(prm, /* may_be_released = */ true);
  }


  void
  BoundaryConditionParameters::check() const
  {
    const std::string section = "section 'Boundary conditions/" + name + "'";
    AssertThrow(!boundaries.empty(),
                InputError("a condition without a boundary",
                           section,
                           "set 'Boundary' to a curve of the geometry"));
    AssertThrow(type == BoundaryCondition::Type::displacement ||
                  (components[0] && components[1]),
                InputError("components are chosen for a condition that has "
                           "none to choose",
                           section,
                           "remove 'Components', or set 'Type = "
                           "displacement'"));
  }


  void
  PointForceParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Point",
                      "0, 0",
                      vector_pattern(),
                      "Point of the solid it acts at, x, y [m].");
    prm.declare_entry("Force",
                      "0, 0",
                      vector_pattern(),
                      "Fx, Fy per unit thickness [N/m].");
    TimeDependence::declare(prm, /* may_be_released = */ false);
  }


  PointForce
  PointForceParameters::parse(ParameterHandler &prm)
  {
    return {get_point(prm, "Point"), get_point(prm, "Force")};
  }


  void
  FixedPointParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Point",
                      "0, 0",
                      vector_pattern(),
                      "Point of the solid that is held, x, y [m].");
    prm.declare_entry("Displacement",
                      "0, 0",
                      vector_pattern(),
                      "Displacement it is held at, ux, uy [m].");
    prm.declare_entry("Stiffness",
                      "0",
                      Patterns::Double(0),
                      "Stiffness of the spring that holds it, per unit "
                      "thickness [N/m per m]; 0: 1000 times the largest "
                      "Young's modulus.");
    declare_components(prm);
    TimeDependence::declare(prm, /* may_be_released = */ true);
  }


  FixedPoint
  FixedPointParameters::parse(ParameterHandler &prm)
  {
    FixedPoint point;
    point.point           = get_point(prm, "Point");
    point.displacement    = get_point(prm, "Displacement");
    point.stiffness       = prm.get_double("Stiffness");
    const auto components = get_components(prm);
    point.components[0]   = components[0];
    point.components[1]   = components[1];
    return point;
  }
} // namespace NMM
