#include <cmath>
#include <cstdio>
#include <fuzz/fuzz.h>
#include <random>
#include <sstream>

// Plates with cracks that grow, and other curves that they meet: joints, holes, interfaces,
// the boundary, each other.
namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      enum class Kind
      {
        equilibrium,
        contact,
        motion
      };


      class PlateMaker
      {
      public:
        PlateMaker(const std::uint64_t seed, const Kind kind)
          : generator(seed)
          , digits(chance(0.5) ? 1 + integer(3) : 17)
          , has_contact(kind == Kind::contact ||
                        (kind == Kind::motion && chance(0.3)))
          , moves(kind == Kind::motion)
        {
        }


        Case
        make()
        {
          static const char *const criteria[] = {"hoop stress",
                                                 "local symmetry",
                                                 "energy release"};
          const bool               is_pulled  = chance(0.7);
          std::ostringstream       scene;
          scene
            << "subsection Geometry\n  set Text = boundary name=bottom "
               "LINESTRING (0 0, 1 0); boundary name=sides LINESTRING (1 0, 1 "
               "1); boundary name=top LINESTRING (1 1, 0 1); boundary "
               "name=sides LINESTRING (0 1, 0 0)"
            << curves()
            << "\nend\nsubsection Mathematical mesh\n  set Cell size = "
            << (has_contact ? 0.2 : 0.1) + 0.2 * number()
            << "\nend\nsubsection Fracture\n  set Intensity factors = true\n"
               "  set Increments = "
            << 1 + integer(!has_contact ? 3
                           : moves      ? 0
                                        : 2)
            << "\n  set Increment = " << std::pow(10., -2. * number() - 0.3)
            << "\n  set Grading = "
            << (has_contact ? 0.5 : 0.3) + 0.4 * number()
            << "\n  set Criterion = " << criteria[integer(2)]
            << "\nend\nsubsection Materials\n  set Names = rock\n"
               "  subsection rock\n    set Young's modulus = "
            // contact sees the deformed faces: small strains
            << (moves         ? 1e3
                : has_contact ? 1e6
                              : 1.)
            << "\n    set Poisson's ratio = 0.25\n    set Density = 1\n"
               "    set Toughness = "
            << (moves ? 0.4 : 1.);
          // The length over which stress is averaged is between 1e-3 and 0.6 of the plate.
          if (chance(0.5))
            scene << "\n    set Fracture strength = "
                  << std::pow(10., 1.4 * number());
          scene
            << "\n  end\nend\n"
               "subsection Boundary conditions\n  set Names = held, "
               "pulled\n  subsection held\n    set Boundary = bottom\n    set "
               "Type = displacement\n    set Value = 0; 0\n  end\n  "
               "subsection pulled\n    set Boundary = top\n    set Type = "
            << (is_pulled ? "traction" : "displacement")
            << "\n    set Value = " << number() - 0.5 << "; " << number() - 0.2
            << "\n  end\nend\nsubsection Output\n  set Picture = false\n  "
               "set Fields = false\nend\n";
          if (has_contact)
            scene << "subsection Contact\n  set Enforcement = penalty\n"
                     "  set Friction angle = "
                  << 60. * number() << "\nend\n";
          // A wave runs through the plate in 0.03 s.
          if (moves)
            scene << "subsection Model\n  set Analysis = dynamic\n"
                     "  set Kinematics = "
                  << (chance(0.5) ? "small" : "finite")
                  << "\nend\nsubsection Time\n  set End time = 0.1\n"
                     "  set Initial step = 2e-3\nend\n";
          Case result;
          result.description = std::to_string(n_cracks) + " cracks and " +
                               std::to_string(n_others) + " other curves";
          result.files["case.prm"] = scene.str();
          return result;
        }

      private:
        std::mt19937_64 generator;
        unsigned int    digits;
        bool            has_contact, moves;
        unsigned int    n_cracks = 0, n_others = 0;


        double
        number()
        {
          return std::uniform_real_distribution<double>(0., 1.)(generator);
        }


        unsigned int
        integer(const unsigned int largest)
        {
          return std::uniform_int_distribution<unsigned int>(0, largest)(
            generator);
        }


        bool
        chance(const double probability)
        {
          return number() < probability;
        }


        /// With few digits, so that coincidences abound, or with all.
        std::string
        coordinate(const double x) const
        {
          char text[40];
          std::snprintf(
            text, sizeof(text), "%.*g", static_cast<int>(digits), x);
          return text;
        }


        std::string
        point()
        {
          const double x = 1.2 * number() - 0.1;
          return coordinate(x) + " " + coordinate(1.2 * number() - 0.1);
        }


        std::string
        curves()
        {
          std::ostringstream text;
          n_cracks = 1 + integer(has_contact ? 1 : 3);
          n_others = integer(3);
          for (unsigned int i = 0; i < n_cracks; ++i)
          {
            text << "; joint name=crack" << i;
            if (chance(0.3))
              text << " CIRCULARSTRING (" << point() << ", " << point() << ", "
                   << point() << ')';
            else
            {
              text << " LINESTRING (" << point();
              for (unsigned int p = 0; p <= integer(2); ++p)
                text << ", " << point();
              text << ')';
            }
          }
          for (unsigned int i = 0; i < n_others; ++i)
            switch (integer(3))
            {
              case 0:
                text << "; joint name=wall" << i << " LINESTRING (" << point()
                     << ", " << point() << ')';
                break;
              case 1:
                text << "; joint state=closed name=seam" << i << " LINESTRING ("
                     << point() << ", " << point() << ')';
                break;
              case 2:
                text << "; interface name=layer" << i << " LINESTRING ("
                     << point() << ", " << point() << ')';
                break;
              default:
                text << "; hole name=hole" << i << " CIRCLE ("
                     << coordinate(0.2 + 0.6 * number()) << ' '
                     << coordinate(0.2 + 0.6 * number()) << ", "
                     << coordinate(0.03 + 0.1 * number()) << ')';
            }
          return text.str();
        }
      };
    } // namespace


    Case
    make_growth_case(const std::uint64_t seed)
    {
      return PlateMaker(seed, Kind::equilibrium).make();
    }


    Case
    make_contact_growth_case(const std::uint64_t seed)
    {
      return PlateMaker(seed, Kind::contact).make();
    }


    Case
    make_growth_in_motion_case(const std::uint64_t seed)
    {
      return PlateMaker(seed, Kind::motion).make();
    }
  } // namespace Fuzz
} // namespace NMM
