#ifndef nmm_contact_contact_law_h
#define nmm_contact_contact_law_h

#include <nmm/base/named_law.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * How two faces act on each other at a contact point: a stateless law. What a point remembers
   * (where it sticks, how far it has slid, whether it is bonded) belongs to the point and is an
   * argument.
   *
   * Normal direction: a spring with the potential V(d) of the penetration d = -gap [m],
   * @f[ p = V'(d),\quad d > 0; \qquad p = 0,\quad d \le 0, @f]
   * and only bonded points bear tension, p = V'(d) for d < 0.
   *
   * Shear: a linear spring, @f$ q = \epsilon_t (g_t - g_t^\mathrm{slip}) @f$, up to the
   * strength, which may depend on the pressure and on the length kappa of the way that the
   * point has slid, whichever way,
   * @f[ |q| \le S(p, \kappa), \qquad \dot\kappa = |\dot g_t^\mathrm{slip}|. @f]
   *
   * Dilation: faces that slide in contact ride up on each other and open by
   * @f$ \delta = \tan\psi\,\min(\kappa, \kappa_\mathrm{max}) @f$, so that
   * p = V'(delta + d). That is a flow rule which is not associated; Coulomb's law with it
   * dissipates @f$ (p(\tan\phi-\tan\psi) + c)\,\dot\kappa \ge 0 @f$ (Plesha, Int. J. Numer. Anal.
   * Methods Geomech. 11 (1987) 345, without wear). The opening stays with the point as long as there
   * is a face within reach, and grows there even if the point itself is open, as long as both
   * bodies touch somewhere.
   *
   * Stresses are per reference length of the slave and unit thickness.
   *
   * To add a law: derive a class in a file of its own, and name it in contact_laws().
   */
  class ContactLaw
  {
  public:
    virtual ~ContactLaw() = default;

    /// A function's value and its derivative by its argument.
    struct Response
    {
      double value = 0., derivative = 0.;
    };

    /// S [Pa] and its derivatives by the pressure [-] and by the slip [Pa/m].
    struct Strength
    {
      double value = 0., by_pressure = 0., by_slip = 0.;
    };

    using Parameter = LawParameter;

    virtual std::unique_ptr<ContactLaw>
    clone() const = 0;

    /// All parameters; those of the base class come first.
    virtual std::vector<Parameter>
    parameters();

    /// V(d) [J/m^2] of the penetration @p d [m]; linear spring unless overridden.
    virtual double
    energy(const double d) const
    {
      return 0.5 * normal_stiffness * d * d;
    }

    /// p = V'(d) [Pa] and V''(d) [Pa/m].
    virtual Response
    pressure(const double d) const
    {
      return {normal_stiffness * d, normal_stiffness};
    }

    /// The penetration d [m] with V'(d) = @p pressure [Pa].
    virtual double
    penetration(const double pressure) const
    {
      return pressure / normal_stiffness;
    }

    /// Mean pressure (V(d_1) - V(d_0)) / (d_1 - d_0) between two penetrations, and its
    /// derivative by d_1.
    virtual Response
    mean_pressure(const double d_0, const double d_1) const
    {
      return {0.5 * normal_stiffness * (d_0 + d_1), 0.5 * normal_stiffness};
    }

    /// Strength of faces that are not bonded (any more), @p pressure >= 0, @p slip >= 0.
    virtual Strength
    strength(double pressure, double slip) const = 0;

    /// Shear strength of a bond under a pressure >= 0 [Pa].
    virtual double
    bond_strength(const double pressure) const
    {
      return strength(pressure, 0.).value;
    }

    /// Whether there is any shear; otherwise faces are smooth, and points have no anchors.
    virtual bool
    has_friction() const = 0;

    /// Whether the strength depends on the slip, which then is kept.
    virtual bool
    depends_on_slip() const
    {
      return false;
    }

    /// Divide the strength by @p factor, and whatever has to follow it; for a search for the
    /// factor of safety.
    virtual void
    reduce_strength(double factor) = 0;

    /// @throws InputError naming the value and @p where it is. Laws check theirs as well.
    virtual void
    check(const std::string &where) const;

    /// delta after the slip kappa [m].
    double
    opening(const double slip) const
    {
      return dilation *
             (dilation_limit == 0. ? slip : std::min(slip, dilation_limit));
    }

    /// eps_t [Pa/m].
    double
    shear_spring() const
    {
      return shear_stiffness == 0. ? normal_stiffness : shear_stiffness;
    }

    /// What a shear spring stores [J/m^2] under the shear @p q [Pa].
    double
    shear_energy(const double q) const
    {
      return q * q / (2. * shear_spring());
    }

    /// V''(0), the penalty eps_n: pressure over small penetrations [Pa/m].
    double normal_stiffness = 0.;
    /// eps_t: shear over elastic slip [Pa/m]; 0: that of the normal direction.
    double shear_stiffness = 0.;
    /**
     * Dashpots in time steps that conserve energy: pressure over the rate of
     * penetration and shear over that of the elastic slip [Pa s/m]. Never tension.
     * A share xi of the critical one for faces with the mass m per area is
     * @f$ 2\xi\sqrt{\epsilon m} @f$. Other steps do without.
     */
    double normal_damping = 0., shear_damping = 0.;
    /**
     * A joint whose faces are bonded where they touch when the computation begins.
     * The bond bears tension up to @p tensile_strength [Pa] and shear up to
     * bond_strength(); where one of them is exceeded it breaks, and from then on the faces
     * have the strength of faces that are not bonded.
     */
    bool   is_bond          = false;
    double tensile_strength = 0.;
    /// Tangent of the dilation angle psi [-], and the slip kappa_max beyond which nothing
    /// opens any more [m]; 0: no limit.
    double dilation = 0., dilation_limit = 0.;
  };


  using NamedContactLaw = NamedLaw<ContactLaw>;

  /// All laws; the first one is the default.
  const std::vector<NamedContactLaw> &
  contact_laws();
} // namespace NMM

#endif
