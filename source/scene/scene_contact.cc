#include <nmm/base/exceptions.h>
#include <nmm/contact/diagnostics/locked_corners.h>
#include <nmm/contact/law/coulomb_law.h>
#include <nmm/contact/surface/initial_stress.h>
#include <nmm/covers/crack_tip.h>
#include <nmm/scene/parameter_tree.h>
#include <nmm/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <scene/parsing.h>
#include <scene/shapes.h>
#include <set>

// This file makes the contact of a scene: its faces, laws and rigid obstacles.
namespace NMM
{
  using dealii::Point;

  namespace
  {
    std::string
    choice(const std::string              &word,
           const std::vector<std::string> &names,
           const std::string              &nothing)
    {
      return names.empty()
               ? nothing
               : "choose among '" +
                   internal::join(near_matches(word, names), "', '") + "'";
    }
  } // namespace


  void
  Scene::set_joint_states(Geometry &geometry) const
  {
    const ContactSectionParameters &parameters = scene_parameters.contact;
    for (const auto &[key, names, state] :
         {std::make_tuple("Open joints",
                          parameters.open_joints,
                          JointState::open),
          std::make_tuple("Tied joints",
                          parameters.tied_joints,
                          JointState::closed)})
      for (const std::string &name : names)
      {
        bool                     is_found = false;
        std::vector<std::string> joints;
        for (Curve &curve : geometry.curves())
          if (curve.role == CurveRole::joint)
          {
            joints.push_back(curve.name);
            if (curve.name == name)
            {
              curve.state = state;
              is_found    = true;
            }
          }
        AssertThrow(is_found,
                    InputError("the geometry has no joint '" + name + "'",
                               std::string("parameter 'Contact/") + key + "'",
                               choice(name, joints, "it has no joints")));
      }
    for (const std::string &name : parameters.open_joints)
      AssertThrow(std::find(parameters.tied_joints.begin(),
                            parameters.tied_joints.end(),
                            name) == parameters.tied_joints.end(),
                  InputError("the joint '" + name +
                               "' is listed as open and "
                               "as tied",
                             "parameter 'Contact/Tied joints'",
                             "remove it from one of both lists"));
  }


  std::vector<RigidObstacle>
  Scene::make_obstacles(const PhysicalMesh &physical_mesh,
                        ObstacleSwitches   *switches) const
  {
    const auto is_frozen = std::make_shared<bool>(false);
    if (switches != nullptr)
      *switches = {{}, is_frozen};

    std::vector<RigidObstacle> obstacles;
    const auto                 add = [&](const std::string &name,
                         const Curve       &curve,
                         const TimeVector  &motion,
                         const double       release_time,
                         const std::string &section) {
      AssertThrow(physical_mesh.find_curve(name) == invalid_index &&
                    std::none_of(obstacles.begin(),
                                 obstacles.end(),
                                 [&](const RigidObstacle &other) {
                                   return other.name == name;
                                 }),
                  InputError("a curve of the geometry or another obstacle is "
                                             "called '" +
                               name + "', too",
                             "parameter '" + section + "/Names'",
                             "give it another name"));
      RigidObstacle obstacle;
      obstacle.name         = name;
      obstacle.pieces       = internal::oriented_pieces(curve);
      obstacle.displacement = motion;
      if (switches != nullptr && release_time >= 0.)
        switches->releases.push_back(
          {static_cast<unsigned int>(obstacles.size()), release_time});
      if (switches != nullptr && motion)
        obstacle.displacement = [=](const double t) {
          return motion(*is_frozen ? 0. : t);
        };
      obstacles.push_back(std::move(obstacle));
    };
    for (const ObstacleParameters &parameters : scene_parameters.obstacles)
    {
      const std::string section = "Obstacles/" + parameters.name;
      add(parameters.name,
          internal::read_shape(parameters.shape,
                               parameters.file.empty()
                                 ? ""
                                 : relative_to_scene(parameters.file),
                               section,
                               file_name),
          make_vector_function(parameters.displacement,
                               section + "/Displacement"),
          parameters.release_time,
          "Obstacles");
    }
    for (const RegionParameters &parameters : scene_parameters.regions)
      if (parameters.use == RegionParameters::Use::restraint)
        add(parameters.name,
            make_region(parameters),
            {},
            parameters.release_time,
            "Regions");
    return obstacles;
  }


  void
  Scene::check_law_names(const ContactSurface &surface) const
  {
    std::set<std::string> names;
    for (unsigned int e = 0; e < surface.edges().size(); ++e)
      names.insert(surface.name(e));
    const std::vector<std::string> list(names.begin(), names.end());
    for (const ContactLawParameters &law : scene_parameters.contact.laws)
      for (const std::string &name : law.between)
        AssertThrow(name.empty() || names.count(name) > 0,
                    InputError("there are no faces called '" + name + "'",
                               "parameter 'Contact/" + law.name + "/Between'",
                               choice(name, list, "there are no faces at all") +
                                 ", or any; joints that are closed have no "
                                 "faces"));
  }


  namespace
  {
    /// Largest Young's modulus of each block [Pa].
    std::vector<double>
    block_moduli(const PhysicalMesh &mesh, const ElasticityProblem &problem)
    {
      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(mesh);
      std::vector<double> moduli(mesh.n_blocks(), 0.);
      for (unsigned int r = 0; r < mesh.regions().size(); ++r)
      {
        double &modulus = moduli[mesh.regions()[r].block];
        modulus =
          std::max(modulus,
                   problem.materials[region_to_material[r]].youngs_modulus);
      }
      return moduli;
    }


    /// Rank of each value in ascending order, from 0 on; equal values have equal ranks.
    std::vector<unsigned int>
    ranks(const std::vector<double> &values)
    {
      const std::set<double>    steps(values.begin(), values.end());
      std::vector<unsigned int> result;
      for (const double value : values)
        result.push_back(std::distance(steps.begin(), steps.find(value)));
      return result;
    }


    /// The size of cells at faces [m] below which a twentieth of the faces lies by their length, or a
    /// tenth by their number of edges; an edge is in one cell. Slivers are left out, since their cells can be
    /// as thin as they are, unless all regions are slivers.
    double
    smaller_cell_size(const ContactSurface &surface, const bool is_by_length)
    {
      const ManifoldMesh &mesh    = surface.cover_system().manifold_mesh();
      const auto         &regions = mesh.physical_mesh().regions();
      const bool          with_slivers =
        std::all_of(regions.begin(), regions.end(), [](const auto &region) {
          return region.is_sliver;
        });
      std::vector<std::pair<double, double>> sizes;
      double                                 sum = 0.;
      for (unsigned int e = 0; e < surface.edges().size(); ++e)
      {
        const auto &edge = surface.edges()[e];
        if (surface.is_rigid(e) ||
            (!with_slivers && regions[mesh.region(edge.element)].is_sliver))
          continue;
        // The size is the edge length of the equilateral triangle with the same area.
        const double twice_area =
          1. / std::abs(dealii::determinant(edge.inverse));
        const double weight = is_by_length ? edge.start.distance(edge.end) : 1.;
        sizes.emplace_back(std::sqrt(2. * twice_area / std::sqrt(3.)), weight);
        sum += weight;
      }
      Assert(!sizes.empty(), dealii::ExcMessage("A solid has a boundary."));
      std::sort(sizes.begin(), sizes.end());
      double left = (is_by_length ? 0.05 : 0.1) * sum;
      auto   size = sizes.begin();
      while (left >= size->second && size + 1 != sizes.end())
        left -= (size++)->second;
      return size->first;
    }


    /// Cracks with tips towards which the mesh is graded.
    struct FineCracks
    {
      FineCracks() = default;

      explicit FineCracks(const PhysicalMesh &mesh)
      {
        for (const CrackTip &tip : find_crack_tips(mesh))
        {
          shortest = std::min(shortest, tip.free_radius);
          names.insert(mesh.curves()[tip.curve].name);
        }
      }

      /// The cell size [m] that the stiffness of springs between their faces follows. Cells at tips
      /// are up to a million times smaller than the crack; with springs as stiff as such cells the
      /// pressure oscillates. With a stiffness of 30 E / (0.003 R), the intensity factors of a closed
      /// crack of length R are wrong by less than 1e-4.
      double
      cell_size(const ContactSurface &surface) const
      {
        return std::max(smaller_cell_size(surface, /* is_by_length = */ false),
                        3e-3 * shortest);
      }

      std::set<std::string> names;
      /// The smallest free radius of a tip [m].
      double shortest = std::numeric_limits<double>::max();
    };
  } // namespace


  ContactParameters
  Scene::make_contact_parameters(const ContactSurface    &surface,
                                 const ElasticityProblem &problem) const
  {
    check_law_names(surface);
    const ContactSectionParameters &section = scene_parameters.contact;
    const bool                      is_augmented =
      section.enforcement == Enforcement::augmented_lagrangian;
    const double        size = contact_cell_size(surface);
    const PhysicalMesh &mesh =
      surface.cover_system().manifold_mesh().physical_mesh();
    const FineCracks cracks =
      scene_parameters.fracture.grades_mesh() ? FineCracks(mesh) : FineCracks();
    const double fine_size =
      cracks.names.empty() ? size : std::min(size, cracks.cell_size(surface));
    const std::vector<double> moduli = block_moduli(mesh, problem);
    const double modulus = *std::min_element(moduli.begin(), moduli.end());

    // The penalty method needs stiff springs to be accurate, which a static
    // analysis allows. Stiff shear springs prevent Newton's method from
    // deciding between stick and slip in a static analysis; with soft ones in dynamics, faces that
    // lose contact repeatedly slide too far.
    const Analysis analysis = scene_parameters.model.analysis;
    const bool     is_stiff = !is_augmented && analysis == Analysis::statics;
    const auto     make_law = [&](const double cell_size) {
      // A spring at a vertex represents the length of a cell, which does not enter its stiffness.
      const double length =
        section.integration == ContactIntegration::points ? 1. : cell_size;
      CoulombLaw chosen;
      chosen.normal_stiffness = (is_stiff ? 30. : 10.) * modulus / length;
      chosen.shear_stiffness =
        cracks.names.empty()
              ? (analysis == Analysis::dynamics ? 10. : 1.) * modulus / length
              : chosen.normal_stiffness;
      return section.law.make_law(chosen);
    };
    ContactParameters parameters;
    parameters.law           = make_law(size);
    const auto law_of_cracks = make_law(fine_size);
    const auto may_be_crack  = [&](const std::string &name) {
      return name.empty() || cracks.names.count(name) > 0;
    };
    for (const ContactLawParameters &law : section.laws)
      parameters.pairs.push_back({law.between[0],
                                  law.between[1],
                                  law.make_law(may_be_crack(law.between[0]) &&
                                                   may_be_crack(law.between[1])
                                                 ? *law_of_cracks
                                                 : *parameters.law)});
    // the first law that fits holds
    for (const std::string &crack : cracks.names)
      parameters.pairs.push_back({crack, crack, law_of_cracks});
    if (is_augmented)
      parameters.penetration_tolerance = section.penetration_tolerance > 0.
                                           ? section.penetration_tolerance
                                           : 1e-5 * fine_size;
    parameters.reach          = section.reach;
    parameters.n_points       = section.n_points;
    parameters.integration    = section.integration;
    parameters.slave_priority = ranks(moduli);
    parameters.initial_stress = initial_stress_at_faces(surface, problem);
    parameters.rounded_corners =
      find_locked_corners(surface, scene_parameters.model.gravity);
    // A block that moves further than a trial of the factor of safety allows does not stand. Elsewhere
    // the rounding is a small part of what the mesh resolves.
    constexpr double further = 1.5, of_cell = 0.01;
    parameters.corner_rounding =
      section.corner_rounding > 0. ? section.corner_rounding
      : analysis == Analysis::safety_factor
        ? further * scene_parameters.safety_factor.max_displacement
        : of_cell * size;
    return parameters;
  }


  RayleighDamping
  Scene::make_damping(const PhysicalMesh      &mesh,
                      const ElasticityProblem &problem,
                      const bool               has_friction) const
  {
    const TimeParameters  &time   = scene_parameters.time;
    const ModelParameters &model  = scene_parameters.model;
    RayleighDamping        result = time.damping;
    if (result.stiffness >= 0.)
      return result;
    result.stiffness = 0.;
    if (!has_friction || model.analysis != Analysis::dynamics ||
        !time.time_scheme(model.analysis, model.kinematics, true).is_conserving)
      return result;

    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(mesh);
    const std::vector<double> moduli = block_moduli(mesh, problem);
    std::vector<double>       areas(mesh.n_blocks(), 0.), masses = areas;
    for (unsigned int r = 0; r < mesh.regions().size(); ++r)
    {
      const PhysicalMesh::Region &region = mesh.regions()[r];
      areas[region.block] += region.area;
      masses[region.block] +=
        region.area * problem.materials[region_to_material[r]].density;
    }
    // The times are H / c = (A rho / E)^(1/2) of each block.
    std::vector<double> times;
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
      times.push_back(std::sqrt(masses[b] / moduli[b]));
    const auto median = times.begin() + (times.size() - 1) / 2;
    std::nth_element(times.begin(), median, times.end());
    result.stiffness = 4. / dealii::numbers::PI * *median;
    return result;
  }


  double
  contact_cell_size(const ContactSurface &surface)
  {
    return smaller_cell_size(surface, /* is_by_length = */ true);
  }
} // namespace NMM
