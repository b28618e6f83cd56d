#include <nmm/base/archive.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <contact/state/memory.h>

namespace NMM
{
  namespace internal
  {
    namespace Parallel = dealii::Utilities::MPI;

    namespace
    {
      /// Concatenate the items of all ranks.
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


      /// Checks that a history fits a surface: it may come from a file.
      void
      check(const ContactHistory &history, const ContactSurface &surface)
      {
        const unsigned int n_edges      = surface.edges().size();
        const auto         require_edge = [&](const unsigned int edge) {
          require_in_checkpoint(edge < n_edges,
                                "a face in contact is not there");
        };
        const auto require_place = [&](const unsigned int place) {
          // The corners of masters are of the last two kinds.
          const unsigned int n_places = (PointKind::master_ends + 3) * n_edges;
          require_in_checkpoint(place < n_places,
                                "a place in contact is not there");
        };
        const auto require_finite = [](const auto &numbers) {
          require_in_checkpoint(are_finite(numbers),
                                "a number of the contact is not finite");
        };
        for (const ContactHistory::Stick &stick : history.sticks)
        {
          require_place(stick.place);
          require_edge(stick.edge);
          require_finite(std::vector<double>{stick.s, stick.t, stick.slip});
        }
        for (const auto &[place, edge] : history.entrances)
        {
          require_place(place);
          require_edge(edge);
        }
        for (const auto &[edge, other] : history.touching)
        {
          require_edge(edge);
          require_edge(other);
        }
        const unsigned int n_bodies = surface.n_bodies();
        for (const ContactHistory::PairEnergy &pair : history.pair_energies)
        {
          require_in_checkpoint(pair.first < n_bodies && pair.second < n_bodies,
                                "a body in contact is not there");
          require_finite(pair.energies);
        }
        require_in_checkpoint(history.former_bodies.empty() ||
                                history.former_bodies.size() == n_bodies,
                              "bodies have come from another number of them");
        require_finite(history.multipliers);
        require_finite(history.searched_displacements);
        require_in_checkpoint(history.searched_displacements.empty() ||
                                history.searched_displacements.size() ==
                                  2 * surface.cover_system().n_covers(),
                              "it is of another number of covers in contact");
        require_finite(history.searched_reaches);
        require_in_checkpoint(history.searched_displacements.empty() ||
                                history.searched_reaches.size() == n_bodies,
                              "bodies in the search are not there");
        require_in_checkpoint(std::isfinite(history.searched_time) &&
                                std::all_of(history.searched_reaches.begin(),
                                            history.searched_reaches.end(),
                                            [](const double reach) {
                                              return reach >= 0.;
                                            }),
                              "time or reach of the search is no number");
      }
    } // namespace


    void
    ContactMemory::forget_absent_bodies(const ContactSurface &surface)
    {
      const std::size_t n_edges        = surface.edges().size();
      const auto        edge_is_absent = [&](const unsigned int edge) {
        return surface.is_absent(edge % n_edges);
      };
      const auto erase_if = [](auto &entries, const auto &is_dropped) {
        for (auto entry = entries.begin(); entry != entries.end();)
          entry = is_dropped(*entry) ? entries.erase(entry) : std::next(entry);
      };
      const std::vector<bool> &is_absent = surface.absent_bodies();
      erase_if(energies_of_pairs, [&](const auto &entry) {
        return is_absent[entry.first.first] || is_absent[entry.first.second];
      });
      erase_if(entrances, [&](const auto &entry) {
        return edge_is_absent(entry.first) || edge_is_absent(entry.second);
      });
      for (unsigned int edge = 0; edge < touching.size(); ++edge)
      {
        auto &known = touching[edge];
        known.erase(std::remove_if(known.begin(), known.end(), edge_is_absent),
                    known.end());
        if (edge_is_absent(edge))
          known.clear();
      }
      stick_places.remove_if(
        [&](const unsigned int key, const StickPlace &place) {
          return edge_is_absent(key) || edge_is_absent(place.edge);
        });
    }


    void
    ContactMemory::save(const MPI_Comm  communicator,
                        ContactHistory &history) const
    {
      history.has_accepted_state = has_accepted_state;
      history.searched_time      = searched_time;
      history.searched_reaches   = searched_reaches;
      history.touching_reach     = touching_reach;
      for (const dealii::Tensor<1, 2> &u : searched_nodal)
        history.searched_displacements.insert(
          history.searched_displacements.end(), {u[0], u[1]});
      stick_places.for_each(
        [&](const unsigned int key, const std::vector<StickPlace> &places) {
          for (const StickPlace &place : places)
            history.sticks.push_back(
              {key, place.s, place.edge, place.t, place.is_bonded, place.slip});
        });
      history.entrances.assign(entrances.begin(), entrances.end());
      gather(communicator, history.sticks);
      gather(communicator, history.entrances);
      // These are the same on all ranks.
      for (unsigned int edge = 0; edge < touching.size(); ++edge)
        for (const unsigned int other : touching[edge])
          history.touching.emplace_back(edge, other);
      history.former_bodies = former_bodies;
      for (const auto &[pair, energies] : energies_of_pairs)
        history.pair_energies.push_back({pair.first, pair.second, energies});
    }


    void
    ContactMemory::restore(const ContactHistory &history,
                           const ContactSurface &surface)
    {
      check(history, surface);
      const unsigned int n_edges = surface.edges().size();
      has_accepted_state         = history.has_accepted_state;
      touching_reach             = history.touching_reach;
      if (!history.searched_displacements.empty())
      {
        const std::vector<double> &values = history.searched_displacements;
        searched_nodal.resize(values.size() / 2);
        for (unsigned int i = 0; i < values.size(); ++i)
          searched_nodal[cover_of(i)][component_of(i)] = values[i];
        searched_time    = history.searched_time;
        searched_reaches = history.searched_reaches;
      }
      // Corners of masters belong to the rank of the slave, which is not known here, so that every
      // rank takes them.
      const auto [first, last] = surface.locally_owned_edges();
      const bool has_obstacles =
        Parallel::this_mpi_process(surface.cover_system().communicator()) == 0;
      const auto is_mine =
        [&, first = first, last = last](const unsigned int place) {
          const unsigned int edge = place % n_edges;
          return place / n_edges > PointKind::master_ends ||
                 (edge >= first && edge < last) ||
                 (has_obstacles && surface.is_rigid(edge));
        };
      stick_places.clear();
      for (const ContactHistory::Stick &stick : history.sticks)
        if (is_mine(stick.place))
          stick_places.append(
            stick.place,
            {stick.s, stick.edge, stick.t, stick.is_bonded, stick.slip});
      stick_places.sort();
      entrances.clear();
      for (const auto &[place, edge] : history.entrances)
        if (is_mine(place))
          entrances[place] = edge;
      touching.clear();
      if (!history.touching.empty())
        touching.resize(n_edges);
      for (const auto &[edge, other] : history.touching)
        touching[edge].push_back(other);
      energies_of_pairs.clear();
      for (const ContactHistory::PairEnergy &pair : history.pair_energies)
        energies_of_pairs[{pair.first, pair.second}] = pair.energies;
      former_bodies = history.former_bodies;
    }
  } // namespace internal
} // namespace NMM
