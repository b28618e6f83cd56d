#ifndef nmm_mechanics_elasticity_problem_h
#define nmm_mechanics_elasticity_problem_h

#include <nmm/materials/material.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  class PhysicalMesh;

  /// A condition on a named boundary curve.
  struct BoundaryCondition
  {
    enum class Type
    {
      /// Force per area t(x) [Pa], two components.
      traction,
      /// Pressure p(x) [Pa], positive when it pushes: t = -p n, with the normal
      /// and per area of the reference configuration, so that the force keeps its
      /// direction.
      pressure,
      /// Pressure p(X) [Pa] that turns with the surface and acts on its current
      /// area: t dA = -p cof(F) N dA. In small-displacement analyses the same
      /// as `pressure`.
      follower_pressure,
      /// Prescribed displacement [m] of the components in `components`.
      displacement,
      /// Prescribed displacement along the outward normal [m]; the tangential
      /// direction is free of traction. With value 0: a symmetry line.
      normal_displacement
    };

    /// For messages.
    std::string name;
    /// Curve of the physical mesh it holds on: a boundary or hole; of pressures also an open
    /// joint, on both of whose faces they act.
    std::string curve;
    Type        type = Type::traction;
    /// Two components for traction and displacement, else one. Null: zero.
    std::shared_ptr<const dealii::Function<2>> value;
    /// Which components a displacement condition prescribes.
    bool components[2] = {true, true};

    bool
    is_pressure() const
    {
      return type == Type::pressure || type == Type::follower_pressure;
    }
  };

  /// Eq. (11): a force [N per unit thickness] at a point of the solid.
  struct PointForce
  {
    dealii::Point<2>     point;
    dealii::Tensor<1, 2> force;
  };

  /// Eq. (12): a point held by a spring of `stiffness` [N/m per unit thickness]
  /// at `displacement` [m]. Stiffness 0 stands for the default, 1000 times the largest
  /// Young's modulus.
  struct FixedPoint
  {
    dealii::Point<2>     point;
    dealii::Tensor<1, 2> displacement;
    double               stiffness     = 0.;
    bool                 components[2] = {true, true};
  };

  /// Everything the static problem consists of besides geometry and covers.
  struct ElasticityProblem
  {
    PlaneState                     plane_state = PlaneState::plane_stress;
    double                         thickness   = 1.;
    std::vector<Material>          materials;
    std::vector<BoundaryCondition> boundary_conditions;
    std::vector<PointForce>        point_forces;
    std::vector<FixedPoint>        fixed_points;
    /// Acceleration of gravity [m/s^2]; acts on density.
    dealii::Tensor<1, 2> gravity;
    /// Further body force f(x) [N/m^3], two components; null: none.
    std::shared_ptr<const dealii::Function<2>> body_force;

    /**
     * Material of each region of @p mesh as index into materials; a region without a
     * named material takes the only one there is.
     * @throws InputError for an unknown material, a region without one, a
     * condition on an unknown curve or on a curve that is no boundary, a point outside.
     */
    std::vector<unsigned int>
    region_to_material(const PhysicalMesh &mesh) const;

    void
    check(const PhysicalMesh &mesh) const;
  };
} // namespace NMM

#endif
