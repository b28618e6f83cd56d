#include <nmm/base/exceptions.h>
#include <nmm/scene/capabilities.h>
#include <nmm/scene/scene.h>

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

using namespace NMM;
using C = Capability;

// The table of what cannot be combined, against scenes that ask for it. A table that is wrong would
// make a page that is wrong.
namespace
{
  /// How a scene asks for a capability: others that it needs, and entries.
  struct Request
  {
    std::vector<C>           needs;
    std::vector<std::string> entries;
  };


  const std::map<C, Request> requests = {
    {C::statics, {{}, {"Model/Analysis=static"}}},
    {C::small_kinematics, {{}, {"Model/Kinematics=small"}}},
    {C::dynamics,
     {{},
      {"Model/Analysis=dynamic", "Time/End time=1", "Time/Initial step=0.1"}}},
    {C::relaxation, {{}, {"Model/Analysis=relaxation", "Relaxation/Step=0.1"}}},
    {C::safety_factor,
     {{},
      {"Model/Analysis=safety factor",
       "Relaxation/Step=0.1",
       "Safety factor/Largest displacement=0.1"}}},
    {C::stages,
     {{},
      {"Regions/pit/Use=staged",
       "Stages/Names=one",
       "Stages/one/Remove regions=pit"}}},
    {C::growth,
     {{C::intensity_factors},
      {"Fracture/Increments=1", "Fracture/Increment=0.1"}}},
    {C::finite_kinematics, {{}, {"Model/Kinematics=finite"}}},
    {C::large_strain_law, {{}, {"Materials/rock/Law=neo-Hookean"}}},
    {C::yielding,
     {{}, {"Materials/rock/Law=Mohr-Coulomb", "Materials/rock/Cohesion=1"}}},
    {C::initial_stress, {{}, {"Materials/rock/Initial stress=1, 0, 0"}}},
    {C::in_situ_stress,
     {{}, {"In-situ stress/Type=K0", "Model/Gravity=0, -9.81"}}},
    {C::bolts,
     {{},
      {"Bolts/Names=bar",
       "Bolts/bar/Path=LINESTRING (0.1 0.9, 0.4 0.6)",
       "Bolts/bar/Young's modulus=1",
       "Bolts/bar/Area=1",
       "Bolts/bar/Bond stiffness=1"}}},
    {C::water, {{}, {"Water/Table=0.5"}}},
    {C::pores, {{C::water}, {"Water/Pores=true"}}},
    {C::joint_flow,
     {{C::water},
      {"Water/Joint pressure=network",
       "Water/Aperture=1e-4",
       "Water/Residual aperture=1e-5",
       "Water/Largest aperture=1e-3"}}},
    {C::absorbing,
     {{},
      {"Boundary conditions/held/Type=absorbing",
       "Boundary conditions/held/Value="}}},
    {C::contact,
     {{}, {"Contact/Enforcement=penalty", "Contact/Friction angle=30"}}},
    {C::augmented_lagrangian,
     {{C::contact}, {"Contact/Enforcement=augmented Lagrangian"}}},
    {C::springs_at_points, {{C::contact}, {"Contact/Integration=points"}}},
    {C::dashpots, {{C::contact}, {"Contact/Normal damping=1"}}},
    {C::obstacles,
     {{},
      {"Obstacles/Names=floor",
       "Obstacles/floor/Shape=LINESTRING (2 -1, -1 -1)"}}},
    {C::moving_obstacles,
     {{C::obstacles}, {"Obstacles/floor/Displacement=0; t"}}},
    {C::restraints, {{}, {"Regions/prop/Use=restraint"}}},
    {C::sleep, {{}, {"Time/Sleep speed=0.1"}}},
    {C::intensity_factors, {{}, {"Fracture/Intensity factors=true"}}},
    {C::crack_starts, {{C::growth}, {"Materials/rock/Fracture strength=1"}}},
    {C::crack_speed, {{C::growth}, {"Fracture/Speed=1"}}},
    {C::tip_grading, {{}, {"Fracture/Tips=graded"}}},
    {C::loads_in_time, {{}, {"Model/Gravity amplitude=t"}}},
    {C::initial_velocities, {{}, {"Initial velocities/Names=start"}}},
    {C::limits, {{}, {"Regions/all/Use=limit"}}},
    {C::checkpoints, {{}, {"Output/Checkpoint every=2"}}},
    {C::gmsh_mesh,
     {{},
      {"Mathematical mesh/Type=gmsh", "Mathematical mesh/Gmsh file=a.msh"}}},
    {C::own_meshes, {{}, {"Covers/Own meshes=every region"}}},
    {C::merged_blocks,
     {{}, {"Geometry/Small blocks=merge", "Geometry/Small block area=0.01"}}},
    {C::ghost_penalty, {{}, {"Covers/Stabilization=ghost penalty"}}},
    {C::iterative_solver, {{}, {"Solver/Type=iterative"}}},
    {C::condition_number, {{}, {"Solver/Condition number=true"}}},
    {C::exact_solution,
     {{},
      {"Exact solution/Type=thick ring",
       "Exact solution/Inner boundary=square",
       "Exact solution/Outer boundary=square"}}},
    {C::series_of_fields, {{}, {"Output/Fields every=2"}}},
    {C::several_ranks, {}}};


  /// What all scenes of this file have: a square with a crack, and regions that are only places.
  const std::vector<std::string> common = {
    "Geometry/Text=boundary name=square material=rock POLYGON ((0 0, 1 0, 1 1, "
    "0 1)); joint name=crack LINESTRING (0 0.5, 0.5 0.5)",
    "Materials/rock/Density=1",
    "Materials/rock/Toughness=1",
    "Regions/Names=pit, prop, all",
    "Regions/pit/Shape=POLYGON ((0.2 0.1, 0.4 0.1, 0.4 0.3, 0.2 0.3))",
    "Regions/prop/Shape=POLYGON ((0.6 0.6, 0.8 0.6, 0.8 0.8, 0.6 0.8))",
    "Regions/all/Shape=POLYGON ((-9 -9, 9 -9, 9 9, -9 9))"};


  /// A scene with some capabilities and all that these need.
  class Wanted
  {
  public:
    explicit Wanted(const std::vector<C> &capabilities)
    {
      for (const C capability : capabilities)
        add(capability);
    }

    /// Whether an entry would have two values of different requests.
    bool
    is_contradictory() const
    {
      return has_conflict;
    }

    /// These capabilities, what comes with them, and what the scene lacks.
    std::vector<C>
    all() const
    {
      std::vector<C> result(chosen.begin(), chosen.end());
      const auto     add_if = [&](const bool is_so, const C further) {
        if (is_so)
          result.push_back(further);
      };
      add_if(has(C::intensity_factors), C::tip_grading);
      add_if(!has(C::growth), C::no_growth);
      add_if(!has(C::finite_kinematics), C::small_kinematics);
      add_if(!has(C::contact), C::no_contact);
      add_if(!has(C::contact) && !has(C::yielding), C::no_strength);
      add_if(!has(C::dynamics), C::scheme_without_dashpots);
      add_if(has(C::statics) && !has(C::finite_kinematics) &&
               !has(C::contact) && !has(C::yielding) && !has(C::stages) &&
               !has(C::bolts) && !has(C::joint_flow) && !has(C::growth),
             C::one_state);
      return result;
    }

    /// Why the scene is refused; empty if it is not.
    std::string
    refusal() const
    {
      std::vector<std::string> overrides = common;
      for (const auto &[key, value] : entries)
        overrides.push_back(key + "=" + value);
      try
      {
        const Scene scene(NMM_SOURCE_DIR "/tests/scenes/base.prm", overrides);
        check_capabilities(scene.parameters(), has(C::several_ranks) ? 2 : 1);
      }
      catch (const InputError &error)
      {
        return error.message();
      }
      return "";
    }

  private:
    bool
    has(const C capability) const
    {
      return chosen.count(capability) > 0;
    }

    void
    add(const C capability)
    {
      const Request &request = requests.at(capability);
      for (const C other : request.needs)
        add(other);
      if (!chosen.insert(capability).second)
        return;
      for (const std::string &entry : request.entries)
      {
        const std::size_t n   = entry.find('=');
        const std::string key = entry.substr(0, n);
        has_conflict |= key != "Contact/Enforcement" && entries.count(key) > 0;
        // The one that needs contact comes after it.
        if (key != "Contact/Enforcement" || entries.count(key) == 0 ||
            capability == C::augmented_lagrangian)
          entries[key] = entry.substr(n + 1);
      }
    }

    std::set<C>                        chosen;
    std::map<std::string, std::string> entries;
    bool                               has_conflict = false;
  };


  std::string
  names(const std::vector<C> &capabilities)
  {
    std::string result;
    for (const C capability : capabilities)
      result +=
        capability_descriptions()[static_cast<unsigned int>(capability)].name +
        "; ";
    return result;
  }


  /// All choices of one capability from each group.
  std::vector<std::vector<C>>
  choices(const RefusedCombination &combination)
  {
    std::vector<std::vector<C>> result = {{}};
    for (const std::vector<C> &group : combination.groups)
    {
      std::vector<std::vector<C>> longer;
      for (const std::vector<C> &chosen : result)
        for (const C capability : group)
        {
          longer.push_back(chosen);
          // what a scene lacks is nothing to ask for
          if (requests.count(capability) > 0)
            longer.back().push_back(capability);
        }
      result = longer;
    }
    return result;
  }


  TEST(Capabilities, AreDescribedInTheirOrder)
  {
    const auto &descriptions = capability_descriptions();
    for (unsigned int i = 0; i < descriptions.size(); ++i)
    {
      EXPECT_EQ(static_cast<unsigned int>(descriptions[i].capability), i);
      EXPECT_EQ(requests.count(descriptions[i].capability) > 0,
                !descriptions[i].entry.empty())
        << descriptions[i].name;
    }
  }


  // Whatever the table refuses is refused, with its reason.
  TEST(Capabilities, EachRefusalRefuses)
  {
    for (const RefusedCombination &combination : refused_combinations())
      for (const std::vector<C> &chosen : choices(combination))
      {
        SCOPED_TRACE(names(chosen));
        const std::string refusal = Wanted(chosen).refusal();
        EXPECT_TRUE(refusal.find(" cannot be combined with ") !=
                      std::string::npos ||
                    refusal.find(" would not be used by ") != std::string::npos)
          << refusal;
      }
  }


  // Each capability in each analysis, and all pairs, each in one analysis by turns: the table refuses
  // what scenes refuse, and nothing else.
  TEST(Capabilities, ScenesRefuseNothingElse)
  {
    const std::vector<C> analyses  = {C::statics,
                                      C::dynamics,
                                      C::relaxation,
                                      C::safety_factor};
    unsigned int         n_refused = 0, n_allowed = 0, n_pairs = 0;
    const auto           compare = [&](const std::vector<C> &chosen) {
      const Wanted wanted(chosen);
      if (wanted.is_contradictory())
        return;
      SCOPED_TRACE(names(chosen));
      const std::string refusal = wanted.refusal();
      const bool        is_refused = find_refusal(wanted.all()) != nullptr;
      EXPECT_EQ(!refusal.empty(), is_refused) << refusal;
      ++(is_refused ? n_refused : n_allowed);
    };
    for (auto a = requests.begin(); a != requests.end(); ++a)
    {
      for (const C analysis : analyses)
        compare({analysis, a->first});
      for (auto b = std::next(a); b != requests.end(); ++b)
        compare({analyses[n_pairs++ % 4], a->first, b->first});
    }
    EXPECT_GT(n_refused, 200u);
    EXPECT_GT(n_allowed, 200u);
  }
} // namespace
