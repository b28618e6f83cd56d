// Energies of the springs between pairs of bodies, and their conservation in ContactTimeStep::begin().
#include <nmm/contact/contact.h>

#include <algorithm>
#include <array>
#include <contact/contact.h>

namespace NMM
{
  using namespace internal;

  std::vector<PointSprings>
  Contact::Data::closed_springs() const
  {
    std::vector<PointSprings> result;
    for (unsigned int q = 0; q < points.size(); ++q)
      if (points[q].state != ContactState::open)
        result.push_back({bodies(q),
                          point_data[q].law,
                          points[q].weight,
                          point_data[q].stiffening,
                          points[q].pressure,
                          points[q].shear});
    return result;
  }


  void
  Contact::Data::keep_energies()
  {
    step.detection_loss = 0.;
    if (!memory.has_accepted_state)
      return;
    const std::vector<PointSprings> springs = closed_springs();
    const PairEnergies              found = sum_energies(springs, communicator);
    PairEnergies                   &before = memory.energies_of_pairs;
    before = distribute_energies(before, found, memory.former_bodies);
    for (const auto &[pair, energies] : before)
    {
      const auto now = found.find(pair);
      for (unsigned int i = 0; i < 2; ++i)
        step.detection_loss +=
          std::max(0.,
                   energies[i] - (now == found.end() ? 0. : now->second[i]));
    }
    const PairEnergies factors =
      factors_that_keep_energies(springs, before, communicator);
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
