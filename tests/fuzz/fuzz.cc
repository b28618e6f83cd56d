#include <nmm/base/exceptions.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <fuzz/fuzz.h>
#include <stdexcept>

namespace NMM
{
  namespace Fuzz
  {
    const std::vector<Generator> &
    generators()
    {
      static const std::vector<Generator> all = {
        {"geometry", &make_geometry_case, &run_geometry_case},
        {"scene", &make_scene_case, &run_scene_case},
        {"growth", &make_growth_case, &run_scene_case},
        // where contact cycles, a solution takes ten seconds until it is given up
        {"contact-growth", &make_contact_growth_case, &run_scene_case, 60},
        {"growth-in-motion", &make_growth_in_motion_case, &run_scene_case, 60},
        {"blocks", &make_block_case, &run_block_case, 60},
        {"networks", &make_network_case, &run_network_case, 600}};
      return all;
    }


    const Generator &
    find_generator(const std::string &name)
    {
      std::string names;
      for (const Generator &generator : generators())
      {
        if (generator.name == name)
          return generator;
        names += " '" + generator.name + "'";
      }
      throw std::invalid_argument("there is no generator '" + name + "', but" +
                                  names);
    }


    std::string
    check(const Generator &generator, const Case &c)
    {
      try
      {
        return generator.run(c);
      }
      catch (const UserError &error)
      {
        return error.message();
      }
      catch (const std::exception &exception)
      {
        return exception.what();
      }
    }


    void
    write(const Case &c, const std::string &folder)
    {
      std::filesystem::create_directories(folder);
      for (const auto &[name, text] : c.files)
        std::ofstream(std::filesystem::path(folder) / name) << text;
    }
  } // namespace Fuzz
} // namespace NMM
