#ifndef nmm_source_contact_state_common_pieces_h
#define nmm_source_contact_state_common_pieces_h

#include <nmm/contact/surface/surface.h>

#include <array>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// A piece of the boundary that an edge before and an edge after a cut have in common.
    struct CommonPiece
    {
      /// The edge before the cut, and the one after it.
      unsigned int before = invalid_index, after = invalid_index;
      /// Parameters of both ends of the piece on the edge before and on the edge after the cut [-].
      std::array<double, 2> of_before = {{0., 1.}}, of_after = {{0., 1.}};

      /// Parameter on the edge after the cut; also for places beyond the ends of the piece.
      double
      to_after(const double t) const
      {
        if (t == of_before[1])
          return of_after[1];
        return of_after[0] + (t - of_before[0]) /
                               (of_before[1] - of_before[0]) *
                               (of_after[1] - of_after[0]);
      }
    };


    /// The common pieces of two surfaces, see carry_history().
    class CommonPieces
    {
    public:
      CommonPieces(const ContactSurface &from, const ContactSurface &to);

      /// The pieces of an edge before the cut, ascending along the edge.
      const std::vector<CommonPiece> &
      of_before(const unsigned int edge) const
      {
        return pieces_of_before[edge];
      }

      /// The pieces of an edge after the cut, ascending along the edge.
      const std::vector<CommonPiece> &
      of_after(const unsigned int edge) const
      {
        return pieces_of_after[edge];
      }

      /// The edge after the cut that is the same as an edge before it to the last bit, or
      /// invalid_index.
      unsigned int
      same_edge(const unsigned int before) const
      {
        return same_edges[before];
      }

      /// The edge after the cut that ends where an edge before it ends, or invalid_index.
      unsigned int
      edge_at_end(unsigned int before, unsigned int end) const;

      /// The piece that contains the parameter @p t of an edge before the cut, or the nearest one;
      /// null if the edge has no piece.
      const CommonPiece *
      piece_at(unsigned int before, double t) const;

    private:
      void
      match_blocks(const ContactSurface &from, const ContactSurface &to);

      void
      match_obstacles(const ContactSurface &from, const ContactSurface &to);

      std::vector<std::vector<CommonPiece>> pieces_of_before, pieces_of_after;
      std::vector<unsigned int>             same_edges;
    };
  } // namespace internal
} // namespace NMM

#endif
