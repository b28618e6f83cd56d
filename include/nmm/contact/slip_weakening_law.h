#ifndef nmm_contact_slip_weakening_law_h
#define nmm_contact_slip_weakening_law_h

#include <nmm/contact/coulomb_law.h>

namespace NMM
{
  /**
   * Coulomb's law whose strength falls linearly from its peak to a residual value while the
   * faces slide by the length L:
   * @f[ S = p\,\tan\phi(\kappa) + c(\kappa),\quad
   *     \tan\phi = \tan\phi_r + w (\tan\phi_p - \tan\phi_r),\quad
   *     c = c_r + w (c_p - c_r),\quad w = \langle 1 - \kappa / L\rangle_+ @f]
   * (Ida, J. Geophys. Res. 77 (1972) 3796). Peak values are those of CoulombLaw,
   * and as there cohesion grows with the first thousandth of it of pressure.
   *
   * If strength falls faster than the shear spring lets go, @f$ -dS/d\kappa > \epsilon_t @f$,
   * the shear jumps to where both meet: then the shear spring is too soft for the law.
   */
  class SlipWeakeningLaw : public CoulombLaw
  {
  public:
    std::unique_ptr<ContactLaw>
    clone() const override
    {
      return std::make_unique<SlipWeakeningLaw>(*this);
    }

    std::vector<Parameter>
    parameters() override;

    Strength
    strength(double pressure, double slip) const override;

    bool
    depends_on_slip() const override
    {
      return true;
    }

    void
    reduce_strength(double factor) override;

    void
    check(const std::string &where) const override;

    /// tan phi_r [-].
    double residual_friction = 0.;
    /// c_r [Pa].
    double residual_cohesion = 0.;
    /// L [m].
    double weakening_length = 0.;
  };
} // namespace NMM

#endif
