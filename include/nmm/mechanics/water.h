#ifndef nmm_mechanics_water_h
#define nmm_mechanics_water_h

#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/mechanics/force_term.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * Water at rest below a table z(x), whose pressure [Pa] is
   * @f[ p(x,y) = \gamma_w\,\max(0, z(x)-y). @f]
   * Below an inclined table this is the usual assumption of a phreatic line: it neglects that water
   * flows there. In ground with pores it exerts the forces of buoyancy and of seepage.
   */
  struct WaterTable
  {
    /// Elevation z of the table [m] as a function of x [m].
    std::function<double(double)> elevation;
    /// Unit weight gamma_w of water [N/m^3].
    double unit_weight = 9810.;
  };


  /// The pressure p of @p table [Pa]. Its gradient is exact if the table is a line by points, and a
  /// central difference of the elevation otherwise.
  std::shared_ptr<const dealii::Function<2>>
  hydrostatic_pressure(const WaterTable &table);


  /// The elevation of a line by @p points of ascending x, which is level beyond its ends [m].
  /// @throws InputError naming @p name, if a point is not on the right of the one before it.
  std::function<double(double)>
  line_by_points(const std::vector<dealii::Point<2>> &points,
                 const std::string                   &name);


  /**
   * What water does to a solid of blocks and joints. It presses on outer faces and on both faces of
   * each open joint or crack, closed or gaping, so that contact bears what is left, the effective
   * normal stress sigma_n - p, and every contact law sees that alone. Water has no shear strength and
   * its pressure does not depend on how the solid moves: it is that of the reference position.
   *
   * Total stress is effective stress minus p I. There are two descriptions of blocks:
   * - Without pores, the stress of blocks is the total stress, and strength depends on that.
   * - With pores (Water::fills_pores) all blocks are saturated below the table, and their stress is
   *   the effective one sigma'. From equilibrium of the total stress,
   * @f[ \nabla\cdot\sigma' - \nabla p + \rho\,g = 0, \qquad
       \sigma' n = -(p_\Gamma - p)\,n \quad\text{on faces with the pressure } p_\Gamma, @f]
   *   buoyancy and seepage are the body force -grad p, and faces whose pressure is that of the table
   *   are free. Weights are then those of saturated ground, Material::wet_density.
   *
   * On a block that water surrounds, the forces of both descriptions have the same resultant.
   */
  struct Water
  {
    /// Pressure of free water and in pores, such as hydrostatic_pressure() [Pa]; null: there is none.
    std::shared_ptr<const dealii::Function<2>> table = nullptr;
    /// Pressure in open joints and cracks [Pa]; null: they are dry. It may be the function `table`.
    std::shared_ptr<const dealii::Function<2>> in_joints = nullptr;
    /// Names of boundaries and holes on which the pressure of the table acts. If they are not given,
    /// they are all boundaries on which no displacement is prescribed, and holes are dry.
    std::optional<std::vector<std::string>> faces = std::nullopt;
    /// Whether blocks have pores.
    bool fills_pores = false;
  };


  /// The loads on faces by which @p water acts in kinematics @p kinematics, without their curves.
  /// Pressures follow faces in finite displacements.
  std::vector<BoundaryCondition>
  water_conditions(const Water &water, Kinematics kinematics);


  /**
   * Add @p water to the loads of @p problem: water_conditions() at its end, with the curves of
   * @p mesh, and Material::body_force of all materials, which are those of dry ground before.
   * Edges are integrated with the accuracy of the weight functions. A table that crosses a cell makes
   * the pressure and the weight kink there, at an error of the order of the cell; an interface along
   * the table makes both exact.
   * @throws InputError for a face that does not exist.
   */
  void
  add_water(const Water        &water,
            const PhysicalMesh &mesh,
            Kinematics          kinematics,
            ElasticityProblem  &problem);
} // namespace NMM

#endif
