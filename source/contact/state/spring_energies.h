#ifndef nmm_source_contact_state_spring_energies_h
#define nmm_source_contact_state_spring_energies_h

#include <nmm/contact/law/law.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Energies of the normal and the shear springs between pairs of bodies, summed over all ranks
    /// [J/m].
    using PairEnergies =
      std::map<std::pair<unsigned int, unsigned int>, std::array<double, 2>>;


    /// The springs of a closed contact point.
    struct PointSprings
    {
      /// The bodies of the point, the lower number first.
      std::pair<unsigned int, unsigned int> bodies;
      const ContactLaw                     *law = nullptr;
      /// Weight of the point [m], and factor by which its normal spring is stiffer than its law [-].
      double weight = 0., stiffening = 1.;
      /// Pressure and shear [Pa].
      double pressure = 0., shear = 0.;

      /// Energy of the normal spring whose penetration is @p factor times the present one [J/m].
      double
      normal_energy(const double factor = 1.) const
      {
        return weight * stiffening *
               law->energy(factor * law->penetration(pressure / stiffening));
      }

      /// Energy of the shear spring whose shear is @p factor times the present one [J/m].
      double
      shear_energy(const double factor = 1.) const
      {
        return weight * law->shear_energy(factor * shear);
      }
    };


    /// Energies of the @p springs of all ranks, by pair of bodies.
    PairEnergies
    sum_energies(const std::vector<PointSprings> &springs,
                 MPI_Comm                         communicator);

    /**
     * Factors k <= 1 on penetrations and shears with which each pair of bodies stores what it did
     * @p before, where its @p springs would store more, as they do where contact has been found
     * late. The factors must be exact: a pair that stores a little less in each step gives way.
     * For linear springs @f$ k = \sqrt{E_\text{before} / E_\text{found}} @f$; in general Newton's
     * method finds log k, since log E is a convex function of log k for springs that stiffen.
     * Collective.
     */
    PairEnergies
    factors_that_keep_energies(const std::vector<PointSprings> &springs,
                               const PairEnergies              &before,
                               MPI_Comm                         communicator);

    /// Distribute the energies @p before of bodies that have been divided since among the pairs of
    /// their parts, in proportion to the energies @p found. @p former_bodies: see ContactHistory.
    PairEnergies
    distribute_energies(const PairEnergies              &before,
                        const PairEnergies              &found,
                        const std::vector<unsigned int> &former_bodies);
  } // namespace internal
} // namespace NMM

#endif
