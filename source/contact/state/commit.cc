// History of accepted states: multipliers, bonds and anchors.
#include <nmm/base/exceptions.h>
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <contact/contact.h>
#include <contact/law/point_springs.h>

namespace NMM
{
  using namespace internal;
  using dealii::Point;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  namespace
  {
    /// Set the anchor of a point at an accepted state, and return the energy dissipated [J/m]. @p
    /// is_between: whether the state is the end of a conserving step.
    double
    accept_shear(const ContactSurface &surface,
                 const bool            is_between,
                 ContactPoint         &point,
                 PointData            &fixed,
                 StickPlaces          &stick_places)
    {
      const double eps        = fixed.law->shear_spring();
      double       dissipated = 0.;
      if (is_between)
      {
        const double before = shear_energy(point, fixed, fixed.shear_begin);
        const double after  = shear_energy(point, fixed, point.shear);
        const double most   = std::max(0., before + fixed.shear_work);
        // The spring must not store more than the work done on it. Where a point touches for the
        // first time, the pressure in the step, and with it the strength, has been lower than at the
        // end.
        if (after > most)
        {
          const double change = point.shear * (1. - std::sqrt(most / after));
          point.shear -= change;
          point.stick_t +=
            change /
            (eps * surface.place(point.stick_edge, point.stick_t).a.norm());
        }
        dissipated = fixed.shear_work + before - std::min(after, most);
      }
      if (point.master == invalid_index)
        return dissipated;
      // In steps, StepTractions has subtracted the work of dilation.
      if (!is_between)
        dissipated -= point.weight * point.pressure *
                      (point.opening - opening_before(point, fixed));
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
        const Tensor<1, 2> a = surface.place(point.master, point.t).a;
        const double       elastic =
          (point.shear - initial_shear(point, fixed)) / eps;
        place.t -= elastic / a.norm();
        if (!is_between)
          dissipated +=
            point.weight * std::abs(point.shear) *
            std::abs((surface.place(point.edge, point.s).x -
                      surface.place(point.stick_edge, point.stick_t).x) *
                       a / a.norm() -
                     elastic);
      }
      const unsigned int key    = place_key(surface, point.edge, fixed.corner);
      const auto        *places = stick_places.find(key);
      // Both pieces that meet at a division have a point there; only one of them is stored.
      if (places == nullptr || places->back().s < point.s)
        stick_places.append(key, place);
      point.stick_edge = place.edge;
      point.stick_t    = place.t;
      return dissipated;
    }


    /// Record that two edges penetrate each other.
    void
    note_touching(const ContactSurface                   &surface,
                  const unsigned int                      edge,
                  const unsigned int                      master,
                  std::vector<std::vector<unsigned int>> &touching)
    {
      // A corner can pass on to the next edge of the slave, and a point to the next edge of a smooth
      // boundary.
      const ContactSurface::Edge &slave  = surface.edges()[edge];
      const ContactSurface::Edge &other  = surface.edges()[master];
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


    /// Record which edges penetrate each other, and how deep springs are compressed. Collective.
    void
    note_touching(const ContactSurface &surface,
                  const PointSet       &set,
                  ContactMemory        &memory)
    {
      const MPI_Comm communicator = surface.cover_system().communicator();
      memory.touching.resize(surface.edges().size());
      for (auto &known : memory.touching)
        known.clear();
      std::vector<unsigned int> pairs;
      double                    deep = 0.;
      for (unsigned int q = 0; q < set.points.size(); ++q)
      {
        const ContactPoint &point = set.points[q];
        const unsigned int  edge = point.edge, master = point.master;
        // Springs may be compressed by as much again until the next state is accepted.
        if (point.pressure > 0.)
          deep =
            std::max(deep,
                     set.data[q].law->penetration(point.pressure) - point.gap);
        const unsigned int n = pairs.size();
        if (master != invalid_index && point.gap < 0. &&
            (n == 0 || pairs[n - 2] != edge || pairs[n - 1] != master))
        {
          pairs.push_back(edge);
          pairs.push_back(master);
        }
      }
      memory.touching_reach = Parallel::max(deep, communicator);
      if (Parallel::n_mpi_processes(communicator) > 1)
      {
        const auto all = Parallel::all_gather(communicator, pairs);
        pairs.clear();
        for (const auto &part : all)
          pairs.insert(pairs.end(), part.begin(), part.end());
      }
      for (unsigned int i = 0; i < pairs.size(); i += 2)
        note_touching(surface, pairs[i], pairs[i + 1], memory.touching);
    }
  } // namespace


  double
  Contact::augment()
  {
    Data &d = *data;
    d.enter(Data::Stage::assembled,
            d.stage == Data::Stage::assembled && !d.updater.is_between());
    Assert(d.multipliers.are_used(),
           dealii::ExcMessage("There is no penetration tolerance."));
    const unsigned int              n_rule = d.detection.maker.n_rule();
    std::vector<Multipliers::Point> along;
    // Points of corners follow those along edges.
    for (unsigned int begin = 0; begin < d.set.points.size() &&
                                 d.set.data[begin].corner >= PointKind::along;
         begin += n_rule)
    {
      const unsigned int edge =
        d.detection.search.slaves()[d.set.data[begin].slave];
      const double length =
        (d.set.data[begin + n_rule - 1].s - d.set.data[begin].s) *
        d.surface->edges()[edge].length;
      for (unsigned int q = 0; q < n_rule; ++q)
      {
        const ContactPoint &point = d.set.points[begin + q];
        const PointData    &fixed = d.set.data[begin + q];
        // Beside the master there is no penetration.
        if (point.master != invalid_index && point.weight != 0.)
          along.push_back({edge,
                           fixed.s,
                           d.detection.maker.rule_weight(q) * length,
                           fixed.stiffening * fixed.law->normal_stiffness,
                           point.gap - point.opening,
                           fixed.initial_multiplier});
      }
    }
    const double change =
      d.multipliers.update(along,
                           d.parameters.law->normal_stiffness,
                           d.communicator());
    for (unsigned int q = 0; q < d.set.points.size(); ++q)
    {
      PointData         &fixed = d.set.data[q];
      const unsigned int slave = d.detection.search.slaves()[fixed.slave];
      if (fixed.corner < PointKind::along)
        continue;
      d.set.points[q].multiplier =
        d.multipliers.value(slave, fixed.s) + fixed.initial_multiplier;
      fixed.stiffening = d.multipliers.stiffening(slave, fixed.s);
    }
    return change;
  }


  unsigned int
  Contact::break_bonds(const double share)
  {
    Data        &d        = *data;
    const double rounding = 1e-9 * d.detection.projector.search_reach();
    double       largest  = 0.;
    for (unsigned int q = 0; q < d.set.points.size(); ++q)
      largest =
        std::max(largest, bond_ratio(d.set.points[q], d.set.data[q], rounding));
    largest            = Parallel::max(largest, d.communicator());
    unsigned int count = 0;
    if (largest <= 1.)
      return 0;
    for (unsigned int q = 0; q < d.set.points.size(); ++q)
    {
      ContactPoint    &point = d.set.points[q];
      const PointData &fixed = d.set.data[q];
      const double     ratio = bond_ratio(point, fixed, rounding);
      if (ratio <= 1. || ratio < share * largest)
        continue;
      const ContactLaw &law = *fixed.law;
      if (point.pressure < 0.)
        d.memory.broken_energy += normal_energy(point, fixed, point.pressure);
      const double limit =
        law.strength(std::max(0., point.pressure), fixed.slip).value;
      const double shear =
        std::copysign(std::min(limit, std::abs(point.shear)), point.shear);
      d.memory.broken_energy += shear_energy(point, fixed, point.shear) -
                                shear_energy(point, fixed, shear);
      // The point slides from now on, and its anchor is dragged along.
      const double length =
        d.surface->place(point.stick_edge, point.stick_t).a.norm();
      const double initial = initial_shear(point, fixed);
      point.is_bonded      = false;
      point.stick_t +=
        (point.shear - initial - shear + initial_shear(point, fixed)) /
        (law.shear_spring() * length);
      point.shear = shear;
      if (point.pressure < 0.)
      {
        point.pressure = 0.;
        point.state    = ContactState::open;
      }
      ++count;
      // Store the anchor where PointMaker looks for it.
      const StickPlace place{
        point.s, point.stick_edge, point.stick_t, false, fixed.slip};
      d.memory.stick_places.insert(
        place_key(*d.surface, point.edge, fixed.corner), place);
    }
    return Parallel::sum(count, d.communicator());
  }


  double
  Contact::accept()
  {
    Data &d = *data;
    d.enter(Data::Stage::accepted, d.stage == Data::Stage::assembled);
    d.memory.stick_places.clear();
    d.memory.entrances.clear();
    d.memory.former_bodies.clear();
    for (unsigned int q = 0; q < d.set.points.size(); ++q)
      if (d.set.data[q].corner < PointKind::along &&
          d.set.points[q].state != ContactState::open)
        d.memory.entrances[place_key(
          *d.surface, d.set.points[q].edge, d.set.data[q].corner)] =
          d.set.points[q].master;
    note_touching(*d.surface, d.set, d.memory);
    d.detection.search.begin(ContactSearch::Begin::here);
    d.memory.has_accepted_state = true;
    // The loss at detection is the same on all ranks and is counted once.
    double dissipated       = Parallel::this_mpi_process(d.communicator()) == 0
                                ? d.memory.detection_loss
                                : 0.;
    d.memory.detection_loss = 0.;
    if (d.updater.is_between())
      for (const PointData &fixed : d.set.data)
        dissipated += fixed.normal_loss;
    if (!d.parameters.transmit_shear())
    {
      d.memory.energies_of_pairs = energies_of(d.set, *d.surface);
      return Parallel::sum(dissipated, d.communicator());
    }
    (void)break_bonds();
    dissipated += d.memory.broken_energy;
    d.memory.broken_energy = 0.;
    for (unsigned int q = 0; q < d.set.points.size(); ++q)
      if (d.set.data[q].law != nullptr && d.set.data[q].law->transmits_shear())
        dissipated += accept_shear(*d.surface,
                                   d.updater.is_between(),
                                   d.set.points[q],
                                   d.set.data[q],
                                   d.memory.stick_places);
    d.memory.energies_of_pairs = energies_of(d.set, *d.surface);
    return Parallel::sum(dissipated, d.communicator());
  }


  void
  Contact::set_absent_bodies(const std::vector<bool> &is_absent)
  {
    Data &d = *data;
    if (is_absent == d.surface->absent_bodies())
      return;
    d.stage = Data::Stage::created;
    d.surface->set_absent_bodies(is_absent);
    d.detection.search.forget();
    d.memory.forget_absent_bodies(*d.surface);
  }


  ContactHistory
  Contact::history() const
  {
    ContactHistory result;
    result.is_conserving = data->detection.projector.admits_any_depth();
    result.multipliers   = data->multipliers.all();
    data->memory.save(data->communicator(), result);
    return result;
  }


  void
  Contact::restore_history(const ContactHistory &history)
  {
    Data &d = *data;
    d.stage = Data::Stage::created;
    d.multipliers.restore(history.multipliers);
    if (history.is_conserving)
    {
      d.updater.set_positions(Data::Positions::of_motion);
      d.updater.freeze(false);
      d.detection.projector.admit_any_depth();
    }
    d.memory.restore(history, *d.surface);
    d.detection.search.begin(ContactSearch::Begin::unknown);
    if (history.searched_displacements.empty())
      return;
    d.states.move_to(d.memory.searched_nodal, d.memory.searched_time);
    d.detection.search.search(d.memory.searched_reaches);
  }
} // namespace NMM
