#ifndef nmm_contact_law_law_h
#define nmm_contact_law_law_h

#include <nmm/base/named_law.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * Base class of contact laws: pressure and shear strength at a contact point. Laws are
   * stateless; the state (anchor, slip, bond) belongs to the contact point and is an argument.
   *
   * Normal direction: a spring with the potential V(d) of the penetration d = -gap [m],
   * @f[ p = V'(d), \qquad V(0) = V'(0) = 0,\quad V''(0) = \epsilon_n,\quad V'' > 0, @f]
   * and V'' does not fall with d > 0: springs are linear or stiffen. Laws give V' for d < 0 as
   * well, where it is negative: bonded points bear this tension, and Contact opens all others there.
   *
   * Shear: a linear spring, @f$ q = \epsilon_t (g_t - g_t^\mathrm{slip}) @f$, up to the
   * strength, which may depend on the pressure and on the length kappa of the path that the
   * point has slid in either direction,
   * @f[ |q| \le S(p, \kappa), \qquad \dot\kappa = |\dot g_t^\mathrm{slip}|. @f]
   *
   * Dilation: faces that slide in contact ride up on each other and open by
   * @f$ \delta = \tan\psi\,\min(\kappa, \kappa_\mathrm{max}) @f$, so that
   * p = V'(delta + d). This is a non-associated flow rule; with it Coulomb's law
   * dissipates @f$ (p(\tan\phi-\tan\psi) + c)\,\dot\kappa \ge 0 @f$ (Plesha, Int. J. Numer. Anal.
   * Methods Geomech. 11 (1987) 345, without wear). A point keeps its opening as long as there is a
   * face within reach. The opening grows even at open points, as long as both bodies touch
   * somewhere.
   *
   * Stresses are per reference length of the slave and unit thickness.
   *
   * To add a law: derive a class in a file of its own, and name it at the end of contact_laws().
   * Scenes then know the law and its parameters(). A spring that is not linear overrides all of
   * energy(), pressure(), penetration() and mean_pressure(), as BartonBandisLaw does; strength that
   * depends on the slip is as in SlipWeakeningLaw. The other places are the list of sources in
   * source/contact/CMakeLists.txt, a test beside those of tests/contact/laws_test.cc, the table of
   * laws in doc/scene-format.md, doc/parameters.md (`nmm --print-parameters=markdown`) and a file
   * in doc/news.
   */
  class ContactLaw
  {
  public:
    virtual ~ContactLaw() = default;

    /// Pressure as a function of the penetration.
    struct Response
    {
      /// Pressure [Pa].
      double value = 0.;
      /// Derivative of the pressure by the penetration [Pa/m].
      double derivative = 0.;
    };

    /// Shear strength as a function of pressure and slip.
    struct Strength
    {
      /// Strength S [Pa].
      double value = 0.;
      /// Derivative of the strength by the pressure [-].
      double by_pressure = 0.;
      /// Derivative of the strength by the slip [Pa/m]; negative for weakening. Where the strength
      /// falls faster than the shear spring unloads, -by_slip > eps_t, the shear jumps.
      double by_slip = 0.;
    };

    /// A number of the law that scenes give.
    using Parameter = LawParameter;

    /// A copy with the same parameters, of the same derived class.
    virtual std::unique_ptr<ContactLaw>
    clone() const = 0;

    /// The parameters that scenes give, with pointers to members. An override begins with those of
    /// its base class. A law that dilates adds "Dilation angle", "Dilation limit" and
    /// "Friction angle", which scenes compare.
    virtual std::vector<Parameter>
    parameters();

    /// Potential V(d) of the normal spring [J/m^2] at the penetration @p d [m]; that of a linear
    /// spring unless overridden.
    virtual double
    energy(const double d) const
    {
      return 0.5 * normal_stiffness * d * d;
    }

    /// p = V'(d) [Pa] and V''(d) [Pa/m] at the penetration @p d [m].
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

    /// Mean pressure (V(d_1) - V(d_0)) / (d_1 - d_0) between two penetrations [Pa], and its
    /// derivative by d_1 [Pa/m]. It must be free of rounding where both are nearly or exactly the
    /// same, and is then V'.
    virtual Response
    mean_pressure(const double d_0, const double d_1) const
    {
      return {0.5 * normal_stiffness * (d_0 + d_1), 0.5 * normal_stiffness};
    }

    /// Strength of faces that are not, or no longer, bonded, under the @p pressure >= 0 [Pa] after
    /// the @p slip >= 0 [m]. It should vanish with the pressure: otherwise shear jumps where faces
    /// close or open, see CoulombLaw.
    virtual Strength
    strength(double pressure, double slip) const = 0;

    /// The part of strength() at the @p pressure [Pa] that would not depend on the pressure, if
    /// shear were not to jump where faces close or open. See Contact::freeze_geometry(), which
    /// ignores it for laws that depend on the slip.
    virtual Response
    cohesion_at(const double /*pressure*/) const
    {
      return {};
    }

    /// Shear strength of an intact bond [Pa] under the @p pressure >= 0 [Pa], which is 0 in tension.
    /// A law with cohesion overrides it: otherwise bonds in tension break under any shear.
    virtual double
    bond_strength(const double pressure) const
    {
      return strength(pressure, 0.).value;
    }

    /// Whether the law transmits shear, by friction, cohesion or a bond; otherwise points have no
    /// anchors. Must be true if is_bond is.
    virtual bool
    transmits_shear() const = 0;

    /// Whether faces that are not bonded have a friction angle, so that they dissipate energy under
    /// any pressure when they slide. A bond or cohesion alone is no friction.
    virtual bool
    has_friction() const = 0;

    /// Whether the strength depends on the slip. The shear of a step and its slip are then found
    /// together, and the law cannot dilate. Otherwise strength() is given the slip of laws that
    /// dilate, and 0 for others.
    virtual bool
    depends_on_slip() const
    {
      return false;
    }

    /// Divide the shear and tensile strength by @p factor [-], and reduce other parameters that
    /// the strength bounds. Used by the strength reduction method.
    virtual void
    reduce_strength(double factor) = 0;

    /// Check all parameters; derived laws check their own in addition. @throws InputError naming
    /// the value and @p where it is.
    virtual void
    check(const std::string &where) const;

    /// Opening delta by dilation after the slip kappa [m].
    double
    opening(const double slip) const
    {
      return dilation *
             (dilation_limit == 0. ? slip : std::min(slip, dilation_limit));
    }

    /// Stiffness eps_t of the shear spring [Pa/m].
    double
    shear_spring() const
    {
      return shear_stiffness == 0. ? normal_stiffness : shear_stiffness;
    }

    /// Energy of the shear spring [J/m^2] under the shear @p q [Pa].
    double
    shear_energy(const double q) const
    {
      return q * q / (2. * shear_spring());
    }

    /// V''(0), the penalty eps_n: pressure over small penetrations [Pa/m].
    double normal_stiffness = 0.;
    /// eps_t: shear over elastic slip [Pa/m]; 0 stands for the normal stiffness.
    double shear_stiffness = 0.;
    /**
     * Dashpot constant of the normal direction: pressure over the rate of penetration [Pa s/m].
     * Dashpots act only in time steps that conserve energy, and never exert tension. For faces of
     * the mass m per area the constant of the damping ratio xi is @f$ 2\xi\sqrt{\epsilon m} @f$.
     */
    double normal_damping = 0.;
    /// Dashpot constant of the shear direction: shear over the rate of elastic slip [Pa s/m].
    double shear_damping = 0.;
    /**
     * Whether the faces of the joint are bonded where they touch when the computation begins.
     * The bond bears tension up to the tensile strength and shear up to bond_strength(). Where one
     * of them is exceeded the bond breaks, and strength() holds from then on.
     */
    bool is_bond = false;
    /// Tension at which a bond breaks [Pa]; 0 for faces that are not bonded.
    double tensile_strength = 0.;
    /// Tangent of the dilation angle psi [-].
    double dilation = 0.;
    /// Slip kappa_max beyond which the opening no longer grows [m]; 0 stands for no limit.
    double dilation_limit = 0.;
  };


  /// A contact law with the name and documentation by which scenes choose it.
  using NamedContactLaw = NamedLaw<ContactLaw>;

  /// All laws with their default parameters; the first one is the default law.
  const std::vector<NamedContactLaw> &
  contact_laws();
} // namespace NMM

#endif
