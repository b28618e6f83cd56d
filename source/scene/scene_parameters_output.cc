#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>

// What is written and compared, and the scene as a whole.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const std::vector<std::pair<std::string, Quantity>> quantities = []() {
      std::vector<std::pair<std::string, Quantity>> result;
      for (const Quantity quantity : all_quantities())
        result.emplace_back(to_string(quantity), quantity);
      return result;
    }();

    const std::vector<std::pair<std::string, bool>> stress_choices =
      {{"recovered", true}, {"direct", false}};

    const std::vector<std::pair<std::string, bool>> probe_types =
      {{"point", false}, {"line", true}};

    const std::vector<std::pair<std::string, ExactSolutionParameters::Type>>
      exact_solutions = {{"none", ExactSolutionParameters::Type::none},
                         {"thick ring",
                          ExactSolutionParameters::Type::thick_ring}};
  } // namespace


  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Title",
                      "",
                      Patterns::Anything(),
                      "Title of the picture; empty: the scene's file name.");
    prm.declare_entry("Fields",
                      "true",
                      Patterns::Bool(),
                      "Write fields.vtu (fields.pvtu and one file per rank in "
                      "parallel) and fields.pvd.");
    prm.declare_entry("Fields every",
                      "0",
                      Patterns::Integer(0),
                      "Where there are steps of load or time: write fields "
                      "and pictures of every so many of them too, as they "
                      "come, the fields as a series in fields.pvd; 0: of the "
                      "last one alone.");
    prm.declare_entry(
      "Animation",
      "true",
      Patterns::Bool(),
      "With a series of pictures: write animation.html as well, "
      "a page that plays them in any browser, all in one "
      "view and one range of colours.");
    prm.declare_entry("Animation quantities",
                      "",
                      Patterns::List(selection(quantities), 0),
                      "What the page can be coloured by beside the picture's "
                      "quantity; the reader chooses. Each makes the page "
                      "larger by as much again.");
    prm.declare_entry("Contacts",
                      "true",
                      Patterns::Bool(),
                      "With contact: write contacts.csv, the contact points of "
                      "the states of which fields are written.");
    prm.declare_entry("Checkpoint every",
                      "0",
                      Patterns::Integer(0),
                      "Dynamic analysis: write checkpoint.nmm after every so "
                      "many steps, from which 'nmm --restart' continues; 0: "
                      "none.");
    prm.declare_entry("Picture",
                      "true",
                      Patterns::Bool(),
                      "Write picture.png.");
    prm.declare_entry("Picture quantity",
                      "von Mises stress",
                      selection(quantities),
                      "What the picture is coloured by; displacement is the "
                      "length of the displacement vector, velocity that of "
                      "the velocity of a dynamic analysis.");
    prm.declare_entry("Picture stress",
                      "recovered",
                      selection(stress_choices),
                      "Stress in the picture: smoothed within each region "
                      "(recovered) or as the displacements give it (direct).");
    prm.declare_entry("Picture center",
                      "0, 0",
                      vector_pattern(),
                      "Centre of the polar coordinates of radial and hoop "
                      "stress, x, y [m].");
    prm.declare_entry("Picture range",
                      "0, 0",
                      vector_pattern(),
                      "Values at the ends of the colour bar [Pa or m]; equal: "
                      "the least and greatest value of the solution.");
    prm.declare_entry("Picture width",
                      "1600",
                      Patterns::Integer(300, 10000),
                      "Width of the picture [pixels].");
    prm.declare_entry("Mesh lines",
                      "true",
                      Patterns::Bool(),
                      "Draw the mathematical mesh in the picture.");
    prm.declare_entry(
      "Deformation scale",
      "-1",
      Patterns::Double(),
      "Displacements are multiplied by this in the picture [-]; "
      "0 draws the undeformed solid; negative: chosen so that "
      "the largest displacement is 5 % of the solid's size, or 1 "
      "with finite and incremental kinematics.");
    prm.declare_entry("Length unit",
                      "m",
                      Patterns::Anything(),
                      "Unit of length in what is written; only a word.");
    prm.declare_entry("Stress unit",
                      "Pa",
                      Patterns::Anything(),
                      "Unit of stress in what is written; only a word.");
  }


  void
  OutputParameters::parse(ParameterHandler &prm)
  {
    title            = prm.get("Title");
    fields           = prm.get_bool("Fields");
    fields_every     = prm.get_integer("Fields every");
    contacts         = prm.get_bool("Contacts");
    checkpoint_every = prm.get_integer("Checkpoint every");
    animation        = prm.get_bool("Animation");
    picture          = prm.get_bool("Picture");
    quantity         = get_selection(prm, "Picture quantity", quantities);
    animation_quantities.clear();
    for (const std::string &name : get_names(prm, "Animation quantities"))
    {
      const auto entry =
        std::find_if(quantities.begin(), quantities.end(), [&](const auto &q) {
          return q.first == name;
        });
      if (entry->second != quantity &&
          std::find(animation_quantities.begin(),
                    animation_quantities.end(),
                    entry->second) == animation_quantities.end())
        animation_quantities.push_back(entry->second);
    }
    recovered = get_selection(prm, "Picture stress", stress_choices);
    center    = get_point(prm, "Picture center");
    const dealii::Point<2> range = get_point(prm, "Picture range");
    range_min                    = range[0];
    range_max                    = range[1];
    picture_width                = prm.get_integer("Picture width");
    mesh_lines                   = prm.get_bool("Mesh lines");
    deformation_scale            = prm.get_double("Deformation scale");
    length_unit                  = prm.get("Length unit");
    stress_unit                  = prm.get("Stress unit");
  }


  void
  OutputParameters::check() const
  {
    AssertThrow(range_min <= range_max,
                InputError("the picture's range runs from " +
                             std::to_string(range_min) + " down to " +
                             std::to_string(range_max),
                           "parameter 'Output/Picture range'",
                           "give the smaller value first"));
    AssertThrow(fields || picture || fields_every == 0,
                InputError("fields of every " + std::to_string(fields_every) +
                             " steps are asked for, but neither fields nor "
                             "pictures",
                           "parameter 'Output/Fields every'",
                           "remove it, or set 'Fields = true'"));
    for (const std::string &unit : {length_unit, stress_unit})
      AssertThrow(unit.find_first_of(",\"") == std::string::npos,
                  InputError("the unit '" + unit +
                               "' contains a comma or quotation mark",
                             "section 'Output'",
                             "it has to fit in a CSV file"));
  }


  void
  ProbeParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Type",
                      "point",
                      selection(probe_types),
                      "A point, or points at equal distances along a line.");
    prm.declare_entry("Point",
                      "0, 0",
                      vector_pattern(),
                      "point: x, y in the solid [m].");
    prm.declare_entry("From", "0, 0", vector_pattern(), "line: x, y [m].");
    prm.declare_entry("To",
                      "0, 0",
                      vector_pattern(),
                      "line: x, y [m]. The line may leave the solid.");
    prm.declare_entry("Number of points",
                      "101",
                      Patterns::Integer(2, 1000000),
                      "line: points on it, ends included.");
  }


  Probe
  ProbeParameters::parse(ParameterHandler &prm, const std::string &name)
  {
    Probe probe;
    probe.name     = name;
    probe.is_line  = get_selection(prm, "Type", probe_types);
    probe.point    = get_point(prm, "Point");
    probe.from     = get_point(prm, "From");
    probe.to       = get_point(prm, "To");
    probe.n_points = prm.get_integer("Number of points");
    AssertThrow(
      !probe.is_line || probe.from != probe.to,
      InputError("the line of a probe has no length, from and to are " +
                   to_string(probe.from),
                 "section 'Probes/" + name + "'",
                 "give two different points, or 'Type = point'"));
    AssertThrow(name.find_first_of(",\"") == std::string::npos,
                InputError("the name '" + name + "' contains a quotation mark",
                           "parameter 'Probes/Names'",
                           "it has to fit in a CSV file"));
    return probe;
  }


  void
  ExactSolutionParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Type",
                      "none",
                      selection(exact_solutions),
                      "thick ring: Lame's solution of a circular ring under "
                      "inner pressure.");
    prm.declare_entry(
      "Inner boundary",
      "",
      Patterns::Anything(),
      "thick ring: the curve that is its inner circle or a part "
      "of it; centre, radius and pressure are taken from it.");
    prm.declare_entry(
      "Outer boundary",
      "",
      Patterns::Anything(),
      "thick ring: the curve that is its outer circle or a part "
      "of it.");
  }


  void
  ExactSolutionParameters::parse(ParameterHandler &prm)
  {
    type           = get_selection(prm, "Type", exact_solutions);
    inner_boundary = prm.get("Inner boundary");
    outer_boundary = prm.get("Outer boundary");
  }


  void
  ExactSolutionParameters::check() const
  {
    AssertThrow(type == Type::none ||
                  (!inner_boundary.empty() && !outer_boundary.empty()),
                InputError("the thick ring's boundaries are not named",
                           "section 'Exact solution'",
                           "set 'Inner boundary' and 'Outer boundary'"));
  }


  namespace
  {
    /// Call @p action in the subsection of each name.
    template <typename Action>
    void
    for_each_name(ParameterHandler               &prm,
                  const std::vector<std::string> &names,
                  const Action                   &action)
    {
      for (const std::string &name : names)
      {
        prm.enter_subsection(name);
        action(name);
        prm.leave_subsection();
      }
    }


    void
    declare_list(ParameterHandler               &prm,
                 const std::string              &section,
                 const std::vector<std::string> &names,
                 const std::string              &help,
                 void (*declare)(ParameterHandler &))
    {
      prm.enter_subsection(section);
      prm.declare_entry("Names",
                        "",
                        Patterns::List(Patterns::Anything(), 0),
                        help);
      for_each_name(prm, names, [&](const std::string &) { declare(prm); });
      prm.leave_subsection();
    }


    void
    declare_section(ParameterHandler  &prm,
                    const std::string &section,
                    void (*declare)(ParameterHandler &))
    {
      prm.enter_subsection(section);
      declare(prm);
      prm.leave_subsection();
    }


    template <typename Section>
    void
    parse_section(ParameterHandler  &prm,
                  const std::string &name,
                  Section           &section)
    {
      prm.enter_subsection(name);
      section.parse(prm);
      prm.leave_subsection();
    }


    /// Structs that keep their own name and parse themselves.
    template <typename Entry>
    void
    parse_list(ParameterHandler               &prm,
               const std::string              &section,
               const std::vector<std::string> &names,
               std::vector<Entry>             &entries)
    {
      prm.enter_subsection(section);
      entries.clear();
      for_each_name(prm, names, [&](const std::string &name) {
        entries.emplace_back();
        entries.back().name = name;
        entries.back().parse(prm);
      });
      prm.leave_subsection();
    }
  } // namespace


  void
  SceneParameters::declare(ParameterHandler &prm, const SceneNames &names)
  {
    declare_section(prm, "Geometry", &GeometryParameters::declare);
    declare_list(prm,
                 "Traces",
                 names.traces,
                 "Names of files with joints, each with a subsection of its "
                 "own.",
                 &TraceParameters::declare);
    declare_list(prm,
                 "Joint sets",
                 names.joint_sets,
                 "Names of the sets, each with a subsection of its own; their "
                 "joints are called so.",
                 &JointSetParameters::declare);
    declare_list(prm,
                 "Regions",
                 names.regions,
                 "Names of places, each with a subsection of its own: for "
                 "materials and joint sets, to be excavated, or held.",
                 &RegionParameters::declare);
    prm.enter_subsection("Mathematical mesh");
    MathematicalMeshParameters::declare(prm, names.local_sizes);
    prm.leave_subsection();
    prm.enter_subsection("Covers");
    CoverParameters::declare(prm, names.block_meshes);
    prm.leave_subsection();
    declare_list(prm,
                 "Materials",
                 names.materials,
                 "Names of the materials, each with a subsection of its own; "
                 "the geometry uses them.",
                 &MaterialParameters::declare);
    declare_section(prm, "Model", &ModelParameters::declare);
    declare_list(prm,
                 "Boundary conditions",
                 names.boundary_conditions,
                 "Names of the conditions, each with a subsection of its own. "
                 "Boundaries without one are free.",
                 &BoundaryConditionParameters::declare);
    declare_list(prm,
                 "Point forces",
                 names.point_forces,
                 "Names of the forces, each with a subsection of its own.",
                 &PointForceParameters::declare);
    declare_list(prm,
                 "Fixed points",
                 names.fixed_points,
                 "Names of the points, each with a subsection of its own.",
                 &FixedPointParameters::declare);
    prm.enter_subsection("Contact");
    ContactSectionParameters::declare(prm, names.contact_laws);
    prm.leave_subsection();
    declare_list(prm,
                 "Obstacles",
                 names.obstacles,
                 "Names of rigid bodies that the solid touches, each with a "
                 "subsection of its own.",
                 &ObstacleParameters::declare);
    declare_list(prm,
                 "Initial velocities",
                 names.initial_velocities,
                 "Dynamic analysis: names of the motions it starts with, each "
                 "with a subsection of its own; motions of a block add up.",
                 &InitialVelocityParameters::declare);
    declare_section(prm, "Time", &TimeParameters::declare);
    declare_section(prm, "Relaxation", &RelaxationSectionParameters::declare);
    declare_section(prm,
                    "Safety factor",
                    &SafetyFactorSectionParameters::declare);
    declare_section(prm, "Solver", &SolverParameters::declare);
    declare_section(prm, "Load steps", &LoadStepParameters::declare);
    declare_section(prm, "Newton", &NewtonSectionParameters::declare);
    declare_section(prm, "Output", &OutputParameters::declare);
    declare_list(prm,
                 "Probes",
                 names.probes,
                 "Names of the probes, each with a subsection of its own.",
                 &ProbeParameters::declare);
    declare_section(prm, "Exact solution", &ExactSolutionParameters::declare);
  }


  void
  SceneParameters::parse(ParameterHandler &prm, const SceneNames &names)
  {
    parse_section(prm, "Geometry", geometry);
    parse_section(prm, "Mathematical mesh", mathematical_mesh);
    parse_section(prm, "Covers", covers);
    parse_section(prm, "Model", model);
    parse_section(prm, "Time", time);
    parse_section(prm, "Relaxation", relaxation);
    parse_section(prm, "Safety factor", safety_factor);
    parse_section(prm, "Load steps", load_steps);
    parse_section(prm, "Newton", newton);
    parse_section(prm, "Output", output);
    parse_section(prm, "Exact solution", exact_solution);
    parse_list(prm,
               "Boundary conditions",
               names.boundary_conditions,
               boundary_conditions);
    parse_list(prm,
               "Initial velocities",
               names.initial_velocities,
               initial_velocities);
    parse_list(prm, "Traces", names.traces, traces);
    parse_list(prm, "Regions", names.regions, regions);
    prm.enter_subsection("Joint sets");
    joint_sets.clear();
    for_each_name(prm, names.joint_sets, [&](const std::string &name) {
      joint_sets.push_back(JointSetParameters::parse(prm, name));
    });
    prm.leave_subsection();
    prm.enter_subsection("Probes");
    probes.clear();
    for_each_name(prm, names.probes, [&](const std::string &name) {
      probes.push_back(ProbeParameters::parse(prm, name));
    });
    prm.leave_subsection();
    parse_list(prm, "Obstacles", names.obstacles, obstacles);
    prm.enter_subsection("Contact");
    contact.parse(prm, names.contact_laws);
    prm.leave_subsection();

    prm.enter_subsection("Solver");
    solver = SolverParameters::parse(prm);
    prm.leave_subsection();

    prm.enter_subsection("Materials");
    materials.clear();
    for_each_name(prm, names.materials, [&](const std::string &name) {
      materials.push_back(MaterialParameters::parse(prm, name));
    });
    prm.leave_subsection();

    prm.enter_subsection("Point forces");
    point_forces.clear();
    force_times.clear();
    for_each_name(prm, names.point_forces, [&](const std::string &name) {
      point_forces.push_back(PointForceParameters::parse(prm));
      force_times.emplace_back();
      force_times.back().name = name;
      force_times.back().parse(prm, /* may_be_released = */ false);
    });
    prm.leave_subsection();

    prm.enter_subsection("Fixed points");
    fixed_points.clear();
    fixed_point_times.clear();
    for_each_name(prm, names.fixed_points, [&](const std::string &name) {
      fixed_points.push_back(FixedPointParameters::parse(prm));
      fixed_point_times.emplace_back();
      fixed_point_times.back().name = name;
      fixed_point_times.back().parse(prm, /* may_be_released = */ true);
    });
    prm.leave_subsection();
  }
} // namespace NMM
