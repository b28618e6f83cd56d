#ifndef nmm_scene_capabilities_h
#define nmm_scene_capabilities_h

#include <string>
#include <vector>

namespace NMM
{
  struct SceneParameters;

  /// What a scene, or the way in which it is run, can ask for, and what it can lack.
  enum class Capability
  {
    // Analyses
    statics,
    dynamics,
    relaxation,
    safety_factor,
    stages,
    growth,
    no_growth,
    one_state,
    // Deformation and materials
    small_kinematics,
    finite_kinematics,
    large_strain_law,
    yielding,
    no_strength,
    initial_stress,
    in_situ_stress,
    bolts,
    water,
    pores,
    joint_flow,
    absorbing,
    // Contact
    contact,
    no_contact,
    augmented_lagrangian,
    springs_at_points,
    dashpots,
    scheme_without_dashpots,
    obstacles,
    moving_obstacles,
    restraints,
    sleep,
    // Cracks
    intensity_factors,
    crack_starts,
    crack_speed,
    tip_grading,
    // Time
    loads_in_time,
    initial_velocities,
    limits,
    checkpoints,
    // Meshes and solvers
    gmsh_mesh,
    own_meshes,
    merged_blocks,
    ghost_penalty,
    iterative_solver,
    condition_number,
    exact_solution,
    series_of_fields,
    several_ranks
  };


  /// A capability as messages and pages speak of it.
  struct CapabilityDescription
  {
    /// The capability.
    Capability capability;
    /// Its name in a sentence, "cracks that grow".
    std::string name;
    /// How a scene asks for it, "Fracture/Increments"; empty for what a scene lacks.
    std::string entry;
  };


  /**
   * Capabilities that cannot be combined: any one of the first group with any one of each further
   * group. The entry that asks for the capability of the first group is the place of the error.
   */
  struct RefusedCombination
  {
    /// Two or three groups.
    std::vector<std::vector<Capability>> groups;
    /// Why, as the end of a sentence after "since": a reason in mechanics, what it would cost, or
    /// that it has not been built.
    std::string reason;
    /// What a user can do instead.
    std::string remedy;
    /// Whether the second group makes no use of the first one's entry, rather than being in
    /// conflict with it. Such an entry of a scene file is ignored if `--set` changes the analysis.
    bool is_unused = false;
  };


  /// All capabilities, in the order of the enumeration.
  const std::vector<CapabilityDescription> &
  capability_descriptions();

  /// The one table of what cannot be combined. Scenes are checked by it, and the page
  /// doc/capabilities.md is made from it.
  const std::vector<RefusedCombination> &
  refused_combinations();

  /// The first combination of the table of which each group has one of the @p wanted capabilities;
  /// null if they go together.
  const RefusedCombination *
  find_refusal(const std::vector<Capability> &wanted);

  /// Checks that all that a scene asks for can be combined on @p n_ranks ranks. @throws InputError
  /// with the reason and the remedy of the first combination of the table that cannot.
  void
  check_capabilities(const SceneParameters &parameters, unsigned int n_ranks);

  /// The page doc/capabilities.md: which capability each analysis has, and the table of refusals.
  std::string
  capabilities_page();
} // namespace NMM

#endif
