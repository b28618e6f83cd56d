#ifndef nmm_materials_mohr_coulomb_law_h
#define nmm_materials_mohr_coulomb_law_h

#include <nmm/materials/material.h>

namespace NMM
{
  /**
   * Elastic, perfectly plastic rock and soil: Mohr-Coulomb's condition with a tension cut-off.
   * With the principal stresses @f$\sigma_1\ge\sigma_2\ge\sigma_3@f$ (tension positive),
   * @f[ N\sigma_1-\sigma_3\le 2c\sqrt N,\quad N=\frac{1+\sin\phi}{1-\sin\phi};\qquad
   *     \sigma_1\le\sigma_t. @f]
   * Plastic strain flows along the gradients of the same functions, but with the dilation angle
   * psi in place of phi (not associated unless psi = phi); where several conditions hold with
   * equality, along a sum of their gradients with multipliers that are not negative (Koiter).
   *
   * The stress at the end of a step is found by the fully implicit rule
   * @f[ \sigma = \sigma^\mathrm{trial} - C\,\Delta\varepsilon^p @f]
   * in closed form. In the space of principal stresses all conditions are planes, and all sets of
   * one, two and three active planes are tried (planes, edges and apexes). This follows Clausen,
   * Damkilde & Andersen, Int. J. Numer. Meth. Eng. 66 (2006) 1738, who find the set from the
   * geometry instead. The tangent is the derivative of that rule, including the rotation of the
   * principal directions.
   *
   * In plane stress sigma_zz = 0 is one of the principal stresses, and the stress returns in the
   * plane of the two others to a hexagon, with the C of plane stress. Flow has
   * components across the plane, which cause no stress and dissipate nothing. The hexagon's sides
   * and their flows have the same order of directions, so that there is exactly one return for any
   * psi <= phi. Without cohesion a material bears nothing in plane stress.
   *
   * A cut-off above the apex c / tan(phi) has no effect.
   */
  class MohrCoulombLaw : public MaterialLaw
  {
  public:
    std::unique_ptr<MaterialLaw>
    clone() const override
    {
      return std::make_unique<MohrCoulombLaw>(*this);
    }

    std::vector<Parameter>
    parameters() override;

    /// @throws InputError naming a parameter and its value.
    void
    check(const std::string &where, PlaneState plane_state) const override;

    bool
    is_inelastic() const override
    {
      return true;
    }

    std::shared_ptr<const InelasticLaw>
    inelastic_law(const Material &material,
                  PlaneState      plane_state) const override;

    /// Divides tan phi, c, sigma_t and tan psi by @p factor [-].
    void
    reduce_strength(double factor) override;

    /// Whether psi is phi.
    bool
    has_associated_flow() const override
    {
      return dilation == friction;
    }

    /// Lets psi be phi.
    void
    associate_flow() override
    {
      dilation = friction;
    }

    /// Tangent of the friction angle, tan phi [-], >= 0.
    double friction = 0.;
    /// Cohesion c [Pa], >= 0.
    double cohesion = 0.;
    /// Tensile strength sigma_t [Pa], >= 0.
    double tensile_strength = 1e20;
    /// Tangent of the dilation angle, tan psi [-], in [0, tan phi].
    double dilation = 0.;
  };
} // namespace NMM

#endif
