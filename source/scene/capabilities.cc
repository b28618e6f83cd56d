#include <nmm/base/exceptions.h>
#include <nmm/scene/capabilities.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <scene/parsing.h>
#include <sstream>

// This file has the one table of what cannot be combined, and what is made from it.
namespace NMM
{
  using namespace internal;

  namespace
  {
    using C = Capability;

    /// All capabilities in the order of the enumeration.
    const std::vector<CapabilityDescription> descriptions = {
      {C::statics, "a static analysis", "Model/Analysis = static"},
      {C::dynamics, "a dynamic analysis", "Model/Analysis = dynamic"},
      {C::relaxation, "a relaxation analysis", "Model/Analysis = relaxation"},
      {C::safety_factor,
       "a safety factor analysis",
       "Model/Analysis = safety factor"},
      {C::stages, "stages", "Stages/Names"},
      {C::growth, "cracks that grow", "Fracture/Increments"},
      {C::no_growth, "cracks that do not grow", ""},
      {C::one_state,
       "small kinematics without contact, bolts, flow in joints and a material "
       "that yields",
       ""},
      {C::small_kinematics, "small kinematics", "Model/Kinematics = small"},
      {C::finite_kinematics, "finite kinematics", "Model/Kinematics = finite"},
      {C::large_strain_law,
       "a law for large strains",
       "Materials/.../Law = neo-Hookean"},
      {C::yielding, "materials that yield", "Materials/.../Law = Mohr-Coulomb"},
      {C::no_strength,
       "a scene without contact and without a material that yields",
       ""},
      {C::initial_stress,
       "the initial stress of a material",
       "Materials/.../Initial stress"},
      {C::in_situ_stress, "in-situ stress", "In-situ stress/Type = K0"},
      {C::bolts, "bolts", "Bolts/Names"},
      {C::water, "water", "Water/Table"},
      {C::pores, "water in pores", "Water/Pores = true"},
      {C::joint_flow,
       "water that flows in joints",
       "Water/Joint pressure = network"},
      {C::absorbing,
       "absorbing boundaries",
       "Boundary conditions/.../Type = absorbing"},
      {C::contact, "contact", "Contact/Enforcement = penalty"},
      {C::no_contact, "a scene without contact", ""},
      {C::augmented_lagrangian,
       "'augmented Lagrangian'",
       "Contact/Enforcement = augmented Lagrangian"},
      {C::springs_at_points,
       "springs at points",
       "Contact/Integration = points"},
      {C::dashpots,
       "dashpots between faces",
       "Contact/Normal damping, Shear damping"},
      {C::scheme_without_dashpots, "another scheme than 'energy momentum'", ""},
      {C::obstacles, "rigid obstacles", "Obstacles/Names"},
      {C::moving_obstacles,
       "obstacles that move",
       "Obstacles/.../Displacement"},
      {C::restraints, "restraints", "Regions/.../Use = restraint"},
      {C::sleep, "sleeping blocks", "Time/Sleep speed"},
      {C::intensity_factors,
       "intensity factors",
       "Fracture/Intensity factors = true"},
      {C::crack_starts, "cracks that start", "Materials/.../Fracture strength"},
      {C::crack_speed, "a largest speed of cracks", "Fracture/Speed"},
      {C::tip_grading,
       "a mesh that is graded towards crack tips",
       "Fracture/Tips = graded"},
      {C::loads_in_time,
       "loads and supports that change in time",
       ".../Amplitude, Release time"},
      {C::initial_velocities, "initial velocities", "Initial velocities/Names"},
      {C::limits,
       "limits beyond which blocks are dropped",
       "Regions/.../Use = limit"},
      {C::checkpoints, "checkpoints", "Output/Checkpoint every"},
      {C::gmsh_mesh,
       "a mathematical mesh from a file",
       "Mathematical mesh/Type = gmsh"},
      {C::own_meshes, "own meshes of blocks", "Covers/Own meshes"},
      {C::merged_blocks,
       "small blocks that are merged",
       "Geometry/Small blocks = merge"},
      {C::ghost_penalty,
       "'ghost penalty'",
       "Covers/Stabilization = ghost penalty"},
      {C::iterative_solver,
       "the solver 'iterative'",
       "Solver/Type = iterative"},
      {C::condition_number,
       "the condition number",
       "Solver/Condition number = true"},
      {C::exact_solution,
       "the exact solution of the thick ring",
       "Exact solution/Type = thick ring"},
      {C::series_of_fields, "a series of fields", "Output/Fields every"},
      {C::several_ranks, "several ranks", "mpirun -n 2 nmm"}};


    const CapabilityDescription &
    describe(const Capability capability)
    {
      const CapabilityDescription &result =
        descriptions[static_cast<unsigned int>(capability)];
      Assert(result.capability == capability, dealii::ExcInternalError());
      return result;
    }


    /// A capability that a scene asks for by the entry @p path with this value.
    struct Asked
    {
      Capability  capability;
      std::string path;
      std::string value;
    };


    /// What a scene asks for on a number of ranks.
    class AskedFor
    {
    public:
      AskedFor(const SceneParameters &parameters, unsigned int n_ranks);

      /// The first capability of the @p group that is asked for; null if none is.
      const Asked *
      find(const std::vector<Capability> &group) const
      {
        for (const Asked &asked : all)
          if (std::find(group.begin(), group.end(), asked.capability) !=
              group.end())
            return &asked;
        return nullptr;
      }

    private:
      /// A capability whose entry is the one that is described.
      void
      add(const Capability   capability,
          const bool         is_asked_for,
          const std::string &value = "")
      {
        const std::string &entry = describe(capability).entry;
        if (is_asked_for)
          all.push_back({capability, entry.substr(0, entry.find(" =")), value});
      }

      /// A capability that an entry of a subsection asks for.
      void
      add(const Capability   capability,
          const std::string &section,
          const std::string &name,
          const std::string &key,
          const bool         is_asked_for,
          const std::string &value = "")
      {
        if (is_asked_for)
          all.push_back({capability,
                         section + "/" + (name.empty() ? "" : name + "/") + key,
                         value});
      }

      void
      add_analysis(const ModelParameters &model);
      void
      add_materials(const SceneParameters &parameters);
      void
      add_contact(const SceneParameters &parameters);
      void
      add_loads_in_time(const SceneParameters &parameters);

      std::vector<Asked> all;
    };


    AskedFor::AskedFor(const SceneParameters &p, const unsigned int n_ranks)
    {
      const FractureParameters &fracture = p.fracture;
      add_analysis(p.model);
      add(C::stages, !p.stages.empty());
      add(C::growth, fracture.n_increments > 0);
      add(C::no_growth, fracture.n_increments == 0);
      add_materials(p);
      add(C::in_situ_stress, p.in_situ_stress.is_present);
      add_contact(p);
      add(C::sleep, p.time.sleep.speed > 0.);
      add(C::intensity_factors, fracture.intensity_factors);
      add(C::crack_speed, fracture.speed != 0., to_text(fracture.speed));
      add(C::tip_grading, fracture.grades_mesh());
      add_loads_in_time(p);
      add(C::initial_velocities,
          !p.initial_velocities.empty(),
          p.initial_velocities.empty() ? ""
                                       : p.initial_velocities.front().name);
      add(C::checkpoints,
          p.output.checkpoint_every > 0,
          std::to_string(p.output.checkpoint_every));
      add(C::own_meshes, p.covers.mesh.kind != RegionMesh::Kind::where_needed);
      add(C::gmsh_mesh,
          p.mathematical_mesh.type == MathematicalMeshParameters::Type::gmsh);
      add(C::merged_blocks, p.geometry.merges_small_blocks);
      add(C::ghost_penalty,
          p.covers.stabilization == Stabilization::ghost_penalty);
      add(C::iterative_solver,
          p.solver.type == LinearSolverParameters::Type::iterative);
      add(C::condition_number, p.solver.estimate_condition);
      add(C::exact_solution,
          p.exact_solution.type != ExactSolutionParameters::Type::none);
      add(C::one_state,
          p.model.analysis == Analysis::statics &&
            p.model.kinematics == Kinematics::small && !p.is_nonlinear() &&
            fracture.n_increments == 0);
      add(C::series_of_fields,
          p.output.fields_every > 0,
          std::to_string(p.output.fields_every));
      add(C::bolts, !p.bolts.empty());
      add(C::water, p.water.is_present());
      add(C::pores, p.water.fills_pores);
      add(C::joint_flow,
          p.water.joint_pressure == WaterParameters::JointPressure::network);
      for (const BoundaryConditionParameters &condition : p.boundary_conditions)
        add(C::absorbing,
            "Boundary conditions",
            condition.name,
            "Type",
            condition.type == BoundaryCondition::Type::absorbing ||
              condition.type == BoundaryCondition::Type::free_field);
      add(C::several_ranks, n_ranks > 1);
    }


    void
    AskedFor::add_analysis(const ModelParameters &model)
    {
      add(C::statics, model.analysis == Analysis::statics);
      add(C::dynamics, model.analysis == Analysis::dynamics);
      add(C::relaxation, model.analysis == Analysis::relaxation);
      add(C::safety_factor, model.analysis == Analysis::safety_factor);
      add(C::small_kinematics, model.kinematics == Kinematics::small);
      add(C::finite_kinematics, model.kinematics == Kinematics::finite);
    }


    void
    AskedFor::add_materials(const SceneParameters &p)
    {
      for (const Material &material : p.materials)
      {
        const auto add_of_material =
          [&](const Capability capability, const char *key, const bool has) {
            add(capability, "Materials", material.name, key, has);
          };
        add_of_material(C::large_strain_law,
                        "Law",
                        !material.law->has_small_strains());
        add_of_material(C::yielding, "Law", material.law->is_inelastic());
        add_of_material(C::initial_stress,
                        "Initial stress",
                        material.has_initial_stress());
        add_of_material(C::crack_starts,
                        "Fracture strength",
                        material.fracture_strength > 0. &&
                          p.fracture.n_increments > 0);
      }
    }


    void
    AskedFor::add_contact(const SceneParameters &p)
    {
      using Scheme           = TimeParameters::Scheme;
      using Use              = RegionParameters::Use;
      const bool has_contact = p.contact.is_present();
      add(C::contact, has_contact);
      add(C::no_contact, !has_contact);
      add(C::no_strength, !has_contact && !p.has_inelastic_material());
      add(C::augmented_lagrangian,
          p.contact.enforcement == Enforcement::augmented_lagrangian);
      add(C::springs_at_points,
          p.contact.integration == ContactIntegration::points);
      std::vector<ContactLawParameters> laws = p.contact.laws;
      laws.push_back(p.contact.law);
      for (const ContactLawParameters &law : laws)
        for (const char *key : {"Normal damping", "Shear damping"})
          add(C::dashpots,
              "Contact",
              law.name,
              key,
              has_contact && law.values.at(key) != 0.);
      add(C::scheme_without_dashpots,
          p.model.analysis != Analysis::dynamics ||
            (p.time.scheme != Scheme::automatic &&
             p.time.scheme != Scheme::energy_momentum));
      add(C::obstacles, !p.obstacles.empty());
      for (const ObstacleParameters &obstacle : p.obstacles)
        add(C::moving_obstacles,
            "Obstacles",
            obstacle.name,
            "Displacement",
            !obstacle.displacement.empty(),
            obstacle.displacement);
      for (const RegionParameters &region : p.regions)
      {
        add(C::restraints,
            "Regions",
            region.name,
            "Use",
            region.use == Use::restraint);
        add(C::limits,
            "Regions",
            region.name,
            "Use",
            region.use == Use::limit,
            "limit");
      }
    }


    void
    AskedFor::add_loads_in_time(const SceneParameters &p)
    {
      const auto add_amplitude = [&](const std::string &section,
                                     const std::string &name,
                                     const std::string &key,
                                     const std::string &amplitude) {
        add(
          C::loads_in_time, section, name, key, !amplitude.empty(), amplitude);
      };
      const auto add_release = [&](const std::string &section,
                                   const std::string &name,
                                   const double       time) {
        add(C::loads_in_time,
            section,
            name,
            "Release time",
            time >= 0.,
            to_text(time));
      };
      const auto add_loads = [&](const std::string &section,
                                 const auto        &loads) {
        for (const auto &load : loads)
        {
          add_amplitude(section, load.name, "Amplitude", load.time.amplitude);
          add_release(section, load.name, load.time.release_time);
        }
      };
      add_loads("Boundary conditions", p.boundary_conditions);
      add_loads("Point forces", p.point_forces);
      add_loads("Fixed points", p.fixed_points);
      add_amplitude("Model",
                    "",
                    "Gravity amplitude",
                    p.model.gravity_amplitude);
      add_amplitude("Model",
                    "",
                    "Body force amplitude",
                    p.model.body_force_amplitude);
      add_amplitude("Model",
                    "",
                    "Base acceleration",
                    p.model.base_acceleration);
      for (const ObstacleParameters &obstacle : p.obstacles)
        add_release("Obstacles", obstacle.name, obstacle.release_time);
      for (const RegionParameters &region : p.regions)
        add_release("Regions", region.name, region.release_time);
    }


    const std::vector<Capability> at_rest       = {C::statics,
                                                   C::relaxation,
                                                   C::safety_factor},
                                  not_static    = {C::dynamics,
                                                   C::relaxation,
                                                   C::safety_factor},
                                  beyond_linear = {C::dynamics,
                                                   C::relaxation,
                                                   C::safety_factor,
                                                   C::finite_kinematics,
                                                   C::contact,
                                                   C::yielding,
                                                   C::bolts,
                                                   C::joint_flow,
                                                   C::stages};

    const char *const become_dynamic =
      "remove it, or set 'Model/Analysis = dynamic'";
    const char *const one_rank = "run the scene on one rank only";

    // Values that are not used come first: those of a file are ignored if --set changes the
    // analysis, and then nothing else may be wrong.
    const std::vector<RefusedCombination> combinations = {
      {{{C::initial_velocities, C::loads_in_time, C::limits}, at_rest},
       "only a dynamic analysis has a time; the others end in equilibrium",
       become_dynamic,
       true},
      {{{C::crack_speed}, at_rest},
       "the speed of a crack bounds the steps of a motion",
       become_dynamic,
       true},
      {{{C::moving_obstacles}, {C::relaxation, C::safety_factor}},
       "the motion of a relaxation is a means to find rest, and its time has "
       "no meaning",
       "remove it, or set 'Model/Analysis' to static or dynamic",
       true},
      {{{C::checkpoints}, {C::relaxation, C::safety_factor}},
       "it has not been built: only motion and the growth of cracks can be "
       "continued",
       "remove it, or set 'Model/Analysis = dynamic'",
       true},
      {{{C::checkpoints}, {C::statics}, {C::no_growth}},
       "it has not been built: only motion and the growth of cracks can be "
       "continued",
       "remove it, or set 'Model/Analysis = dynamic', or let cracks grow in a "
       "static analysis",
       true},
      {{{C::series_of_fields}, {C::one_state}},
       "a linear problem has one state",
       "remove it, or set 'Model/Kinematics = finite', 'Contact/Enforcement = "
       "penalty' or a material's 'Law = Mohr-Coulomb'",
       true},
      {{{C::large_strain_law}, {C::small_kinematics}},
       "for small strains it is the linear law",
       "set 'Law = linear', or 'Model/Kinematics = finite'"},
      {{{C::obstacles, C::restraints}, {C::no_contact}},
       "only contact feels rigid bodies",
       "remove it, or set 'Contact/Enforcement = penalty'"},
      {{{C::safety_factor}, {C::no_strength}},
       "there is no strength to be reduced",
       "set 'Contact/Enforcement = penalty', and a friction angle or a "
       "cohesion, or a material's 'Law = Mohr-Coulomb'"},
      {{{C::initial_stress}, {C::in_situ_stress}},
       "both are the stress before any load",
       "remove one of them"},
      {{{C::ghost_penalty}, beyond_linear},
       "it has not been built: its matrix is that of displacements in one "
       "linear problem, and aggregation serves all others",
       "set 'Stabilization = aggregation'"},
      {{{C::iterative_solver}, beyond_linear},
       "conjugate gradients need a matrix that is symmetric and positive "
       "definite, which tangents of friction, yielding and large "
       "displacements need not be",
       "set 'Type' to automatic or direct"},
      {{{C::condition_number}, beyond_linear},
       "it is that of the one matrix of a linear problem",
       "set it to false, or 'Model/Kinematics = small' and 'Model/Analysis = "
       "static' without contact, stages and materials that yield"},
      {{{C::exact_solution}, beyond_linear},
       "it solves the linear problem only",
       "set it to none, or 'Model/Kinematics = small' and 'Model/Analysis = "
       "static' without contact, stages and materials that yield"},
      {{{C::augmented_lagrangian}, not_static},
       "it has not been built: pressures are iterated at the end of a load "
       "step, and conserving forces act in the middle of a time step",
       "set it to penalty, or 'Model/Analysis = static'"},
      {{{C::augmented_lagrangian}, {C::springs_at_points}},
       "its pressures act along faces",
       "set it to penalty, or 'Integration = length'"},
      {{{C::dashpots}, {C::scheme_without_dashpots}},
       "their force is that of the rate of the gap over a step, whose work "
       "only the conserving scheme accounts for",
       "remove it, or set 'Model/Analysis = dynamic' and 'Time/Scheme = energy "
       "momentum'"},
      {{{C::sleep}, at_rest},
       "all blocks have to come to rest under their loads, however slowly",
       become_dynamic},
      {{{C::sleep}, {C::no_contact}},
       "blocks wake by the forces of contact",
       "set it to 0, or 'Contact/Enforcement = penalty'"},
      {{{C::sleep}, {C::several_ranks}},
       "it has not been built: the blocks in motion are solved for apart from "
       "those that rest on one rank only",
       one_rank},
      {{{C::intensity_factors}, {C::safety_factor}},
       "it has not been built: what is reduced is the strength of contact and "
       "of materials that yield, and not the toughness",
       "set 'Model/Analysis' to static, dynamic or relaxation, or remove it"},
      {{{C::intensity_factors}, {C::yielding}},
       "the interaction integral depends on its path where a material yields",
       "remove it, or choose an elastic material"},
      {{{C::tip_grading}, {C::gmsh_mesh}},
       "the cells of a file are as they are",
       "set 'Mathematical mesh/Type = regular', or 'Fracture/Tips = as "
       "meshed'"},
      {{{C::growth}, {C::merged_blocks}},
       "cracks would end at joints that have vanished, and what they cut off "
       "would be merged again",
       "remove it, or set 'Geometry/Small blocks = report' and draw the joints "
       "without small blocks"},
      {{{C::initial_stress, C::in_situ_stress}, {C::growth}, {C::statics}},
       "the load at which a crack grows is found by proportion, and the load "
       "factor does not apply to initial stress",
       "remove it, or 'Fracture/Increments', or set 'Model/Analysis' to "
       "dynamic or relaxation"},
      {{{C::water}, {C::in_situ_stress}},
       "it has not been built: the stress of the weight does not know water, "
       "neither its pressure nor wet densities",
       "give the effective stress as 'Initial stress' of materials, or let "
       "gravity settle the solid in load steps"},
      {{{C::joint_flow}, {C::no_contact}},
       "faces that do not touch have no aperture that stress decides",
       "set 'Contact/Enforcement = penalty', or give the pressure"},
      {{{C::joint_flow}, {C::pores}},
       "it has not been built: no water is exchanged between joints and pores",
       "set 'Joint pressure = table', or 'Pores = false'"},
      {{{C::joint_flow}, {C::finite_kinematics}},
       "it has not been built: apertures are those of faces that were opposite "
       "in the drawing, and pressures act along the normals there",
       "set 'Model/Kinematics = small', or give the pressure"},
      {{{C::joint_flow}, {C::growth}},
       "it has not been built: the network is that of the joints in the "
       "drawing",
       "set 'Joint pressure' to table or given"},
      {{{C::bolts}, {C::growth}},
       "it has not been built: what bolts remember is not carried over to the "
       "solid that is cut again",
       "remove one of the two"},
      {{{C::stages}, {C::relaxation}},
       "each stage ends in an equilibrium, after which nothing is to be "
       "relaxed",
       "set 'Model/Analysis' to static, dynamic or safety factor"},
      {{{C::absorbing}, {C::growth}, {C::dynamics}},
       "it has not been built: what the boundary bore before the motion is not "
       "carried over to the solid that is cut again",
       "remove one of the two"},
      {{{C::stages}, {C::growth}},
       "it has not been built: what was excavated and released is not carried "
       "over to the solid that is cut again",
       "remove one of the two"},
      {{{C::moving_obstacles}, {C::stages}},
       "its motion is a function of one load factor, and each stage has one "
       "of its own",
       "let it rest"},
      {{{C::series_of_fields}, {C::safety_factor}},
       "its trials are alternatives and no steps that follow each other",
       "remove it"}};


    /// Names of a group, "a, b or c".
    std::string
    names(const std::vector<Capability> &group)
    {
      std::string result;
      for (unsigned int i = 0; i < group.size(); ++i)
        result += (i == 0                 ? ""
                   : i + 1 < group.size() ? ", "
                                          : " or ") +
                  describe(group[i]).name;
      return result;
    }


    /// An analysis of the page: its head, and what it asks for.
    struct Column
    {
      std::string             head;
      std::vector<Capability> wanted;
    };


    const std::vector<Column> columns = {
      {"static", {C::statics, C::no_growth}},
      {"static, in stages", {C::statics, C::stages, C::no_growth}},
      {"static, cracks grow", {C::statics, C::growth, C::intensity_factors}},
      {"dynamic", {C::dynamics, C::no_growth}},
      {"dynamic, cracks grow", {C::dynamics, C::growth, C::intensity_factors}},
      {"relaxation", {C::relaxation, C::no_growth}},
      {"relaxation, cracks grow",
       {C::relaxation, C::growth, C::intensity_factors}},
      {"safety factor", {C::safety_factor, C::no_growth}}};


    /// Whether the page has a row of the capability: no analysis, and nothing that a scene lacks.
    bool
    has_row(const CapabilityDescription &described)
    {
      return described.capability > C::one_state && !described.entry.empty();
    }
  } // namespace


  const std::vector<CapabilityDescription> &
  capability_descriptions()
  {
    return descriptions;
  }


  const std::vector<RefusedCombination> &
  refused_combinations()
  {
    return combinations;
  }


  const RefusedCombination *
  find_refusal(const std::vector<Capability> &wanted)
  {
    const auto is_wanted = [&](const Capability capability) {
      return std::find(wanted.begin(), wanted.end(), capability) !=
             wanted.end();
    };
    for (const RefusedCombination &combination : combinations)
      if (std::all_of(combination.groups.begin(),
                      combination.groups.end(),
                      [&](const auto &group) {
                        return std::any_of(group.begin(),
                                           group.end(),
                                           is_wanted);
                      }))
        return &combination;
    return nullptr;
  }


  void
  check_capabilities(const SceneParameters &parameters,
                     const unsigned int     n_ranks)
  {
    const AskedFor asked_for(parameters, n_ranks);
    for (const RefusedCombination &combination : combinations)
    {
      std::vector<const Asked *> asked;
      for (const std::vector<Capability> &group : combination.groups)
        asked.push_back(asked_for.find(group));
      if (std::find(asked.begin(), asked.end(), nullptr) != asked.end())
        continue;
      const std::string &path  = asked[0]->path;
      const std::size_t  slash = path.rfind('/');
      std::string        what =
        describe(asked[0]->capability).name + " cannot be combined";
      for (unsigned int i = 1; i < asked.size(); ++i)
        what +=
          (i == 1 ? " with " : " and ") + describe(asked[i]->capability).name;
      AssertThrow(!combination.is_unused,
                  UnusedValue(path.substr(0, slash),
                              path.substr(slash + 1),
                              asked[0]->value,
                              describe(asked[1]->capability).name,
                              combination.remedy));
      AssertThrow(false,
                  InputError(what + ", since " + combination.reason,
                             "parameter '" + path + "'",
                             combination.remedy));
    }
  }


  std::string
  capabilities_page()
  {
    std::ostringstream page;
    page << "# What can be combined\n\n"
            "Made by `nmm --print-capabilities` from the table that scenes are "
            "checked by (`source/scene/capabilities.cc`).\n\n"
            "## Analyses and what they can have\n\n"
            "A yes is for each capability alone; those that exclude each "
            "other follow further below. [parameters.md](parameters.md) "
            "explains the entries.\n\n| capability |";
    std::string line = "|---|";
    for (const Column &column : columns)
    {
      page << ' ' << column.head << " |";
      line += "---|";
    }
    page << '\n' << line << '\n';
    for (const CapabilityDescription &described : descriptions)
    {
      if (!has_row(described))
        continue;
      page << "| " << described.name << " (`" << described.entry << "`) |";
      for (const Column &column : columns)
      {
        std::vector<Capability> wanted = column.wanted;
        wanted.push_back(described.capability);
        page << (find_refusal(wanted) == nullptr ? " yes |" : " no |");
      }
      page << '\n';
    }
    page << "\n## What is refused, why, and what to do\n\n"
            "Any one of the first names is refused with any one of each "
            "further group. What is *not used* is ignored if the scene file "
            "has it and `--set` changes the analysis.\n\n";
    for (const RefusedCombination &combination : combinations)
    {
      page << "- **" << names(combination.groups[0]) << "** with ";
      for (unsigned int i = 1; i < combination.groups.size(); ++i)
        page << (i > 1 ? " and " : "") << "**" << names(combination.groups[i])
             << "**";
      page << (combination.is_unused ? " (*not used*)" : "") << ": "
           << combination.reason << ". *Instead:* " << combination.remedy
           << ".\n";
    }
    return page.str();
  }
} // namespace NMM
