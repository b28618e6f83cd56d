#include <algorithm>
#include <array>
#include <contact/state/memory.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Bodies of a point, the lower number first.
      std::pair<unsigned int, unsigned int>
      bodies_of(const ContactPoint &point, const ContactSurface &surface)
      {
        return std::minmax(surface.edges()[point.edge].body,
                           surface.edges()[point.master].body);
      }


      /// The springs of all closed points.
      std::vector<PointSprings>
      closed_springs(const PointSet &set, const ContactSurface &surface)
      {
        std::vector<PointSprings> result;
        for (unsigned int q = 0; q < set.points.size(); ++q)
          if (const ContactPoint &point = set.points[q];
              point.state != ContactState::open)
            result.push_back({bodies_of(point, surface),
                              set.data[q].law,
                              point.weight,
                              set.data[q].stiffening,
                              point.pressure,
                              point.shear});
        return result;
      }
    } // namespace


    PairEnergies
    energies_of(const PointSet &set, const ContactSurface &surface)
    {
      return sum_energies(closed_springs(set, surface),
                          surface.cover_system().communicator());
    }


    void
    ContactMemory::keep_energies(const ContactSurface &surface, PointSet &set)
    {
      const MPI_Comm communicator = surface.cover_system().communicator();
      detection_loss              = 0.;
      if (!has_accepted_state)
      {
        energies_of_pairs = energies_of(set, surface);
        return;
      }
      const std::vector<PointSprings> springs = closed_springs(set, surface);
      const PairEnergies found  = sum_energies(springs, communicator);
      PairEnergies      &before = energies_of_pairs;
      before = distribute_energies(before, found, former_bodies);
      for (const auto &[pair, energies] : before)
      {
        const auto now = found.find(pair);
        for (unsigned int i = 0; i < 2; ++i)
          detection_loss +=
            std::max(0.,
                     energies[i] - (now == found.end() ? 0. : now->second[i]));
      }
      const PairEnergies factors =
        factors_that_keep_energies(springs, before, communicator);
      for (unsigned int q = 0; q < set.points.size(); ++q)
      {
        ContactPoint &point = set.points[q];
        if (point.state == ContactState::open)
          continue;
        const std::array<double, 2> &keep =
          factors.at(bodies_of(point, surface));
        PointData &fixed = set.data[q];
        fixed.offset     = (1. - keep[0]) * (point.gap - point.opening);
        if (keep[0] == 0.)
          point.state = ContactState::open;
        if (keep[1] < 1. && point.shear != 0.)
        {
          const double length =
            surface.place(point.stick_edge, point.stick_t).a.norm();
          point.stick_t +=
            (1. - keep[1]) * point.shear / (fixed.law->shear_spring() * length);
          point.shear *= keep[1];
        }
      }
    }
  } // namespace internal
} // namespace NMM
