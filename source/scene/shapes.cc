#include <nmm/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <scene/shapes.h>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    /// Twice the area on the left of a closed chain [m^2], with each arc replaced by two chords,
    /// which suffices for the sign.
    double
    signed_area(const std::vector<CurvePiece> &pieces)
    {
      double     area = 0.;
      const auto add  = [&](const Point<2> &a, const Point<2> &b) {
        area += a[0] * b[1] - a[1] * b[0];
      };
      for (const CurvePiece &piece : pieces)
        if (piece.kind == CurvePiece::Kind::arc)
        {
          add(piece.start, piece.through);
          add(piece.through, piece.end);
        }
        else
          add(piece.start, piece.end);
      return area;
    }


    std::vector<CurvePiece>
    reversed(std::vector<CurvePiece> pieces)
    {
      std::reverse(pieces.begin(), pieces.end());
      for (CurvePiece &piece : pieces)
        std::swap(piece.start, piece.end);
      return pieces;
    }


    /// A full circle as two counter-clockwise arcs.
    std::vector<CurvePiece>
    two_arcs(const CurvePiece &circle)
    {
      const Point<2> &c = circle.center;
      const double    r = circle.radius;
      const Point<2>  right(c[0] + r, c[1]), left(c[0] - r, c[1]);
      return {CurvePiece::arc(right, Point<2>(c[0], c[1] + r), left),
              CurvePiece::arc(left, Point<2>(c[0], c[1] - r), right)};
    }


    /// The role of a shape that is given without a record: polygons and circles are bodies, and
    /// all other shapes are lines with a body on their left.
    std::string
    role_of_shape(const std::string &shape)
    {
      std::string word;
      for (const char c : shape)
      {
        if (std::isalpha(static_cast<unsigned char>(c)) == 0)
          break;
        word += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      }
      return word == "POLYGON" || word == "CURVEPOLYGON" || word == "CIRCLE"
               ? "boundary"
               : "interface";
    }
  } // namespace


  namespace internal
  {
    std::vector<CurvePiece>
    oriented_pieces(const Curve &curve)
    {
      std::vector<CurvePiece> pieces =
        curve.pieces.front().kind == CurvePiece::Kind::circle
          ? two_arcs(curve.pieces.front())
          : curve.pieces;
      const bool is_boundary = curve.role == CurveRole::boundary;
      if (!curve.is_closed() || (!is_boundary && curve.role != CurveRole::hole))
        return pieces;
      return (signed_area(pieces) > 0.) == is_boundary ? pieces
                                                       : reversed(pieces);
    }


    Curve
    read_shape(const std::string &shape,
               const std::string &file,
               const std::string &section,
               const std::string &scene_file)
    {
      const std::string where =
        "parameter '" + section + (file.empty() ? "/Shape'" : "/File'");
      const Geometry geometry =
        file.empty()
          ? parse_geometry(role_of_shape(shape) + " name=shape " + shape,
                           scene_file + ", " + where)
          : read_geometry(file);
      AssertThrow(geometry.curves().size() == 1,
                  InputError("the shape consists of " +
                               std::to_string(geometry.curves().size()) +
                               " curves",
                             where,
                             "give one curve"));
      return geometry.curves().front();
    }
  } // namespace internal
} // namespace NMM
