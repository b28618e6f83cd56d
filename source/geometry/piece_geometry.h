#ifndef nmm_source_geometry_piece_geometry_h
#define nmm_source_geometry_piece_geometry_h

#include <nmm/geometry/curve.h>

#include <array>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    // Curve pieces in floating-point arithmetic, for the cleaning step, which
    // may round; only lies_exactly_on() is exact.

    /// Lower and upper corner of a box around the piece.
    std::array<dealii::Point<2>, 2>
    corners_around(const CurvePiece &piece);

    /// Length of a piece [m].
    double
    length(const CurvePiece &piece);

    /// The point of the piece that is nearest to @p point.
    dealii::Point<2>
    nearest_point(const CurvePiece &piece, const dealii::Point<2> &point);

    /// Points that two pieces have in common, unless they overlap.
    std::vector<dealii::Point<2>>
    crossings(const CurvePiece &a, const CurvePiece &b);

    /**
     * The first point in which @p piece, continued in its direction beyond its end (or, for @p
     * at_start, its start), meets @p other within @p reach; the piece's own end if there is none.
     * An arc is continued along its tangent.
     */
    dealii::Point<2>
    continuation(const CurvePiece &piece,
                 bool              at_start,
                 const CurvePiece &other,
                 double            reach);

    bool
    lies_exactly_on(const CurvePiece &piece, const dealii::Point<2> &point);

    /// Divide a piece at @p point, which should lie on it. A circle becomes two half circles from
    /// the point and back to it.
    std::pair<CurvePiece, CurvePiece>
    split(const CurvePiece &piece, const dealii::Point<2> &point);

    /// The piece with another end point (start for @p at_start).
    CurvePiece
    with_moved_end(const CurvePiece       &piece,
                   bool                    at_start,
                   const dealii::Point<2> &point);

    /// Whether the piece has a length and, if it is an arc, a circle.
    bool
    is_valid(const CurvePiece &piece);
  } // namespace internal
} // namespace NMM

#endif
