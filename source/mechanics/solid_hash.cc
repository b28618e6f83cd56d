#include <nmm/materials/material.h>

#include <algorithm>
#include <mechanics/solid_hash.h>
#include <memory>
#include <typeinfo>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Adds the kind of a material law and its parameters to a hash.
      void
      hash_law(const Material &material, Hash &hash)
      {
        const std::vector<NamedMaterialLaw> &laws = material_laws();
        const std::unique_ptr<MaterialLaw>   law  = material.law->clone();
        const auto                           known =
          std::find_if(laws.begin(),
                       laws.end(),
                       [&](const NamedMaterialLaw &named) {
                         return typeid(*named.law) == typeid(*law);
                       });
        hash.add(static_cast<unsigned int>(known - laws.begin()));
        for (const LawParameter &parameter : law->parameters())
          hash.add(*parameter.value);
        if (material.given_initial_stress_zz)
          hash.add(*material.given_initial_stress_zz);
      }
    } // namespace


    Hash
    hash_of_solid(const CoverSystem &covers, const ElasticityProblem &problem)
    {
      const ManifoldMesh &mesh = covers.manifold_mesh();
      Hash                hash;
      hash.add(covers.n_covers());
      hash.add(mesh.n_elements());
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        for (const unsigned int k : covers.covers(e))
          hash.add(k);
        hash.add(mesh.region(e));
        hash.add(mesh.area(e));
      }
      for (unsigned int k = 0; k < covers.n_covers(); ++k)
        for (unsigned int c = 0; c < 2; ++c)
          hash.add(covers.node(k)[c]);
      for (const unsigned int m :
           problem.region_to_material(mesh.physical_mesh()))
      {
        const Material &material = problem.materials[m];
        for (const double value : {material.youngs_modulus,
                                   material.poissons_ratio,
                                   material.density,
                                   material.initial_stress[0][0],
                                   material.initial_stress[1][1],
                                   material.initial_stress[0][1]})
          hash.add(value);
        hash_law(material, hash);
      }
      if (problem.has_varying_initial_stress())
        for (unsigned int k = 0; k < covers.n_covers(); ++k)
          for (const Material &material : problem.materials)
          {
            const auto stress = material.initial_stress_at(covers.node(k));
            for (const unsigned int c : {0, 1, 2})
              hash.add(stress.access_raw_entry(c));
          }
      hash.add(static_cast<unsigned int>(problem.plane_state));
      return hash;
    }
  } // namespace internal
} // namespace NMM
