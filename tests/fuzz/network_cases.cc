#include <cmath>
#include <fuzz/fuzz.h>
#include <random>
#include <sstream>

// Slopes of two random joint sets, whose blocks find rest or fall.
namespace NMM
{
  namespace Fuzz
  {
    namespace
    {
      /// A number between two bounds for each call.
      class Numbers
      {
      public:
        explicit Numbers(const std::uint64_t seed)
          : generator(seed)
        {
        }


        double
        operator()(const double from, const double to)
        {
          return std::uniform_real_distribution<double>(from, to)(generator);
        }


      private:
        std::mt19937_64 generator;
      };


      std::string
      joint_set(const std::string  &name,
                const double        dip,
                const double        spacing,
                const std::uint64_t seed,
                Numbers            &numbers)
      {
        std::ostringstream text;
        text << "  subsection " << name << "\n    set Dip = " << dip
             << "\n    set Dip scatter = " << numbers(0., 8.)
             << "\n    set Spacing = " << spacing
             << "\n    set Spacing scatter = " << numbers(0., 0.4)
             << "\n    set Persistence = " << numbers(0.8, 1.)
             << "\n    set Trace length = " << spacing * numbers(3., 7.)
             << "\n    set Seed = " << seed << "\n  end\n";
        return text.str();
      }
    } // namespace


    Case
    make_network_case(const std::uint64_t seed)
    {
      Numbers      numbers(seed);
      const double height = numbers(15., 30.), face = numbers(3., height);
      const bool   is_cohesive = numbers(0., 1.) < 0.5,
                 merges        = numbers(0., 1.) < 0.5;
      // Blocks end where traces meet, so there are about half as many as cells of the two sets.
      const double       n_cells = numbers(400., 1100.);
      const double       area    = 60. * 10. + height * (40. - 0.5 * face);
      const double       spacing = std::sqrt(area / n_cells);
      const double       dip     = numbers(-60., 60.);
      std::ostringstream text;
      text << "subsection Geometry\n"
              "  set Text = boundary name=ground material=rock LINESTRING "
              "(60 10, 40 10, "
           << 40. - face << ' ' << 10. + height << ", 0 " << 10. + height
           << "); boundary name=held LINESTRING (0 " << 10. + height
           << ", 0 0, 60 0, 60 10)\n"
              "  set Dangling ends = drop\n  set Small blocks = "
           << (merges ? "merge" : "report")
           << "\n  set Small block area = " << 0.04 * spacing * spacing
           << "\n  set Cleaning tolerance = " << 0.04 * spacing
           << "\nend\nsubsection Joint sets\n  set Names = first, second\n"
           << joint_set("first", dip, spacing, 2 * seed, numbers)
           << joint_set("second",
                        dip + numbers(50., 110.),
                        spacing * numbers(0.8, 1.5),
                        2 * seed + 1,
                        numbers)
           << "end\nsubsection Covers\n  set Own meshes = automatic\n"
              "  set Elements across = 1\nend\n"
              "subsection Materials\n  set Names = rock\n  subsection rock\n"
              "    set Young's modulus = 5e9\n    set Poisson's ratio = 0.25\n"
              "    set Density = 2500\n  end\nend\n"
              "subsection Model\n  set Analysis = relaxation\n"
              "  set Kinematics = finite\n  set Gravity = 0, -9.81\nend\n"
              "subsection Contact\n  set Enforcement = penalty\n"
              "  set Friction angle = "
           << numbers(25., 50.)
           << "\n  set Cohesion = " << (is_cohesive ? 20e3 : 0.)
           << "\nend\nsubsection Boundary conditions\n  set Names = fix\n"
              "  subsection fix\n    set Boundary = held\n    set Type = "
              "displacement\n  end\nend\n"
              "subsection Relaxation\n  set Step = 0.002\nend\n"
              "subsection Output\n  set Picture = false\n  set Fields = "
              "false\nend\n";
      Case result;
      result.description = std::string("a slope of two joint sets") +
                           (is_cohesive ? " with cohesion" : "") +
                           (merges ? ", small blocks merged" : "");
      result.files["case.prm"] = text.str();
      return result;
    }
  } // namespace Fuzz
} // namespace NMM
