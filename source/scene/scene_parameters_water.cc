#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters_water.h>

#include <algorithm>
#include <scene/expression.h>
#include <scene/parsing.h>
#include <tuple>

// This file has the parameters of water.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    using JointPressure = WaterParameters::JointPressure;

    const Words<JointPressure> joint_pressures = {
      {"none", JointPressure::none},
      {"table", JointPressure::table},
      {"given", JointPressure::given},
      {"network", JointPressure::network}};


    /// The elevation of a table: points, or an expression, which has an x or
    /// parentheses.
    std::function<double(double)>
    parse_table(const std::string &text, const std::string &parameter)
    {
      if (text.find_first_of("x(") == std::string::npos)
        return line_by_points(read_line(text, parameter),
                              "parameter '" + parameter + "'");
      const auto function = parse_expressions<1>({text}, "x", parameter);
      return [function](const double x) {
        return function->value(dealii::Point<1>(x));
      };
    }
  } // namespace


  bool
  WaterParameters::is_present() const
  {
    return !table.empty() || (joint_pressure != JointPressure::none &&
                              joint_pressure != JointPressure::table);
  }


  void
  WaterParameters::list_entries(Entries &entries)
  {
    entries.add("Table",
                table,
                "Elevation y of the water table, points 'x y, x y' of it from "
                "left to right, or an expression of x [m]. Empty: no water.");
    entries.add("Unit weight",
                unit_weight,
                Patterns::Double(0),
                "Of water, > 0 [N/m^3].");
    entries.add("Faces",
                faces,
                "Boundaries and holes on which the pressure of the table acts, "
                "or none. Empty: all boundaries on which no displacement is "
                "prescribed, while holes are dry.");
    entries.add("Joint pressure",
                joint_pressure,
                joint_pressures,
                "Pressure in open joints and cracks, on both of their faces, "
                "so that contact bears the effective stress: none, that of the "
                "table, the given one, or that of steady flow in the network "
                "of joints.");
    entries.add("Given joint pressure",
                given_pressure,
                "given: expression of x and y [Pa].");
    const auto add = [&](const char *key, double &value, const char *help) {
      entries.add(key, value, Patterns::Double(0), help);
    };
    add("Viscosity", flow.viscosity, "network: of water, > 0 [Pa s].");
    add("Aperture",
        flow.aperture,
        "network: aperture of a joint whose faces touch without effective "
        "stress, > 0; contact closes it, and opening widens it [m].");
    add("Residual aperture",
        flow.residual_aperture,
        "network: least aperture for the flow, > 0 [m].");
    add("Largest aperture",
        flow.largest_aperture,
        "network: largest aperture for the flow [m].");
    entries.add("Impermeable",
                flow.impermeable,
                "network: boundaries and holes through which nothing flows.");
    entries.add("Pores",
                fills_pores,
                "Whether blocks have pores full of water below the table. "
                "Their stress and strength are then effective ones, and "
                "buoyancy and seepage are body forces.");
  }


  void
  WaterParameters::check() const
  {
    AssertThrow(unit_weight > 0.,
                InputError("the unit weight of water is 0",
                           "parameter 'Water/Unit weight'",
                           "give a positive number of N/m^3"));
    const bool is_given = joint_pressure == JointPressure::given;
    AssertThrow(is_given != given_pressure.empty(),
                InputError(is_given ? "the joint pressure is to be given, but "
                                      "there is none"
                                    : "the given joint pressure is not used",
                           "parameter 'Water/Given joint pressure'",
                           is_given ? "give an expression of x and y"
                                    : "set 'Joint pressure = given', or remove "
                                      "it"));
    AssertThrow(!fills_pores || !table.empty(),
                InputError("there is no table below which pores are full",
                           "parameter 'Water/Pores'",
                           "set 'Table', or remove it"));
    AssertThrow(joint_pressure != JointPressure::network || !table.empty(),
                InputError("there is no table that gives heads at boundaries",
                           "parameter 'Water/Joint pressure'",
                           "set 'Table'"));
    if (joint_pressure == JointPressure::network)
      make_flow(true).check();
    else
    {
      const WaterParameters defaults;
      for (const auto &[key, value, standard] :
           {std::make_tuple("Viscosity",
                            flow.viscosity,
                            defaults.flow.viscosity),
            std::make_tuple("Aperture", flow.aperture, 0.),
            std::make_tuple("Residual aperture", flow.residual_aperture, 0.),
            std::make_tuple("Largest aperture", flow.largest_aperture, 0.)})
        expect_default("Water",
                       key,
                       value,
                       standard,
                       "water that does not flow",
                       "set 'Joint pressure = network', or remove it");
    }
    if (!is_present())
      expect_defaults("Water",
                      *this,
                      "a scene without water",
                      "set 'Table', or remove it");
  }


  JointWater
  WaterParameters::make_flow(const bool is_at_rest) const
  {
    JointWater result = flow;
    result.table      = {parse_table(table, "Water/Table"), unit_weight};
    if (is_at_rest)
      result.amplitude = [](const double t) { return std::min(1., t); };
    return result;
  }


  Water
  WaterParameters::make_water(const std::string &text,
                              const std::string &name) const
  {
    Water water;
    if (!text.empty())
      water.table =
        hydrostatic_pressure({parse_table(text, name), unit_weight});
    if (joint_pressure == JointPressure::table)
      water.in_joints = water.table;
    else if (joint_pressure == JointPressure::given)
      water.in_joints = parse_expressions<2>({given_pressure},
                                             "x,y",
                                             "Water/Given joint pressure");
    if (faces.size() == 1 && faces[0] == "none")
      water.faces.emplace();
    else if (!faces.empty())
      water.faces = faces;
    water.fills_pores = fills_pores;
    return water;
  }
} // namespace NMM
