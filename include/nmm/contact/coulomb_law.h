#ifndef nmm_contact_coulomb_law_h
#define nmm_contact_coulomb_law_h

#include <nmm/contact/contact_law.h>

namespace NMM
{
  /**
   * Coulomb's friction with cohesion,
   * @f[ S = p\tan\phi + \min(c, 1000\,p). @f]
   * Bonds have the strength p tan(phi) + c until they break, and then no cohesion.
   *
   * Cohesion that were there in full as soon as faces touch would make shear jump where they
   * close or open: between the state with cohesion, in which a point opens, and the one without,
   * in which it closes, there may be no equilibrium at all. So it grows with the first thousandth
   * of c of pressure, which no balance of blocks notices. The tunnel in jointed rock with joints
   * 4.3 m and 4.7 m apart came to an end at 0.685 of its load without that; with a slope
   * from 2 to 1e5 it takes the whole load, with the same states in the end.
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
      const Response c = cohesion_under(pressure, is_bond ? 0. : cohesion);
      return {friction * pressure + c.value, friction + c.derivative, 0.};
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
    /// c: what cohesion adds to the shear strength of faces in contact [Pa].
    double cohesion = 0.;

  protected:
    /// min(c, 1000 p) and its derivative by the pressure p.
    static Response
    cohesion_under(const double pressure, const double c)
    {
      constexpr double slope = 1000.;
      return slope * pressure < c ? Response{slope * pressure, slope}
                                  : Response{c, 0.};
    }
  };
} // namespace NMM

#endif
