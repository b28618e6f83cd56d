// Networks of lines and arcs in a square or a disk: through common points, drawn twice,
// nearly straight, tangent, of any size, far from the origin, with rounded digits.

#include <deal.II/base/numbers.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fuzz/fuzz.h>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      using dealii::Point;
      using dealii::Tensor;

      std::string
      number(const double value)
      {
        char text[40];
        std::snprintf(text, sizeof(text), "%.17g", value);
        return text;
      }


      class GeometryMaker
      {
      public:
        explicit GeometryMaker(const std::uint64_t seed)
          : generator(seed)
        {
        }

        Case
        make();

      private:
        double
        uniform(const double low, const double high)
        {
          // the same on every machine, unlike std::uniform_real_distribution
          return low + (high - low) * std::ldexp(generator() >> 11, -53);
        }

        unsigned int
        integer(const unsigned int low, const unsigned int high)
        {
          return low + generator() % (high - low + 1);
        }

        bool
        chance(const double probability)
        {
          return uniform(0., 1.) < probability;
        }

        Point<2>
        inside()
        {
          return Point<2>(uniform(0.25, 0.75), uniform(0.25, 0.75));
        }

        /// A coordinate of the unit square, with so many digits.
        double
        rounded(const double x) const
        {
          if (digits == 0)
            return x;
          const double factor = std::pow(10., digits);
          return std::round(x * factor) / factor;
        }

        Point<2>
        placed(const Point<2> &x) const
        {
          return Point<2>(origin[0] + scale * rounded(x[0]),
                          origin[1] + scale * rounded(x[1]));
        }

        std::string
        text(const Point<2> &x) const
        {
          const Point<2> y = placed(x);
          return number(y[0]) + " " + number(y[1]);
        }

        /// One line unless rounding makes nothing of it.
        void
        add_line(const Point<2> &a, const Point<2> &b);
        void
        add_arc(const Point<2> &a, const Point<2> &m, const Point<2> &b);
        void
        add_line_through(const Point<2> &x, double angle, double reach);

        void
        add_rosette();
        void
        add_network();
        void
        add_copies();
        void
        add_collinear();
        void
        add_nearly_straight_arcs();
        void
        add_tangents();
        void
        add_slivers();
        void
        add_arcs();

        std::mt19937_64    generator;
        std::ostringstream curves;
        unsigned int       n_lines = 0;
        unsigned int       digits  = 0;
        double             scale   = 1.;
        Point<2>           origin;
        std::string        kinds;
      };


      void
      GeometryMaker::add_line(const Point<2> &a, const Point<2> &b)
      {
        if (placed(a) == placed(b))
          return;
        curves << (chance(0.15) ? "interface" : "joint state=closed")
               << " name=l" << n_lines++ << " LINESTRING (" << text(a) << ", "
               << text(b) << ")\n";
      }


      void
      GeometryMaker::add_arc(const Point<2> &a,
                             const Point<2> &m,
                             const Point<2> &b)
      {
        const Point<2> p = placed(a), q = placed(m), r = placed(b);
        // between the ends, so that what is on a line exactly is a segment
        if (p == q || q == r || p == r || (q - p) * (r - q) <= 0.)
          return;
        curves << "joint state=closed name=l" << n_lines++
               << " CIRCULARSTRING (" << text(a) << ", " << text(m) << ", "
               << text(b) << ")\n";
      }


      void
      GeometryMaker::add_line_through(const Point<2> &x,
                                      const double    angle,
                                      const double    reach)
      {
        const Tensor<1, 2> d({std::cos(angle), std::sin(angle)});
        add_line(x - uniform(0.3, 1.) * reach * d,
                 x + uniform(0.3, 1.) * reach * d);
      }


      void
      GeometryMaker::add_rosette()
      {
        kinds += " rosette";
        const Point<2>     x     = inside();
        const unsigned int n     = integer(3, 12);
        const double       first = uniform(0., dealii::numbers::PI);
        const bool         even  = chance(0.5);
        for (unsigned int i = 0; i < n; ++i)
          add_line_through(x,
                           even ? first + dealii::numbers::PI * i / n
                                : uniform(0., dealii::numbers::PI),
                           1.5);
      }


      void
      GeometryMaker::add_network()
      {
        kinds += " network";
        const unsigned int n = integer(2, 8);
        for (unsigned int i = 0; i < n; ++i)
          add_line_through(inside(), uniform(0., dealii::numbers::PI), 1.5);
      }


      void
      GeometryMaker::add_copies()
      {
        kinds += " copies";
        const Point<2>     x = inside();
        const double       a = uniform(0., dealii::numbers::PI);
        const Tensor<1, 2> d({std::cos(a), std::sin(a)}), n({-d[1], d[0]});
        const Point<2>     p = x - d, q = x + d;
        add_line(p, q);
        const unsigned int n_copies = integer(1, 3);
        for (unsigned int i = 0; i < n_copies; ++i)
        {
          const double shift =
            chance(0.3) ? 0. : std::pow(10., -uniform(3., 18.));
          if (chance(0.5))
            add_line(p + shift * n, q + shift * n);
          else
            add_line(q + shift * n, p - shift * n);
        }
      }


      void
      GeometryMaker::add_collinear()
      {
        kinds += " collinear";
        const Point<2>     x = inside();
        const double       a = uniform(0., dealii::numbers::PI);
        const Tensor<1, 2> d({std::cos(a), std::sin(a)});
        const unsigned int n = integer(2, 4);
        for (unsigned int i = 0; i < n; ++i)
          add_line(x + uniform(-0.9, 0.1) * d, x + uniform(-0.1, 0.9) * d);
      }


      void
      GeometryMaker::add_nearly_straight_arcs()
      {
        kinds += " flat-arcs";
        const unsigned int n = integer(1, 3);
        for (unsigned int i = 0; i < n; ++i)
        {
          const Point<2>     x = inside();
          const double       a = uniform(0., 2. * dealii::numbers::PI);
          const Tensor<1, 2> d({std::cos(a), std::sin(a)}), e({-d[1], d[0]});
          const double       l = uniform(0.1, 1.2);
          const double       sagitta =
            chance(0.3) ? 0. : l * std::pow(10., -uniform(1., 18.));
          add_arc(x - l * d, x + sagitta * e, x + l * d);
          if (chance(0.3))
            add_line(x - l * d, x + l * d);
        }
      }


      void
      GeometryMaker::add_tangents()
      {
        kinds += " tangents";
        const Point<2>     c = inside();
        const double       r = uniform(0.02, 0.2);
        const double       a = uniform(0., 2. * dealii::numbers::PI);
        const Tensor<1, 2> d({std::cos(a), std::sin(a)}), e({-d[1], d[0]});
        if (rounded(r) <= 0.)
          return;
        const Point<2> center = placed(c);
        curves << "joint state=closed name=l" << n_lines++ << " CIRCLE ("
               << number(center[0]) << " " << number(center[1]) << ", "
               << number(scale * rounded(r)) << ")\n";
        const double shift =
          chance(0.5) ? 0. : std::pow(10., -uniform(3., 17.));
        const Point<2> t = c + (r + shift) * d;
        if (chance(0.5))
          add_line(t - 0.6 * e, t + 0.6 * e);
        else
          add_arc(t - 0.1 * e + 0.03 * d, t, t + 0.1 * e + 0.03 * d);
      }


      void
      GeometryMaker::add_slivers()
      {
        kinds += " slivers";
        const Point<2> p(0., uniform(0.2, 0.8)), q(1., uniform(0.2, 0.8));
        const double   width = std::pow(10., -uniform(3., 17.));
        add_line(p, q);
        add_line(p + Point<2>(0., width),
                 chance(0.5) ? q + Point<2>(0., width) : q);
        if (chance(0.5))
          add_line(Point<2>(0., width), Point<2>(1., width));
      }


      void
      GeometryMaker::add_arcs()
      {
        kinds += " arcs";
        const unsigned int n = integer(1, 4);
        for (unsigned int i = 0; i < n; ++i)
          add_arc(inside() + Point<2>(uniform(-0.6, 0.), uniform(-0.6, 0.6)),
                  inside(),
                  inside() + Point<2>(uniform(0., 0.6), uniform(-0.6, 0.6)));
      }


      Case
      GeometryMaker::make()
      {
        if (chance(0.7))
          digits = integer(1, 16);
        if (chance(0.3))
          scale = std::pow(10., uniform(-9., 9.));
        if (chance(0.2))
          origin = scale * std::pow(10., uniform(0., 6.)) *
                   Point<2>(uniform(-1., 1.), uniform(-1., 1.));

        void (GeometryMaker::*const all[])() = {
          &GeometryMaker::add_rosette,
          &GeometryMaker::add_network,
          &GeometryMaker::add_copies,
          &GeometryMaker::add_collinear,
          &GeometryMaker::add_nearly_straight_arcs,
          &GeometryMaker::add_tangents,
          &GeometryMaker::add_slivers,
          &GeometryMaker::add_arcs};
        const unsigned int n = integer(1, 3);
        for (unsigned int i = 0; i < n; ++i)
          (this->*all[chance(0.3) ? 0 : integer(0, 7)])();

        Case               result;
        std::ostringstream boundary;
        double             area;
        const Point<2>     lower = placed({0., 0.}), upper = placed({1., 1.});
        if (chance(0.2))
        {
          const Point<2> center = placed({0.5, 0.5});
          boundary << "boundary name=b material=m CIRCLE (" << number(center[0])
                   << " " << number(center[1]) << ", " << number(0.5 * scale)
                   << ")\n";
          area = 0.25 * dealii::numbers::PI * scale * scale;
        }
        else
        {
          boundary << "boundary name=b material=m POLYGON ((" << text({0., 0.})
                   << ", " << text({1., 0.}) << ", " << text({1., 1.}) << ", "
                   << text({0., 1.}) << "))\n";
          area = (upper[0] - lower[0]) * (upper[1] - lower[1]);
        }

        result.files["case.wkt"] = boundary.str() + curves.str();
        result.numbers           = {{"area", area},
                                    {"size", scale},
                                    {"coordinate",
                                     std::max({std::abs(lower[0]),
                                               std::abs(lower[1]),
                                               std::abs(upper[0]),
                                               std::abs(upper[1])})},
                                    {"cell size",
                                     (chance(0.5) ? 0.3 : uniform(0.15, 0.6)) * scale},
                                    {"rotation", chance(0.5) ? 0. : uniform(0., 60.)},
                                    {"right-angled", chance(0.5) ? 1. : 0.},
                                    {"degree", chance(0.7) ? 2. : 1.}};
        std::ostringstream scene;
        scene << "# All joints closed, a linear field prescribed.\n"
              << "subsection Geometry\n  set File = case.wkt\nend\n"
              << "subsection Mathematical mesh\n  set Cell size = "
              << number(result.numbers["cell size"])
              << "\n  set Rotation = " << number(result.numbers["rotation"])
              << "\n  set Pattern = "
              << (result.numbers["right-angled"] != 0. ? "right-angled"
                                                       : "equilateral")
              << "\n  set Degree = " << result.numbers["degree"] << "\nend\n"
              << "subsection Materials\n  set Names = m\n  subsection m\n"
              << "    set Young's modulus = 1e9\n  end\nend\n"
              << "subsection Boundary conditions\n  set Names = held\n"
              << "  subsection held\n    set Boundary = b\n"
              << "    set Type = displacement\n    set Value = x; y\n"
              << "  end\nend\n";
        result.files["case.prm"] = scene.str();
        result.description =
          kinds.substr(1) + ", digits " + std::to_string(digits) + ", size " +
          number(scale) + ", origin " + number(origin[0] / scale);
        return result;
      }
    } // namespace


    Case
    make_geometry_case(const std::uint64_t seed)
    {
      return GeometryMaker(seed).make();
    }
  } // namespace Fuzz
} // namespace NMM
