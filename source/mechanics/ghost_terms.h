#ifndef nmm_source_mechanics_ghost_terms_h
#define nmm_source_mechanics_ghost_terms_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <deal.II/base/quadrature.h>

#include <mechanics/local_system.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The pairs of elements of a ghost penalty, which may be null, that this rank assembles: those
    /// whose first element it owns.
    inline std::vector<std::pair<unsigned int, unsigned int>>
    owned_pairs(const CoverSystem &covers, const GhostPenalty *ghost_penalty)
    {
      std::vector<std::pair<unsigned int, unsigned int>> result;
      const auto [first, last] = covers.locally_owned_elements();
      if (ghost_penalty != nullptr)
        for (const auto &pair : ghost_penalty->pairs)
          if (pair.first >= first && pair.first < last)
            result.push_back(pair);
      return result;
    }


    /**
     * The terms of the ghost penalty, see GhostPenalty, for a pair of joined
     * elements. Local systems have the covers of the first element, followed by those of the
     * second one (shared covers occur twice).
     */
    class GhostTerms
    {
    public:
      /// The factors gamma [-] of the energy of the difference. Measurements on the
      /// disk and on slivers: with the factors 1, 0.1, 0.03, 0.01 in the stiffness the error
      /// is 2.1, 1.1, 1.0, 1.0 times that of aggregation and the condition
      /// number 7, 1.3, 1, 1 times, but with 0.01 displacement conditions on slivers
      /// lose coercivity. The mass matrix needs a smaller factor.
      static constexpr double stiffness_factor = 0.03, mass_factor = 1e-3;

      GhostTerms(const CoverSystem &covers, const ElasticityProblem &problem);

      void
      add_stiffness(const std::pair<unsigned int, unsigned int> &pair,
                    LocalSystem                                 &system) const;

      /// Add gamma rho int (u_E - u_F) . (v_E - v_F) for the elements E and F of the pair.
      void
      add_mass(const std::pair<unsigned int, unsigned int> &pair,
               LocalSystem                                 &system) const;

    private:
      /// Call an action with the gradients or values of the weight functions of both elements,
      /// those of the second one with negative sign, and the quadrature weight [m^2], for each
      /// quadrature point of both cells.
      template <typename Action>
      void
      for_each_point(const std::pair<unsigned int, unsigned int> &pair,
                     const Action                                &action) const;

      const CoverSystem           *covers;
      unsigned int                 degree, n_per_cell;
      dealii::Quadrature<2>        rule;
      std::vector<PlaneElasticity> region_to_elasticity;
      std::vector<double>          region_to_density;
    };
  } // namespace internal
} // namespace NMM

#endif
