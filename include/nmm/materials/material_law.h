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
   * How stress follows from deformation: a stateless strategy with the parameters that the law
   * has beside the elastic constants, density and initial stress of Material. It makes the
   * functions that are evaluated at quadrature points, for the kinematics in which the law is
   * defined:
   *
   * | kinematics | function | a law without it |
   * |---|---|---|
   * | `small` | InelasticLaw | is linear elastic there |
   * | `finite` | HyperelasticLaw | cannot be used there |
   *
   * To add a law: derive a class in a file of its own, and name it in material_laws().
   */
  class MaterialLaw
  {
  public:
    using Parameter = LawParameter;

    virtual ~MaterialLaw() = default;

    virtual std::unique_ptr<MaterialLaw>
    clone() const = 0;

    /// Parameters beside those of Material.
    virtual std::vector<Parameter>
    parameters()
    {
      return {};
    }

    /// @throws InputError naming a parameter of this law, its value and @p where it is.
    virtual void
    check(const std::string & /*where*/, PlaneState /*plane_state*/) const
    {
    }

    /// Whether the law may be used with small strains.
    virtual bool
    has_small_strains() const
    {
      return true;
    }

    /// Whether inelastic_law() gives a law.
    virtual bool
    is_inelastic() const
    {
      return false;
    }

    /// The law for large deformations. Null: it has none.
    virtual std::shared_ptr<const HyperelasticLaw>
    hyperelastic_law(const Material & /*material*/,
                     PlaneState /*plane_state*/) const
    {
      return nullptr;
    }

    /// The law for small strains. Null: stress is linear in strain.
    virtual std::shared_ptr<const InelasticLaw>
    inelastic_law(const Material & /*material*/,
                  PlaneState /*plane_state*/) const
    {
      return nullptr;
    }

    /// Divide the strength by @p factor, in a search for the factor of safety. Elastic laws have
    /// no strength.
    virtual void
    reduce_strength(double /*factor*/)
    {
    }
  };


  using NamedMaterialLaw = NamedLaw<MaterialLaw>;

  /// All laws; the first one is the default.
  const std::vector<NamedMaterialLaw> &
  material_laws();

  /// The law called @p name, with default parameters. @throws InputError if there is none.
  std::shared_ptr<const MaterialLaw>
  material_law(const std::string &name);
} // namespace NMM

#endif
