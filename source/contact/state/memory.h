#ifndef nmm_source_contact_state_memory_h
#define nmm_source_contact_state_memory_h

#include <nmm/contact/state/history.h>
#include <nmm/contact/surface/surface.h>

#include <contact/state/point_data.h>
#include <contact/state/spring_energies.h>
#include <map>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Energies of the springs of all closed points of all ranks, by pair of bodies.
    PairEnergies
    energies_of(const PointSet &set, const ContactSurface &surface);


    /**
     * What contact remembers of the last accepted state, on this rank; ContactHistory is the same
     * for all ranks, to be saved.
     */
    struct ContactMemory
    {
      /// Whether a state has been accepted yet. Faces that touch can become bonded only before
      /// that.
      bool        has_accepted_state = false;
      StickPlaces stick_places;
      /// Master of each corner that is in contact, by place_key(): the face through which the
      /// corner came in.
      std::map<unsigned int, unsigned int> entrances;
      /// For each edge, the edges that it penetrates or that penetrate it, and those next to them;
      /// the same on all ranks.
      std::vector<std::vector<unsigned int>> touching;
      PairEnergies                           energies_of_pairs;
      /// See ContactHistory::former_bodies.
      std::vector<unsigned int> former_bodies;
      /// Displacements [m], time [s] and reach [m] of the last search for candidate pairs. A
      /// computation that continues from a checkpoint repeats this search to find the same pairs.
      std::vector<dealii::Tensor<1, 2>> searched_nodal;
      double                            searched_time = 0.;
      std::vector<double>               searched_reaches;
      /// See ContactHistory::touching_reach [m].
      double touching_reach = 0.;
      /// Energy lost since the last accepted state [J/m]: of bonds of this rank that broke, and when
      /// faces were searched for, which is the same on all ranks.
      double broken_energy = 0., detection_loss = 0.;

      /// Remove the history of bodies that are absent from the surface.
      void
      forget_absent_bodies(const ContactSurface &surface);

      /// Let each pair of bodies store no more than at the last accepted state, see
      /// ContactTimeStep::begin(). Sets detection_loss. Collective.
      void
      keep_energies(const ContactSurface &surface, PointSet &set);

      /// Collect the history of all ranks. Collective.
      void
      save(MPI_Comm communicator, ContactHistory &history) const;

      /// Take over the part of the history that this rank needs. @throws InputError for a history
      /// that does not fit the surface, as that of a damaged file.
      void
      restore(const ContactHistory &history, const ContactSurface &surface);
    };
  } // namespace internal
} // namespace NMM

#endif
