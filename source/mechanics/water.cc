#include <nmm/base/exceptions.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/mechanics/water.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    class HydrostaticPressure : public dealii::Function<2>
    {
    public:
      explicit HydrostaticPressure(WaterTable table)
        : table(std::move(table))
      {
      }

      double
      value(const Point<2> &x, const unsigned int = 0) const override
      {
        return table.unit_weight * std::max(0., table.elevation(x[0]) - x[1]);
      }

      dealii::Tensor<1, 2>
      gradient(const Point<2> &x, const unsigned int = 0) const override
      {
        if (table.elevation(x[0]) <= x[1])
          return {};
        // A difference over 1e-6 has the error 1e-12 of a smooth table, and as much rounding times 100.
        const double h = 1e-6 * (1. + std::abs(x[0]));
        const double slope =
          0.5 / h * (table.elevation(x[0] + h) - table.elevation(x[0] - h));
        return dealii::Tensor<1, 2>(
          {table.unit_weight * slope, -table.unit_weight});
      }

    private:
      WaterTable table;
    };


    /// Pressure in joints beyond that in the pores beside them.
    class ExcessPressure : public dealii::Function<2>
    {
    public:
      ExcessPressure(std::shared_ptr<const dealii::Function<2>> in_joints,
                     std::shared_ptr<const dealii::Function<2>> in_pores)
        : in_joints(std::move(in_joints))
        , in_pores(std::move(in_pores))
      {
      }

      double
      value(const Point<2> &x, const unsigned int = 0) const override
      {
        return in_joints->value(x) - in_pores->value(x);
      }

    private:
      std::shared_ptr<const dealii::Function<2>> in_joints, in_pores;
    };


    /// The body force of water on a material: the weight of what fills its pores, and -grad p.
    class ForceOfWater : public dealii::Function<2>
    {
    public:
      ForceOfWater(std::shared_ptr<const dealii::Function<2>> pressure,
                   const dealii::Tensor<1, 2>                &weight,
                   const bool                                 fills_pores)
        : dealii::Function<2>(2)
        , pressure(std::move(pressure))
        , weight(weight)
        , fills_pores(fills_pores)
      {
      }

      double
      value(const Point<2> &x, const unsigned int component) const override
      {
        if (!(pressure->value(x) > 0.))
          return 0.;
        return weight[component] -
               (fills_pores ? pressure->gradient(x)[component] : 0.);
      }

    private:
      std::shared_ptr<const dealii::Function<2>> pressure;
      /// Weight of the water in pores [N/m^3].
      dealii::Tensor<1, 2> weight;
      bool                 fills_pores;
    };


    bool
    is_outer(const Curve &curve)
    {
      return curve.role == CurveRole::boundary || curve.role == CurveRole::hole;
    }


    /// Names of the faces on which free water presses.
    std::vector<std::string>
    wet_faces(const Water             &water,
              const PhysicalMesh      &mesh,
              const ElasticityProblem &problem)
    {
      if (water.faces)
      {
        for (const std::string &name : *water.faces)
        {
          const unsigned int c = mesh.find_curve(name);
          AssertThrow(c != invalid_index && is_outer(mesh.curves()[c]),
                      InputError("there is no boundary or hole '" + name + "'",
                                 "the faces that water presses on",
                                 "name boundaries and holes"));
        }
        return *water.faces;
      }
      std::vector<bool> is_held(mesh.curves().size(), false);
      for (const BoundaryCondition &condition : problem.boundary_conditions)
        if (condition.is_support())
          for (const unsigned int c : condition.curves_in(mesh))
            is_held[c] = true;
      std::vector<std::string> result;
      for (unsigned int c = 0; c < mesh.curves().size(); ++c)
        if (mesh.curves()[c].role == CurveRole::boundary && !is_held[c])
          result.push_back(mesh.curves()[c].name);
      return result;
    }


    std::vector<std::string>
    open_joints(const PhysicalMesh &mesh)
    {
      std::vector<std::string> result;
      for (const Curve &curve : mesh.curves())
        if (curve.role == CurveRole::joint && curve.state == JointState::open)
          result.push_back(curve.name);
      return result;
    }


    const char *const at_faces = "water at faces", *const in_joints =
                                                     "water in joints";
  } // namespace


  std::shared_ptr<const dealii::Function<2>>
  hydrostatic_pressure(const WaterTable &table)
  {
    return std::make_shared<const HydrostaticPressure>(table);
  }


  std::function<double(double)>
  line_by_points(const std::vector<Point<2>> &points, const std::string &name)
  {
    AssertThrow(!points.empty(),
                InputError("the line has no points",
                           name,
                           "give points of ascending x"));
    for (std::size_t i = 1; i < points.size(); ++i)
      AssertThrow(points[i - 1][0] < points[i][0],
                  InputError("the line goes back or is vertical at " +
                               to_string(points[i]),
                             name,
                             "give points of ascending x"));
    return [points](const double x) {
      if (x <= points.front()[0])
        return points.front()[1];
      if (x >= points.back()[0])
        return points.back()[1];
      const auto     right = std::upper_bound(points.begin(),
                                          points.end(),
                                          x,
                                          [](const double a, const auto &p) {
                                            return a < p[0];
                                          });
      const Point<2> a = *(right - 1), b = *right;
      return a[1] + (b[1] - a[1]) * ((x - a[0]) / (b[0] - a[0]));
    };
  }


  std::vector<BoundaryCondition>
  water_conditions(const Water &water, const Kinematics kinematics)
  {
    std::vector<BoundaryCondition> result;
    const auto                     add = [&](const char                                *name,
                         std::shared_ptr<const dealii::Function<2>> pressure) {
      BoundaryCondition condition;
      condition.name  = name;
      condition.type  = kinematics == Kinematics::finite
                                              ? BoundaryCondition::Type::follower_pressure
                                              : BoundaryCondition::Type::pressure;
      condition.value = std::move(pressure);
      result.push_back(condition);
    };
    const bool has_pores = water.fills_pores && water.table;
    if (water.table && !has_pores && !(water.faces && water.faces->empty()))
      add(at_faces, water.table);
    if (water.in_joints && !has_pores)
      add(in_joints, water.in_joints);
    else if (water.in_joints && water.in_joints != water.table)
      add(in_joints,
          std::make_shared<const ExcessPressure>(water.in_joints, water.table));
    return result;
  }


  void
  add_water(const Water        &water,
            const PhysicalMesh &mesh,
            const Kinematics    kinematics,
            ElasticityProblem  &problem)
  {
    std::vector<BoundaryCondition> conditions =
      water_conditions(water, kinematics);
    for (BoundaryCondition &condition : conditions)
      condition.curves = condition.name == at_faces
                           ? wet_faces(water, mesh, problem)
                           : open_joints(mesh);
    problem.boundary_conditions.insert(problem.boundary_conditions.end(),
                                       conditions.begin(),
                                       conditions.end());
    if (!water.table)
      return;
    for (Material &material : problem.materials)
    {
      const double excess =
        material.wet_density.value_or(material.density) - material.density;
      if (excess != 0. || water.fills_pores)
        material.body_force =
          std::make_shared<const ForceOfWater>(water.table,
                                               excess * problem.gravity,
                                               water.fills_pores);
    }
  }
} // namespace NMM
