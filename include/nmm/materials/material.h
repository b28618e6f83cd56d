#ifndef nmm_materials_material_h
#define nmm_materials_material_h

#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace NMM
{
  /// The assumption about the direction across the plane.
  enum class PlaneState
  {
    /// There is no stress across the plane, sigma_zz = 0, as in thin plates.
    plane_stress,
    /// There is no strain across the plane, epsilon_zz = 0, as in long bodies.
    plane_strain
  };

  class HyperelasticLaw;
  class InelasticLaw;
  class MaterialLaw;

  /// The first of material_laws(): linear elasticity.
  std::shared_ptr<const MaterialLaw>
  default_material_law();

  /**
   * The two constants of plane isotropic elasticity,
   * @f[ \sigma = \lambda\,\mathrm{tr}(\varepsilon)\,I + 2\mu\,\varepsilon, @f]
   * in-plane components only: lambda = E nu / ((1 + nu)(1 - 2 nu)) in plane
   * strain, E nu / (1 - nu^2) in plane stress, mu = E / (2 (1 + nu)) in both
   * [Pa].
   */
  struct PlaneElasticity
  {
    /// Lame's first constant of the plane, which depends on the plane state [Pa].
    double lambda = 0.;
    /// Shear modulus [Pa].
    double mu = 0.;

    /// In-plane stress sigma without initial stress [Pa], tension positive, for the displacement
    /// gradient du_i/dx_j [-].
    dealii::SymmetricTensor<2, 2>
    stress(const dealii::Tensor<2, 2> &gradient) const;

    /// Largest eigenvalue of the elasticity tensor, max(2 mu, 2 (lambda + mu))
    /// [Pa]: |sigma|^2 <= largest_eigenvalue() * (epsilon : C : epsilon).
    double
    largest_eigenvalue() const;
  };

  /// An isotropic material. Any consistent set of units can be used; comments name SI units.
  struct Material
  {
    /// Name by which geometries refer to the material, also in messages.
    std::string name;
    /// Young's modulus E [Pa], > 0.
    double youngs_modulus = std::numeric_limits<double>::signaling_NaN();
    /// Poisson's ratio nu [-], in (-1, 0.5).
    double poissons_ratio = std::numeric_limits<double>::signaling_NaN();
    /// Mass per volume rho [kg/m^3], >= 0.
    double density = 0.;
    /// Fracture toughness K_c [Pa m^(1/2)]: a crack grows when its equivalent intensity factor
    /// reaches it. 0 stands for an unknown toughness.
    double toughness = 0.;
    /// Strength f_t [Pa] at which cracks start at boundaries: where the mean stress over a length
    /// reaches it, see find_crack_starts(). 0 stands for an unknown strength; no crack starts.
    double fracture_strength = 0.;
    /// The law that gives stress from deformation; never null.
    std::shared_ptr<const MaterialLaw> law = default_material_law();
    /// Initial stress sigma_0 of the paper's eq. (9), tension positive [Pa]. In `finite`
    /// kinematics it is the second Piola-Kirchhoff stress at rest.
    dealii::SymmetricTensor<2, 2> initial_stress = {};
    /// The initial stress sigma_zz across the plane in plane strain [Pa]. If it is not given, it is
    /// nu times the sum of both normal components in the plane, which is the stress of a body
    /// that was never strained across the plane.
    std::optional<double> given_initial_stress_zz = std::nullopt;

    /// Checks all parameters, and those of the law. @throws InputError naming the material, the
    /// parameter and its value.
    void
    check(PlaneState plane_state) const;

    /// The elastic constants of the plane.
    PlaneElasticity
    plane_elasticity(PlaneState plane_state) const;

    /// The in-plane part of Hooke's tensor C in sigma = C : epsilon [Pa].
    dealii::SymmetricTensor<4, 2>
    elasticity_tensor(PlaneState plane_state) const;

    /// sigma_zz of the initial stress [Pa]; 0 in plane stress.
    double
    initial_stress_zz(PlaneState plane_state) const;

    /// The law for large deformations; never null. @throws InputError if the material's law has
    /// none.
    std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(PlaneState plane_state) const;

    /// The law for small strains. Null means that stress is linear in strain.
    std::shared_ptr<const InelasticLaw>
    inelastic_law(PlaneState plane_state) const;

    /// Hooke's sigma_zz for the in-plane strain @p strain, initial stress included [Pa]; 0 in
    /// plane stress.
    double
    out_of_plane_stress(const dealii::SymmetricTensor<2, 2> &strain,
                        PlaneState                           plane_state) const;
  };
} // namespace NMM

#endif
