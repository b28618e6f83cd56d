#ifndef nmm_source_contact_step_clearances_h
#define nmm_source_contact_step_clearances_h

#include <nmm/contact/contact_surface.h>

#include <contact/contact_search.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Conservative bounds on the relative motion of bodies in a time step: contact points that
     * cannot touch anything within the step are skipped. It exists for speed alone; without
     * begin(), or after disable(), no point is clear, and results are the same.
     *
     * At the begin of the step a point has a clearance c from everything that it may touch, see
     * ContactSearch::clearance(). It is clear as long as c is larger than the bound on the
     * motion of any face of its body against any face of the bodies that it faces.
     *
     * The displacements of a straight edge since the begin are c_0 + c_1 tau + c_2 tau^2 with
     * tau = t - 1/2. For -1/2 <= t <= 3/2 they differ from c_0 by r = |c_1| + |c_2| at
     * most, and the normal turns by w = (|c_1| + 2 |c_2|) / L. Hence a point of one edge (s) moves
     * against what lies behind another one (m), or its continuation, by a depth of at most D,
     * by at most
     * @f[ |c_0^s - c_0^m| + r^s + r^m + \tfrac54 D\,w^m, @f]
     * as long as the other edge turns by less than half a radian. Of a body, c_0 is that of
     * its first edge, and r is the largest distance from it plus r of any edge. States in
     * between have moved by less. Arcs, and bodies that turn further, move by any distance.
     */
    class StepClearances
    {
    public:
      /// A step begins where the surface is. @p clearances [m] and @p point_to_body by contact
      /// point; points whose clearance is 0 are never clear. @p depth [m]: how far behind a
      /// face contact is looked for. The surface and the search must outlive the step.
      void
      begin(const ContactSurface     &surface,
            const ContactSearch      &search,
            std::vector<double>       clearances,
            std::vector<unsigned int> point_to_body,
            double                    depth);

      /// No point is clear until the next step begins.
      void
      disable();

      /// The surface has moved on, or back: bounds are those of its present state.
      void
      note_motion();

      /// Whether a point cannot touch anything, nor on the way from the begin of the step to
      /// the present state, even if all had moved @p factor times as far.
      bool
      is_clear(unsigned int point, double factor = 1.);

    private:
      /// Motion of all edges of a body since the begin of the step.
      struct Motion
      {
        dealii::Tensor<1, 2> center;
        /// r [m] and w [rad].
        double radius = 0., turn = 0.;
        bool   is_known = false;
      };

      Motion
      motion_of_edge(unsigned int edge) const;

      const Motion &
      motion_of_body(unsigned int body);

      /// Bound on the motion of a body against all bodies that it faces [m].
      double
      bound(unsigned int body);

      void
      list_edges_of_bodies();

      void
      list_faced_bodies(const ContactSearch &search);

      const ContactSurface     *surface = nullptr;
      double                    depth   = 0.;
      std::vector<double>       clearances;
      std::vector<unsigned int> point_to_body;
      /// By body: its edges, and the bodies whose faces its points may touch.
      std::vector<std::vector<unsigned int>> edges_of_bodies, faced_bodies;
      /// By edge, at the begin of the step.
      std::vector<ContactSurface::EdgeDisplacement> at_begin;
      /// By body, at present; negative bounds are not known.
      std::vector<Motion> motions;
      std::vector<double> bounds;
    };
  } // namespace internal
} // namespace NMM

#endif
