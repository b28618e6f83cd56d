#include <nmm/base/exceptions.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace NMM
{
  namespace
  {
    unsigned int
    n_value_components(const BoundaryCondition::Type type)
    {
      return (type == BoundaryCondition::Type::traction ||
              type == BoundaryCondition::Type::displacement ||
              type == BoundaryCondition::Type::absorbing ||
              type == BoundaryCondition::Type::free_field)
               ? 2
               : 1;
    }


    std::string
    list_of_names(const std::vector<std::string> &names)
    {
      std::string list;
      for (const std::string &name : names)
        list += (list.empty() ? "\"" : ", \"") + name + "\"";
      return list.empty() ? "none" : list;
    }


    void
    check_curve(const BoundaryCondition &condition,
                const std::string       &name,
                const PhysicalMesh      &mesh)
    {
      const std::string where = "boundary condition \"" + condition.name + "\"";
      const unsigned int curve = mesh.find_curve(name);

      std::vector<std::string> boundaries;
      for (const Curve &c : mesh.curves())
        if (c.role == CurveRole::boundary || c.role == CurveRole::hole)
          boundaries.push_back(c.name);

      AssertThrow(curve != invalid_index,
                  InputError("There is no curve \"" + name + "\"",
                             where,
                             "name one of the boundary curves " +
                               list_of_names(boundaries)));
      const CurveRole role = mesh.curves()[curve].role;
      if (role == CurveRole::joint && condition.is_pressure())
      {
        // only open joints have faces
        for (const unsigned int c : mesh.find_curves(name))
          AssertThrow(condition.curves ||
                        mesh.curves()[c].state == JointState::open,
                      InputError("Joint \"" + name +
                                   "\" is closed and has no faces that a "
                                   "pressure could act on",
                                 where,
                                 "give it 'state=open'"));
      }
      else
      {
        AssertThrow(role == CurveRole::boundary || role == CurveRole::hole,
                    InputError("Curve \"" + name +
                                 "\" is no boundary of the solid",
                               where,
                               "name one of the boundary curves " +
                                 list_of_names(boundaries) +
                                 ", or prescribe a pressure if it is a "
                                 "joint"));
      }
    }


    void
    check_condition(const BoundaryCondition &condition,
                    const PhysicalMesh      &mesh)
    {
      const std::string where = "boundary condition \"" + condition.name + "\"";
      if (!condition.curves)
        check_curve(condition, condition.curve, mesh);
      else
        for (const std::string &name : *condition.curves)
          check_curve(condition, name, mesh);

      const unsigned int n_components = n_value_components(condition.type);
      AssertThrow(condition.value == nullptr ||
                    condition.value->n_components == n_components,
                  InputError("The value has " +
                               std::to_string(condition.value->n_components) +
                               " component(s)",
                             where,
                             "give " + std::to_string(n_components)));
      AssertThrow(condition.type != BoundaryCondition::Type::displacement ||
                    condition.components[0] || condition.components[1],
                  InputError("No component of the displacement is prescribed",
                             where,
                             "choose x, y or both, or remove the condition"));
    }


    /// Check that a point is finite and within the bounding box. Whether it lies in the solid
    /// is checked later, by the search for its element.
    void
    check_point(const dealii::Point<2> &point,
                const std::string      &what,
                const PhysicalMesh     &mesh)
    {
      const auto  &box    = mesh.bounding_box().get_boundary_points();
      const double size   = box.first.distance(box.second);
      bool         inside = std::isfinite(point[0]) && std::isfinite(point[1]);
      for (unsigned int d = 0; d < 2; ++d)
        inside = inside && point[d] >= box.first[d] - 1e-9 * size &&
                 point[d] <= box.second[d] + 1e-9 * size;
      AssertThrow(inside,
                  InputError(what + " lies outside the solid",
                             to_string(point),
                             "move it into the solid, whose bounding box is " +
                               to_string(box.first) + " to " +
                               to_string(box.second)));
    }
  } // namespace


  std::vector<unsigned int>
  BoundaryCondition::curves_in(const PhysicalMesh &mesh) const
  {
    if (!curves)
      return mesh.find_curves(curve);
    const std::set<std::string> names(curves->begin(), curves->end());
    std::vector<unsigned int>   result;
    for (unsigned int c = 0; c < mesh.curves().size(); ++c)
      if (names.count(mesh.curves()[c].name) > 0)
        result.push_back(c);
    return result;
  }


  std::vector<unsigned int>
  ElasticityProblem::region_to_material(const PhysicalMesh &mesh) const
  {
    std::vector<std::string> names;
    for (const Material &material : materials)
      names.push_back(material.name);

    std::vector<unsigned int> result;
    result.reserve(mesh.regions().size());
    for (unsigned int r = 0; r < mesh.regions().size(); ++r)
    {
      const PhysicalMesh::Region &region = mesh.regions()[r];
      if (region.material == invalid_index)
      {
        AssertThrow(materials.size() == 1,
                    InputError("Region " + std::to_string(r) +
                                 " has no material",
                               to_string(region.inside),
                               "put a material point into it or name a "
                               "material on its boundary; there are " +
                                 list_of_names(names)));
        result.push_back(0);
        continue;
      }
      const std::string &wanted = mesh.material_names()[region.material];
      unsigned int       found  = invalid_index;
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (materials[m].name == wanted)
          found = m;
      AssertThrow(found != invalid_index,
                  InputError("Region " + std::to_string(r) +
                               " is of the unknown material \"" + wanted + "\"",
                             to_string(region.inside),
                             "define it or name one of " +
                               list_of_names(names)));
      result.push_back(found);
    }
    return result;
  }


  bool
  ElasticityProblem::has_varying_initial_stress() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const Material &material) {
                         return material.varying_initial_stress != nullptr;
                       });
  }


  bool
  ElasticityProblem::has_forces_of_materials() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const Material &material) {
                         return material.body_force != nullptr;
                       });
  }


  void
  ElasticityProblem::check(const PhysicalMesh &mesh) const
  {
    std::set<std::string> names;
    for (const Material &material : materials)
    {
      material.check(plane_state);
      AssertThrow(names.insert(material.name).second,
                  InputError("There are two materials of the same name",
                             "material \"" + material.name + "\"",
                             "rename one of them"));
    }
    AssertThrow(!materials.empty(),
                InputError("There is no material",
                           "the list of materials",
                           "define at least one"));
    region_to_material(mesh);

    AssertThrow(std::isfinite(thickness) && thickness > 0.,
                InputError("The thickness is " + std::to_string(thickness) +
                             " m",
                           "",
                           "give a positive number"));
    AssertThrow(std::isfinite(gravity.norm()),
                InputError("Gravity is not finite",
                           "",
                           "give two numbers in m/s^2"));
    AssertThrow(body_force == nullptr || body_force->n_components == 2,
                InputError("The body force has " +
                             std::to_string(body_force->n_components) +
                             " component(s)",
                           "",
                           "give 2"));

    for (const BoundaryCondition &condition : boundary_conditions)
      check_condition(condition, mesh);

    for (const PointForce &force : point_forces)
    {
      check_point(force.point, "A point force", mesh);
      AssertThrow(std::isfinite(force.force.norm()),
                  InputError("A point force is not finite",
                             to_string(force.point),
                             "give two numbers in N/m"));
    }
    for (const FixedPoint &fixed : fixed_points)
    {
      check_point(fixed.point, "A fixed point", mesh);
      AssertThrow(std::isfinite(fixed.displacement.norm()) &&
                    std::isfinite(fixed.stiffness) && fixed.stiffness >= 0.,
                  InputError("A fixed point has the stiffness " +
                               std::to_string(fixed.stiffness) +
                               " N/m^2 or a displacement that is not finite",
                             to_string(fixed.point),
                             "give a stiffness that is not negative (0: the "
                             "default) and a finite displacement"));
      AssertThrow(fixed.components[0] || fixed.components[1],
                  InputError("A fixed point fixes no component",
                             to_string(fixed.point),
                             "choose x, y or both, or remove it"));
    }
  }
} // namespace NMM
