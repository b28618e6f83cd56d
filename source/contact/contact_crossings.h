#ifndef nmm_source_contact_contact_crossings_h
#define nmm_source_contact_contact_crossings_h

#include <nmm/base/step_fault.h>
#include <nmm/contact/contact_surface.h>

#include <functional>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Does a step take a point of one body through another body? The contact forces look at
     * the end of a step (and at its middle), and do not see what lies between: a point that
     * has passed through a thin body is in front of it again, and one that is nearer to the far
     * side is pushed out there.
     *
     * Edges are parabolas through their ends and middle, which straight ones that deform are, and
     * are divided into so many chords that these are within a fiftieth of the body's mean width 2 A/P
     * of them. Points are the ends of all chords, of both bodies: boundaries of two polygons that are apart cannot
     * overlap before a vertex of one has crossed an edge of the other, so nothing
     * else needs to be looked at. Between begin and end of the step, positions are
     * @f[ x(\lambda) = c(\lambda) + R(\lambda\theta)\,
     *     \left((1-\lambda)\,d_0 + \lambda R(-\theta)\,d_1\right),\quad
     *     d_i = x_i - c_i, @f]
     * with the mean position c of the body, which moves straight on, and its mean rotation theta,
     * @f$ |\theta| < \pi @f$. The path is divided into pieces of at most
     * 0.2 rad, on which all points move straight: a chord of such an arc of radius r is within
     * 0.005 r of it, but its ends are exact, and so is on which side of a face they are. On
     * a piece, point p and chord (a, b) meet where
     * @f$ (b - a) \times (p - a) = 0 @f$, a quadratic equation in the time.
     *
     * A point has come into a body by the face E: the first one that it crosses or, if it is
     * inside when the step begins, the nearest one there. It leaves by X: the last one that it
     * crosses or, if it is inside at the end, the nearest one. It has not passed through if
     * one comes from E to X along the boundary, by faces that look the same way as E (or as X) to within
     * 32 degrees and at most a length tau of others: a point may pass by a corner, as those of
     * blocks that slide do. tau is half of the reach of the contact,
     * and at most a fortieth of the body's circumference. A point that comes in, ends deeper inside
     * than tau, and is in contact by none of its faces has not been noticed, which is no better.
     *
     * What costs little: for that to happen, a point must move against the
     * body by the thickness at stake, the smallest chord between places that are further apart than
     * tau along the boundary. In a convex body of the area A, circumference P, inradius
     * r >= A/P and diameter D <= P/2 let c be the length of such a chord. Each part that it cuts off
     * reaches (tau - c)/2 beyond it at least, and the hull of the furthest place there and the
     * inscribed circle on the other side is 2 r (tau - c)/(2 D) wide at the chord. Hence
     * @f[ c \ge T = \tau\,\frac{r}{D + r}. @f]
     * Two bodies whose relative motion and penetration together are less than T/2 are not looked at
     * (1/2, since arcs are longer than their chords by a factor of pi/2 at most). Other bodies have
     * T = 0.
     *
     * Where a crossing is found, the step to be tried ends a quarter of the way from where the
     * point comes in to where it leaves (or to the end of the step), and for what has not been noticed
     * where it is half of tau deep: what the
     * point moves inside of the body is then a part of its thickness, or of the reach.
     */
    class ContactCrossings
    {
    public:
      /// Of two edges: points of the first one, chords of the other one.
      using Pair = std::pair<unsigned int, unsigned int>;
      /// Is an edge in contact with a body?
      using IsInContact = std::function<bool(unsigned int, unsigned int)>;

      /// @p reach: within which contact looks for faces [m]. Where the surface is does not matter.
      ContactCrossings(const ContactSurface &surface, double reach);

      /// Could a relative motion (or penetration) of so much [m] cross anything?
      bool
      may_cross(const double motion) const
      {
        return 2. * motion >= least_thickness;
      }

      /// Start, middle and end of all edges, one edge after the other, at both ends of a step.
      void
      set_step(std::vector<dealii::Point<2>> begin,
               std::vector<dealii::Point<2>> end);

      /// The same, for the bodies of two edges, from how they move; @p depth: what they penetrate.
      bool
      may_cross(unsigned int edge, unsigned int other, double depth) const;

      /// The shortest of the steps that the crossings of these pairs ask for. All edges of a body
      /// that are near an edge must be there.
      StepFault
      find(std::vector<Pair> pairs, const IsInContact &is_in_contact) const;

    private:
      struct Body
      {
        double tau = 0., thickness = 0., width = 0.;
        /// Of the last step: mean position, motion, what its points move otherwise at most, rotation.
        dealii::Point<2>     center;
        dealii::Tensor<1, 2> motion;
        double               radius = 0., angle = 0.;
        unsigned int         n = 0;
      };

      /// On a boundary.
      struct Place
      {
        unsigned int edge = invalid_index;
        double       t    = 0.;
        /// Of the nearest place: from the point [m], and with a sign, negative inside.
        double distance = 0., gap = 0.;
      };

      /// Part of an edge.
      struct Chord
      {
        unsigned int edge  = invalid_index;
        double       first = 0., last = 1.;
      };

      /// Of a point that moves past the faces of a body.
      struct Path
      {
        Place  first, last;
        double begin = 1., end = 0.;
        bool   crosses = false;
      };

      /// Of an edge.
      unsigned int
      n_chords(unsigned int edge) const;

      /// Of a place on an edge at a time of the step, 0 to 1.
      dealii::Point<2>
      position(unsigned int edge, double t, double time) const;

      Place
      nearest(const dealii::Point<2>   &x,
              const std::vector<Chord> &chords,
              double                    time,
              double                    bound,
              std::vector<Chord>       *near) const;

      void
      follow(unsigned int              edge,
             double                    t,
             const std::vector<Chord> &chords,
             Path                     &path) const;

      dealii::Tensor<1, 2>
      normal(const Place &place) const;

      bool
      is_same_side(const Place &a, const Place &b, double tau) const;

      bool
      reaches(const Place &from, const Place &to, double tau) const;

      /// Of one point past one body.
      void
      examine(unsigned int              edge,
              double                    t,
              const std::vector<Chord> &chords,
              const IsInContact        &is_in_contact,
              StepFault                &fault) const;

      const ContactSurface         *surface;
      std::vector<Body>             bodies;
      double                        least_thickness;
      std::vector<dealii::Point<2>> at_begin, at_end;
    };
  } // namespace internal
} // namespace NMM

#endif
