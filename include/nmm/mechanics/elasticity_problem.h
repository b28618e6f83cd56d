#ifndef nmm_mechanics_elasticity_problem_h
#define nmm_mechanics_elasticity_problem_h

#include <nmm/materials/material.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

/**
 * @defgroup mechanics Mechanics
 *
 * Element terms, loads and supports of elastic and inelastic solids with small and finite displacements. This
 * module does not know contact.
 *
 * **In**: a CoverSystem, a QuadratureCollection, dealii::AffineConstraints (of aggregated covers)
 * and an ElasticityProblem with materials, loads and supports. **Out**: the displacement unknowns
 * (2 per cover) [m], stresses, residuals and tangents.
 *
 * | file (in nmm/mechanics) | job |
 * |---|---|
 * | elasticity_problem.h | materials, loads and supports |
 * | static_elasticity.h | small displacements, one linear system |
 * | finite_elasticity.h | total Lagrangian forces and tangent |
 * | inelastic_terms.h | adds inelastic materials, in small and finite displacements |
 * | static_system.h, nonlinear_statics.h | static equilibrium of terms at growing load factors |
 * | force_term.h | interface of one kind of force, and the unknowns of a body |
 * | force_sink.h | where forces between a few covers, of whichever blocks, are added |
 * | mechanical_model.h | the forces of a body as a list of terms |
 * | solid_term.h | the term of a solid, at rest or in motion, in both kinematics |
 * | spring_term.h | the term of springs between material points |
 * | bolt.h, bolt_term.h | the term of rock bolts and anchors |
 * | water.h | the loads of water below a table, on faces, in joints and in pores |
 * | absorbing_term.h | the term of boundaries through which waves leave and come in |
 * | joint_flow.h, joint_water_term.h | flow in a network of joints, and the term of its pressure |
 * | loading.h | loads, releases and base acceleration as functions of time |
 * | mass_matrix.h | consistent mass matrix |
 * | material_vector.h | positions of material points as functions of the unknowns |
 * | solid_layout.h | the unknowns of a solid |
 * | disk_cover.h | a disk with functions of its own, as at a crack tip |
 * | carried_covers.h | displacements of a solid that has been cut further |
 * | load_values.h | tractions and prescribed displacements at points |
 * | displacement_field.h, stress_recovery.h, block_motion.h | evaluation of a solution |
 * | error_norms.h, thick_ring.h | errors, and an exact solution to compare with |
 *
 * Order of calls, for small and for finite displacements:
 * @code
 * StaticElasticity elasticity(covers, quadrature, constraints, problem);
 * elasticity.assemble();
 * elasticity.solve(LinearSolverParameters());
 * DisplacementField field(covers, problem, elasticity.solution());
 * @endcode
 * @code
 * FiniteElasticity elasticity(covers, quadrature, constraints, problem);
 * NonlinearStatics statics(elasticity);
 * statics.run(LoadSteps::equal(10));
 * DisplacementField field(covers, problem, statics.solution());
 * @endcode
 * Further forces, here springs, are a list of terms beside the solid:
 * @code
 * FiniteElasticity elasticity(covers, quadrature, constraints, problem);
 * const auto solid = make_solid_at_rest(elasticity, Kinematics::finite);
 * SpringTerm springs(covers, solid->layout(), {spring});
 * NonlinearStatics statics(*solid, NewtonParameters(), {&springs});
 * statics.run(LoadSteps::equal(10));
 * @endcode
 *
 * To add a kind of force, see ForceTerm (force_term.h); SpringTerm is an example. A boundary
 * condition of a new type goes into BoundaryCondition, and its integrals into
 * source/mechanics/edge_tables.h.
 */

namespace NMM
{
  class PhysicalMesh;

  /// A load or displacement condition on a named curve.
  struct BoundaryCondition
  {
    /// The kinds of loads and conditions.
    enum class Type
    {
      /// Force per area t(x) [Pa], two components.
      traction,
      /// Pressure p(x) [Pa], positive in compression: t = -p n, with normal and area of the
      /// reference configuration, so that the force keeps its direction.
      pressure,
      /// Pressure p(X) [Pa] that rotates with the surface and acts on its current
      /// area: t dA = -p cof(F) N dA. In small-displacement analyses the same
      /// as `pressure`.
      follower_pressure,
      /// Prescribed displacement [m] of the components in `components`.
      displacement,
      /// Prescribed displacement along the outward normal [m]; the tangential
      /// direction is free of traction. The value 0 makes a symmetry line.
      normal_displacement,
      /// Waves leave through it in motion, see AbsorbingTerm, with the wave that comes in as the
      /// value, two components of `wave`. At rest it is held as a displacement of zero.
      absorbing,
      /// An absorbing boundary on a vertical side, beside which the ground goes on as a column that
      /// moves by itself. The value is the wave that comes in at the base of the column.
      free_field
    };

    /// What the value of an absorbing boundary is.
    enum class Wave
    {
      /// The velocity of the incoming wave [m/s].
      velocity,
      /// The traction that the incoming wave alone exerts on the solid [Pa].
      stress
    };

    /// Name for messages.
    std::string name;
    /// Name of the curve of the physical mesh on which the condition holds: a boundary or a hole.
    /// A pressure may also act on an open joint, on both of its faces.
    std::string curve;
    /// Kind of the condition.
    Type type = Type::traction;
    /// Value as a function of the reference position, with two components for traction,
    /// displacement and absorbing boundaries, one for the other types. Null stands for zero.
    std::shared_ptr<const dealii::Function<2>> value;
    /// Which components (x, y) a condition of type `displacement` prescribes.
    bool components[2] = {true, true};
    /// Whether an absorbing boundary is held at rest along its normal only.
    bool slides_at_rest = false;
    /// The kind of value of an absorbing boundary.
    Wave wave = Wave::velocity;
    /// Names of any number of curves on which it holds, instead of `curve`.
    std::optional<std::vector<std::string>> curves = std::nullopt;

    /// Indices of the curves of @p mesh on which it holds.
    std::vector<unsigned int>
    curves_in(const PhysicalMesh &mesh) const;

    /// Whether the condition is a pressure of either type.
    bool
    is_pressure() const
    {
      return type == Type::pressure || type == Type::follower_pressure;
    }

    /// Whether it holds displacements, which Nitsche's method imposes, and is no load.
    bool
    is_support() const
    {
      return type == Type::displacement || holds_normal() || is_absorbing();
    }

    /// Whether it is a support along the normal only.
    bool
    holds_normal() const
    {
      return type == Type::normal_displacement ||
             (is_absorbing() && slides_at_rest);
    }

    /// Whether it absorbs waves.
    bool
    is_absorbing() const
    {
      return type == Type::absorbing || type == Type::free_field;
    }
  };

  /// Eq. (11): a force at a point of the solid.
  struct PointForce
  {
    /// Point in the reference configuration [m].
    dealii::Point<2> point;
    /// Force per unit thickness [N/m].
    dealii::Tensor<1, 2> force;
  };

  /// Eq. (12): a point that is held by a spring.
  struct FixedPoint
  {
    /// Point in the reference configuration [m].
    dealii::Point<2> point;
    /// Displacement at which the spring exerts no force [m].
    dealii::Tensor<1, 2> displacement;
    /// Stiffness of the spring per unit thickness [N/m^2]. 0 stands for the default, 1000 times
    /// the largest Young's modulus.
    double stiffness = 0.;
    /// Which components (x, y) of the displacement are held.
    bool components[2] = {true, true};
  };

  /// A static problem except for geometry and covers: materials, loads and supports.
  struct ElasticityProblem
  {
    /// Plane stress or plane strain, for all materials.
    PlaneState plane_state = PlaneState::plane_stress;
    /// Thickness of the solid [m]. Forces and energies are computed per unit thickness, so that it
    /// matters for output only.
    double thickness = 1.;
    /// Materials, with names that differ.
    std::vector<Material> materials;
    /// Loads and displacement conditions on curves.
    std::vector<BoundaryCondition> boundary_conditions;
    /// Forces at points.
    std::vector<PointForce> point_forces;
    /// Points held by springs.
    std::vector<FixedPoint> fixed_points;
    /// Acceleration of gravity, which acts on the density of materials [m/s^2].
    dealii::Tensor<1, 2> gravity;
    /// Further body force f(x) with two components [N/m^3]; null: none.
    std::shared_ptr<const dealii::Function<2>> body_force;

    /**
     * Index into `materials` for each region of @p mesh. A region without a
     * named material gets the only material if there is just one.
     * @throws InputError for an unknown material or a region without one.
     */
    std::vector<unsigned int>
    region_to_material(const PhysicalMesh &mesh) const;

    /// Whether the initial stress of any material varies within it.
    bool
    has_varying_initial_stress() const;

    /// Whether any material has a body force of its own.
    bool
    has_forces_of_materials() const;

    /// Check that values are valid and that the problem fits @p mesh.
    /// @throws InputError naming the value, also for an unknown material, a region without one, a
    /// condition on an unknown curve or on a curve that is no boundary, and a point outside of the
    /// bounding box of @p mesh.
    void
    check(const PhysicalMesh &mesh) const;
  };
} // namespace NMM

#endif
