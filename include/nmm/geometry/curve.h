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
   * Coordinates are taken as the exact numbers their doubles are. An arc is
   * given by three points it passes through, because three doubles always lie
   * exactly on one circle, while a rounded end point does not lie exactly on a
   * circle given by centre and radius.
   */
  struct CurvePiece
  {
    enum class Kind
    {
      segment,
      arc,
      circle
    };

    static CurvePiece
    segment(const dealii::Point<2> &start, const dealii::Point<2> &end);

    /**
     * An arc is the segment between its ends, with is_straightened set, if its
     * sagitta @f$ s @f$ is below what rounding moves its points by anyway,
     * @f[ s \le 4\,\varepsilon\,\max(R, |x|, |y|), \qquad
         \varepsilon = 2^{-52}, @f]
     * R being its radius and x, y the coordinates of its ends: points on an arc are
     * computed from centre and radius in doubles. Measured by its chord c that is a
     * sagitta of at most 1.1e-8 c, and a radius of at least 1.2e7 c.
     */
    static CurvePiece
    arc(const dealii::Point<2> &start,
        const dealii::Point<2> &through,
        const dealii::Point<2> &end);

    static CurvePiece
    circle(const dealii::Point<2> &center, double radius);

    Kind kind = Kind::segment;

    /// First and last point [m]; for a circle both are center + (radius, 0).
    dealii::Point<2> start, end;

    /// A point of the arc between start and end [m]; arcs only.
    dealii::Point<2> through;

    /// Centre [m] and radius [m]: given for circles; for arcs derived exactly
    /// and rounded once.
    dealii::Point<2> center;
    double           radius = 0.;

    /// A segment that was given as an arc of hardly any sagitta, see arc().
    bool is_straightened = false;
  };

  /// Whether an arc of at most a half circle, between @p start and @p end, is a segment
  /// up to rounding; see CurvePiece::arc().
  bool
  is_nearly_straight(const dealii::Point<2> &start,
                     const dealii::Point<2> &end,
                     double                  radius);

  /// What a curve means to the solid.
  enum class CurveRole
  {
    /// Part of the outer boundary of a domain.
    boundary,
    /// Part of the boundary of a hole in a domain.
    hole,
    /// A joint or crack: the displacement may jump across it.
    joint,
    /// A material interface: bonded, strain may jump, displacement does not.
    interface
  };

  /// A joint whose faces do not touch (open: stress free) or are held together
  /// (closed: tied until a strength is exceeded).
  enum class JointState
  {
    open,
    closed
  };

  /**
   * A named curve: consecutive pieces, each starting where the last one ended.
   */
  struct Curve
  {
    std::string             name;
    CurveRole               role = CurveRole::boundary;
    std::vector<CurvePiece> pieces;

    /// Joints only.
    JointState state = JointState::open;

    /// Joints only: the domain (name of its boundary) or the region of
    /// Geometry::regions() outside of which the curve does not count. Empty: the
    /// solid.
    std::string within;

    /// Joints only: parts with the same region on both sides, which bound no
    /// block, do not count.
    bool drops_ends = false;

    /// Joints: what lies outside the solid, or all of it, is nothing to tell. Holes:
    /// one may reach beyond its domain, and overlap others, as an excavation does.
    bool is_clipped = false;

    /// For a boundary, the material of its domain; for a closed interface, the material inside it.
    /// Empty: this curve does not give one.
    std::string material;

    /// Where it was read, as "file:line"; empty if made by a call.
    std::string source;

    /// First point of the first piece and last point of the last piece [m].
    const dealii::Point<2> &
    start() const;
    const dealii::Point<2> &
    end() const;

    /// Whether the last point is exactly the first one.
    bool
    is_closed() const;

    /**
     * Throw an InputError that names the curve, unless every coordinate is
     * finite, every piece has a length, every radius is positive and finite, no
     * arc runs through infinity (points exactly on a line, the middle one not
     * between the others), each piece starts exactly where the last one ended, a full circle is the only piece, and there is a piece.
     */
    void
    check() const;
  };

  /// "boundary", "hole", "joint" or "interface": the word of geometry files.
  std::string
  to_string(CurveRole role);
} // namespace NMM

#endif
