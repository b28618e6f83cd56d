#ifndef nmm_contact_state_history_h
#define nmm_contact_state_history_h

#include <nmm/base/types.h>

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <vector>

namespace NMM
{
  /**
   * The history of contact at the last accepted state, of all ranks. A computation that continues
   * from it gives the same results to the last bit, on any number of ranks. Contact::history()
   * makes it, Contact::restore_history() takes it over, and boost serializes it for checkpoints.
   * carry_history() carries it to the surface of the solid after another cut.
   *
   * Edges are numbers of ContactSurface::edges(). A *place* is an edge along which contact points
   * lie, or a corner: edge + (kind + 1) * n_edges, see internal::place_key().
   */
  struct ContactHistory
  {
    /// Anchor, bond and slip of one contact point.
    struct Stick
    {
      /// Place of the contact point.
      unsigned int place = 0;
      /// Parameter of the contact point on its edge, from 0 to 1 [-].
      double s = 0.;
      /// Edge of the anchor.
      unsigned int edge = 0;
      /// Parameter of the anchor on its edge [-].
      double t = 0.;
      /// Whether the bond of the point holds.
      bool is_bonded = false;
      /// Length of the path that the point has slid [m]; 0 unless strength or dilation depend on
      /// it.
      double slip = 0.;

      /// Read or write all members.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &place &s &edge &t &is_bonded &slip;
      }
    };

    /// Energy that the springs between two bodies store.
    struct PairEnergy
    {
      /// Number of the body with the lower number.
      unsigned int first = 0;
      /// Number of the other body; equal to the first one for contact within a body.
      unsigned int second = 0;
      /// Energies of the normal springs and of the shear springs [J/m].
      std::array<double, 2> energies = {{0., 0.}};

      /// Read or write all members.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &first &second &energies;
      }
    };

    /// Read or write all members.
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &has_accepted_state &is_conserving &multipliers
        &searched_displacements &searched_time &searched_reaches &touching_reach
          &sticks &entrances &touching &pair_energies &former_bodies;
    }

    /// Whether a state has been accepted yet. Faces that touch can become bonded only before that.
    bool has_accepted_state = false;
    /// Whether a step that conserves energy has been tried.
    bool is_conserving = false;
    /// Multipliers of the augmented Lagrangian [Pa]; empty for the penalty method.
    std::vector<double> multipliers;
    /// Displacements of covers at the last search for candidates [m]; empty before the first one.
    std::vector<double> searched_displacements;
    /// Time of the last search for candidates [s].
    double searched_time = 0.;
    /// Reaches of all bodies in the last search for candidates [m].
    std::vector<double> searched_reaches;
    /// Distance within which the next search must look so that it finds all faces that touch [m].
    double touching_reach = 0.;
    /// Anchors of all contact points that have a master and a law that transmits shear.
    std::vector<Stick> sticks;
    /// Corners (places) that are in contact, and the edge through which they came in.
    std::vector<std::pair<unsigned int, unsigned int>> entrances;
    /// Pairs of edges that penetrate each other, and their neighbours, in both orders.
    std::vector<std::pair<unsigned int, unsigned int>> touching;
    /// Energies of all pairs of bodies in contact.
    std::vector<PairEnergy> pair_energies;
    /// For each body, the number of the body that it was a part of at the last accepted state;
    /// invalid_index if that is not known. Of pairs whose bodies were the same, only the sum of
    /// energies is known, see carry_history(). Empty if no body has been divided.
    std::vector<unsigned int> former_bodies;
  };
} // namespace NMM

#endif
