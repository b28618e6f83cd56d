#include <nmm/base/exceptions.h>
#include <nmm/materials/material.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>
#include <set>
#include <sstream>

// This file has the parameters of the mathematical mesh and the solver. Those of the physics are in
// scene_parameters_mechanics.cc, and those of the output in scene_parameters_output.cc.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<LocalSize::Kind> local_size_types = {
      {"point", LocalSize::Kind::point},
      {"box", LocalSize::Kind::box},
      {"curve", LocalSize::Kind::curve}};

    const Words<MathematicalMeshParameters::Type> mesh_types = {
      {"regular", MathematicalMeshParameters::Type::regular},
      {"graded", MathematicalMeshParameters::Type::graded},
      {"gmsh", MathematicalMeshParameters::Type::gmsh}};

    const Words<MeshPattern> mesh_patterns = {
      {"equilateral", MeshPattern::equilateral},
      {"right-angled", MeshPattern::right_angled}};

    const Words<LinearSolverParameters::Type> solver_types = {
      {"automatic", LinearSolverParameters::Type::automatic},
      {"direct", LinearSolverParameters::Type::direct},
      {"iterative", LinearSolverParameters::Type::iterative}};
  } // namespace


  void
  LocalSizeParameters::list_entries(Entries           &entries,
                                    LocalSize         &local_size,
                                    const std::string &name)
  {
    entries.add("Type",
                local_size.kind,
                local_size_types,
                "Fine at a point, in a box or along a curve.");
    entries.add("Point", local_size.point, "Type point: x, y [m].");
    entries.add("Lower corner",
                local_size.lower,
                "Type box: its lower left corner x, y [m].");
    entries.add("Upper corner",
                local_size.upper,
                "Type box: its upper right corner x, y [m].");
    entries.add("Curve",
                local_size.curve,
                "Type curve: name of a curve of the geometry.");
    entries.add("Size",
                local_size.size,
                Patterns::Double(0),
                "Edge length of triangles there, > 0 [m].");
    entries.add("Growth",
                local_size.growth,
                Patterns::Double(0, 1),
                "Increase of the edge length per distance from there [-]: "
                "small values grade gently.");
    if (!entries.are_parsed())
      return;
    const std::string section = "section 'Mathematical mesh/" + name + "'";
    AssertThrow(local_size.size > 0.,
                InputError("the local size is " +
                             std::to_string(local_size.size) + " m",
                           section,
                           "set 'Size' to a positive edge length"));
    AssertThrow(local_size.kind != LocalSize::Kind::curve ||
                  !local_size.curve.empty(),
                InputError("a local size along a curve without its name",
                           section,
                           "set 'Curve' to a curve of the geometry"));
    AssertThrow(
      local_size.kind != LocalSize::Kind::box ||
        (local_size.lower[0] < local_size.upper[0] &&
         local_size.lower[1] < local_size.upper[1]),
      InputError("the box of a local size is empty, from " +
                   to_string(local_size.lower) + " to " +
                   to_string(local_size.upper),
                 section,
                 "give a lower corner left of and below the upper one"));
  }


  void
  MathematicalMeshParameters::list_entries(
    Entries                        &entries,
    const std::vector<std::string> &local_size_names)
  {
    entries.add("Type",
                type,
                mesh_types,
                "regular: equal triangles over the bounding box; graded: "
                "triangles that follow the local sizes in Names; gmsh: read "
                "from a file. None needs to fit the geometry.");
    entries.add("Degree",
                degree,
                Patterns::Integer(1, 2),
                "Polynomial degree of the weight functions: 2 is the "
                "second-order method with six-node triangles.");
    entries.add("Cell size",
                regular.cell_size,
                Patterns::Double(0),
                "regular: edge length of the triangles (equilateral) or "
                "squares (right-angled); graded: the largest edge length [m]. "
                "Must be set for both.");
    entries.add(
      "Pattern",
      regular.pattern,
      mesh_patterns,
      "regular: equilateral triangles, or squares halved along a diagonal.");
    entries.add("Offset",
                regular.offset,
                "regular: a node of the mesh lies at the centre of the "
                "bounding box plus this, before rotation [m].");
    entries.add("Rotation",
                regular.rotation,
                Patterns::Double(),
                "regular: the mesh is turned counter-clockwise about the "
                "centre of the bounding box [degrees].");
    entries.add(
      "Whole box",
      regular.whole_box,
      "regular: keep also the cells that surely lie outside the solid.");
    entries.add("Gmsh file",
                gmsh_file,
                "gmsh: triangle mesh that covers the solid, relative to the "
                "folder of the scene file.");
    entries.subsections(
      local_size_names,
      graded.local_sizes,
      "graded: names of the local sizes, each with a subsection of its own.",
      [&](LocalSize &local_size, const std::string &name) {
        LocalSizeParameters::list_entries(entries, local_size, name);
      });
    graded.cell_size = regular.cell_size;
  }


  void
  MathematicalMeshParameters::check(const bool may_choose_size) const
  {
    const std::string section = "section 'Mathematical mesh'";
    AssertThrow(type == Type::gmsh || regular.cell_size > 0. ||
                  (type == Type::regular && may_choose_size),
                InputError("the cell size of the mathematical mesh is " +
                             std::to_string(regular.cell_size) + " m",
                           section,
                           "set 'Cell size' to a positive length"));
    AssertThrow((type == Type::gmsh) == !gmsh_file.empty(),
                InputError(gmsh_file.empty()
                             ? "no file for a mathematical mesh of type gmsh"
                             : "the file '" + gmsh_file +
                                 "' would not be used by this type of mesh",
                           section,
                           "set 'Gmsh file' for 'Type = gmsh' only"));
    AssertThrow(type == Type::graded || graded.local_sizes.empty(),
                InputError("local sizes would not be used by this type of mesh",
                           section,
                           "set 'Type = graded', or leave 'Names' empty"));
  }


  void
  SolverParameters::list_entries(Entries                &entries,
                                 LinearSolverParameters &parameters)
  {
    entries.add("Type",
                parameters.type,
                solver_types,
                "direct: MUMPS; iterative: conjugate gradients with algebraic "
                "multigrid, which needs less memory; automatic: direct up to "
                "Direct limit unknowns, above it iterative, and direct after "
                "all if that takes more than Maximum iterations for the loads "
                "and all functions at crack tips together.");
    entries.add(
      "Direct limit",
      parameters.direct_limit,
      Patterns::Integer(0),
      "automatic: unknowns above which the iterative solver is used.");
    entries.add("Tolerance",
                parameters.tolerance,
                Patterns::Double(0, 1),
                "iterative: relative residual at which it ends [-].");
    entries.add("Maximum iterations",
                parameters.max_iterations,
                Patterns::Integer(1),
                "iterative: iterations after which it gives up (exit code 3).");
    entries.add(
      "Condition number",
      parameters.estimate_condition,
      "Estimate the condition number of the matrix after diagonal scaling and "
      "the place where it is weakest; costs about two more solutions.");
    entries.add("Condition number limit",
                parameters.condition_limit,
                Patterns::Double(1),
                "A condition number above this is warned of [-].");
    AssertThrow(!entries.are_parsed() || parameters.tolerance > 0.,
                InputError("the tolerance of the solver is 0",
                           "parameter 'Solver/Tolerance'",
                           "give a positive number such as 1e-11"));
  }


  SceneNames
  SceneNames::examples()
  {
    SceneNames names;
    names.traces              = {"<traces>"};
    names.joint_sets          = {"<joint set>"};
    names.regions             = {"<region>"};
    names.local_sizes         = {"<local size>"};
    names.block_meshes        = {"<block>"};
    names.materials           = {"<material>"};
    names.boundary_conditions = {"<condition>"};
    names.point_forces        = {"<force>"};
    names.fixed_points        = {"<fixed point>"};
    names.bolts               = {"<bolt>"};
    names.contact_laws        = {"<law>"};
    names.obstacles           = {"<obstacle>"};
    names.initial_velocities  = {"<velocity>"};
    names.probes              = {"<probe>"};
    names.stages              = {"<stage>"};
    return names;
  }


  namespace
  {
    /// The lists of names with their sections.
    template <typename Names>
    auto
    sections_of_lists(Names &names)
    {
      return std::vector<std::pair<std::string, decltype(&names.materials)>>{
        {"Traces", &names.traces},
        {"Joint sets", &names.joint_sets},
        {"Regions", &names.regions},
        {"Mathematical mesh", &names.local_sizes},
        {"Covers", &names.block_meshes},
        {"Materials", &names.materials},
        {"Boundary conditions", &names.boundary_conditions},
        {"Point forces", &names.point_forces},
        {"Fixed points", &names.fixed_points},
        {"Bolts", &names.bolts},
        {"Contact", &names.contact_laws},
        {"Obstacles", &names.obstacles},
        {"Initial velocities", &names.initial_velocities},
        {"Probes", &names.probes},
        {"Stages", &names.stages}};
    }
  } // namespace


  void
  SceneNames::clear(const std::string &section)
  {
    for (const auto &list : sections_of_lists(*this))
      if (list.first == section)
        list.second->clear();
  }


  void
  SceneNames::declare(ParameterHandler &prm)
  {
    SceneNames names;
    for (const auto &list : sections_of_lists(names))
    {
      prm.enter_subsection(list.first);
      prm.declare_entry("Names", "", Patterns::List(Patterns::Anything(), 0));
      prm.leave_subsection();
    }
  }


  void
  SceneNames::parse(ParameterHandler &prm)
  {
    for (const auto &[section, list] : sections_of_lists(*this))
    {
      prm.enter_subsection(section);
      *list = get_names(prm, "Names");
      prm.leave_subsection();

      const std::string     where = "parameter '" + section + "/Names'";
      std::set<std::string> seen;
      for (const std::string &name : *list)
      {
        AssertThrow(seen.insert(name).second,
                    InputError("the name '" + name + "' is given twice",
                               where,
                               "give each name once"));
        AssertThrow(
          name.find_first_of("/=") == std::string::npos,
          InputError("the name '" + name +
                       "' contains a slash or an equals sign",
                     where,
                     "use letters, digits, spaces, dots and hyphens"));
      }
    }
  }


  bool
  SceneParameters::has_inelastic_material() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const Material &material) {
                         return material.law->is_inelastic();
                       });
  }


  bool
  SceneParameters::may_be_continued() const
  {
    return model.analysis == Analysis::dynamics ||
           (model.analysis == Analysis::statics && fracture.n_increments > 0);
  }


  bool
  SceneParameters::is_nonlinear() const
  {
    return contact.is_present() || has_inelastic_material() ||
           !stages.empty() || !bolts.empty() ||
           water.joint_pressure == WaterParameters::JointPressure::network;
  }


  void
  SceneParameters::check() const
  {
    geometry.check(std::any_of(traces.begin(),
                               traces.end(),
                               [](const TraceParameters &file) {
                                 return file.role == CurveRole::boundary;
                               }));
    for (const TraceParameters &file : traces)
      file.check();
    for (const RegionParameters &region : regions)
      region.check();
    covers.check();
    mathematical_mesh.check(covers.may_choose_cell_size());
    AssertThrow(
      !materials.empty(),
      InputError(
        "the scene has no material",
        "section 'Materials'",
        "list at least one name in 'Names' and describe it in a subsection"));
    for (const Material &material : materials)
      material.check(model.plane_state);
    check_gravity();
    check_in_situ_stress();
    for (const BoundaryConditionParameters &condition : boundary_conditions)
      condition.check();
    // A start from equilibrium or stages is a static analysis before another one.
    const bool starts_static =
      !stages.empty() || (model.analysis == Analysis::dynamics &&
                          time.start == TimeParameters::Start::equilibrium);
    load_steps.check(model.kinematics,
                     starts_static ? Analysis::statics : model.analysis,
                     is_nonlinear());
    newton.check(model.kinematics, model.analysis, is_nonlinear());
    output.check();
    exact_solution.check();
    contact.check();
    for (const ObstacleParameters &obstacle : obstacles)
      obstacle.check();
    check_analysis();
    check_fracture();
    check_stages();
    check_bolts();
    check_water();
  }


  void
  SceneParameters::check_gravity() const
  {
    AssertThrow(model.gravity.norm() == 0. ||
                  std::any_of(materials.begin(),
                              materials.end(),
                              [](const Material &material) {
                                return material.density > 0.;
                              }),
                InputError("gravity has no effect, since no material has a "
                           "density",
                           "parameter 'Model/Gravity'",
                           "set 'Density' of the materials, or remove "
                           "'Gravity'"));
  }


  void
  SceneParameters::check_in_situ_stress() const
  {
    if (!in_situ_stress.is_present)
    {
      expect_defaults("In-situ stress",
                      in_situ_stress,
                      "a scene without in-situ stress",
                      "remove it, or set 'Type = K0'");
      return;
    }
    AssertThrow(model.gravity[0] == 0. && model.gravity[1] < 0.,
                InputError("in-situ stress comes from weight, but gravity does "
                           "not point downwards",
                           "parameter 'Model/Gravity'",
                           "give it a negative y component alone, such as "
                           "'0, -9.81'"));
    in_situ_stress.check(model.plane_state);
  }


  namespace
  {
    /// Loads that act where a support holds all of what they push: the support bears them, and
    /// Nitsche's method lets it give way by the load over its penalty.
    void
    add_loads_on_supports(const SceneParameters    &parameters,
                          std::vector<std::string> &notices)
    {
      using Type = BoundaryCondition::Type;
      std::set<std::string> staged;
      for (const StageParameters &stage : parameters.stages)
        for (const auto *names :
             {&stage.added_conditions, &stage.removed_conditions})
          staged.insert(names->begin(), names->end());
      for (const auto &load : parameters.boundary_conditions)
        for (const auto &support : parameters.boundary_conditions)
        {
          const bool is_pressure = load.type == Type::pressure ||
                                   load.type == Type::follower_pressure,
                     is_held =
                       support.type == Type::displacement
                         ? support.components[0] && support.components[1]
                         : support.type == Type::normal_displacement &&
                             is_pressure;
          if (!is_held || !(is_pressure || load.type == Type::traction) ||
              staged.count(load.name) > 0 || staged.count(support.name) > 0)
            continue;
          for (const std::string &boundary : load.boundaries)
            if (std::find(support.boundaries.begin(),
                          support.boundaries.end(),
                          boundary) != support.boundaries.end())
              notices.push_back(
                "the load '" + load.name + "' acts on '" + boundary +
                "', which '" + support.name +
                "' holds: it does nothing but make the support give way by "
                "some thousandths of what it would do to the solid");
        }
    }
  } // namespace


  std::vector<std::string>
  SceneParameters::notices() const
  {
    std::vector<std::string> result;
    if (in_situ_stress.is_present && !in_situ_stress.K0)
      for (const Material &material : materials)
      {
        std::ostringstream text;
        text.precision(6);
        text << "in-situ stress: K0 of the material '" << material.name
             << "' is that of elastic ground that was never strained sideways, "
             << in_situ_stress.ratio(material, model.plane_state);
        result.push_back(text.str());
      }
    for (const Material &material : materials)
      if (model.gravity.norm() > 0. && material.density == 0.)
        result.push_back("gravity has no effect on the material '" +
                         material.name + "', since its 'Density' is 0");
    for (const Material &material : materials)
      if (!material.law->has_associated_flow())
      {
        const bool is_searched = model.analysis == Analysis::safety_factor;
        if (is_searched && safety_factor.flow_rule == FlowRule::associated)
          result.push_back("the material '" + material.name +
                           "' flows with a dilation angle that is its friction "
                           "angle, as limit analysis assumes; set 'Safety "
                           "factor/Flow rule = given' for its own");
        else
          result.push_back("the dilation angle of the material '" +
                           material.name +
                           "' is below its friction angle: bands of shear "
                           "then depend on the mesh, and so may limit loads; "
                           "compare two meshes");
      }
    add_loads_on_supports(*this, result);
    return result;
  }


  void
  SceneParameters::check_fracture() const
  {
    fracture.check();
    AssertThrow(!fracture.grades_mesh() ||
                  mathematical_mesh.type ==
                    MathematicalMeshParameters::Type::gmsh ||
                  mathematical_mesh.regular.cell_size > 0.,
                InputError("only a mesh of a given cell size can be graded "
                           "towards crack tips",
                           "parameter 'Fracture/Tips'",
                           "set 'Mathematical mesh/Cell size', or let tips be "
                           "'as meshed'"));
    if (fracture.n_increments == 0)
      return;
    AssertThrow(load_steps.load_steps().are_ascending(),
                InputError("cracks grow under loads that ascend, but a load "
                           "factor is smaller than the one before it",
                           "parameter 'Load steps/Load factors'",
                           "give factors that ascend, or remove "
                           "'Fracture/Increments'"));
    for (const Material &material : materials)
    {
      const std::string where = "parameter 'Materials/" + material.name;
      AssertThrow(material.toughness > 0. && std::isfinite(material.toughness),
                  InputError("the toughness is " +
                               std::to_string(material.toughness) +
                               " Pa m^0.5, but cracks grow",
                             where + "/Toughness'",
                             "give the material's, > 0"));
    }
  }
} // namespace NMM
