#ifndef nmm_fracture_turned_tip_h
#define nmm_fracture_turned_tip_h

#include <nmm/fracture/intensity_factors.h>

#include <deal.II/base/tensor.h>

namespace NMM
{
  /// The rotation R of the material about a crack tip, from the mean deformation gradient F = R U
  /// of the tip's regions within its free radius, at the displacements @p u [-]. Collective.
  dealii::Tensor<2, 2>
  rotation_at(const CrackTip &tip, const DisplacementField &u);

  /**
   * The intensity factors of a tip in finite kinematics. An observer who turns with the material about
   * the tip sees the displacements
   * @f[ R^T (X + u) - X, @f]
   * whose gradient is as small as the strain, and gravity, contact forces and accelerations turned by
   * R^T as well. For these the factors are those of compute_intensity_factors(); arguments are the
   * same. Initial stress and loads that follow the surface (BoundaryCondition::Type::follower_pressure)
   * turn with the material. Limits: strains are small, and other loads do not act on the faces of the crack.
   * Collective.
   */
  IntensityFactors
  compute_turned_factors(const DisplacementField &u,
                         const ElasticityProblem &problem,
                         const CrackTip          &tip,
                         double                   largest_radius = 0.,
                         const TipLoading        &loading        = {},
                         DiskRules               *rules          = nullptr);
} // namespace NMM

#endif
