#include <array>
#include <cmath>
#include <cstdio>
#include <fuzz/fuzz.h>
#include <random>
#include <sstream>
#include <vector>

// Blocks that move on a floor, far from the origin of the coordinates: stacks, networks of joints,
// interfaces on which joints end, laws that depend on slip, and supports that move.
namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      class BlockMaker
      {
      public:
        explicit BlockMaker(const std::uint64_t seed)
          : generator(seed)
        {
          const double angle = chance(0.5) ? 0. : 0.6 * number() - 0.3;
          direction          = {{std::cos(angle), std::sin(angle)}};
          has_support        = chance(0.3);
        }


        /// The scene with its shapes moved by @p offset.
        std::string
        scene(const std::array<double, 2> &offset)
        {
          this->offset = offset;
          std::ostringstream text;
          text << "subsection Geometry\n  set Text = " << solid()
               << "\nend\nsubsection Mathematical mesh\n  set Cell size = 0.6\n"
                  "end\nsubsection Materials\n  set Names = rock, soil\n"
               << material("rock", 1e8) << material("soil", 3e7)
               << "end\nsubsection Model\n  set Analysis = dynamic\n  set "
                  "Kinematics = finite\n  set Gravity = 0, -9.81\nend\n"
                  "subsection Contact\n  set Enforcement = penalty\n"
               << law
               << "end\nsubsection Obstacles\n  set Names = floor\n"
                  "  subsection floor\n    set Shape = LINESTRING ("
               << place(20., 0.) << ", " << place(-20., 0.)
               << ")\n  end\nend\n";
          if (has_support)
            text << "subsection Boundary conditions\n  set Names = drag\n"
                    "  subsection drag\n    set Boundary = top\n    set Type = "
                    "displacement\n    set Value = 0.02; -1e-4\n    set "
                    "Amplitude = t\n  end\nend\n";
          text << "subsection Time\n  set End time = 0.1\n  set Initial step = "
                  "5e-3\nend\nsubsection Output\n  set Picture = false\n  set "
                  "Fields = false\nend\n";
          return text.str();
        }


        void
        choose()
        {
          n_blocks               = 1 + integer(2);
          is_network             = chance(0.5);
          has_layer              = !is_network && chance(0.5);
          const double       phi = 40. * number();
          std::ostringstream text;
          text << "  set Friction angle = " << phi << '\n';
          switch (integer(2))
          {
            case 0:
              text << "  set Cohesion = " << (chance(0.5) ? 0. : 2e4) << '\n';
              break;
            case 1:
              text << "  set Law = slip weakening\n  set Residual friction "
                      "angle = "
                   << 0.5 * phi << "\n  set Weakening length = "
                   << std::pow(10., -4. + 2. * number()) << '\n';
              break;
            default:
              text.str("");
              text << "  set Law = Barton-Bandis\n  set JRC = "
                   << 20. * number()
                   << "\n  set JCS = 1e8\n  set Residual angle = "
                   << 10. + 20. * number() << '\n';
          }
          law = text.str();
          for (double &x : lines)
            x = number();
        }


        std::string
        description() const
        {
          return (is_network ? "a network"
                             : std::to_string(n_blocks) + " blocks") +
                 std::string(has_layer ? ", joints that end on a layer" : "") +
                 (has_support ? ", dragged" : "");
        }


        double
        number()
        {
          return std::uniform_real_distribution<double>(0., 1.)(generator);
        }


        bool
        chance(const double probability)
        {
          return number() < probability;
        }


      private:
        std::mt19937_64       generator;
        std::array<double, 2> direction, offset = {};
        std::array<double, 8> lines = {};
        bool         has_support, is_network = false, has_layer = false;
        unsigned int n_blocks = 1;
        std::string  law;


        unsigned int
        integer(const unsigned int largest)
        {
          return std::uniform_int_distribution<unsigned int>(0, largest)(
            generator);
        }


        /// The place x along the floor and y above it.
        std::string
        place(const double x, const double y) const
        {
          char text[80];
          std::snprintf(text,
                        sizeof(text),
                        "%.17g %.17g",
                        offset[0] + direction[0] * x - direction[1] * y,
                        offset[1] + direction[1] * x + direction[0] * y);
          return text;
        }


        /// A rectangle whose upper side is called @p top.
        std::string
        rectangle(const std::string &name,
                  const std::string &top,
                  const double       x,
                  const double       y,
                  const double       width,
                  const double       height) const
        {
          return "boundary name=" + name + " material=rock LINESTRING (" +
                 place(x, y + height) + ", " + place(x, y) + ", " +
                 place(x + width, y) + ", " + place(x + width, y + height) +
                 "); boundary name=" + top + " LINESTRING (" +
                 place(x + width, y + height) + ", " + place(x, y + height) +
                 ")";
        }


        std::string
        line(const std::string &name,
             const double       x0,
             const double       y0,
             const double       x1,
             const double       y1) const
        {
          return "; " + name + " LINESTRING (" + place(x0, y0) + ", " +
                 place(x1, y1) + ")";
        }


        std::string
        solid() const
        {
          std::string text;
          if (is_network)
          {
            text = rectangle("sides", "top", 0., 0., 3., 2.);
            for (unsigned int i = 0; i < 4; ++i)
              text += line("joint name=a" + std::to_string(i),
                           -1.,
                           2. * lines[2 * i],
                           4.,
                           2. * lines[2 * i] + 0.5) +
                      line("joint name=b" + std::to_string(i),
                           3. * lines[2 * i + 1],
                           -0.5,
                           3. * lines[2 * i + 1] + 0.4,
                           // some end in the solid
                           lines[2 * i] < 0.3 ? 1. : 2.5);
            return text;
          }
          for (unsigned int i = 0; i < n_blocks; ++i)
            text += (i > 0 ? "; " : "") +
                    rectangle("block" + std::to_string(i),
                              i + 1 == n_blocks ? "top" : "upper",
                              0.3 * lines[i] * i,
                              i,
                              2. - 0.4 * i,
                              1.);
          if (has_layer)
          {
            text += line("interface name=layer", -0.1, 0.5, 2.1, 0.5);
            for (unsigned int i = 0; i < 2; ++i)
              text += line("joint name=crack" + std::to_string(i),
                           0.2 + 0.7 * i + 0.6 * lines[4 + i],
                           i == 0 ? -0.1 : 0.7,
                           0.2 + 0.7 * i + 0.6 * lines[4 + i],
                           i == 0 ? 0.5 : 0.5);
          }
          return text;
        }


        static std::string
        material(const std::string &name, const double modulus)
        {
          std::ostringstream text;
          text << "  subsection " << name
               << "\n    set Young's modulus = " << modulus
               << "\n    set Poisson's ratio = 0.25\n    set Density = 2500\n"
                  "  end\n";
          return text.str();
        }
      };
    } // namespace


    Case
    make_block_case(const std::uint64_t seed)
    {
      BlockMaker maker(seed);
      maker.choose();
      std::array<double, 2> offset;
      for (double &x : offset)
        x = (maker.chance(0.5) ? 1. : -1.) *
            std::pow(10., 4. + 3. * maker.number());
      Case result;
      result.description         = maker.description();
      result.files["case.prm"]   = maker.scene(offset);
      result.files["origin.prm"] = maker.scene({{0., 0.}});
      return result;
    }
  } // namespace Fuzz
} // namespace NMM
