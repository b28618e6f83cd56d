#ifndef nmm_source_contact_detection_crossings_h
#define nmm_source_contact_detection_crossings_h

#include <nmm/base/step_fault.h>
#include <nmm/contact/surface/surface.h>

#include <functional>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Finds points of one body that a step takes through another body. Contact forces depend on
     * positions at the end of a step (and in its middle) only: a point that has passed through a
     * thin body is in front of it again, and a point that is nearer to the far side is pushed out
     * there.
     *
     * Edges are approximated by parabolas through their ends and middle, which is exact for
     * straight edges that deform. They are divided into chords that deviate by less than a fiftieth
     * of the body's mean width 2 A/P. The points that are examined are the ends of all chords of
     * both bodies, because the boundaries of two separate polygons cannot overlap before a vertex
     * of one has crossed an edge of the other. During the step, positions are
     * @f[ x(\lambda) = c(\lambda) + R(\lambda\theta)\,
     *     \left((1-\lambda)\,d_0 + \lambda R(-\theta)\,d_1\right),\quad
     *     d_i = x_i - c_i, @f]
     * with the mean position c of the body, which moves on a straight line, and its mean rotation
     * theta, @f$ |\theta| < \pi @f$. The path is divided into pieces of at most 0.2 rad, on which
     * all points move on straight lines. The chord of such an arc of radius r deviates by at most
     * 0.005 r; its ends are exact, and so are the sides of faces on which they lie. On
     * a piece, the point p and the chord (a, b) meet where
     * @f$ (b - a) \times (p - a) = 0 @f$, a quadratic equation in the time.
     *
     * A point enters a body through the face E: the first one that it crosses or, if it is
     * inside at the beginning of the step, the nearest one. It leaves through X: the last one that
     * it crosses or, if it is inside at the end, the nearest one. It has not passed through the
     * body if E and X are connected along the boundary by faces that look the same way as E (or X)
     * to within 32 degrees and at most a length tau of other faces, because points may pass by a
     * corner when blocks slide. Faces that meet in a point are connected there: the mouth of a crack
     * in a face has no width, and a point that glides over it does not pass through the body. tau
     * is half of the reach of the contact, and at most a fortieth of the body's circumference.
     *
     * Where corners meet, springs may be compressed by more than tau. A point in a corner, on the
     * line of equal distance from both faces, then changes from E to X by the smallest motion, so
     * that no step would succeed. If the point is inside during the whole step, crosses no face and
     * the bodies are in contact there, tau is therefore replaced by
     * @f$ \max(\tau, \min(P / 40, W / 5)) @f$ with the circumference P and the mean width
     * W = 2 A/P: as for a long reach, but less than the thickness of a plate.
     *
     * A point that begins outside or at a face (less than tau/10 deep), ends deeper than tau, and
     * is in contact with none of the body's faces then has been missed by the contact, and is
     * treated as a crossing.
     *
     * A cheap test comes first. To cross a body, a point must move relative to it by the relevant
     * thickness: the smallest chord between places that are further apart than
     * tau along the boundary. In a convex body of the area A, circumference P, inradius
     * r >= A/P and diameter D <= P/2 let c be the length of such a chord. Each part that it cuts
     * off extends at least (tau - c)/2 beyond the chord, and the hull of the furthest place there
     * and the inscribed circle on the other side is 2 r (tau - c)/(2 D) wide at the chord. Hence
     * @f[ c \ge T = \tau\,\frac{r}{D + r}. @f]
     * Two bodies whose relative motion and penetration together are less than T/2 are not examined
     * (1/2, since arcs are longer than their chords by a factor of pi/2 at most). An obstacle that
     * is one straight line has T = tau; other bodies, such as those that are not convex, have
     * T = 0.
     *
     * If a crossing is found, the step is to be repeated so that it ends a quarter of the way from
     * where the point enters to where it leaves (or to the end of the step). For a point that
     * contact has missed, it ends where the point is half of tau deep. The motion inside of the
     * body is then a fraction of its thickness, or of the reach.
     */
    class ContactCrossings
    {
    public:
      /// Pair of edges: points are those of the first one, chords those of the other one.
      using Pair = std::pair<unsigned int, unsigned int>;
      /// Function that tells whether an edge is in contact with a body.
      using IsInContact = std::function<bool(unsigned int, unsigned int)>;

      /// Prepare the search for crossings. @p reach is the reach of the contact [m]. The current
      /// positions of the surface are not used.
      ContactCrossings(const ContactSurface &surface, double reach);

      /// Whether a relative motion, or penetration, of @p motion [m] could cross any body.
      bool
      may_cross(const double motion) const
      {
        return 2. * motion >= least_thickness;
      }

      /// Set the step: positions of the start, middle and end of all edges, one edge after the
      /// other, at the beginning and the end of the step.
      void
      set_step(const std::vector<ContactPosition> &begin,
               const std::vector<ContactPosition> &end);

      /// Whether the bodies of two edges could cross each other by their motion in the step. @p
      /// depth is their penetration [m].
      bool
      may_cross(unsigned int edge, unsigned int other, double depth) const;

      /// Find crossings of pairs of edges. The result asks for the shortest of the steps that they
      /// require. For an edge, the pairs must have all edges of the other body that are near it.
      StepFault
      find(std::vector<Pair> pairs, const IsInContact &is_in_contact) const;

    private:
      struct Body
      {
        double tau = 0., corner_length = 0., thickness = 0., width = 0.,
               circumference = 0.;
        /// Motion in the last step: mean position, translation, largest other motion of a point,
        /// and rotation.
        dealii::Point<2>     center;
        dealii::Tensor<1, 2> motion;
        double               radius = 0., angle = 0.;
        unsigned int         n = 0;
      };

      /// A place on a boundary.
      struct Place
      {
        unsigned int edge = invalid_index;
        double       t    = 0.;
        /// Distance of a point from this place [m], and the same with a sign, negative inside.
        double distance = 0., gap = 0.;
      };

      /// A part of an edge.
      struct Chord
      {
        unsigned int edge  = invalid_index;
        double       first = 0., last = 1.;
      };

      /// Path of a point past the faces of a body.
      struct Path
      {
        Place  first, last;
        double begin = 1., end = 0.;
        bool   crosses = false;
      };

      /// Number of chords of an edge.
      unsigned int
      n_chords(unsigned int edge) const;

      /// The fault of a body whose points move relative to each other by more than its
      /// circumference in the step; rotations move them by less. Its boundary may be so curved
      /// that the search would take minutes, and is no solution of a step anyway.
      StepFault
      find_excessive_deformation() const;

      /// Position of a place on an edge at a time of the step, from 0 to 1.
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

      /// An edge, and whether the boundary is followed along it or against it.
      struct Passage
      {
        unsigned int edge    = invalid_index;
        bool         forward = true;
      };

      /// The passages that continue a passage where its edge ends: to the next edge of the boundary,
      /// and to all edges of the body that meet in the same point.
      std::vector<Passage>
      continuations(const Passage &passage) const;

      /// Set incident_ends and range_of_end.
      void
      find_incident_ends();

      /// Examine the motion of one point past one body.
      void
      examine(unsigned int              edge,
              double                    t,
              const std::vector<Chord> &chords,
              const IsInContact        &is_in_contact,
              StepFault                &fault) const;

      const ContactSurface *surface;
      std::vector<Body>     bodies;
      double                least_thickness;
      /// Positions at both ends of the step, relative to the start of the first edge.
      std::vector<dealii::Point<2>> at_begin, at_end;
      /// Edges with their ends (0, 1), sorted by the points where they end, and the range of those of
      /// the same body and point for each edge and end.
      std::vector<std::pair<unsigned int, unsigned int>> incident_ends;
      std::vector<std::pair<unsigned int, unsigned int>> range_of_end;
    };
  } // namespace internal
} // namespace NMM

#endif
