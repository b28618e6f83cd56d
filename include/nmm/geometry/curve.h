#ifndef nmm_geometry_curve_h
#define nmm_geometry_curve_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * One straight segment, circular arc or full circle of the physical mesh.
   *
   * Coordinates are the exact values of their doubles. An arc is given by three points on it,
   * because three points with double coordinates lie exactly on one circle, while a rounded end
   * point does not lie exactly on a circle given by centre and radius.
   *
   * Pieces are made by segment(), arc() and circle(); Curve::check() examines them.
   */
  struct CurvePiece
  {
    /// Shape of a piece.
    enum class Kind
    {
      /// Straight segment from start to end.
      segment,
      /// Circular arc from start over through to end.
      arc,
      /// Full circle, counter-clockwise.
      circle
    };

    /// A straight segment between two points [m].
    static CurvePiece
    segment(const dealii::Point<2> &start, const dealii::Point<2> &end);

    /**
     * A circular arc over three points [m]. The result is the segment between the ends, with
     * is_straightened set, if the sagitta @f$ s @f$ of the arc is no more than the rounding of its
     * points,
     * @f[ s \le 4\,\varepsilon\,\max(R, |x|, |y|), \qquad
         \varepsilon = 2^{-52}, @f]
     * with the radius R and the coordinates x, y of the ends, because points on an arc are
     * computed from centre and radius in doubles. If R is the largest of these, an arc with the
     * chord c is straightened if its sagitta is at most 1.1e-8 c, or its radius at least 1.2e7 c.
     */
    static CurvePiece
    arc(const dealii::Point<2> &start,
        const dealii::Point<2> &through,
        const dealii::Point<2> &end);

    /// A full circle; @p center and @p radius in [m].
    static CurvePiece
    circle(const dealii::Point<2> &center, double radius);

    /// Shape of the piece.
    Kind kind = Kind::segment;

    /// First point [m]; for a circle center + (radius, 0).
    dealii::Point<2> start;
    /// Last point [m]; for a circle the same as the first one.
    dealii::Point<2> end;

    /// A point of the arc between start and end [m]; arcs only.
    dealii::Point<2> through;

    /// Centre of a circle or arc [m]; for arcs computed exactly and rounded once.
    dealii::Point<2> center;
    /// Radius of a circle or arc [m], positive; 0 for segments.
    double radius = 0.;

    /// Whether the segment was given as an arc with negligible sagitta, see arc().
    bool is_straightened = false;
  };

  /// Whether an arc of at most a half circle, between @p start and @p end, is a segment
  /// up to rounding; see CurvePiece::arc().
  bool
  is_nearly_straight(const dealii::Point<2> &start,
                     const dealii::Point<2> &end,
                     double                  radius);

  /// Meaning of a curve for the solid.
  enum class CurveRole
  {
    /// Part of the outer boundary of a domain.
    boundary,
    /// Part of the boundary of a hole in a domain.
    hole,
    /// A joint or crack: the displacement may jump across it.
    joint,
    /// A material interface across which strain may jump, but not displacement.
    interface
  };

  /// Connection of the two faces of a joint.
  enum class JointState
  {
    /// The faces are separate; they transmit stress only where the analysis has contact.
    open,
    /// The faces are tied to each other.
    closed
  };

  /**
   * A named curve: consecutive pieces, each starting where the last one ended.
   */
  struct Curve
  {
    /// Name, by which loads, laws and messages refer to it; curves of one role may share a name.
    std::string name;
    /// Meaning of the curve for the solid.
    CurveRole role = CurveRole::boundary;
    /// The pieces in order; each starts exactly where the last one ended.
    std::vector<CurvePiece> pieces;

    /// Joints only: connection of both faces.
    JointState state = JointState::open;

    /// Joints only: name of the domain's boundary, or of the region of Geometry::regions(), outside
    /// of which the curve is ignored. Empty if the curve is not confined.
    std::string within;

    /// Joints only: whether parts with the same region on both sides, which bound no block, are
    /// removed.
    bool drops_ends = false;

    /// Joints: whether parts outside the solid are ignored without an error or a notice. Holes:
    /// whether the hole may reach beyond its domain and overlap others, as an excavation does.
    bool is_clipped = false;

    /// Interfaces only: whether the program added the curve for its own purposes, so that pictures
    /// do not show it.
    bool is_auxiliary = false;

    /// For a boundary, the material of its domain; for a closed interface, the material inside it.
    /// Empty if the curve does not determine a material.
    std::string material;

    /// Place where the curve was read, as "file:line"; empty if a function call made it.
    std::string source;

    /// First point of the first piece [m].
    const dealii::Point<2> &
    start() const;
    /// Last point of the last piece [m].
    const dealii::Point<2> &
    end() const;

    /// Whether the last point is exactly the first one.
    bool
    is_closed() const;

    /**
     * Check the pieces. @throws InputError naming the curve unless it has at least one piece,
     * every coordinate is finite, every piece has a length, every radius is positive and finite,
     * the three points of an arc do not lie exactly on a line with the middle one outside of the
     * others, each piece starts exactly where the last one ended, and a full circle is the only
     * piece.
     */
    void
    check() const;
  };

  /// The word of geometry files for a role: "boundary", "hole", "joint" or "interface".
  std::string
  to_string(CurveRole role);
} // namespace NMM

#endif
