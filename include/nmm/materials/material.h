#ifndef nmm_materials_material_h
#define nmm_materials_material_h

#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace NMM
{
  /// What is assumed about the third direction.
  enum class PlaneState
  {
    /// sigma_zz = 0 (thin plates).
    plane_stress,
    /// epsilon_zz = 0 (long bodies).
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
    double lambda = 0.;
    double mu     = 0.;

    /// sigma without initial stress [Pa] from du_i/dx_j [-].
    dealii::SymmetricTensor<2, 2>
    stress(const dealii::Tensor<2, 2> &gradient) const;

    /// Largest eigenvalue of the elasticity tensor, max(2 mu, 2 (lambda + mu))
    /// [Pa]: |sigma|^2 <= largest_eigenvalue() * (epsilon : C : epsilon).
    double
    largest_eigenvalue() const;
  };

  /// An isotropic material. Units are any consistent set; SI is written here.
  struct Material
  {
    std::string name;
    /// E [Pa], > 0.
    double youngs_modulus = std::numeric_limits<double>::signaling_NaN();
    /// nu [-], in (-1, 0.5).
    double poissons_ratio = std::numeric_limits<double>::signaling_NaN();
    /// rho [kg/m^3], >= 0.
    double density = 0.;
    /// K_c [Pa m^(1/2)]: a crack grows where its equivalent intensity factor reaches
    /// it. 0: not known.
    double toughness = 0.;
    /// How stress follows from deformation; never null.
    std::shared_ptr<const MaterialLaw> law = default_material_law();
    /// sigma_0 of the paper's eq. (9), tension positive [Pa]; in `finite`
    /// kinematics the second Piola-Kirchhoff stress at rest.
    dealii::SymmetricTensor<2, 2> initial_stress = {};
    /// The initial stress across the plane [Pa] in plane strain; if it is not given, nu times
    /// the sum of both normal components, as if the plane had never been strained across.
    std::optional<double> given_initial_stress_zz = std::nullopt;

    /// @throws InputError naming the material, the parameter and its value.
    void
    check(PlaneState plane_state) const;

    PlaneElasticity
    plane_elasticity(PlaneState plane_state) const;

    /// sigma = C : epsilon, the in-plane part [Pa].
    dealii::SymmetricTensor<4, 2>
    elasticity_tensor(PlaneState plane_state) const;

    /// sigma_zz of the initial stress [Pa]; 0 in plane stress.
    double
    initial_stress_zz(PlaneState plane_state) const;

    /// The law for large deformations. @throws InputError if the material's law has none.
    std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(PlaneState plane_state) const;

    /// The law for small strains; null: stress is linear in strain.
    std::shared_ptr<const InelasticLaw>
    inelastic_law(PlaneState plane_state) const;

    /// sigma_zz for in-plane strain @p strain, initial stress included [Pa]; 0 in plane
    /// stress.
    double
    out_of_plane_stress(const dealii::SymmetricTensor<2, 2> &strain,
                        PlaneState                           plane_state) const;
  };
} // namespace NMM

#endif
