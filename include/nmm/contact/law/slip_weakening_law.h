#ifndef nmm_contact_law_slip_weakening_law_h
#define nmm_contact_law_slip_weakening_law_h

#include <nmm/contact/law/coulomb_law.h>

namespace NMM
{
  /**
   * Coulomb's law whose strength falls linearly from its peak to a residual value while the
   * faces slide by the length L:
   * @f[ S = p\,\tan\phi(\kappa) + c(\kappa),\quad
   *     \tan\phi = \tan\phi_r + w (\tan\phi_p - \tan\phi_r),\quad
   *     c = c_r + w (c_p - c_r),\quad w = \langle 1 - \kappa / L\rangle_+ @f]
   * (Ida, J. Geophys. Res. 77 (1972) 3796). Peak values are those of CoulombLaw. As there, cohesion
   * grows in proportion to the pressure until that is a thousandth of the cohesion.
   *
   * If the strength falls faster than the shear spring unloads, @f$ -dS/d\kappa > \epsilon_t @f$,
   * the shear jumps to the value at which both agree. The shear spring is then too soft for the
   * law.
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

    /// Residual friction coefficient tan phi_r [-], at most the peak one.
    double residual_friction = 0.;
    /// Residual cohesion c_r [Pa].
    double residual_cohesion = 0.;
    /// Slip L over which the strength falls to its residual value [m].
    double weakening_length = 0.;
  };
} // namespace NMM

#endif
