#ifndef nmm_materials_st_venant_kirchhoff_law_h
#define nmm_materials_st_venant_kirchhoff_law_h

#include <nmm/materials/material.h>

namespace NMM
{
  /**
   * The law with stress linear in strain. In `finite` kinematics it is St. Venant-Kirchhoff's law,
   * @f[ W = \lambda/2\,(\mathrm{tr} E)^2 + \mu\,E:E, \qquad E = (F^TF - I)/2, @f]
   * with the plane lambda of PlaneElasticity, which contains the condition S_33 = 0 of plane
   * stress in closed form. The law is defined for all F, but is meant for large rotations with
   * moderate strains: it loses its stiffness under strong compression.
   */
  class LinearLaw : public MaterialLaw
  {
  public:
    std::unique_ptr<MaterialLaw>
    clone() const override
    {
      return std::make_unique<LinearLaw>(*this);
    }

    std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(const Material &material,
                     PlaneState      plane_state) const override;
  };


  /// The same law as LinearLaw, but for `finite` kinematics only: a scene that chooses it cannot
  /// be run with small strains by mistake.
  class StVenantKirchhoffLaw : public LinearLaw
  {
  public:
    std::unique_ptr<MaterialLaw>
    clone() const override
    {
      return std::make_unique<StVenantKirchhoffLaw>(*this);
    }

    bool
    has_small_strains() const override
    {
      return false;
    }
  };
} // namespace NMM

#endif
