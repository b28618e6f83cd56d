// What an accepted state leaves behind: multipliers, bonds, places of sticking.
#include <nmm/base/exceptions.h>
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <contact/contact_data.h>

namespace NMM
{
  using namespace internal;
  using dealii::Point;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  double
  Contact::augment()
  {
    Data &d = *data;
    Assert(d.multiplier_space != nullptr,
           dealii::ExcMessage("There is no penetration tolerance."));
    const MultiplierSpace &space  = *d.multiplier_space;
    const unsigned int     n      = space.size();
    const unsigned int     n_rule = d.rule_points.size();
    // integrals of spring pressure times function, of functions, and of stiffness
    // times function
    std::vector<double> sums(3 * n, 0.);
    // those of corners come last
    for (unsigned int begin = 0;
         begin < d.points.size() && d.point_data[begin].corner >= Data::along;
         begin += n_rule)
    {
      const unsigned int edge = d.search.slaves()[d.point_data[begin].slave];
      const double       length =
        (d.point_data[begin + n_rule - 1].s - d.point_data[begin].s) *
        d.surface->edges()[edge].length;
      for (unsigned int q = 0; q < n_rule; ++q)
      {
        const ContactPoint &point = d.points[begin + q];
        // beside the master, where there is nothing to penetrate
        if (point.master == invalid_index || point.weight == 0.)
          continue;
        const auto  &f      = space[edge];
        const double share  = f.share(d.point_data[begin + q].s);
        const double weight = d.rule_weights[q] * length;
        const double eps    = d.point_data[begin + q].law->normal_stiffness;
        const auto   add    = [&](const unsigned int i, const double value) {
          sums[i] -= eps * value * (point.gap - point.opening);
          sums[n + i] += value;
          sums[2 * n + i] += eps * value;
        };
        add(f.first, weight * (1. - share));
        add(f.second, weight * share);
      }
    }
    Parallel::sum(sums, d.communicator, sums);

    double change = 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      double value = 0.;
      if (sums[n + i] > 0.)
        value = std::max(0., d.multipliers[i] + sums[i] / sums[n + i]);
      const double difference = std::abs(value - d.multipliers[i]);
      const double eps        = sums[n + i] > 0. ? sums[2 * n + i] / sums[n + i]
                                                 : d.parameters.law->normal_stiffness;
      change                  = std::max(change, difference / eps);
      d.multipliers[i]        = value;
    }
    for (unsigned int q = 0; q < d.points.size(); ++q)
    {
      const Data::PointData &fixed = d.point_data[q];
      if (fixed.corner >= Data::along)
        d.points[q].multiplier =
          space.value(d.multipliers, d.search.slaves()[fixed.slave], fixed.s);
    }
    return change;
  }


  double
  Contact::Data::bond_ratio(const unsigned int q) const
  {
    const ContactPoint &point = points[q];
    const ContactLaw   *law   = point_data[q].law;
    if (!point.is_bonded || law == nullptr)
      return -1.;
    // without strength any stress beyond rounding is too much
    const auto ratio = [&](const double stress, const double strength) {
      const double least = 1e-9 * reach * law->normal_stiffness;
      return std::max(0., stress) / std::max(strength, least);
    };
    return std::max(ratio(-point.pressure, law->tensile_strength),
                    ratio(std::abs(point.shear),
                          law->bond_strength(std::max(0., point.pressure))));
  }


  unsigned int
  Contact::break_bonds(const double share)
  {
    Data  &d       = *data;
    double largest = 0.;
    for (unsigned int q = 0; q < d.points.size(); ++q)
      largest = std::max(largest, d.bond_ratio(q));
    largest            = Parallel::max(largest, d.communicator);
    unsigned int count = 0;
    if (largest <= 1.)
      return 0;
    for (unsigned int q = 0; q < d.points.size(); ++q)
    {
      const double ratio = d.bond_ratio(q);
      if (ratio <= 1. || ratio < share * largest)
        continue;
      ContactPoint     &point = d.points[q];
      const ContactLaw &law   = *d.point_data[q].law;
      if (point.pressure < 0.)
        d.broken_energy += d.normal_energy(q, point.pressure);
      const double limit =
        law.strength(std::max(0., point.pressure), d.point_data[q].slip).value;
      const double shear =
        std::copysign(std::min(limit, std::abs(point.shear)), point.shear);
      d.broken_energy +=
        d.shear_energy(q, point.shear) - d.shear_energy(q, shear);
      // it slides from now on: the place where it sticks is dragged along
      const double length =
        d.surface->place(point.stick_edge, point.stick_t).a.norm();
      point.stick_t += (point.shear - shear) / (law.shear_spring() * length);
      point.shear     = shear;
      point.is_bonded = false;
      if (point.pressure < 0.)
      {
        point.pressure = 0.;
        point.state    = ContactState::open;
      }
      ++count;
      // points are made anew from these places
      const StickPlace place{
        point.s, point.stick_edge, point.stick_t, false, d.point_data[q].slip};
      d.stick_places.insert(d.place_key(point.edge, d.point_data[q].corner),
                            place);
    }
    return Parallel::sum(count, d.communicator);
  }


  /// Where a point sticks from now on; returns what has been dissipated.
  double
  Contact::Data::accept_shear(const unsigned int q)
  {
    ContactPoint &point      = points[q];
    PointData    &fixed      = point_data[q];
    const double  eps        = fixed.law->shear_spring();
    double        dissipated = 0.;
    if (is_between)
    {
      const double before = shear_energy(q, fixed.shear_begin);
      const double after  = shear_energy(q, point.shear);
      const double most   = std::max(0., before + fixed.shear_work);
      // no more is stored than has been put in: where it touches for the
      // first time the pressure, and with it the strength, has been lower
      if (after > most)
      {
        const double change = point.shear * (1. - std::sqrt(most / after));
        point.shear -= change;
        point.stick_t +=
          change /
          (eps * surface->place(point.stick_edge, point.stick_t).a.norm());
      }
      dissipated = fixed.shear_work + before - std::min(after, most);
    }
    if (point.master == invalid_index)
      return dissipated;
    // steps know already what rising against the pressure has taken
    if (!is_between)
      dissipated -=
        point.weight * point.pressure * (point.opening - opening_before(q));
    fixed.slip += fixed.new_slip;
    fixed.new_slip = 0.;
    StickPlace place{
      point.s, point.master, point.t, point.is_bonded, fixed.slip};
    if (point.state == ContactState::stick)
    {
      place.edge = point.stick_edge;
      place.t    = point.stick_t;
    }
    else if (point.state == ContactState::slip)
    {
      const Tensor<1, 2> a = surface->place(point.master, point.t).a;
      place.t -= point.shear / (eps * a.norm());
      if (!is_between)
        dissipated +=
          point.weight * std::abs(point.shear) *
          std::abs(
            (point.x - surface->place(point.stick_edge, point.stick_t).x) * a /
              a.norm() -
            point.shear / eps);
    }
    const unsigned int key    = place_key(point.edge, fixed.corner);
    const auto        *places = stick_places.find(key);
    // both pieces that meet at a division have a point there
    if (places == nullptr || places->back().s < point.s)
      stick_places.append(key, place);
    point.stick_edge = place.edge;
    point.stick_t    = place.t;
    return dissipated;
  }


  void
  Contact::Data::note_touching(const unsigned int edge,
                               const unsigned int master)
  {
    // corners turn round to the next edge of the slave, and points go on along
    // smooth boundaries
    const ContactSurface::Edge &slave  = surface->edges()[edge];
    const ContactSurface::Edge &other  = surface->edges()[master];
    constexpr auto              smooth = ContactSurface::Corner::smooth;
    const auto note = [&](const unsigned int from, const unsigned int to) {
      auto &known = touching[from];
      if (std::find(known.begin(), known.end(), to) == known.end())
        known.push_back(to);
    };
    for (const unsigned int a : {edge, slave.previous, slave.next})
      for (const unsigned int b :
           {master,
            other.at_start == smooth ? other.previous : invalid_index,
            other.at_end == smooth ? other.next : invalid_index})
        if (a != invalid_index && b != invalid_index)
        {
          note(a, b);
          note(b, a);
        }
  }


  void
  Contact::Data::note_touching()
  {
    touching.resize(surface->edges().size());
    for (auto &known : touching)
      known.clear();
    std::vector<unsigned int> pairs;
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      const unsigned int edge = points[q].edge, master = points[q].master;
      const unsigned int n = pairs.size();
      if (master != invalid_index && points[q].gap < 0. &&
          (n == 0 || pairs[n - 2] != edge || pairs[n - 1] != master))
      {
        pairs.push_back(edge);
        pairs.push_back(master);
      }
    }
    if (Parallel::n_mpi_processes(communicator) > 1)
    {
      const auto all = Parallel::all_gather(communicator, pairs);
      pairs.clear();
      for (const auto &part : all)
        pairs.insert(pairs.end(), part.begin(), part.end());
    }
    for (unsigned int i = 0; i < pairs.size(); i += 2)
      note_touching(pairs[i], pairs[i + 1]);
  }


  double
  Contact::accept()
  {
    Data &d = *data;
    d.stick_places.clear();
    d.entrances.clear();
    for (unsigned int q = 0; q < d.points.size(); ++q)
      if (d.point_data[q].corner < Data::along &&
          d.points[q].state != ContactState::open)
        d.entrances[d.place_key(d.points[q].edge, d.point_data[q].corner)] =
          d.points[q].master;
    d.note_touching();
    d.search.begin(ContactSearch::Begin::here);
    d.is_virgin = false;
    // the same on all ranks
    double dissipated =
      Parallel::this_mpi_process(d.communicator) == 0 ? d.detection_loss : 0.;
    d.detection_loss = 0.;
    if (d.is_between)
      for (const Data::PointData &fixed : d.point_data)
        dissipated += fixed.normal_loss;
    if (!d.has_friction)
    {
      d.energies_of_pairs = d.pair_energies();
      return Parallel::sum(dissipated, d.communicator);
    }
    (void)break_bonds();
    dissipated += d.broken_energy;
    d.broken_energy = 0.;
    for (unsigned int q = 0; q < d.points.size(); ++q)
      if (d.point_data[q].law != nullptr && d.point_data[q].law->has_friction())
        dissipated += d.accept_shear(q);
    d.energies_of_pairs = d.pair_energies();
    return Parallel::sum(dissipated, d.communicator);
  }


  void
  Contact::set_absent_bodies(const std::vector<bool> &is_absent)
  {
    Data &d = *data;
    AssertDimension(is_absent.size(), d.surface->n_bodies());
    d.surface->set_absent_bodies(is_absent);
    d.search.forget();
    const std::size_t n_edges        = d.surface->edges().size();
    const auto        edge_is_absent = [&](const unsigned int edge) {
      return is_absent[d.surface->edges()[edge % n_edges].body];
    };
    const auto erase_if = [](auto &entries, const auto &is_dropped) {
      for (auto entry = entries.begin(); entry != entries.end();)
        entry = is_dropped(*entry) ? entries.erase(entry) : std::next(entry);
    };
    erase_if(d.energies_of_pairs, [&](const auto &entry) {
      return is_absent[entry.first.first] || is_absent[entry.first.second];
    });
    erase_if(d.entrances, [&](const auto &entry) {
      return edge_is_absent(entry.first) || edge_is_absent(entry.second);
    });
    for (unsigned int edge = 0; edge < d.touching.size(); ++edge)
    {
      auto &known = d.touching[edge];
      known.erase(std::remove_if(known.begin(), known.end(), edge_is_absent),
                  known.end());
      if (edge_is_absent(edge))
        known.clear();
    }
    d.stick_places.remove_if(
      [&](const unsigned int key, const StickPlace &place) {
        return edge_is_absent(key) || edge_is_absent(place.edge);
      });
  }


  namespace
  {
    /// Those of all ranks, one after the other.
    template <typename Item>
    void
    gather(const MPI_Comm communicator, std::vector<Item> &items)
    {
      if (Parallel::n_mpi_processes(communicator) == 1)
        return;
      std::vector<Item> all;
      for (const auto &part : Parallel::all_gather(communicator, items))
        all.insert(all.end(), part.begin(), part.end());
      items = std::move(all);
    }
  } // namespace


  ContactHistory
  Contact::history() const
  {
    const Data    &d = *data;
    ContactHistory result;
    result.has_accepted_state     = !d.is_virgin;
    result.is_conserving          = d.is_conserving;
    result.multipliers            = d.multipliers;
    result.searched_displacements = d.searched_nodal;
    result.searched_time          = d.searched_time;
    result.searched_reach         = d.searched_reach;
    d.stick_places.for_each(
      [&](const unsigned int key, const std::vector<StickPlace> &places) {
        for (const StickPlace &place : places)
          result.sticks.push_back(
            {key, place.s, place.edge, place.t, place.is_bonded, place.slip});
      });
    result.entrances.assign(d.entrances.begin(), d.entrances.end());
    gather(d.communicator, result.sticks);
    gather(d.communicator, result.entrances);
    // these are the same on all ranks
    for (unsigned int edge = 0; edge < d.touching.size(); ++edge)
      for (const unsigned int other : d.touching[edge])
        result.touching.emplace_back(edge, other);
    for (const auto &[pair, energies] : d.energies_of_pairs)
      result.pair_energies.push_back({pair.first, pair.second, energies});
    return result;
  }


  void
  Contact::restore_history(const ContactHistory &history)
  {
    Data              &d       = *data;
    const unsigned int n_edges = d.surface->edges().size();
    d.is_virgin                = !history.has_accepted_state;
    d.is_conserving            = history.is_conserving;
    d.search.begin(ContactSearch::Begin::unknown);
    if (history.multipliers.size() == d.multipliers.size())
      d.multipliers = history.multipliers;
    if (!history.searched_displacements.empty())
    {
      d.searched_nodal = history.searched_displacements;
      d.searched_time  = history.searched_time;
      d.searched_reach = history.searched_reach;
      d.nodal          = d.searched_nodal;
      d.surface->set_displacements(&d.nodal);
      set_time(d.searched_time);
      d.search.search(d.searched_reach);
    }
    // corners of masters are with the slave's rank, which is not known here
    const auto [first, last] = d.surface->locally_owned_edges();
    const bool has_obstacles = Parallel::this_mpi_process(d.communicator) == 0;
    const auto is_mine =
      [&, first = first, last = last](const unsigned int place) {
        const unsigned int edge = place % n_edges;
        return place / n_edges > Data::master_ends ||
               (edge >= first && edge < last) ||
               (has_obstacles && d.surface->is_rigid(edge));
      };
    d.stick_places.clear();
    for (const ContactHistory::Stick &stick : history.sticks)
      if (is_mine(stick.place))
        d.stick_places.append(
          stick.place,
          {stick.s, stick.edge, stick.t, stick.is_bonded, stick.slip});
    d.stick_places.sort();
    d.entrances.clear();
    for (const auto &[place, edge] : history.entrances)
      if (is_mine(place))
        d.entrances[place] = edge;
    d.touching.clear();
    if (!history.touching.empty())
      d.touching.resize(n_edges);
    for (const auto &[edge, other] : history.touching)
      d.touching[edge].push_back(other);
    d.energies_of_pairs.clear();
    for (const ContactHistory::PairEnergy &pair : history.pair_energies)
      d.energies_of_pairs[{pair.first, pair.second}] = pair.energies;
  }
} // namespace NMM
