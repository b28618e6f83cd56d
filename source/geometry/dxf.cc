#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>
#include <nmm/geometry/dxf.h>

#include "geometry/dxf_file.h"
#include <cmath>
#include <map>
#include <set>

namespace NMM
{
  using dealii::Point;
  using internal::DxfFile;
  using internal::DxfGroup;
  using internal::DxfRecord;

  namespace
  {
    /// Cosine and sine of an angle in degrees, exact at right angles.
    Point<2>
    direction(const double degrees)
    {
      const double quarters = std::remainder(degrees, 360.) / 90.;
      if (quarters == std::round(quarters))
        switch (static_cast<int>(quarters))
        {
          case 0:
            return {1., 0.};
          case 1:
            return {0., 1.};
          case -1:
            return {0., -1.};
          default:
            return {-1., 0.};
        }
      const double angle = degrees * (dealii::numbers::PI / 180.);
      return {std::cos(angle), std::sin(angle)};
    }


    /// The unit that a value of `$INSUNITS` stands for; empty if it stands for none.
    std::string
    unit_name(const int insunits)
    {
      const std::map<int, std::string> names = {{1, "in"},
                                                {2, "ft"},
                                                {3, "mi"},
                                                {4, "mm"},
                                                {5, "cm"},
                                                {6, "m"},
                                                {7, "km"},
                                                {8, "microinches"},
                                                {9, "mil"},
                                                {10, "yd"},
                                                {12, "nm"},
                                                {13, "um"},
                                                {14, "dm"},
                                                {15, "dam"},
                                                {16, "hm"},
                                                {17, "Gm"},
                                                {21, "US survey ft"}};
      const auto                       name  = names.find(insunits);
      return name != names.end() ? name->second
             : insunits == 0     ? ""
                                 : "unit number " + std::to_string(insunits);
    }


    /// Kinds of entities that would be missing from the joints, and what to do about them.
    const std::map<std::string, std::string> refused_kinds = {
      {"SPLINE", "convert it to a polyline"},
      {"ELLIPSE", "convert it to a polyline"},
      {"INSERT", "explode the block"},
      {"XLINE", "draw a line with two ends"},
      {"RAY", "draw a line with two ends"}};


    /// Mirrors a piece at the y-axis.
    CurvePiece
    mirrored(const CurvePiece &piece)
    {
      const auto mirror = [](const Point<2> &p) {
        return Point<2>(-p[0], p[1]);
      };
      switch (piece.kind)
      {
        case CurvePiece::Kind::circle:
          return CurvePiece::circle(mirror(piece.center), piece.radius);
        case CurvePiece::Kind::arc:
          return CurvePiece::arc(mirror(piece.start),
                                 mirror(piece.through),
                                 mirror(piece.end));
        case CurvePiece::Kind::segment:
          break;
      }
      return CurvePiece::segment(mirror(piece.start), mirror(piece.end));
    }


    struct Vertex
    {
      Point<2> point;
      /// The tangent of a quarter of the angle of the arc to the next vertex; 0 for a segment.
      double bulge;
    };


    /// The pieces of a polyline; none if it has no length.
    std::vector<CurvePiece>
    pieces_of(const std::vector<Vertex> &all, const bool is_closed)
    {
      std::vector<Vertex> vertices;
      // Some programs write the same point twice.
      for (const Vertex &vertex : all)
        if (!vertices.empty() && vertices.back().point == vertex.point)
          vertices.back().bulge = vertex.bulge;
        else
          vertices.push_back(vertex);
      const bool returns = vertices.size() > 2 ||
                           (vertices.size() == 2 &&
                            vertices.front().bulge != vertices.back().bulge);
      if (is_closed && returns &&
          vertices.front().point != vertices.back().point)
        vertices.push_back({vertices.front().point, 0.});

      std::vector<CurvePiece> pieces;
      for (std::size_t i = 1; i < vertices.size(); ++i)
      {
        const Point<2> &a     = vertices[i - 1].point;
        const Point<2> &b     = vertices[i].point;
        const double    bulge = vertices[i - 1].bulge;
        if (bulge == 0.)
        {
          pieces.push_back(CurvePiece::segment(a, b));
          continue;
        }
        // If the bulge is positive, the arc runs counter-clockwise and lies to the right of the
        // chord.
        const Point<2> through(0.5 * (a[0] + b[0]) +
                                 0.5 * bulge * (b[1] - a[1]),
                               0.5 * (a[1] + b[1]) -
                                 0.5 * bulge * (b[0] - a[0]));
        pieces.push_back(CurvePiece::arc(a, through, b));
      }
      return pieces;
    }


    /// Collects the curves of a drawing.
    class DrawingReader
    {
    public:
      DrawingReader(const std::string              &file_name,
                    const std::vector<std::string> &layers);

      Drawing
      read();

    private:
      struct Layer
      {
        /// As the drawing spells it first, or as the caller does.
        std::string name;
        bool        is_wanted = false, is_in_drawing = false, is_hidden = false,
             has_curves = false;
      };

      Layer &
      layer(const std::string &text);
      void
      read_header(const DxfRecord &header);
      void
      read_layer(const DxfRecord &record);
      void
      read_entity(const DxfRecord &entity);
      /// Adds the pieces of an entity that is drawn, if they have a length.
      void
      add(const DxfRecord &entity, std::vector<CurvePiece> pieces);
      void
      read_arc(const DxfRecord &arc);
      void
      read_lwpolyline(const DxfRecord &polyline);
      void
      read_polyline_start(const DxfRecord &polyline);
      void
      read_vertex(const DxfRecord &vertex);
      void
      finish_polyline();
      /// Whether the plane of an entity is seen from below. @throws InputError if it is not the
      /// plane x, y.
      static bool
      is_from_below(const DxfRecord &entity);
      void
      check_layers() const;
      std::string
      describe_skipped() const;

      const std::string file_name;
      const bool        reads_all_layers;
      std::string       code_page;
      Drawing           drawing;
      /// By their names in lower case.
      std::map<std::string, Layer> layers;
      /// Numbers of entities that were left out, by their description.
      std::map<std::string, unsigned int> skipped;
      /// The POLYLINE whose vertices are being read; its kind is empty if there is none.
      DxfRecord           polyline;
      std::vector<Vertex> vertices;
    };


    DrawingReader::DrawingReader(const std::string              &file_name,
                                 const std::vector<std::string> &wanted)
      : file_name(file_name)
      , reads_all_layers(wanted.empty())
    {
      for (const std::string &name : wanted)
        layers[internal::lower_case(name)] = {name, true};
    }


    DrawingReader::Layer &
    DrawingReader::layer(const std::string &text)
    {
      const std::string name =
        text.empty() ? "0" : internal::decode_dxf_text(text, code_page);
      Layer &result = layers[internal::lower_case(name)];
      if (!result.is_in_drawing)
        result.name = name;
      result.is_in_drawing = true;
      result.is_wanted     = result.is_wanted || reads_all_layers;
      return result;
    }


    Drawing
    DrawingReader::read()
    {
      const std::string text = read_input_file(file_name, "the drawing");
      DxfFile           file(text, file_name);
      std::string       section;
      for (DxfRecord record; file.next(record);)
        if (record.kind == "SECTION")
        {
          section = record.text(2);
          if (section == "HEADER")
            read_header(record);
        }
        else if (section == "TABLES" && record.kind == "LAYER")
          read_layer(record);
        else if (section == "ENTITIES")
          read_entity(record);
      check_layers();
      drawing.notice = describe_skipped();
      AssertThrow(!drawing.curves.empty() || !skipped.empty(),
                  InputError("the drawing has no lines, polylines, arcs or "
                             "circles",
                             file_name,
                             "give another file"));
      return std::move(drawing);
    }


    void
    DrawingReader::read_header(const DxfRecord &header)
    {
      for (std::size_t i = 1; i < header.groups.size(); ++i)
      {
        const std::string &variable = header.groups[i - 1].value;
        if (header.groups[i - 1].code != 9)
          continue;
        if (variable == "$DWGCODEPAGE")
          code_page = header.groups[i].value;
        if (variable == "$INSUNITS")
        {
          DxfRecord value = header;
          value.groups    = {header.groups[i]};
          drawing.unit    = unit_name(value.integer(70));
        }
      }
    }


    void
    DrawingReader::read_layer(const DxfRecord &record)
    {
      // Bit 1 of the flags: frozen. A negative colour: switched off.
      layer(record.text(2)).is_hidden =
        (record.integer(70) & 1) != 0 || record.integer(62) < 0;
    }


    void
    DrawingReader::read_entity(const DxfRecord &entity)
    {
      if (entity.kind == "VERTEX")
        return read_vertex(entity);
      finish_polyline();
      if (entity.kind == "SEQEND" || entity.kind == "ENDSEC")
        return;
      const std::set<std::string> read_kinds = {
        "LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE"};
      const bool is_read = read_kinds.count(entity.kind) > 0;
      Layer     &own     = layer(entity.text(8));
      own.has_curves     = own.has_curves || is_read;
      if (!own.is_wanted)
        return;

      const std::string kind = excerpt(entity.kind);
      if (entity.integer(67) == 1)
        ++skipped[kind + " in paper space"];
      else if (entity.integer(60) == 1)
        ++skipped[kind + " that is invisible"];
      else if (own.is_hidden)
        ++skipped[kind + " on a layer that is frozen or switched off"];
      else if (!is_read)
      {
        const auto refused = refused_kinds.find(entity.kind);
        AssertThrow(refused == refused_kinds.end(),
                    InputError("the " + entity.kind + " on layer '" + own.name +
                                 "' cannot be read",
                               entity.place(),
                               refused->second + ", or leave its layer out"));
        ++skipped[entity.kind];
      }
      else
      {
        for (const DxfGroup &group : entity.groups)
          if (group.code >= 10 && group.code < 60)
            (void)entity.number(group);
        if (entity.kind == "LINE")
          add(entity,
              {CurvePiece::segment({entity.number(10), entity.number(20)},
                                   {entity.number(11), entity.number(21)})});
        else if (entity.kind == "LWPOLYLINE")
          read_lwpolyline(entity);
        else if (entity.kind == "POLYLINE")
          read_polyline_start(entity);
        else
          read_arc(entity);
      }
    }


    bool
    DrawingReader::is_from_below(const DxfRecord &entity)
    {
      const double x = entity.number(210, 0.), y = entity.number(220, 0.),
                   z = entity.number(230, 1.);
      AssertThrow(z != 0. && std::abs(x) < 1e-9 * std::abs(z) &&
                    std::abs(y) < 1e-9 * std::abs(z),
                  InputError("the " + entity.kind +
                               " is not drawn in the plane x, y",
                             entity.place(),
                             "turn it into that plane, or leave its layer "
                             "out"));
      return z < 0.;
    }


    void
    DrawingReader::add(const DxfRecord &entity, std::vector<CurvePiece> pieces)
    {
      const bool has_no_length =
        pieces.empty() ||
        (pieces.size() == 1 && pieces[0].kind == CurvePiece::Kind::segment &&
         pieces[0].start == pieces[0].end);
      if (has_no_length)
      {
        ++skipped[entity.kind + " without a length"];
        return;
      }
      // Lines and polylines in space have coordinates of the drawing, and others those of their own
      // plane, in which x points to the left if it is seen from below.
      const bool is_in_space =
        entity.kind == "LINE" ||
        (entity.kind == "POLYLINE" && (entity.integer(70) & 8) != 0);
      if (!is_in_space && is_from_below(entity))
        for (CurvePiece &piece : pieces)
          piece = mirrored(piece);
      Curve curve;
      curve.name   = layer(entity.text(8)).name;
      curve.role   = CurveRole::joint;
      curve.pieces = std::move(pieces);
      curve.source = entity.place() + ", " + entity.kind;
      curve.check();
      drawing.curves.push_back(std::move(curve));
    }


    void
    DrawingReader::read_arc(const DxfRecord &arc)
    {
      const Point<2> center(arc.number(10), arc.number(20));
      const double   radius = arc.number(40);
      if (radius == 0.)
        return add(arc, {});
      if (arc.kind == "CIRCLE")
        return add(arc, {CurvePiece::circle(center, radius)});
      // The arc runs counter-clockwise from the first to the second angle. If both are the same
      // direction up to the digits of a file, it is a circle.
      const double first = arc.number(50), second = arc.number(51);
      if (std::abs(std::remainder(second - first, 360.)) < 1e-9)
        return add(arc, {CurvePiece::circle(center, radius)});
      const auto at = [&](const double degrees) {
        return center + radius * direction(degrees);
      };
      double span = std::fmod(second - first, 360.);
      if (span < 0.)
        span += 360.;
      add(arc,
          {CurvePiece::arc(at(first), at(first + 0.5 * span), at(second))});
    }


    void
    DrawingReader::read_lwpolyline(const DxfRecord &entity)
    {
      std::vector<Vertex> points;
      std::vector<bool>   has_y;
      for (const DxfGroup &group : entity.groups)
        if (group.code == 10)
        {
          points.push_back({{entity.number(group), 0.}, 0.});
          has_y.push_back(false);
        }
        else if (group.code == 20 && !points.empty())
        {
          points.back().point[1] = entity.number(group);
          has_y.back()           = true;
        }
        else if (group.code == 42 && !points.empty())
          points.back().bulge = entity.number(group);
      for (const bool has : has_y)
        AssertThrow(has,
                    InputError("a point of the LWPOLYLINE lacks its y (group "
                               "20)",
                               entity.place(),
                               "save the drawing as a DXF text file again"));
      add(entity, pieces_of(points, (entity.integer(70) & 1) != 0));
    }


    void
    DrawingReader::read_polyline_start(const DxfRecord &entity)
    {
      const int flags = entity.integer(70);
      if ((flags & 16) != 0)
        ++skipped["POLYLINE that is a polygon mesh"];
      else if ((flags & 64) != 0)
        ++skipped["POLYLINE that is a polyface mesh"];
      else
        polyline = entity;
      vertices.clear();
    }


    void
    DrawingReader::read_vertex(const DxfRecord &vertex)
    {
      // Control points of the frame of a spline (16) are not drawn.
      if (!polyline.kind.empty() && (vertex.integer(70) & 16) == 0)
        vertices.push_back(
          {{vertex.number(10), vertex.number(20)}, vertex.number(42, 0.)});
    }


    void
    DrawingReader::finish_polyline()
    {
      if (polyline.kind.empty())
        return;
      add(polyline, pieces_of(vertices, (polyline.integer(70) & 1) != 0));
      polyline.kind.clear();
    }


    void
    DrawingReader::check_layers() const
    {
      if (reads_all_layers)
        return;
      constexpr unsigned int n_shown = 20;
      std::string            with_curves;
      unsigned int           n = 0;
      for (const auto &[key, one] : layers)
        if (one.has_curves && !one.is_hidden && n++ < n_shown)
          with_curves += (with_curves.empty() ? "'" : ", '") + one.name + "'";
      for (const auto &[key, one] : layers)
      {
        AssertThrow(!one.is_wanted || !one.is_hidden,
                    InputError("the layer '" + one.name +
                                 "' is frozen or switched off",
                               file_name,
                               "thaw it and switch it on, or leave it out"));
        AssertThrow(!one.is_wanted || one.has_curves,
                    InputError("the drawing has no lines on layer '" +
                                 one.name + "'",
                               file_name,
                               with_curves.empty()
                                 ? "no layer has lines that are visible"
                                 : "layers with lines are " + with_curves));
      }
    }


    std::string
    DrawingReader::describe_skipped() const
    {
      if (skipped.empty())
        return "";
      constexpr unsigned int n_shown = 20;
      std::string            list;
      unsigned int           n = 0;
      for (const auto &[kind, number] : skipped)
        if (n++ < n_shown)
          list += (n == 1 ? "" : ", ") + std::to_string(number) + " " + kind;
      if (n > n_shown)
        list += " and " + std::to_string(n - n_shown) + " other kinds";
      return "left out of the drawing " + file_name + ": " + list +
             "; only lines, polylines, arcs and circles that are visible in "
             "model space are read";
    }
  } // namespace


  Drawing
  read_dxf(const std::string &file_name, const std::vector<std::string> &layers)
  {
    return DrawingReader(file_name, layers).read();
  }
} // namespace NMM
