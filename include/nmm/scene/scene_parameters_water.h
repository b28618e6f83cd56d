#ifndef nmm_scene_scene_parameters_water_h
#define nmm_scene_scene_parameters_water_h

#include <nmm/mechanics/joint_water_term.h>
#include <nmm/mechanics/water.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// The section `Water`.
  struct WaterParameters
  {
    /// Where the pressure in joints comes from.
    enum class JointPressure
    {
      none,
      table,
      given,
      network
    };

    /// Elevation of the table, points of it, or an expression of x; empty: there is none.
    std::string table;
    /// Unit weight of water [N/m^3].
    double unit_weight = WaterTable().unit_weight;
    /// Names of the outer faces it presses on, or the word `none`; empty: those of Water::faces that
    /// are not given.
    std::vector<std::string> faces;
    /// Where the pressure in joints comes from.
    JointPressure joint_pressure = JointPressure::table;
    /// Pressure in joints, an expression of x and y [Pa].
    std::string given_pressure;
    /// Water that flows in the network of joints, but for the table and the amplitude.
    JointWater flow;
    /// Whether blocks have pores full of water.
    bool fills_pores = false;

    /// Whether the scene has water.
    bool
    is_present() const;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);

    /// Checks the values. @throws InputError for one that is missing or not used.
    void
    check() const;

    /// The water that flows in joints; `joint_pressure` is `network`. Its pressure grows with the load
    /// factor up to 1 if @p is_at_rest. @throws InputError for an expression that cannot be parsed.
    JointWater
    make_flow(bool is_at_rest) const;

    /// The water with the table @p text, which is that of the parameter @p name. @throws InputError
    /// for an expression that cannot be parsed.
    Water
    make_water(const std::string &text,
               const std::string &name = "Water/Table") const;
  };
} // namespace NMM

#endif
