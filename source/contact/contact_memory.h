#ifndef nmm_source_contact_contact_memory_h
#define nmm_source_contact_contact_memory_h

#include <nmm/contact/contact_history.h>
#include <nmm/contact/contact_surface.h>

#include <array>
#include <contact/contact_points.h>
#include <map>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Energies of all springs between pairs of bodies, normal and shear, of all ranks [J/m].
    using PairEnergies =
      std::map<std::pair<unsigned int, unsigned int>, std::array<double, 2>>;


    /**
     * What contact remembers of the last accepted state, on this rank; ContactHistory is the same for
     * all ranks, to be saved.
     */
    struct ContactMemory
    {
      /// Whether a state has been accepted yet: before, faces that touch may be bonded.
      bool has_accepted_state = false;
      /// Multipliers of the augmented Lagrangian [Pa]; empty without.
      std::vector<double> multipliers;
      StickPlaces         stick_places;
      /// The master of each corner that is in contact, by place_key(): the face through which it
      /// came in.
      std::map<unsigned int, unsigned int> entrances;
      /// By edge: edges that it has been behind, or that have been behind it, and those that
      /// they go on to; the same on all ranks.
      std::vector<std::vector<unsigned int>> touching;
      PairEnergies                           energies_of_pairs;
      /// Displacements of all faces, time and distance [m] of the last search for
      /// candidates: a continuation searches there, too, to find the same ones.
      std::vector<double> searched_nodal;
      double              searched_time = 0., searched_reach = 0.;

      /// Forget what concerns bodies that are absent from the surface.
      void
      forget_absent_bodies(const ContactSurface &surface);

      /// Of all ranks. Collective.
      void
      save(MPI_Comm communicator, ContactHistory &history) const;

      /// Take over what this rank needs.
      void
      restore(const ContactHistory &history, const ContactSurface &surface);
    };
  } // namespace internal
} // namespace NMM

#endif
