#ifndef nmm_contact_coulomb_law_h
#define nmm_contact_coulomb_law_h

#include <nmm/contact/contact_law.h>

namespace NMM
{
  /**
   * Coulomb's friction with cohesion,
   * @f[ S = p\tan\phi + c. @f]
   * Bonds have the same strength until they break, and then no cohesion.
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
      return {friction * pressure + (is_bond ? 0. : cohesion), friction, 0.};
    }

    double
    bond_strength(const double pressure) const override
    {
      return cohesion + friction * pressure;
    }

    bool
    has_friction() const override
    {
      return friction > 0. || cohesion > 0. || is_bond;
    }

    void
    reduce_strength(double factor) override;

    void
    check(const std::string &where) const override;

    /// tan phi [-].
    double friction = 0.;
    /// c: shear strength without pressure [Pa], while in contact.
    double cohesion = 0.;
  };
} // namespace NMM

#endif
