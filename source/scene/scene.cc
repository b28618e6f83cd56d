#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>
#include <nmm/base/memory.h>
#include <nmm/fracture/tip_grading.h>
#include <nmm/scene/capabilities.h>
#include <nmm/scene/parameter_tree.h>
#include <nmm/scene/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <scene/expression.h>
#include <scene/parsing.h>
#include <sstream>

namespace NMM
{
  namespace
  {
    /**
     * Expressions of x and y, separated by semicolons, as a function with
     * @p n_components components; null if @p text is empty.
     */
    std::shared_ptr<const dealii::Function<2>>
    make_function(const std::string &text,
                  const unsigned int n_components,
                  const std::string &parameter)
    {
      if (text.find_first_not_of(" \t") == std::string::npos)
        return nullptr;

      const std::vector<std::string> expressions =
        dealii::Utilities::split_string_list(text, ';');
      const std::string where = "parameter '" + parameter + "'";
      AssertThrow(expressions.size() == n_components,
                  InputError("'" + text + "' has " +
                               std::to_string(expressions.size()) +
                               " expression(s) instead of " +
                               std::to_string(n_components),
                             where,
                             n_components == 1
                               ? "give one expression of x and y"
                               : "give two, separated by a semicolon"));

      return internal::parse_expressions<2>(expressions, "x,y", parameter);
    }


    unsigned int
    n_values(const BoundaryCondition::Type type)
    {
      return type == BoundaryCondition::Type::traction ||
                 type == BoundaryCondition::Type::displacement ||
                 type == BoundaryCondition::Type::absorbing ||
                 type == BoundaryCondition::Type::free_field
               ? 2
               : 1;
    }


    /**
     * Memory that an analysis uses [bytes], from measurements on squares of 1e5 and 4e5 triangles
     * (`peak_memory` in the summary). If systems are factorized, the factors grow a
     * little faster than the number of cells.
     */
    double
    estimate_memory(const SceneParameters &parameters, const double n_cells)
    {
      const ModelParameters &model = parameters.model;
      const bool is_quadratic      = parameters.mathematical_mesh.degree > 1;
      const bool is_iterative      = model.analysis == Analysis::statics &&
                                model.kinematics == Kinematics::small &&
                                !parameters.is_nonlinear();
      const double linear  = is_quadratic ? 3800. : 2000.;
      const double factors = (is_iterative                          ? 0.
                              : model.analysis == Analysis::statics ? 4700.
                                                                    : 13000.) *
                             (is_quadratic ? 1. : 0.25);
      constexpr double n_measured = 1e5;
      return n_cells * (linear + factors * std::log(std::max(n_cells, 2.)) /
                                   std::log(n_measured));
    }


    /// Checks the memory for a regular mesh, or for a graded one with its largest cells, before it
    /// is made. @throws InputError if it does not suffice.
    void
    check_memory(const SceneParameters       &parameters,
                 const RegularMeshParameters &mesh,
                 const PhysicalMesh          &physical_mesh,
                 const MPI_Comm               communicator)
    {
      const double h = mesh.cell_size;
      if (!(h > 0.))
        return;
      double area = 0.;
      if (mesh.whole_box)
        area = physical_mesh.bounding_box().volume();
      else
        for (const PhysicalMesh::Region &region : physical_mesh.regions())
          area += region.area;
      const double of_triangle =
        h * h *
        (mesh.pattern == MeshPattern::equilateral ? 0.25 * std::sqrt(3.) : 0.5);
      const double       n_cells = area / of_triangle;
      std::ostringstream number;
      number.precision(2);
      number << n_cells << " cells";
      require_memory(estimate_memory(parameters, n_cells),
                     available_memory(communicator),
                     number.str(),
                     "parameter 'Mathematical mesh/Cell size'",
                     [&](const double excess) {
                       std::ostringstream text;
                       text.precision(2);
                       // The advice is a little larger than the size that just fits.
                       text << "choose at least "
                            << 1.05 * h * std::sqrt(excess)
                            << " m, or a machine or limit with more memory";
                       return text.str();
                     });
    }


    /// Checks the memory for a mesh from a file, for its cells whose first corner is in the box of
    /// the solid. @throws InputError if it does not suffice.
    void
    check_memory(const SceneParameters  &parameters,
                 const MathematicalMesh &mesh,
                 const PhysicalMesh     &physical_mesh,
                 const MPI_Comm          communicator)
    {
      const dealii::BoundingBox<2> &box = physical_mesh.bounding_box();
      const double                  n_cells =
        std::count_if(mesh.cells().begin(),
                      mesh.cells().end(),
                      [&](const auto &cell) {
                        return box.point_inside(mesh.vertices()[cell[0]]);
                      });
      require_memory(estimate_memory(parameters, n_cells),
                     available_memory(communicator),
                     std::to_string(static_cast<std::size_t>(n_cells)) +
                       " cells",
                     "parameter 'Mathematical mesh/Gmsh file'",
                     [](const double excess) {
                       std::ostringstream text;
                       text.precision(2);
                       text << "make cells " << 1.05 * std::sqrt(excess)
                            << " times as large, or choose a machine or limit "
                               "with more memory";
                       return text.str();
                     });
    }


    /// Declares a square that stands on its base and is pressed from above. Printed defaults are
    /// thus a scene that can be run, and whose values the user can replace one by one.
    void
    declare_first_scene(dealii::ParameterHandler &prm)
    {
      SceneNames names;
      names.materials           = {"rock"};
      names.boundary_conditions = {"held", "pressed"};
      SceneParameters::declare(prm, names);
      const std::vector<std::array<std::string, 3>> entries = {
        {{"Geometry",
          "Text",
          "boundary name=right material=rock LINESTRING (1 0, 1 1); "
          "boundary name=base LINESTRING (0 0, 1 0); "
          "boundary name=top LINESTRING (1 1, 0 1); "
          "boundary name=left LINESTRING (0 1, 0 0)"}},
        {{"Mathematical mesh", "Cell size", "0.25"}},
        {{"Materials", "Names", "rock"}},
        {{"Materials/rock", "Young's modulus", "1e9"}},
        {{"Boundary conditions", "Names", "held, pressed"}},
        {{"Boundary conditions/held", "Boundary", "base"}},
        {{"Boundary conditions/held", "Type", "displacement"}},
        {{"Boundary conditions/held", "Value", "0; 0"}},
        {{"Boundary conditions/pressed", "Boundary", "top"}},
        {{"Boundary conditions/pressed", "Type", "pressure"}},
        {{"Boundary conditions/pressed", "Value", "1e5"}}};
      for (const auto &[section, key, value] : entries)
      {
        const auto path = dealii::Utilities::split_string_list(section, '/');
        for (const std::string &name : path)
          prm.enter_subsection(name);
        prm.set(key, value);
        for (std::size_t i = 0; i < path.size(); ++i)
          prm.leave_subsection();
      }
    }


    void
    print_parameters(const dealii::ParameterHandler &prm,
                     std::ostream                   &out,
                     const Scene::Format             format)
    {
      using dealii::ParameterHandler;
      switch (format)
      {
        case Scene::Format::prm:
          prm.print_parameters(out,
                               ParameterHandler::PRM |
                                 ParameterHandler::KeepDeclarationOrder);
          break;
        case Scene::Format::json:
          prm.print_parameters(out,
                               ParameterHandler::ShortJSON |
                                 ParameterHandler::KeepDeclarationOrder);
          break;
        case Scene::Format::markdown:
          out << parameter_reference(prm);
          break;
      }
    }
  } // namespace


  Scene::Scene(const std::string              &file_name,
               const std::vector<std::string> &overrides,
               const bool                      is_confined)
    : file_name(file_name)
    , is_confined(is_confined)
    , prm(std::make_shared<dealii::ParameterHandler>())
  {
    std::vector<ParameterAssignment> assignments;
    for (const std::string &text : overrides)
      assignments.push_back(parse_assignment(text));

    {
      dealii::ParameterHandler first_pass;
      SceneNames::declare(first_pass);
      read_parameters(file_name, assignments, true, first_pass);
      names.parse(first_pass);
    }

    SceneParameters::declare(*prm, names);
    read_parameters(file_name, assignments, false, *prm);
    parse_parameters(assignments);
  }


  void
  Scene::parse_parameters(const std::vector<ParameterAssignment> &assignments)
  {
    for (;;)
      try
      {
        scene_parameters = SceneParameters();
        scene_parameters.parse(*prm, names);
        scene_parameters.check();
        check_capabilities(scene_parameters, /* n_ranks = */ 1);
        return;
      }
      catch (const internal::UnusedValue &unused)
      {
        const bool is_assigned =
          std::any_of(assignments.begin(),
                      assignments.end(),
                      [&](const ParameterAssignment &assignment) {
                        return assignment.path == unused.path;
                      });
        if (assignments.empty() || is_assigned)
          throw;
        set_default(unused.path, *prm);
        if (unused.path.back() == "Names")
          names.clear(unused.path.front());
        unused_values[unused.by].push_back(internal::join(unused.path, "/"));
      }
  }


  const SceneParameters &
  Scene::parameters() const
  {
    return scene_parameters;
  }


  std::vector<std::string>
  Scene::notices() const
  {
    std::vector<std::string> result = scene_parameters.notices();
    for (const auto &[by, parameters] : unused_values)
      result.push_back("not used by " + by + ": '" +
                       internal::join(parameters, "', '") + "'");
    return result;
  }


  void
  Scene::print(std::ostream &out, const Format format) const
  {
    print_parameters(*prm, out, format);
  }


  void
  Scene::print_defaults(std::ostream &out, const Format format)
  {
    dealii::ParameterHandler prm;
    if (format == Format::markdown)
      SceneParameters::declare(prm, SceneNames::examples());
    else
      declare_first_scene(prm);
    print_parameters(prm, out, format);
  }


  std::string
  Scene::title() const
  {
    return scene_parameters.output.title.empty()
             ? std::filesystem::path(file_name).stem().string()
             : scene_parameters.output.title;
  }


  std::string
  Scene::relative_to_scene(const std::string &name) const
  {
    namespace fs          = std::filesystem;
    const fs::path folder = fs::path(file_name).parent_path();
    const fs::path path   = folder / name;
    if (is_confined)
    {
      // Links are followed, so that none leads out of the folder.
      const fs::path inside = fs::weakly_canonical(path).lexically_relative(
        fs::weakly_canonical(fs::absolute(file_name).parent_path()));
      AssertThrow(!inside.empty() && *inside.begin() != "..",
                  InputError("the scene names a file outside of its folder",
                             excerpt(name),
                             "put the file beside the scene, or run without "
                             "--confined"));
    }
    return path.string();
  }


  MathematicalMesh
  Scene::make_mathematical_mesh(
    const PhysicalMesh           &physical_mesh,
    const MPI_Comm                communicator,
    const std::vector<LocalSize> &further_sizes) const
  {
    const MathematicalMeshParameters &parameters =
      scene_parameters.mathematical_mesh;
    if (scene_parameters.fracture.grades_mesh())
    {
      GradedMeshParameters graded = parameters.graded;
      if (parameters.type == MathematicalMeshParameters::Type::regular)
        static_cast<RegularMeshParameters &>(graded) = parameters.regular;
      const auto add = [&](const std::vector<LocalSize> &sizes) {
        graded.local_sizes.insert(graded.local_sizes.end(),
                                  sizes.begin(),
                                  sizes.end());
      };
      const FractureParameters &fracture = scene_parameters.fracture;
      add(sizes_at_tips(physical_mesh,
                        fracture.grading,
                        fracture.smallest_at_tips(
                          scene_parameters.model.analysis ==
                          Analysis::dynamics)));
      // Displacements are carried over to the next mesh where cracks grow in motion. Its cells must
      // not be larger, while those at corners grow with the crack.
      if (fracture.n_increments == 0 ||
          scene_parameters.model.analysis == Analysis::statics)
        add(sizes_at_corners(physical_mesh, fracture.grading));
      add(further_sizes);
      check_memory(scene_parameters, graded, physical_mesh, communicator);
      return make_graded_mesh(physical_mesh, graded, parameters.degree);
    }
    switch (parameters.type)
    {
      case MathematicalMeshParameters::Type::graded:
        check_memory(scene_parameters,
                     parameters.graded,
                     physical_mesh,
                     communicator);
        return make_graded_mesh(physical_mesh,
                                parameters.graded,
                                parameters.degree);
      case MathematicalMeshParameters::Type::gmsh: {
        MathematicalMesh mesh =
          read_gmsh_mesh(relative_to_scene(parameters.gmsh_file),
                         parameters.degree);
        check_memory(scene_parameters, mesh, physical_mesh, communicator);
        return mesh;
      }
      case MathematicalMeshParameters::Type::regular:
        break;
    }
    RegularMeshParameters regular = parameters.regular;
    if (regular.cell_size == 0.)
    {
      // A single region is resolved by this mesh. Several regions have meshes of their own, for
      // which this one must be too coarse.
      const unsigned int n_across = scene_parameters.covers.mesh.n_across;
      const bool is_alone = physical_mesh.regions().size() == 1 && n_across > 1;
      regular.cell_size =
        largest_extent(physical_mesh) * (is_alone ? 1. / n_across : 1.5);
    }
    check_memory(scene_parameters, regular, physical_mesh, communicator);
    return make_regular_mesh(physical_mesh, regular, parameters.degree);
  }


  double
  Scene::memory_per_cell() const
  {
    constexpr double n_cells = 1e5;
    return estimate_memory(scene_parameters, n_cells) / n_cells;
  }


  std::vector<RegionMesh>
  Scene::make_region_meshes(const PhysicalMesh &physical_mesh) const
  {
    const CoverParameters  &parameters = scene_parameters.covers;
    const auto             &regions    = physical_mesh.regions();
    std::vector<RegionMesh> choices(regions.size(), parameters.mesh);
    for (const BlockMeshParameters &block : parameters.blocks)
    {
      const unsigned int found = find_region(physical_mesh, block.block);
      AssertThrow(found != invalid_index,
                  InputError("the point " + to_string(block.block) +
                               " lies in no block",
                             "parameter 'Covers/" + block.name + "/Block'",
                             "give a point inside the block that is meant"));
      for (unsigned int r = 0; r < regions.size(); ++r)
        if (regions[r].block == regions[found].block)
          choices[r] = block.mesh;
    }
    return choices;
  }


  ElasticityProblem
  Scene::make_problem() const
  {
    const ModelParameters &model = scene_parameters.model;
    ElasticityProblem      problem;
    problem.plane_state = model.plane_state;
    problem.thickness   = model.thickness;
    problem.gravity     = model.gravity;
    problem.body_force = make_function(model.body_force, 2, "Model/Body force");
    problem.materials  = scene_parameters.materials;
    for (const PointForceParameters &force : scene_parameters.point_forces)
      problem.point_forces.push_back(force.force);
    for (const FixedPointParameters &point : scene_parameters.fixed_points)
      problem.fixed_points.push_back(point.point);

    for (const auto &parameters : scene_parameters.boundary_conditions)
    {
      const auto value =
        make_function(parameters.value,
                      n_values(parameters.type),
                      "Boundary conditions/" + parameters.name + "/Value");
      for (const std::string &curve : parameters.boundaries)
      {
        BoundaryCondition condition;
        condition.name          = parameters.name;
        condition.curve         = curve;
        condition.type          = parameters.type;
        condition.value         = value;
        condition.components[0] = parameters.components[0];
        condition.components[1] = parameters.components[1];
        if (parameters.wave)
          condition.wave = *parameters.wave;
        condition.slides_at_rest = parameters.slides_at_rest;
        problem.boundary_conditions.push_back(condition);
      }
    }
    return problem;
  }
} // namespace NMM
