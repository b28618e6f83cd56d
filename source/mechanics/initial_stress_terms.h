#ifndef nmm_source_mechanics_initial_stress_terms_h
#define nmm_source_mechanics_initial_stress_terms_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/quadrature/element_quadrature.h>

#include <array>
#include <mechanics/edge_tables.h>
#include <mechanics/local_system.h>
#include <mechanics/nitsche_terms.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The terms of initial stress S_0(X) that varies within elastic materials
     * (Material::varying_initial_stress), beside those of a law without initial stress:
     * @f[ W = S_0:E, \qquad P = F S_0, \qquad A_{iJkL} = \delta_{ik}(S_0)_{JL}, @f]
     * in small displacements W = S_0 : grad u and P = S_0. S_0 does not depend on the deformation,
     * so that the integrals are computed once for each element,
     * @f[ f_i = \int S_0\,\nabla w_i, \qquad G_{ij} = \int \nabla w_i\cdot S_0\,\nabla w_j, @f]
     * and its forces are f_i + sum_j G_ij u_j, without the sum in small displacements. On displacement
     * conditions and ties it has the traction F S_0 N.
     *
     * A rule of the degree of the weight functions is exact for S_0 that is linear in an element.
     * Inelastic materials are left to InelasticTerms.
     *
     * Memory: 400 bytes for each element whose material has such a stress, and 32 bytes for each
     * weak point. Nothing without such a material.
     */
    class InitialStressTerms
    {
    public:
      InitialStressTerms(const CoverSystem          &covers,
                         const QuadratureCollection &quadrature,
                         const ElasticityProblem    &problem,
                         const EdgeTables           &edges);

      /// Add forces and energy of small displacements @p u. Their matrix is 0.
      void
      add_small(unsigned int             element,
                const LocalDisplacement &u,
                LocalSystem             &local) const;

      /// Add forces, energy and matrix of finite displacements @p u. Between two states, whose mean
      /// is @p u, the forces do exactly the work by which W changes, since E is quadratic in u.
      void
      add_finite(unsigned int             element,
                 const LocalDisplacement &u,
                 LocalSystem             &local) const;

      /// @{
      /// Add the traction at the weak point with the index @p point to the fluxes of its sides, in
      /// small and in finite displacements. In a conserving step @p u is the mean of both states, and
      /// so is terms.d.
      void
      add_small_fluxes(unsigned int point, NitscheTerms &terms) const;

      void
      add_finite_fluxes(unsigned int             point,
                        const LocalDisplacement &u,
                        NitscheTerms            &terms) const;
      /// @}

    private:
      struct Integrals
      {
        double forces[WeightFunctions::max_per_cell][2];
        double moduli[WeightFunctions::max_per_cell]
                     [WeightFunctions::max_per_cell];
      };

      Integrals
      integrate(unsigned int                 element,
                const dealii::Quadrature<2> &rule,
                const dealii::Function<2>   &stress) const;

      /// The integrals of an element; null if its material has no such stress.
      const Integrals *
      of(const unsigned int element) const
      {
        if (element_to_entry.empty())
          return nullptr;
        const unsigned int entry = element_to_entry[element - first_element];
        return entry == invalid_index ? nullptr : &entries[entry];
      }

      const CoverSystem        *covers;
      unsigned int              degree, n_per_cell, first_element = 0;
      std::vector<unsigned int> element_to_entry;
      std::vector<Integrals>    entries;
      /// S_0 N of both sides of each weak point [Pa]; empty if no material has such a stress.
      std::vector<std::array<dealii::Tensor<1, 2>, 2>> tractions;
    };
  } // namespace internal
} // namespace NMM

#endif
