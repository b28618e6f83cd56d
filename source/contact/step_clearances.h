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
     * cannot touch anything within the step are skipped. This class only saves time; without
     * begin(), or after disable(), no point is clear, and results are the same.
     *
     * At the beginning of the step a point has a clearance c from all places where it would touch,
     * see ContactSearch::clearance(). It is clear as long as c is larger than the bound on the
     * motion of any face of its body relative to any face of the bodies that it faces.
     *
     * The displacements of a straight edge since the beginning are c_0 + c_1 tau + c_2 tau^2 with
     * tau = t - 1/2. For -1/2 <= t <= 3/2 they differ from c_0 by r = |c_1| + |c_2| at
     * most, and the normal turns by w = (|c_1| + 2 |c_2|) / L. Hence the motion of a point of one
     * edge (s), relative to a place at most D behind another edge (m) or its continuation, is at
     * most
     * @f[ |c_0^s - c_0^m| + r^s + r^m + \tfrac54 D\,w^m, @f]
     * as long as the other edge turns by less than half a radian. For a body, c_0 is that of
     * its first edge, and r is the largest distance from it plus r of any edge. The bound holds for
     * states in between, too. For arcs, and for bodies that turn further, there is no bound.
     */
    class StepClearances
    {
    public:
      /// Begin a step at the current positions of the surface. @p clearances [m] and @p
      /// point_to_body are by contact point; points with the clearance 0 are never clear. @p depth
      /// is the depth behind a face to which contact is searched for [m]. The surface and the
      /// search must outlive the step.
      void
      begin(const ContactSurface     &surface,
            const ContactSearch      &search,
            std::vector<double>       clearances,
            std::vector<unsigned int> point_to_body,
            double                    depth);

      /// Let no point be clear until the next step begins.
      void
      disable();

      /// Update the bounds after the surface has moved.
      void
      note_motion();

      /// Whether a point cannot touch anything between the beginning of the step and the present
      /// state, even if everything had moved @p factor times as far.
      bool
      is_clear(unsigned int point, double factor = 1.);

    private:
      /// Motion of all edges of a body since the beginning of the step.
      struct Motion
      {
        dealii::Tensor<1, 2> center;
        /// Bounds r [m] and w [rad] of the class comment.
        double radius = 0., turn = 0.;
        bool   is_known = false;
      };

      Motion
      motion_of_edge(unsigned int edge) const;

      const Motion &
      motion_of_body(unsigned int body);

      /// Bound on the motion of a body relative to all bodies that it faces [m].
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
      /// For each body, its edges, and the bodies whose faces its points may touch.
      std::vector<std::vector<unsigned int>> edges_of_bodies, faced_bodies;
      /// Displacement of each edge at the beginning of the step.
      std::vector<ContactSurface::EdgeDisplacement> at_begin;
      /// Present motion and bound of each body; negative bounds have not been computed.
      std::vector<Motion> motions;
      std::vector<double> bounds;
    };
  } // namespace internal
} // namespace NMM

#endif
