#ifndef nmm_mechanics_in_situ_stress_h
#define nmm_mechanics_in_situ_stress_h

#include <nmm/covers/manifold_mesh.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <optional>
#include <vector>

namespace NMM
{
  /**
   * Initial stress that comes from the weight of the ground:
   * @f[ \sigma_{yy}(x,y) = -\int_y^{G(x)}\gamma(x,y')\,dy', \qquad
       \sigma_{xx} = K_0\,\sigma_{yy}, \qquad \sigma_{zz} = K_0^z\,\sigma_{yy}, \qquad
       \sigma_{xy} = 0, @f]
   * where G(x) is the elevation of the ground line and gamma the unit weight of what lies on the
   * vertical above the point: density times gravity of the materials of the solid, and a given one
   * between the solid and the ground line. What lies above the ground line does not count: it is
   * built later. Where the vertical leaves the solid and enters it again, as through a tunnel, the
   * void counts as filled with the material above it, since it is excavated later.
   *
   * This stress is in balance with the weight if ground line and layers are level, and K_0 is the
   * same along each level. Elsewhere the forces out of balance move the solid.
   */
  struct InSituStress
  {
    /// Ratio of the horizontal to the vertical stress [-]. If it is not given, it is that of a
    /// material that was loaded without horizontal strain: nu / (1 - nu) in plane strain, nu in
    /// plane stress, of each material.
    std::optional<double> K0 = std::nullopt;
    /// Ratio of the stress across the plane to the vertical one [-], in plane strain only. If it is
    /// not given, it is K0.
    std::optional<double> K0_out_of_plane = std::nullopt;
    /// The ground line by points of ascending x, level beyond its ends [m]. If there is none, the
    /// upper surface of the solid is the ground.
    std::vector<dealii::Point<2>> ground_line;
    /// Unit weight gamma between the solid and the ground line [N/m^3].
    double unit_weight_above = 0.;

    /// The ratio K_0 of a material.
    double
    ratio(const Material &material, PlaneState plane_state) const;

    /// Check all values. @throws InputError naming the value.
    void
    check(PlaneState plane_state) const;
  };


  /**
   * Set Material::varying_initial_stress of all materials of @p problem to @p stress, for the solid of
   * @p mesh. The functions do not refer to @p mesh or @p problem. Their cost is proportional to the
   * number of edges that a vertical line crosses.
   * @throws InputError if gravity does not point downwards, or if a material has another initial
   * stress.
   */
  void
  set_in_situ_stress(const InSituStress &stress,
                     const ManifoldMesh &mesh,
                     ElasticityProblem  &problem);
} // namespace NMM

#endif
