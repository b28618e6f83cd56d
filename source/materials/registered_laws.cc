#include <nmm/base/exceptions.h>
#include <nmm/materials/mohr_coulomb_law.h>
#include <nmm/materials/neo_hooke_law.h>
#include <nmm/materials/st_venant_kirchhoff_law.h>

namespace NMM
{
  const std::vector<NamedMaterialLaw> &
  material_laws()
  {
    static const std::vector<NamedMaterialLaw> laws = {
      {"linear",
       "stress linear in strain; finite kinematics: the next one",
       std::make_shared<LinearLaw>()},
      {"St. Venant-Kirchhoff",
       "finite kinematics, second Piola-Kirchhoff stress linear in the "
       "Green-Lagrange strain",
       std::make_shared<StVenantKirchhoffLaw>()},
      {"neo-Hookean",
       "finite kinematics, for large strains",
       std::make_shared<NeoHookeLaw>()},
      {"Mohr-Coulomb",
       "elastic, perfectly plastic; finite kinematics: for small strains",
       std::make_shared<MohrCoulombLaw>()}};
    return laws;
  }


  std::shared_ptr<const MaterialLaw>
  default_material_law()
  {
    return material_laws().front().law;
  }


  std::shared_ptr<const MaterialLaw>
  material_law(const std::string &name)
  {
    std::string names;
    for (const NamedMaterialLaw &named : material_laws())
    {
      if (named.name == name)
        return named.law;
      names += (names.empty() ? "" : ", ") + named.name;
    }
    AssertThrow(false,
                InputError("there is no material law '" + name + "'",
                           "the list of laws",
                           "choose one of " + names));
    return nullptr;
  }
} // namespace NMM
