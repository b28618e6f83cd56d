#include <nmm/base/input_file.h>
#include <nmm/geometry/geometry.h>

#include "geometry/curve.h"
#include "geometry/geometry_scanner.h"
#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace NMM
{
  namespace
  {
    /**
     * Parser of geometry files by recursive descent.
     *
     * CGAL's reader (CGAL/IO/WKT.h 5.5) is not used: it does not support arcs, and it turns
     * mistakes into points. "LINESTRING (0 0, 1)" is read as (0,0), (1,0), "LINESTRING (0 0 1, 2
     * 3)" as (0,0), (1,0), (2,3), without an error. Mistakes that it rejects are reported as
     * "error." on the standard error stream, without a position.
     */
    class GeometryParser
    {
    public:
      GeometryParser(const std::string &text, const std::string &source_name);

      Geometry
      parse();

    private:
      using Kind   = internal::GeometryScanner::Kind;
      using Point  = dealii::Point<2>;
      using Pieces = std::vector<CurvePiece>;

      struct Attributes
      {
        std::string name, material;
        JointState  state = JointState::open;
      };

      void
      parse_record();
      Attributes
      parse_attributes(const std::string &role);
      void
      parse_material_point(const Attributes &attributes);
      void
      parse_curve(CurveRole role, const Attributes &attributes);
      /// Parse a geometry: the pieces of each of its chains.
      std::vector<Pieces>
                          parse_chains(const std::string &shape);
      std::vector<Pieces> parse_list(Pieces (GeometryParser::*parse_one)());

      Pieces
      parse_line();
      Pieces
      parse_line_ring();
      Pieces
      parse_circular_string();
      Pieces
      parse_circle();
      Pieces
      parse_compound();
      Pieces
      parse_curve_ring();
      std::vector<Point>
      parse_points(unsigned int n_min);
      Point
      parse_point();
      /// Parse an upper-case keyword; "" if a parenthesis comes next.
      std::string
      parse_shape();

      void
      open();
      void
      close();
      bool
      skip_comma();
      [[noreturn]] void
      fail(const std::string &what,
           const std::string &where,
           const std::string &remedy) const;

      internal::GeometryScanner scanner;
      Geometry                  geometry;
      /// Place where the current record starts.
      std::string record;
    };


    const char *const curve_shapes =
      "LINESTRING, MULTILINESTRING, POLYGON, CIRCULARSTRING, COMPOUNDCURVE, "
      "CURVEPOLYGON or CIRCLE";


    GeometryParser::GeometryParser(const std::string &text,
                                   const std::string &source_name)
      : scanner(text, source_name)
    {
    }


    void
    GeometryParser::fail(const std::string &what,
                         const std::string &where,
                         const std::string &remedy) const
    {
      AssertThrow(false, InputError(what, where, remedy));
      throw InputError(what, where, remedy); // tells the compiler of noreturn
    }


    Geometry
    GeometryParser::parse()
    {
      while (scanner.peek().kind != Kind::end_of_text)
        if (scanner.peek().kind == Kind::end_of_line)
          scanner.next();
        else
          parse_record();
      return std::move(geometry);
    }


    void
    GeometryParser::parse_record()
    {
      record                                       = scanner.place();
      const std::string                      role  = scanner.peek().text;
      const std::map<std::string, CurveRole> roles = {
        {"boundary", CurveRole::boundary},
        {"hole", CurveRole::hole},
        {"joint", CurveRole::joint},
        {"interface", CurveRole::interface}};
      if (scanner.peek().kind != Kind::word ||
          (role != "material" && roles.count(role) == 0))
        fail("a record starts with '" + excerpt(role) + "'",
             record,
             "start it with boundary, hole, joint, interface or material");
      scanner.next();

      const Attributes attributes = parse_attributes(role);
      if (role == "material")
        parse_material_point(attributes);
      else
        parse_curve(roles.at(role), attributes);

      if (scanner.peek().kind != Kind::end_of_text)
        scanner.expect(Kind::end_of_line,
                       "the end of the record",
                       "start each record on a new line");
    }


    GeometryParser::Attributes
    GeometryParser::parse_attributes(const std::string &role)
    {
      const std::map<std::string, std::vector<std::string>> role_to_keys = {
        {"boundary", {"name", "material"}},
        {"hole", {"name"}},
        {"joint", {"name", "state"}},
        {"interface", {"name", "material"}},
        {"material", {"name"}}};
      const std::vector<std::string> &keys = role_to_keys.at(role);

      std::map<std::string, std::string> values;
      // A word followed by "=" is a key. The first other word is the shape, which only the parser
      // of shapes reads.
      while (scanner.next_is_key())
      {
        const std::string where = scanner.place();
        const std::string key   = scanner.next().text;
        scanner.next();
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
        {
          std::string known;
          for (const std::string &k : keys)
            known += (known.empty() ? "" : " and ") + k;
          fail("a " + role + " has no key '" + excerpt(key) + "'",
               where,
               "its keys are " + known);
        }
        const auto value = scanner.peek();
        if ((value.kind != Kind::word && value.kind != Kind::quoted) ||
            value.text.empty())
          fail("the key '" + key + "' has no value",
               where,
               "write " + key +
                 "=value, with quotation marks around a "
                 "value that contains blanks");
        if (!values.insert({key, value.text}).second)
          fail("the key '" + key + "' is given twice", where, "remove one");
        scanner.next();
      }

      Attributes attributes;
      attributes.name     = values["name"];
      attributes.material = values["material"];
      if (values.count("state") > 0)
      {
        const std::string &state = values.at("state");
        if (state != "open" && state != "closed")
          fail("the state of a joint is '" + excerpt(state) + "'",
               record,
               "write state=open or state=closed");
        attributes.state =
          state == "open" ? JointState::open : JointState::closed;
      }
      return attributes;
    }


    void
    GeometryParser::parse_material_point(const Attributes &attributes)
    {
      if (attributes.name.empty())
        fail("a material point has no material",
             record,
             "write material name=... POINT (x y)");
      const std::string where = scanner.place();
      const std::string shape = parse_shape();
      if (shape != "POINT")
        fail("the place of a material is given as '" + excerpt(shape) + "'",
             where,
             "write POINT (x y)");
      open();
      const Point point = parse_point();
      close();
      geometry.add_material_point(point, attributes.name);
    }


    void
    GeometryParser::parse_curve(const CurveRole   role,
                                const Attributes &attributes)
    {
      const std::string where = scanner.place();
      const std::string shape = parse_shape();
      const bool is_polygon   = shape == "POLYGON" || shape == "CURVEPOLYGON";

      const std::vector<Pieces> chains = parse_chains(shape);
      if (is_polygon && chains.size() > 1 &&
          (role == CurveRole::hole || role == CurveRole::interface))
        fail("a " + to_string(role) + " is a polygon with inner rings",
             where,
             role == CurveRole::hole
               ? "write islands in a hole as boundaries"
               : "write each inner ring as an interface with its own material");

      std::string name = attributes.name;
      for (unsigned int i = 0; i < chains.size(); ++i)
      {
        Curve curve;
        curve.name     = name;
        curve.role     = role;
        curve.state    = attributes.state;
        curve.material = attributes.material;
        curve.pieces   = chains[i];
        curve.source   = record;
        if (role == CurveRole::boundary && is_polygon && i > 0)
        {
          curve.name += ".hole" + std::to_string(i);
          curve.role = CurveRole::hole;
          curve.material.clear();
        }
        geometry.add(std::move(curve));
        // All curves of an unnamed record have the name that the first one gets.
        if (i == 0)
          name = geometry.curves().back().name;
      }
    }


    std::vector<GeometryParser::Pieces>
    GeometryParser::parse_chains(const std::string &shape)
    {
      const std::string where = scanner.place();
      if (shape == "LINESTRING")
        return {parse_line()};
      if (shape == "CIRCULARSTRING")
        return {parse_circular_string()};
      if (shape == "COMPOUNDCURVE")
        return {parse_compound()};
      if (shape == "CIRCLE")
        return {parse_circle()};
      if (shape == "MULTILINESTRING")
        return parse_list(&GeometryParser::parse_line);
      if (shape == "POLYGON")
        return parse_list(&GeometryParser::parse_line_ring);
      if (shape == "CURVEPOLYGON")
        return parse_list(&GeometryParser::parse_curve_ring);
      fail(shape.empty() ? "a curve has no shape"
                         : "'" + excerpt(shape) + "' is no shape of a curve",
           where,
           std::string("write ") + curve_shapes);
    }


    std::vector<GeometryParser::Pieces>
    GeometryParser::parse_list(Pieces (GeometryParser::*parse_one)())
    {
      std::vector<Pieces> list;
      open();
      do
        list.push_back((this->*parse_one)());
      while (skip_comma());
      close();
      return list;
    }


    GeometryParser::Pieces
    GeometryParser::parse_line()
    {
      const std::vector<Point> points = parse_points(2);
      Pieces                   pieces;
      for (unsigned int i = 1; i < points.size(); ++i)
        pieces.push_back(CurvePiece::segment(points[i - 1], points[i]));
      return pieces;
    }


    GeometryParser::Pieces
    GeometryParser::parse_line_ring()
    {
      const std::string where  = scanner.place();
      Pieces            pieces = parse_line();
      if (pieces.back().end != pieces.front().start)
        pieces.push_back(
          CurvePiece::segment(pieces.back().end, pieces.front().start));
      if (pieces.size() < 3)
        fail("a ring of a polygon has fewer than three different points",
             where,
             "give at least three");
      return pieces;
    }


    GeometryParser::Pieces
    GeometryParser::parse_circular_string()
    {
      const std::string        where  = scanner.place();
      const std::vector<Point> points = parse_points(3);
      if (points.size() % 2 == 0)
        fail("a CIRCULARSTRING has " + std::to_string(points.size()) +
               " points",
             where,
             "give an odd number: start, a point between, end, a point "
             "between, end, ...");
      Pieces pieces;
      for (unsigned int i = 2; i < points.size(); i += 2)
        pieces.push_back(
          CurvePiece::arc(points[i - 2], points[i - 1], points[i]));
      return pieces;
    }


    GeometryParser::Pieces
    GeometryParser::parse_circle()
    {
      open();
      const Point center = parse_point();
      scanner.expect(Kind::comma,
                     "','",
                     "write CIRCLE (x y, radius), centre first");
      const double radius = scanner.number();
      close();
      return {CurvePiece::circle(center, radius)};
    }


    GeometryParser::Pieces
    GeometryParser::parse_compound()
    {
      Pieces pieces;
      open();
      do
      {
        const std::string where = scanner.place();
        const std::string shape = parse_shape();
        if (!shape.empty() && shape != "LINESTRING" &&
            shape != "CIRCULARSTRING")
          fail("'" + excerpt(shape) + "' is no part of a COMPOUNDCURVE",
               where,
               "write (x y, ...) or LINESTRING (...) for straight and "
               "CIRCULARSTRING (...) for curved parts");
        const Pieces part =
          shape == "CIRCULARSTRING" ? parse_circular_string() : parse_line();
        pieces.insert(pieces.end(), part.begin(), part.end());
      } while (skip_comma());
      close();
      return pieces;
    }


    GeometryParser::Pieces
    GeometryParser::parse_curve_ring()
    {
      const std::string where = scanner.place();
      const std::string shape = parse_shape();
      if (shape.empty() || shape == "LINESTRING")
        return parse_line_ring();
      if (shape == "CIRCLE")
        return parse_circle();
      if (shape != "CIRCULARSTRING" && shape != "COMPOUNDCURVE")
        fail("'" + excerpt(shape) + "' is no ring of a CURVEPOLYGON",
             where,
             "write (x y, ...), LINESTRING, CIRCULARSTRING, COMPOUNDCURVE or "
             "CIRCLE");
      const Pieces pieces =
        shape == "COMPOUNDCURVE" ? parse_compound() : parse_circular_string();
      const Point &start = pieces.front().start;
      const Point &end   = pieces.back().end;
      if (start != end)
        fail("a ring of a CURVEPOLYGON starts at " + to_string(start) +
               " but ends " + internal::describe_length(start.distance(end)) +
               " away at " + to_string(end),
             where,
             "let it end exactly where it starts");
      return pieces;
    }


    std::vector<GeometryParser::Point>
    GeometryParser::parse_points(const unsigned int n_min)
    {
      const std::string  where = scanner.place();
      std::vector<Point> points;
      open();
      do
        points.push_back(parse_point());
      while (skip_comma());
      close();
      if (points.size() < n_min)
        fail("a curve has too few points (" + std::to_string(points.size()) +
               ")",
             where,
             "give at least " + std::to_string(n_min));
      return points;
    }


    GeometryParser::Point
    GeometryParser::parse_point()
    {
      const double x = scanner.number();
      if (scanner.peek().kind != Kind::word)
        fail("a point has only one coordinate",
             scanner.place(),
             "write two numbers, x y, for each point");
      const double y = scanner.number();
      if (scanner.peek().kind == Kind::word &&
          std::isalpha(static_cast<unsigned char>(scanner.peek().text[0])))
        fail("the parentheses of a record are not closed before '" +
               excerpt(scanner.peek().text) + "'",
             record,
             "add the missing ')'");
      if (scanner.peek().kind == Kind::word)
        fail("'" + excerpt(scanner.peek().text) +
               "' follows the two coordinates of a "
               "point",
             scanner.place(),
             "write two numbers, x y, for each point and a comma between "
             "points");
      return {x, y};
    }


    std::string
    GeometryParser::parse_shape()
    {
      if (scanner.peek().kind != Kind::word)
        return "";
      std::string shape = scanner.next().text;
      std::transform(shape.begin(),
                     shape.end(),
                     shape.begin(),
                     [](const unsigned char c) { return std::toupper(c); });
      return shape;
    }


    void
    GeometryParser::open()
    {
      scanner.expect(Kind::open_parenthesis,
                     "'('",
                     "write the points in parentheses");
    }


    void
    GeometryParser::close()
    {
      scanner.expect(Kind::close_parenthesis,
                     "',' or ')'",
                     "separate by commas and close each parenthesis");
    }


    bool
    GeometryParser::skip_comma()
    {
      if (scanner.peek().kind != Kind::comma)
        return false;
      scanner.next();
      return true;
    }
  } // namespace


  Geometry
  parse_geometry(const std::string &text, const std::string &source_name)
  {
    return GeometryParser(text, source_name).parse();
  }


  Geometry
  read_geometry(const std::string &file_name)
  {
    return parse_geometry(read_input_file(file_name, "the geometry file"),
                          file_name);
  }
} // namespace NMM
