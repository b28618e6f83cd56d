#ifndef nmm_contact_law_barton_bandis_law_h
#define nmm_contact_law_barton_bandis_law_h

#include <nmm/contact/law/law.h>

namespace NMM
{
  /**
   * Rough rock joints after Barton and Bandis. Peak shear strength (Barton & Choubey, Rock
   * Mech. 10 (1977) 1)
   * @f[ S = p\,\tan\left(\phi_r + \mathrm{JRC}_n
   *     \log_{10}\frac{\mathrm{JCS}_n}{p}\right), @f]
   * the angle in degrees being at least phi_r and at most 70 degrees; with the scale
   * corrections from laboratory samples of the length L_0 to joints of the length L_n
   * (Barton & Bandis, 23rd US Symp. Rock Mech. (1982) 739)
   * @f[ \mathrm{JRC}_n = \mathrm{JRC}_0 (L_n/L_0)^{-0.02\,\mathrm{JRC}_0},\qquad
   *     \mathrm{JCS}_n = \mathrm{JCS}_0 (L_n/L_0)^{-0.03\,\mathrm{JRC}_0}. @f]
   * Normal closure d (Bandis, Lumsden & Barton, Int. J. Rock Mech. Min. Sci. 20 (1983) 249):
   * a hyperbola with the initial stiffness k = normal_stiffness and the largest closure d_m,
   * @f[ p = \frac{k d}{1 - d/d_m},\qquad
   *     V = -k d_m \left(d + d_m \ln(1 - d/d_m)\right),\qquad d < d_m, @f]
   * linear in tension (bonds), and linear beyond 0.99 d_m, so that iterations can return from
   * closures that are too large. With d_m = 0 the spring is linear.
   *
   * Not modelled: the shear displacement at the peak, the strength after the peak, and hysteresis
   * of the closure.
   */
  class BartonBandisLaw : public ContactLaw
  {
  public:
    std::unique_ptr<ContactLaw>
    clone() const override
    {
      return std::make_unique<BartonBandisLaw>(*this);
    }

    std::vector<Parameter>
    parameters() override;

    double
    energy(double d) const override;

    Response
    pressure(double d) const override;

    double
    penetration(double pressure) const override;

    Response
    mean_pressure(double d_0, double d_1) const override;

    Strength
    strength(double pressure, double slip) const override;

    bool
    transmits_shear() const override
    {
      return true;
    }

    bool
    has_friction() const override
    {
      return true;
    }

    void
    reduce_strength(double factor) override;

    void
    check(const std::string &where) const override;

    /// Roughness coefficient JRC_n of a joint of the length L_n [-].
    double
    roughness() const;

    /// Wall compressive strength JCS_n of a joint of the length L_n [Pa].
    double
    compressive_strength() const;

    /// Roughness coefficient JRC_0 of samples of the length L_0 [-], from 0 to 20.
    double joint_roughness = 0.;
    /// Wall compressive strength JCS_0 of samples of the length L_0 [Pa].
    double joint_compressive_strength = 0.;
    /// Residual friction angle phi_r [degrees], from 0 up to below 70.
    double residual_angle = 0.;
    /// Length L_0 of the samples [m].
    double sample_length = 0.1;
    /// Length L_n of the joint [m]; if it equals L_0 there is no scale correction.
    double joint_length = 0.1;
    /// Largest closure d_m of the hyperbola [m]; 0 selects a linear spring.
    double largest_closure = 0.;
    /// Number by which the strength is divided [-], see reduce_strength().
    double strength_divisor = 1.;

  private:
    /// Closure beyond which the hyperbola is continued by its tangent [m].
    double
    end_of_hyperbola() const
    {
      constexpr double part = 0.99;
      return part * largest_closure;
    }
  };
} // namespace NMM

#endif
