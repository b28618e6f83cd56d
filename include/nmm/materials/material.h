#ifndef nmm_materials_material_h
#define nmm_materials_material_h

#include <nmm/base/named_law.h>

#include <deal.II/base/function.h>
#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
    /// Mass per volume where pores are full of water [kg/m^3]; not given: the same as `density`. It
    /// counts for the weight below a water table; the mass in motion is that of `density`.
    std::optional<double> wet_density = std::nullopt;
    /// Force f(x) per volume of this material beside its weight [N/m^3], two components, with the
    /// amplitude of gravity. Null: none. See add_water().
    std::shared_ptr<const dealii::Function<2>> body_force = nullptr;
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
    /// Initial stress sigma_0(x) as a function of the place x [m] in the reference configuration,
    /// with the components xx, yy, xy and, in plane strain, zz, which may be left out [Pa]. Then
    /// both members above are not used, and must have their defaults. Null: it is uniform.
    std::shared_ptr<const dealii::Function<2>> varying_initial_stress = nullptr;

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

    /// sigma_zz of the uniform initial stress [Pa]; 0 in plane stress.
    double
    initial_stress_zz(PlaneState plane_state) const;

    /// Whether the initial stress is not 0 or varies.
    bool
    has_initial_stress() const;

    /// Initial stress at @p x, in-plane components [Pa].
    dealii::SymmetricTensor<2, 2>
    initial_stress_at(const dealii::Point<2> &x) const;

    /// sigma_zz of the initial stress at @p x [Pa]; 0 in plane stress.
    double
    initial_stress_zz_at(const dealii::Point<2> &x,
                         PlaneState              plane_state) const;

    /// Weight under the acceleration @p gravity [m/s^2] and body force of the material at @p x
    /// [N/m^3].
    dealii::Tensor<1, 2>
    weight_at(const dealii::Point<2>     &x,
              const dealii::Tensor<1, 2> &gravity) const;

    /// The law for large deformations; never null. @throws InputError if the material's law has
    /// none.
    std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(PlaneState plane_state) const;

    /// The law for small strains. Null means that stress is linear in strain.
    std::shared_ptr<const InelasticLaw>
    inelastic_law(PlaneState plane_state) const;

    /// Hooke's sigma_zz for the in-plane strain @p strain, with the initial stress at @p x [Pa]; 0
    /// in plane stress.
    double
    out_of_plane_stress(const dealii::SymmetricTensor<2, 2> &strain,
                        PlaneState                           plane_state,
                        const dealii::Point<2> &x = dealii::Point<2>()) const;
  };


  /// The in-plane stress [Pa] whose components xx, yy, xy are the first ones of @p components.
  dealii::SymmetricTensor<2, 2>
  stress_at(const dealii::Function<2> &components, const dealii::Point<2> &x);


  /**
   * A material law: how stress follows from deformation. It has the parameters of the law beside
   * the elastic constants, density and initial stress of Material, and no history. It makes
   * the objects that are evaluated at quadrature points, for the kinematics in which the law is
   * defined:
   *
   * | kinematics | object | a law without it |
   * |---|---|---|
   * | `small` | InelasticLaw | is linear elastic there, if has_small_strains() |
   * | `finite` | HyperelasticLaw, or InelasticLaw (see InelasticTerms) | cannot be used there |
   *
   * The room `materials` consists of these laws. A scene or a program fills in a Material, whose
   * member Material::law is one of material_laws(), a copy with other parameters, or a law of the
   * program's own. Order of calls: Material::check(); then
   * Material::hyperelastic_law() or Material::inelastic_law(), once for each region of the solid
   * and again whenever the strength is reduced; then
   * HyperelasticLaw::evaluate() or InelasticLaw::evaluate() at each quadrature point, which give
   * stress, tangent and energy, and the new MaterialState of an inelastic law.
   *
   * @code
   *   Material material;
   *   material.name           = "steel";
   *   material.youngs_modulus = 2.1e11;
   *   material.poissons_ratio = 0.3;
   *   material.law            = material_law("neo-Hookean");
   *   material.check(PlaneState::plane_strain);
   *   const auto law = material.hyperelastic_law(PlaneState::plane_strain);
   *   HyperelasticLaw::Response response;
   *   if (law->evaluate(H, response) == Deformation::inverted)
   *     return; // det F <= 0: the step was too large
   * @endcode
   *
   * To add a law, derive a class in a file of its own, and name it at the end of material_laws() in
   * source/materials/registered_laws.cc. Scenes then know the law and its parameters(). A law for large
   * deformations only overrides hyperelastic_law(), and has_small_strains() to return false, as
   * NeoHookeLaw does; its evaluation is a class derived from HyperelasticLaw in the same file. Or it
   * derives from EnergyLaw (energy_law.h) and writes its energy alone. One that yields overrides
   * is_inelastic(), inelastic_law() and reduce_strength(), as MohrCoulombLaw does. The other places
   * are the list of sources in
   * source/materials/CMakeLists.txt, a test in tests/materials, the table of laws in
   * doc/scene-format.md, doc/parameters.md (`nmm --print-parameters=markdown`) and a file in
   * doc/news.
   */
  class MaterialLaw
  {
  public:
    /// A parameter of this law, with its name and help text in scenes.
    using Parameter = LawParameter;

    virtual ~MaterialLaw() = default;

    /// A copy with the same parameters, which the caller may change.
    virtual std::unique_ptr<MaterialLaw>
    clone() const = 0;

    /// The parameters beside those of Material, with pointers into this law.
    virtual std::vector<Parameter>
    parameters()
    {
      return {};
    }

    /// Checks the parameters of this law. @throws InputError naming the parameter, its value and
    /// the place @p where.
    virtual void
    check(const std::string & /*where*/, PlaneState /*plane_state*/) const
    {
    }

    /// Whether the law can be used in kinematics with small strains.
    virtual bool
    has_small_strains() const
    {
      return true;
    }

    /// Whether inelastic_law() returns a law. Both must be overridden together.
    virtual bool
    is_inelastic() const
    {
      return false;
    }

    /// The law for large deformations. Null means that there is none.
    virtual std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(const Material & /*material*/,
                     PlaneState /*plane_state*/) const
    {
      return nullptr;
    }

    /// The law for small strains. Null means that stress is linear in strain.
    virtual std::shared_ptr<const InelasticLaw>
    inelastic_law(const Material & /*material*/,
                  PlaneState /*plane_state*/) const
    {
      return nullptr;
    }

    /// Divides the strength by @p factor [-], in a search for the factor of safety. Elastic laws
    /// have no strength and are not changed.
    virtual void
    reduce_strength(double /*factor*/)
    {
    }

    /// Whether plastic flow is normal to the yield surface; true without flow.
    virtual bool
    has_associated_flow() const
    {
      return true;
    }

    /// Lets the plastic flow be associated, that is normal to the yield surface. Laws without flow are
    /// not changed.
    virtual void
    associate_flow()
    {
    }
  };


  /// A material law with the name by which scenes choose it.
  using NamedMaterialLaw = NamedLaw<MaterialLaw>;

  /// All material laws; the first one is the default.
  const std::vector<NamedMaterialLaw> &
  material_laws();

  /// The law called @p name, with default parameters. @throws InputError if there is none.
  std::shared_ptr<const MaterialLaw>
  material_law(const std::string &name);
} // namespace NMM

#endif
