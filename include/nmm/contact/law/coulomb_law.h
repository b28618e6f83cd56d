#ifndef nmm_contact_law_coulomb_law_h
#define nmm_contact_law_coulomb_law_h

#include <nmm/contact/law/law.h>

namespace NMM
{
  /**
   * Coulomb's friction with cohesion,
   * @f[ S = p\tan\phi + \min(c, 1000\,p). @f]
   * Bonds have the strength p tan(phi) + c until they break; after that there is no cohesion.
   *
   * If cohesion acted in full as soon as faces touch, shear would jump where a point closes or
   * opens, and the point might have no equilibrium: with its cohesion it opens, without it closes.
   * So cohesion grows in proportion to the pressure until that is a thousandth of c, which is
   * negligible in the equilibrium of blocks.
   */
  class CoulombLaw : public ContactLaw
  {
  public:
    std::unique_ptr<ContactLaw>
    clone() const override
    {
      return std::make_unique<CoulombLaw>(*this);
    }

    std::vector<Parameter>
    parameters() override;

    Strength
    strength(const double pressure, double /*slip*/) const override
    {
      const Response c = cohesion_under(pressure, cohesion);
      return {friction * pressure + c.value, friction + c.derivative, 0.};
    }

    Response
    cohesion_at(const double pressure) const override
    {
      return cohesion_under(pressure, cohesion);
    }

    double
    bond_strength(const double pressure) const override
    {
      return cohesion + friction * pressure;
    }

    bool
    transmits_shear() const override
    {
      return friction > 0. || cohesion > 0. || is_bond;
    }

    bool
    has_friction() const override
    {
      return friction > 0.;
    }

    void
    reduce_strength(double factor) override;

    void
    check(const std::string &where) const override;

    /// Friction coefficient tan phi [-].
    double friction = 0.;
    /// Cohesion c, the part of the shear strength that does not depend on the pressure [Pa].
    double cohesion = 0.;

  protected:
    /// min(c, 1000 p) and its derivative by the pressure p; 0 for a bond that has broken.
    Response
    cohesion_under(const double pressure, const double c) const;
  };
} // namespace NMM

#endif
