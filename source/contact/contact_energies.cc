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


  PairEnergies
  Contact::Data::pair_energies(const PairEnergies *factors) const
  {
    PairEnergies result;
    for (unsigned int q = 0; q < points.size(); ++q)
      if (points[q].state != ContactState::open)
      {
        const ContactPoint    &point    = points[q];
        std::array<double, 2> &energies = result[bodies(q)];
        if (factors == nullptr)
        {
          energies[0] += normal_energy(q, point.pressure);
          energies[1] += shear_energy(q, point.shear);
          continue;
        }
        const ContactLaw            &law    = *point_data[q].law;
        const std::array<double, 2> &factor = factors->at(bodies(q));
        energies[0] += point.weight *
                       law.energy(factor[0] * law.penetration(point.pressure));
        energies[1] += shear_energy(q, factor[1] * point.shear);
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


  /// Factors k on penetrations and shears with which each pair of bodies stores no more than
  /// before. For linear springs k = sqrt(E_before / E_found). The energy of other springs grows
  /// faster than the square, so that this is iterated.
  PairEnergies
  Contact::Data::factors_that_keep_energies(const PairEnergies &found) const
  {
    constexpr unsigned int max_iterations = 50;
    constexpr double       rounding       = 1e-12;

    PairEnergies factors;
    for (const auto &[pair, energies] : found)
      factors[pair] = {{1., 1.}};
    PairEnergies now        = found;
    bool         is_reached = false;
    for (unsigned int i = 0; i < max_iterations && !is_reached; ++i)
    {
      is_reached = true;
      for (auto &[pair, factor] : factors)
      {
        const auto before = memory.energies_of_pairs.find(pair);
        for (unsigned int k = 0; k < 2; ++k)
        {
          const double old =
            before == memory.energies_of_pairs.end() ? 0. : before->second[k];
          const double energy = now[pair][k];
          if (energy <= old * (1. + rounding))
            continue;
          factor[k] *= std::sqrt(old / energy);
          is_reached = is_reached && factor[k] == 0.;
        }
      }
      if (!is_reached)
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
