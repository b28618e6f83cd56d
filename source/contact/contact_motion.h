#ifndef nmm_source_contact_contact_motion_h
#define nmm_source_contact_contact_motion_h

#include <nmm/contact/contact_surface.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * How far faces move against each other in a step, at most: what is clear of each
     * other by more than that needs no search.
     *
     * Displacements of a straight edge are c_0 + c_1 tau + c_2 tau^2 with
     * tau = t - 1/2. For -1/2 <= t <= 3/2 they differ from c_0 by r = |c_1| + |c_2|
     * at most, and the normal turns by
     * (|c_1| + 2 |c_2|) / L. Hence a point of one edge, against what lies behind another
     * one, or its continuation, by a depth of D at most, moves by
     * @f[ |c_0^s - c_0^m| + r^s + r^m + \tfrac54 D\,(|c_1^m| + 2 |c_2^m|) / L^m, @f]
     * as long as the other edge turns by less than half a radian; for coefficients
     * that are differences between now and the begin. Everything in between has
     * moved by less. Arcs move by any distance.
     */
    class ContactMotion
    {
    public:
      /// Where the surface is now.
      void
      begin(const ContactSurface &surface);

      /// An edge of a block has moved to where the surface has it.
      void
      move(const ContactSurface &surface, unsigned int edge);

      /// Edges of obstacles are where the surface has them at its time.
      void
      move_obstacles(const ContactSurface &surface);

      /// Of a place of @p edge against what is behind @p master by at most @p depth,
      /// since the begin [m].
      double
      bound(unsigned int edge, unsigned int master, double depth) const;

      /// Of any edge of one body against any one of the other, at least the largest bound()
      /// [m]: edges of a body differ in c_0 from the first one's, and that adds to r.
      double
      bound_of_bodies(unsigned int body, unsigned int other, double depth);

    private:
      struct Motion
      {
        dealii::Tensor<1, 2> center;
        double               radius = 0., turn = 0.;
      };

      Motion
      find_motion(const ContactSurface &surface, unsigned int edge) const;

      /// Of all its edges.
      const Motion &
      of_body(unsigned int body);

      std::vector<ContactSurface::EdgeDisplacement> at_begin;
      std::vector<Motion>                           motions;
      std::vector<unsigned int>                     rigid_edges;
      /// Edges of bodies, one body after the other; what is known of these.
      std::vector<unsigned int> body_begins, edges_of_bodies, edge_to_body;
      std::vector<Motion>       body_motions;
      std::vector<bool>         is_body_known;
    };
  } // namespace internal
} // namespace NMM

#endif
