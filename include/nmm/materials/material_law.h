#ifndef nmm_materials_material_law_h
#define nmm_materials_material_law_h

#include <nmm/base/named_law.h>
#include <nmm/materials/material.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  class HyperelasticLaw;
  class InelasticLaw;

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
   * source/materials/material_law.cc. Scenes then know the law and its parameters(). A law for large
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
