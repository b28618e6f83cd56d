#ifndef nmm_contact_contact_history_h
#define nmm_contact_contact_history_h

#include <nmm/base/types.h>

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <vector>

namespace NMM
{
  /**
   * What contact remembers of the last accepted state, of all ranks: all that a continuation on any
   * number of ranks needs to go on with the same bits. Made by Contact::history(), taken over
   * by Contact::restore_history(), and serialized by boost for checkpoints.
   *
   * Edges are numbers of ContactSurface::edges(). A *place* is an edge along which contact points
   * lie, or a corner: edge + (kind + 1) * n_edges, see Contact::Data::place_key().
   */
  struct ContactHistory
  {
    /// Where a point at the parameter s of a place sticks.
    struct Stick
    {
      unsigned int place     = 0;
      double       s         = 0.;
      unsigned int edge      = 0;
      double       t         = 0.;
      bool         is_bonded = false;
      /// Length of the way that has been slid, where the law depends on it [m].
      double slip = 0.;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &place &s &edge &t &is_bonded &slip;
      }
    };

    /// Energies of the normal and the shear springs between two bodies [J/m].
    struct PairEnergy
    {
      unsigned int          first = 0, second = 0;
      std::array<double, 2> energies = {{0., 0.}};

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &first &second &energies;
      }
    };

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &has_accepted_state &is_conserving &multipliers
        &searched_displacements &searched_time &searched_reach &sticks
          &entrances &touching &pair_energies;
    }

    /// Whether a state has been accepted yet: before, faces that touch may be bonded.
    bool has_accepted_state = false;
    /// Whether a step that conserves energy has been tried.
    bool is_conserving = false;
    /// Multipliers of the augmented Lagrangian [Pa]; empty without.
    std::vector<double> multipliers;
    /// Displacements of covers [m], time and distance [m] of the last search for candidates.
    std::vector<double> searched_displacements;
    double              searched_time = 0., searched_reach = 0.;
    std::vector<Stick>  sticks;
    /// Corners (places) that are in contact, and the edge through which they came in.
    std::vector<std::pair<unsigned int, unsigned int>> entrances;
    /// Edges that have been behind each other.
    std::vector<std::pair<unsigned int, unsigned int>> touching;
    std::vector<PairEnergy>                            pair_energies;
  };
} // namespace NMM

#endif
