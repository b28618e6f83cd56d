#include <algorithm>
#include <cmath>
#include <contact/state/spring_energies.h>
#include <initializer_list>

namespace NMM
{
  namespace internal
  {
    namespace Parallel = dealii::Utilities::MPI;

    namespace
    {
      /// For each pair of bodies, the sum of of_point(springs) over all ranks.
      template <typename OfPoint>
      PairEnergies
      sum_over_pairs(const std::vector<PointSprings> &all,
                     const MPI_Comm                   communicator,
                     const OfPoint                   &of_point)
      {
        PairEnergies result;
        for (const PointSprings &springs : all)
        {
          const std::array<double, 2> energies = of_point(springs);
          std::array<double, 2>      &sums     = result[springs.bodies];
          for (unsigned int i = 0; i < 2; ++i)
            sums[i] += energies[i];
        }
        if (Parallel::n_mpi_processes(communicator) == 1)
          return result;
        std::vector<double> mine;
        for (const auto &[pair, energies] : result)
          for (const double x : {double(pair.first),
                                 double(pair.second),
                                 energies[0],
                                 energies[1]})
            mine.push_back(x);
        result.clear();
        for (const auto &part : Parallel::all_gather(communicator, mine))
          for (unsigned int i = 0; i + 3 < part.size(); i += 4)
          {
            auto &energies = result[{static_cast<unsigned int>(part[i]),
                                     static_cast<unsigned int>(part[i + 1])}];
            energies[0] += part[i + 2];
            energies[1] += part[i + 3];
          }
        return result;
      }
    } // namespace


    PairEnergies
    sum_energies(const std::vector<PointSprings> &all,
                 const MPI_Comm                   communicator)
    {
      return sum_over_pairs(
        all,
        communicator,
        [](const PointSprings &springs) -> std::array<double, 2> {
          return {{springs.normal_energy(), springs.shear_energy()}};
        });
    }


    PairEnergies
    factors_that_keep_energies(const std::vector<PointSprings> &all,
                               const PairEnergies              &before,
                               const MPI_Comm                   communicator)
    {
      constexpr unsigned int max_iterations = 50;
      constexpr double       rounding       = 1e-12;

      PairEnergies factors;
      const auto   energies = [&]() {
        return sum_over_pairs(
          all,
          communicator,
          [&](const PointSprings &springs) -> std::array<double, 2> {
            const std::array<double, 2> &factor = factors.at(springs.bodies);
            return {{springs.normal_energy(factor[0]),
                     springs.shear_energy(factor[1])}};
          });
      };
      // Derivatives of these energies by the logarithms of the factors.
      const auto slopes_of_energies = [&]() {
        return sum_over_pairs(
          all,
          communicator,
          [&](const PointSprings &springs) -> std::array<double, 2> {
            const std::array<double, 2> &factor = factors.at(springs.bodies);
            const ContactLaw            &law    = *springs.law;
            const double d = factor[0] * law.penetration(springs.pressure /
                                                         springs.stiffening);
            return {
              {springs.weight * springs.stiffening * d * law.pressure(d).value,
               2. * springs.shear_energy(factor[1])}};
          });
      };
      PairEnergies now = sum_energies(all, communicator);
      for (const auto &[pair, ignored] : now)
        factors[pair] = {{1., 1.}};
      for (unsigned int i = 0; i < max_iterations; ++i)
      {
        PairEnergies slopes;
        PairEnergies next       = factors;
        bool         is_reached = true;
        for (auto &[pair, factor] : next)
        {
          const auto known = before.find(pair);
          for (unsigned int k = 0; k < 2; ++k)
          {
            const double old    = known == before.end() ? 0. : known->second[k];
            const double energy = now[pair][k];
            if (energy <= old * (1. + rounding))
              continue;
            if (slopes.empty())
              slopes = slopes_of_energies();
            factor[k] *= std::pow(old / energy, energy / slopes[pair][k]);
            is_reached = is_reached && factor[k] == 0.;
          }
        }
        factors = std::move(next);
        if (is_reached)
          break;
        now = energies();
      }
      return factors;
    }


    PairEnergies
    distribute_energies(const PairEnergies              &before,
                        const PairEnergies              &found,
                        const std::vector<unsigned int> &former_bodies)
    {
      if (former_bodies.empty())
        return before;
      const auto former_pair =
        [&](const std::pair<unsigned int, unsigned int> &pair) {
          const std::pair<unsigned int, unsigned int> result = std::minmax(
            {former_bodies[pair.first], former_bodies[pair.second]});
          return result;
        };
      PairEnergies sums_before, sums_found;
      const auto   add = [&](const PairEnergies &from, PairEnergies &sums) {
        for (const auto &[pair, energies] : from)
          for (unsigned int i = 0; i < 2; ++i)
            sums[former_pair(pair)][i] += energies[i];
      };
      add(before, sums_before);
      add(found, sums_found);
      PairEnergies result;
      for (const PairEnergies *energies : {&found, &before})
        for (const auto &[pair, ignored] : *energies)
          for (unsigned int i = 0; i < 2; ++i)
          {
            const double sum   = sums_found[former_pair(pair)][i];
            const auto   known = before.find(pair);
            const auto   other = found.find(pair);
            if (sum > 0.)
              result[pair][i] =
                other == found.end()
                  ? 0.
                  : other->second[i] / sum * sums_before[former_pair(pair)][i];
            else
              // Nothing is left of this energy, whichever pair had it.
              result[pair][i] = known == before.end() ? 0. : known->second[i];
          }
      return result;
    }
  } // namespace internal
} // namespace NMM
