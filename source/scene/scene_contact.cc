#include <nmm/base/exceptions.h>
#include <nmm/contact/chosen_parameters.h>
#include <nmm/scene/parameter_tree.h>
#include <nmm/scene/scene.h>

#include <algorithm>
#include <cmath>
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
  Scene::make_obstacles(const PhysicalMesh           &physical_mesh,
                        std::vector<ObstacleRelease> *releases) const
  {
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
      if (releases != nullptr && release_time >= 0.)
        releases->push_back(
          {static_cast<unsigned int>(obstacles.size()), release_time});
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


  ContactParameters
  Scene::make_contact_parameters(const ContactSurface    &surface,
                                 const ElasticityProblem &problem) const
  {
    check_law_names(surface);
    const ContactSectionParameters &section  = scene_parameters.contact;
    const Analysis                  analysis = scene_parameters.model.analysis;
    ContactChoices                  choices;
    choices.law = [&](const ContactLaw &springs) {
      return section.law.make_law(springs);
    };
    for (const ContactLawParameters &law : section.laws)
      choices.pairs.push_back(
        {law.between[0], law.between[1], [&law](const ContactLaw &springs) {
           return law.make_law(springs);
         }});
    choices.use = analysis == Analysis::statics    ? ContactUse::statics
                  : analysis == Analysis::dynamics ? ContactUse::motion
                                                   : ContactUse::relaxation;
    choices.has_multipliers =
      section.enforcement == Enforcement::augmented_lagrangian;
    choices.has_graded_tips = scene_parameters.fracture.grades_mesh();
    if (choices.has_multipliers)
      choices.values.penetration_tolerance = section.penetration_tolerance;
    choices.values.reach           = section.reach;
    choices.values.n_points        = section.n_points;
    choices.values.integration     = section.integration;
    choices.values.corner_rounding = section.corner_rounding;
    choices.gravity                = scene_parameters.model.gravity;
    if (analysis == Analysis::safety_factor)
      choices.way_at_corners = scene_parameters.safety_factor.max_displacement;
    return choose_contact_parameters(surface, problem, choices);
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
} // namespace NMM
