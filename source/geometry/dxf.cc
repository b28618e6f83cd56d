#include <nmm/base/exceptions.h>
#include <nmm/geometry/dxf.h>

#include <algorithm>

#ifdef NMM_HAVE_DXFLIB
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <dl_creationadapter.h>
#include <dl_dxf.h>
#include <filesystem>
#include <fstream>
#include <set>
#endif

namespace NMM
{
#ifdef NMM_HAVE_DXFLIB
  namespace
  {
    using dealii::Point;

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


    /// Collects the curves of a drawing. dxflib calls its functions for each entity after it has
    /// read the first line of the next one.
    class Drawing : public DL_CreationAdapter
    {
    public:
      Drawing(const std::string              &file_name,
              const std::vector<std::string> &layers)
        : file_name(file_name)
        , layers(layers.begin(), layers.end())
      {
      }

      void
      processCodeValuePair(unsigned int       code,
                           const std::string &value) override;

      void
      addBlock(const DL_BlockData &) override
      {
        is_in_block = true;
      }

      void
      endBlock() override
      {
        is_in_block = false;
      }

      void
      addLine(const DL_LineData &line) override
      {
        if (is_wanted())
          add("LINE",
              {CurvePiece::segment({line.x1, line.y1}, {line.x2, line.y2})});
      }

      void
      addArc(const DL_ArcData &arc) override;
      void
      addCircle(const DL_CircleData &circle) override;
      void
      addPolyline(const DL_PolylineData &polyline) override;
      void
      addVertex(const DL_VertexData &vertex) override;

      void
      addSpline(const DL_SplineData &) override
      {
        reject("SPLINE", "convert it to a polyline");
      }

      void
      addEllipse(const DL_EllipseData &) override
      {
        reject("ELLIPSE", "convert it to a polyline");
      }

      void
      addInsert(const DL_InsertData &) override
      {
        reject("INSERT", "explode the block");
      }

      void
      addXLine(const DL_XLineData &) override
      {
        reject("XLINE", "draw a line with two ends");
      }

      void
      addRay(const DL_RayData &) override
      {
        reject("RAY", "draw a line with two ends");
      }

      /// The curves, after the end of the file has been read.
      std::vector<Curve>
      finish();

    private:
      struct Vertex
      {
        Point<2> point;
        double   bulge;
      };

      std::string
      layer() const
      {
        return attributes.getLayer();
      }

      bool
      is_wanted() const
      {
        return !is_in_block && (layers.empty() || layers.count(layer()) > 0);
      }

      std::string
      describe(const std::string &entity) const
      {
        return entity + " on layer '" + layer() + "'";
      }

      /// Place in the file where the current entity starts.
      std::string
      place() const
      {
        return file_name + ":" + std::to_string(entity_line);
      }

      void
      reject(const std::string &entity, const std::string &remedy) const
      {
        AssertThrow(!is_wanted(),
                    InputError("the " + describe(entity) + " cannot be read",
                               place(),
                               remedy + ", or leave its layer out"));
      }

      void
      check_plane(const std::string &entity);

      void
      add(const std::string &entity, std::vector<CurvePiece> pieces);

      void
      finish_polyline();

      std::string           file_name;
      std::set<std::string> layers, layers_seen;
      std::vector<Curve>    curves;
      unsigned int          n_pairs = 0;
      /// Line of the entity that dxflib hands over, and of the one that it is reading.
      unsigned int entity_line = 0, next_entity_line = 0;
      bool         is_in_block = false, has_section = false, has_end = false;
      /// Whether the vertices of a polyline are being read, and whether that polyline is closed.
      bool                is_open = false, is_closed = false;
      Curve               polyline_curve;
      std::vector<Vertex> vertices;
    };


    void
    Drawing::processCodeValuePair(const unsigned int code,
                                  const std::string &value)
    {
      ++n_pairs;
      if (code == 0)
      {
        entity_line      = next_entity_line;
        next_entity_line = 2 * n_pairs;
        has_section      = has_section || value == "SECTION";
        has_end          = has_end || value == "EOF";
        if (value != "VERTEX" && value != "SEQEND")
          finish_polyline();
      }
      else if (code >= 10 && code < 60)
      {
        // dxflib would read text that is not a number as 0.
        char *end = nullptr;
        errno     = 0;
        (void)std::strtod(value.c_str(), &end);
        AssertThrow(end != value.c_str() && *end == '\0',
                    InputError("'" + value + "' is no number",
                               file_name + ":" + std::to_string(2 * n_pairs),
                               "save the drawing as a DXF text file again"));
      }
    }


    void
    Drawing::check_plane(const std::string &entity)
    {
      double normal[3] = {0., 0., 1.};
      if (extrusion != nullptr)
        extrusion->getDirection(normal);
      AssertThrow(
        std::abs(normal[0]) < 1e-9 && std::abs(normal[1]) < 1e-9 &&
          normal[2] > 0.,
        InputError("the " + describe(entity) +
                     " is not drawn in the plane x, y",
                   place(),
                   "turn it into that plane, or leave its layer out"));
    }


    void
    Drawing::add(const std::string &entity, std::vector<CurvePiece> pieces)
    {
      Curve curve;
      curve.name   = layer();
      curve.role   = CurveRole::joint;
      curve.pieces = std::move(pieces);
      curve.source = place() + ", " + entity;
      curve.check();
      layers_seen.insert(layer());
      curves.push_back(std::move(curve));
    }


    void
    Drawing::addArc(const DL_ArcData &arc)
    {
      if (!is_wanted())
        return;
      check_plane("ARC");
      const Point<2> center(arc.cx, arc.cy);
      const auto     at = [&](const double degrees) {
        return center + arc.radius * direction(degrees);
      };
      // The arc runs counter-clockwise from the first to the second angle.
      double span = std::fmod(arc.angle2 - arc.angle1, 360.);
      if (span <= 0.)
        span += 360.;
      add("ARC",
          {CurvePiece::arc(at(arc.angle1),
                           at(arc.angle1 + 0.5 * span),
                           at(arc.angle2))});
    }


    void
    Drawing::addCircle(const DL_CircleData &circle)
    {
      if (!is_wanted())
        return;
      check_plane("CIRCLE");
      add("CIRCLE",
          {CurvePiece::circle({circle.cx, circle.cy}, circle.radius)});
    }


    void
    Drawing::addPolyline(const DL_PolylineData &polyline)
    {
      finish_polyline();
      if (!is_wanted())
        return;
      check_plane("POLYLINE");
      is_open   = true;
      is_closed = (polyline.flags & 1) != 0;
      vertices.clear();
      polyline_curve        = Curve();
      polyline_curve.name   = layer();
      polyline_curve.role   = CurveRole::joint;
      polyline_curve.source = place() + ", POLYLINE";
    }


    void
    Drawing::addVertex(const DL_VertexData &vertex)
    {
      if (!is_open)
        return;
      const Point<2> point(vertex.x, vertex.y);
      // Some programs write the same point twice.
      if (!vertices.empty() && vertices.back().point == point)
        vertices.back().bulge = vertex.bulge;
      else
        vertices.push_back({point, vertex.bulge});
    }


    void
    Drawing::finish_polyline()
    {
      if (!is_open)
        return;
      is_open = false;
      if (is_closed && vertices.size() > 1 &&
          vertices.front().point != vertices.back().point)
        vertices.push_back({vertices.front().point, 0.});
      AssertThrow(vertices.size() > 1,
                  InputError("a POLYLINE on layer '" + polyline_curve.name +
                               "' has " + std::to_string(vertices.size()) +
                               " different point(s)",
                             polyline_curve.source,
                             "give it two at least, or remove it"));
      for (unsigned int i = 1; i < vertices.size(); ++i)
      {
        const Point<2> &a     = vertices[i - 1].point;
        const Point<2> &b     = vertices[i].point;
        const double    bulge = vertices[i - 1].bulge;
        if (bulge == 0.)
        {
          polyline_curve.pieces.push_back(CurvePiece::segment(a, b));
          continue;
        }
        // The bulge is the tangent of a quarter of the angle. If it is positive, the arc runs
        // counter-clockwise and lies to the right of the chord.
        const Point<2> through(0.5 * (a[0] + b[0]) +
                                 0.5 * bulge * (b[1] - a[1]),
                               0.5 * (a[1] + b[1]) -
                                 0.5 * bulge * (b[0] - a[0]));
        polyline_curve.pieces.push_back(CurvePiece::arc(a, through, b));
      }
      polyline_curve.check();
      layers_seen.insert(polyline_curve.name);
      curves.push_back(std::move(polyline_curve));
    }


    std::vector<Curve>
    Drawing::finish()
    {
      finish_polyline();
      AssertThrow(has_section,
                  InputError("this is no DXF drawing",
                             file_name,
                             "save the drawing as a DXF text file, not a "
                             "binary one"));
      AssertThrow(has_end,
                  InputError("the drawing ends early, after " +
                               std::to_string(2 * n_pairs) + " lines",
                             file_name,
                             "save it again"));
      for (const std::string &name : layers)
        AssertThrow(layers_seen.count(name) > 0,
                    InputError("the drawing has no lines on layer '" + name +
                                 "'",
                               file_name,
                               "name a layer with lines, polylines, arcs or "
                               "circles"));
      AssertThrow(!curves.empty(),
                  InputError("the drawing has no lines, polylines, arcs or "
                             "circles",
                             file_name,
                             "give another file"));
      return std::move(curves);
    }
  } // namespace


  bool
  can_read_dxf()
  {
    return true;
  }


  std::vector<Curve>
  read_dxf(const std::string &file_name, const std::vector<std::string> &layers)
  {
    AssertThrow(std::filesystem::is_regular_file(file_name) &&
                  std::ifstream(file_name).good(),
                InputError("the file cannot be read: " +
                             std::string(std::filesystem::exists(file_name)
                                           ? "it is no file, or not yours"
                                           : "it does not exist"),
                           file_name,
                           "correct its name"));
    Drawing drawing(file_name, layers);
    DL_Dxf  reader;
    AssertThrow(reader.in(file_name, &drawing),
                InputError("the file cannot be read",
                           file_name,
                           "correct its name or its rights"));
    return drawing.finish();
  }

#else

  bool
  can_read_dxf()
  {
    return false;
  }


  std::vector<Curve>
  read_dxf(const std::string &file_name, const std::vector<std::string> &)
  {
    AssertThrow(false,
                InputError("DXF drawings cannot be read, because this program "
                           "was built without dxflib",
                           file_name,
                           "install libdxflib-dev and build again, or convert "
                           "the drawing to WKT"));
    return {};
  }
#endif
} // namespace NMM
