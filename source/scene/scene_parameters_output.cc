#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>

// This file has the parameters of output, probes and the exact solution, and lists all sections of
// a scene.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<Quantity> quantities = []() {
      std::vector<std::pair<std::string, Quantity>> result;
      for (const Quantity quantity : all_quantities())
        result.emplace_back(to_string(quantity), quantity);
      return result;
    }();

    const Words<bool> stress_choices = {{"recovered", true}, {"direct", false}};

    const Words<bool> probe_types = {{"point", false}, {"line", true}};

    const Words<ExactSolutionParameters::Type> exact_solutions = {
      {"none", ExactSolutionParameters::Type::none},
      {"thick ring", ExactSolutionParameters::Type::thick_ring}};
  } // namespace


  void
  OutputParameters::list_entries(Entries &entries)
  {
    dealii::Tensor<1, 2> range({range_min, range_max});

    entries.add("Title",
                title,
                "Title of the picture; empty: the scene's file name.");
    entries.add("Fields",
                fields,
                "Write fields.vtu (fields.pvtu and one file per rank in "
                "parallel) and fields.pvd.");
    entries.add("Fields every",
                fields_every,
                Patterns::Integer(0),
                "Where there are steps of load or time: write fields and "
                "pictures of every so many of them too, as they come, the "
                "fields as a series in fields.pvd; 0: of the last one alone.");
    entries.add(
      "Animation",
      animation,
      "With a series of pictures: write animation.html as well, a page that "
      "plays them in any browser, all in one view and one range of colours.");
    entries.add(
      "Animation quantities",
      animation_quantities,
      quantities,
      "What the page can be coloured by beside the picture's quantity; the "
      "reader chooses. Each makes the page larger by as much again.");
    entries.add("Contacts",
                contacts,
                "With contact: write contacts.csv, the contact points of the "
                "states of which fields are written.");
    entries.add("Checkpoint every",
                checkpoint_every,
                Patterns::Integer(0),
                "Dynamic analysis: write checkpoint.nmm after every so many "
                "steps, or increments of cracks in a static analysis, from "
                "which 'nmm --restart' continues; 0: none.");
    entries.add("Picture", picture, "Write picture.png.");
    entries.add("Picture quantity",
                quantity,
                quantities,
                "What the picture is coloured by; displacement is the length "
                "of the displacement vector, velocity that of the velocity of "
                "a dynamic analysis, plastic strain the equivalent one of "
                "materials that yield.");
    entries.add("Picture stress",
                recovered,
                stress_choices,
                "Stress in the picture: smoothed within each region "
                "(recovered) or as the displacements give it (direct).");
    entries.add(
      "Picture center",
      center,
      "Centre of the polar coordinates of radial and hoop stress, x, y [m].");
    entries.add("Picture range",
                range,
                "Values at the ends of the colour bar [Pa or m]; equal: the "
                "least and greatest value of the solution.");
    entries.add("Picture window",
                window,
                Patterns::List(Patterns::Double(), 0, 4),
                "Part of the plane that pictures show: left, lower, right and "
                "upper end [m]; empty: all.");
    entries.add("Picture width",
                picture_width,
                Patterns::Integer(300, 10000),
                "Width of the picture [pixels].");
    entries.add("Mesh lines",
                mesh_lines,
                "Draw the mathematical mesh in the picture.");
    entries.add(
      "Deformation scale",
      deformation_scale,
      Patterns::Double(),
      "Displacements are multiplied by this in the picture [-]; 0 draws the "
      "undeformed solid; negative: chosen so that the largest displacement is "
      "5 % of the solid's size, or 1 with finite kinematics.");
    entries.add("Length unit",
                length_unit,
                "Unit of length in what is written; only a word.");
    entries.add("Stress unit",
                stress_unit,
                "Unit of stress in what is written; only a word.");
    range_min = range[0];
    range_max = range[1];
    std::vector<Quantity> others;
    for (const Quantity other : animation_quantities)
      if (other != quantity &&
          std::find(others.begin(), others.end(), other) == others.end())
        others.push_back(other);
    animation_quantities = others;
  }


  void
  OutputParameters::check() const
  {
    AssertThrow(window.empty() ||
                  (window.size() == 4 && window[0] < window[2] &&
                   window[1] < window[3]),
                InputError("the window of pictures has no width or height, or "
                           "is not of four numbers",
                           "parameter 'Output/Picture window'",
                           "give its left, lower, right and upper end"));
    AssertThrow(range_min <= range_max,
                InputError("the picture's range runs from " +
                             std::to_string(range_min) + " down to " +
                             std::to_string(range_max),
                           "parameter 'Output/Picture range'",
                           "give the smaller value first"));
    AssertThrow(
      fields || picture || fields_every == 0,
      InputError("fields of every " + std::to_string(fields_every) +
                   " steps are asked for, but neither fields nor pictures",
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
  ProbeParameters::list_entries(Entries &entries, Probe &probe)
  {
    entries.add("Type",
                probe.is_line,
                probe_types,
                "A point, or points at equal distances along a line.");
    entries.add("Point", probe.point, "point: x, y in the solid [m].");
    entries.add("From", probe.from, "line: x, y [m].");
    entries.add("To",
                probe.to,
                "line: x, y [m]. The line may leave the solid.");
    entries.add("Number of points",
                probe.n_points,
                Patterns::Integer(2, 1000000),
                "line: points on it, ends included.");
    if (!entries.are_parsed())
      return;
    const std::string &name = probe.name;
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
  }


  void
  ExactSolutionParameters::list_entries(Entries &entries)
  {
    entries.add(
      "Type",
      type,
      exact_solutions,
      "thick ring: Lame's solution of a circular ring under inner pressure.");
    entries.add("Inner boundary",
                inner_boundary,
                "thick ring: the curve that is its inner circle or a part of "
                "it; centre, radius and pressure are taken from it.");
    entries.add(
      "Outer boundary",
      outer_boundary,
      "thick ring: the curve that is its outer circle or a part of it.");
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


  void
  SceneParameters::list_entries(Entries &entries, const SceneNames &names)
  {
    entries.section("Geometry", &geometry);
    entries.section_of_subsections(
      "Traces",
      names.traces,
      traces,
      "Names of files with joints, each with a subsection of its own.");
    entries.section("Joint sets", [&]() {
      entries.subsections(names.joint_sets,
                          joint_sets,
                          "Names of the sets, each with a subsection of its "
                          "own; their joints are called so.",
                          [&](JointSet &set, const std::string &name) {
                            set.name = name;
                            JointSetParameters::list_entries(entries, set);
                          });
    });
    entries.section_of_subsections(
      "Regions",
      names.regions,
      regions,
      "Names of places, each with a subsection of its own: for materials and "
      "joint sets, to be excavated, or held.");
    entries.section("Mathematical mesh", [&]() {
      mathematical_mesh.list_entries(entries, names.local_sizes);
    });
    entries.section("Covers", [&]() {
      covers.list_entries(entries, names.block_meshes);
    });
    entries.section("Materials", [&]() {
      entries.subsections(names.materials,
                          materials,
                          "Names of the materials, each with a subsection of "
                          "its own; the geometry uses them.",
                          [&](Material &material, const std::string &name) {
                            material.name = name;
                            MaterialParameters::list_entries(entries, material);
                          });
    });
    entries.section("Model", &model);
    entries.section("In-situ stress", &in_situ_stress);
    entries.section_of_subsections(
      "Boundary conditions",
      names.boundary_conditions,
      boundary_conditions,
      "Names of the conditions, each with a subsection of its own. Boundaries "
      "without one are free.");
    entries.section_of_subsections(
      "Point forces",
      names.point_forces,
      point_forces,
      "Names of the forces, each with a subsection of its own.");
    entries.section_of_subsections(
      "Fixed points",
      names.fixed_points,
      fixed_points,
      "Names of the points, each with a subsection of its own.");
    entries.section_of_subsections(
      "Bolts",
      names.bolts,
      bolts,
      "Names of the bolts and anchors, each with a subsection of its own.");
    entries.section("Water", &water);
    entries.section("Contact", [&]() {
      contact.list_entries(entries, names.contact_laws);
    });
    entries.section_of_subsections(
      "Obstacles",
      names.obstacles,
      obstacles,
      "Names of rigid bodies that the solid touches, each with a subsection of "
      "its own.");
    entries.section_of_subsections(
      "Initial velocities",
      names.initial_velocities,
      initial_velocities,
      "Dynamic analysis: names of the motions it starts with, each with a "
      "subsection of its own; motions of a block add up.");
    entries.section("Time", &time);
    entries.section("Relaxation", &relaxation);
    entries.section("Safety factor", &safety_factor);
    entries.section_of_subsections(
      "Stages",
      names.stages,
      stages,
      "Names of the stages after the first equilibrium, in "
      "their order, each with a subsection of its own. Each begins where the "
      "one before has ended.");
    entries.section("Solver",
                    [&]() { SolverParameters::list_entries(entries, solver); });
    entries.section("Load steps", &load_steps);
    entries.section("Newton", &newton);
    entries.section("Output", &output);
    entries.section("Probes", [&]() {
      entries.subsections(
        names.probes,
        probes,
        "Names of the probes, each with a subsection of its own.",
        [&](Probe &probe, const std::string &name) {
          probe.name = name;
          ProbeParameters::list_entries(entries, probe);
        });
    });
    entries.section("Exact solution", &exact_solution);
    entries.section("Fracture", &fracture);
  }


  void
  SceneParameters::declare(dealii::ParameterHandler &prm,
                           const SceneNames         &names)
  {
    Entries entries(Entries::Stage::declare, &prm);
    SceneParameters().list_entries(entries, names);
  }


  void
  SceneParameters::parse(dealii::ParameterHandler &prm, const SceneNames &names)
  {
    Entries entries(Entries::Stage::parse, &prm);
    list_entries(entries, names);
  }
} // namespace NMM
