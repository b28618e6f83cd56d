// Energies of the springs between pairs of bodies, and their conservation in ContactTimeStep::begin().
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <contact/contact_data.h>
#include <initializer_list>

namespace NMM
{
  using namespace internal;
  namespace Parallel = dealii::Utilities::MPI;

  std::pair<unsigned int, unsigned int>
  Contact::Data::bodies(const unsigned int q) const
  {
    return std::minmax(surface->edges()[points[q].edge].body,
                       surface->edges()[points[q].master].body);
  }


  template <typename OfPoint>
  PairEnergies
  Contact::Data::sum_over_pairs(const OfPoint &of_point) const
  {
    PairEnergies result;
    for (unsigned int q = 0; q < points.size(); ++q)
      if (points[q].state != ContactState::open)
      {
        const std::array<double, 2> energies = of_point(q);
        std::array<double, 2>      &sums     = result[bodies(q)];
        for (unsigned int i = 0; i < 2; ++i)
          sums[i] += energies[i];
      }
    if (Parallel::n_mpi_processes(communicator) == 1)
      return result;
    std::vector<double> mine;
    for (const auto &[pair, energies] : result)
      for (const double x :
           {double(pair.first), double(pair.second), energies[0], energies[1]})
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


  PairEnergies
  Contact::Data::pair_energies(const PairEnergies *factors) const
  {
    return sum_over_pairs([&](const unsigned int q) -> std::array<double, 2> {
      if (factors == nullptr)
        return {{normal_energy(q, points[q].pressure),
                 shear_energy(q, points[q].shear)}};
      const ContactLaw            &law    = *point_data[q].law;
      const std::array<double, 2> &factor = factors->at(bodies(q));
      return {{points[q].weight *
                 law.energy(factor[0] * law.penetration(points[q].pressure)),
               shear_energy(q, factor[1] * points[q].shear)}};
    });
  }


  PairEnergies
  Contact::Data::pair_energies_by_factor(const PairEnergies &factors) const
  {
    return sum_over_pairs([&](const unsigned int q) -> std::array<double, 2> {
      const ContactLaw            &law    = *point_data[q].law;
      const std::array<double, 2> &factor = factors.at(bodies(q));
      const double d = factor[0] * law.penetration(points[q].pressure);
      return {{points[q].weight * d * law.pressure(d).value,
               2. * shear_energy(q, factor[1] * points[q].shear)}};
    });
  }


  /// Factors k <= 1 on penetrations and shears with which each pair of bodies stores what it did
  /// before, where it would store more. They must be exact: a pair that stores a little less in
  /// each step gives way. For linear springs k = sqrt(E_before / E_found); in general Newton's
  /// method finds log k, since log E is a convex function of log k for springs that stiffen.
  PairEnergies
  Contact::Data::factors_that_keep_energies(const PairEnergies &found) const
  {
    constexpr unsigned int max_iterations = 50;
    constexpr double       rounding       = 1e-12;

    PairEnergies factors;
    for (const auto &[pair, energies] : found)
      factors[pair] = {{1., 1.}};
    PairEnergies now = found;
    for (unsigned int i = 0; i < max_iterations; ++i)
    {
      PairEnergies slopes;
      PairEnergies next       = factors;
      bool         is_reached = true;
      for (auto &[pair, factor] : next)
      {
        const auto before = memory.energies_of_pairs.find(pair);
        for (unsigned int k = 0; k < 2; ++k)
        {
          const double old =
            before == memory.energies_of_pairs.end() ? 0. : before->second[k];
          const double energy = now[pair][k];
          if (energy <= old * (1. + rounding))
            continue;
          if (slopes.empty())
            slopes = pair_energies_by_factor(factors);
          factor[k] *= std::pow(old / energy, energy / slopes[pair][k]);
          is_reached = is_reached && factor[k] == 0.;
        }
      }
      factors = std::move(next);
      if (is_reached)
        break;
      now = pair_energies(&factors);
    }
    return factors;
  }


  void
  Contact::Data::distribute_energies(const PairEnergies &found)
  {
    if (memory.former_bodies.empty())
      return;
    const auto former_pair =
      [&](const std::pair<unsigned int, unsigned int> &pair) {
        const std::pair<unsigned int, unsigned int> result =
          std::minmax({memory.former_bodies[pair.first],
                       memory.former_bodies[pair.second]});
        return result;
      };
    PairEnergies before, now;
    const auto   add = [&](const PairEnergies &from, PairEnergies &sums) {
      for (const auto &[pair, energies] : from)
        for (unsigned int i = 0; i < 2; ++i)
          sums[former_pair(pair)][i] += energies[i];
    };
    add(memory.energies_of_pairs, before);
    add(found, now);
    PairEnergies result;
    for (const PairEnergies *energies :
         std::initializer_list<const PairEnergies *>{&found,
                                                     &memory.energies_of_pairs})
      for (const auto &[pair, ignored] : *energies)
        for (unsigned int i = 0; i < 2; ++i)
        {
          const double sum   = now[former_pair(pair)][i];
          const auto   known = memory.energies_of_pairs.find(pair);
          const auto   other = found.find(pair);
          if (sum > 0.)
            result[pair][i] =
              other == found.end()
                ? 0.
                : other->second[i] / sum * before[former_pair(pair)][i];
          else
            // Nothing is left of this energy, whichever pair had it.
            result[pair][i] =
              known == memory.energies_of_pairs.end() ? 0. : known->second[i];
        }
    memory.energies_of_pairs = std::move(result);
  }


  void
  Contact::Data::keep_energies()
  {
    step.detection_loss = 0.;
    if (!memory.has_accepted_state)
      return;
    const PairEnergies found = pair_energies();
    distribute_energies(found);
    for (const auto &[pair, energies] : memory.energies_of_pairs)
    {
      const auto now = found.find(pair);
      for (unsigned int i = 0; i < 2; ++i)
        step.detection_loss +=
          std::max(0.,
                   energies[i] - (now == found.end() ? 0. : now->second[i]));
    }
    const PairEnergies factors = factors_that_keep_energies(found);
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      ContactPoint &point = points[q];
      if (point.state == ContactState::open)
        continue;
      const std::array<double, 2> &keep  = factors.at(bodies(q));
      PointData                   &fixed = point_data[q];
      fixed.offset = (1. - keep[0]) * (point.gap - point.opening);
      if (keep[0] == 0.)
        point.state = ContactState::open;
      if (keep[1] < 1. && point.shear != 0.)
      {
        const double length =
          surface->place(point.stick_edge, point.stick_t).a.norm();
        point.stick_t +=
          (1. - keep[1]) * point.shear / (fixed.law->shear_spring() * length);
        point.shear *= keep[1];
      }
    }
  }
} // namespace NMM
