#ifndef nmm_tests_fuzz_fuzz_h
#define nmm_tests_fuzz_fuzz_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * Random input for the library, run in one process: thousands of cases take minutes.
   * A case follows from its seed alone. Each generator is a file of its own that is
   * listed in generators().
   */
  namespace Fuzz
  {
    struct Case
    {
      /// What is in it, for the message if the case fails.
      std::string description;
      /// Names and contents of files; case.prm is a scene that does what run() does,
      /// as far as a scene can.
      std::map<std::string, std::string> files;
      /// What else run() needs.
      std::map<std::string, double> numbers;
    };

    struct Generator
    {
      std::string name;
      Case (*make)(std::uint64_t seed);
      /// What is wrong with the library's answer; empty if nothing is.
      std::string (*run)(const Case &);
      /// What takes longer counts as a hang.
      unsigned int seconds_at_most = 10;
    };

    const std::vector<Generator> &
    generators();

    /// @throws std::invalid_argument if there is none.
    const Generator &
    find_generator(const std::string &name);

    /// What is wrong with a case, exceptions included; empty if nothing is.
    std::string
    check(const Generator &generator, const Case &c);

    /// Write a case's files into a folder, which is made if need be.
    void
    write(const Case &c, const std::string &folder);

    Case
    make_geometry_case(std::uint64_t seed);

    std::string
    run_geometry_case(const Case &c);

    Case
    make_scene_case(std::uint64_t seed);

    /// A plate with cracks that grow.
    Case
    make_growth_case(std::uint64_t seed);

    /// The same with faces that touch.
    Case
    make_contact_growth_case(std::uint64_t seed);

    /// The same in motion, some of them with contact.
    Case
    make_growth_in_motion_case(std::uint64_t seed);

    /// Blocks that move on a floor, far from the origin of the coordinates, as case.prm, and the same
    /// at the origin, as origin.prm.
    Case
    make_block_case(std::uint64_t seed);

    /// Runs both scenes. Wrong are, besides what run_scene_case() finds, different ends, and far away
    /// many more iterations than at the origin.
    std::string
    run_block_case(const Case &c);

    /// A slope of some hundred blocks between two random joint sets, relaxed under its weight.
    Case
    make_network_case(std::uint64_t seed);

    /// Wrong are, besides what run_scene_case() finds, ends without a cause in mechanics: steps that became
    /// too short, or too many of them.
    std::string
    run_network_case(const Case &c);

    /// Runs the scene as the program nmm does. Wrong are exit codes other than 0, 2 and 3, files written with
    /// 2, and tables with values that are not finite with 0.
    std::string
    run_scene_case(const Case &c);
  } // namespace Fuzz
} // namespace NMM

#endif
