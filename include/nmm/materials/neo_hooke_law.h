#ifndef nmm_materials_neo_hooke_law_h
#define nmm_materials_neo_hooke_law_h

#include <nmm/materials/material.h>

namespace NMM
{
  /**
   * The compressible neo-Hookean law for large strains, with the isochoric split of Simo & Miehe
   * (CMAME 98 (1992) 41),
   * @f[ W = \mu/2\,(J^{-2/3}(F:F+s^2)-3) + K/2\,(J-1)^2,\;
   *   J = s \det F,\; K = E/(3(1-2\nu)). @f]
   * Here s is the stretch of the third direction. In plane stress it is found by a Newton
   * iteration on dW/ds = 0, where W is convex in s; A follows by static condensation of s. The
   * law is defined for det F > 0.
   */
  class NeoHookeLaw : public MaterialLaw
  {
  public:
    std::unique_ptr<MaterialLaw>
    clone() const override
    {
      return std::make_unique<NeoHookeLaw>(*this);
    }

    bool
    has_small_strains() const override
    {
      return false;
    }

    std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(const Material &material,
                     PlaneState      plane_state) const override;
  };
} // namespace NMM

#endif
