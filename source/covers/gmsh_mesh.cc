#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>
#include <nmm/covers/graded_mesh.h>

#include <deal.II/grid/grid_in.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace NMM
{
  using namespace dealii;

  namespace
  {
    const char *const remedy =
      "save it as gmsh format 2 or 4, ASCII, with triangles of first order "
      "only";


    [[noreturn]] void
    refuse(const std::string &what,
           const std::string &file_name,
           const std::string &advice = remedy)
    {
      AssertThrow(false, InputError(what, file_name, advice));
      throw; // not reached: the assertion above always throws
    }


    /// A stream at the line after the one that is @p head; no stream if there is none.
    std::istringstream
    section(const std::string &text, const std::string &head)
    {
      std::istringstream in(text);
      for (std::string line; std::getline(in, line);)
        if (line.substr(0, line.find_last_not_of(" \t\r") + 1) == head)
          return in;
      return in;
    }


    /// The numbers of elements of each type (numbers as in the file) in the section `$Elements`.
    std::map<int, unsigned int>
    count_types(const std::string &text, const bool has_blocks)
    {
      std::map<int, unsigned int> counts;
      std::istringstream          in = section(text, "$Elements");
      std::string                 line;
      std::getline(in, line);
      while (std::getline(in, line) && line[0] != '$')
      {
        std::istringstream words(line);
        int                number, dimension, type = 0;
        unsigned int       n = 1;
        // Format 4: dimension and tag of an entity, type, number of lines. Format 2: number, type.
        if (!has_blocks)
          words >> number >> type;
        else
          words >> dimension >> number >> type >> n;
        if (words.fail())
          return {};
        counts[type] += n;
        for (unsigned int i = 0; has_blocks && i < n && in.good(); ++i)
          std::getline(in, line);
      }
      return counts;
    }


    /// Refuses files that deal.II cannot read, or reads as something else. @throws InputError that
    /// says what the file has.
    void
    check_contents(const std::string &text, const std::string &file_name)
    {
      double             version   = 0.;
      int                is_binary = 0;
      std::istringstream format    = section(text, "$MeshFormat");
      if (!(format >> version >> is_binary))
        refuse("this is no gmsh mesh", file_name);
      if (is_binary != 0)
        refuse("the mesh file is a binary one", file_name);
      const int generation = static_cast<int>(version);
      if (generation != 2 && generation != 4)
        refuse("the mesh file has the format " + std::to_string(generation),
               file_name);
      if (text.find("$EndElements") == std::string::npos)
        refuse("the mesh file ends early: its list of elements has no end",
               file_name,
               "save it again");

      // deal.II reserves as much memory as these numbers say.
      for (const char *head : {"$Nodes", "$Elements"})
      {
        std::istringstream in = section(text, head);
        double             n  = 0.;
        for (int i = 0; i < (generation == 4 ? 2 : 1); ++i)
          in >> n;
        if (in.fail() || !(n >= 0. && n < text.size()))
          refuse(std::string("the mesh file has no number of lines in ") + head,
                 file_name,
                 "save it again");
      }

      const std::set<int> points_and_lines = {1, 15};
      const std::set<int> second_order     = {8,  9,  10, 11, 12, 13, 14, 16,
                                              17, 18, 19, 20, 21, 22, 23, 24,
                                              25, 26, 27, 28, 29, 30, 31};
      const auto          counts           = count_types(text, generation == 4);
      unsigned int        n_second         = 0;
      for (const auto &[type, n] : counts)
        n_second += second_order.count(type) > 0 ? n : 0;
      if (n_second > 0)
        refuse("the mesh has " + std::to_string(n_second) +
                 " elements of second or higher order",
               file_name,
               "save it with elements of first order (gmsh -order 1)");
      for (const auto &[type, n] : counts)
      {
        const std::string number = std::to_string(n);
        if (type == 3)
          refuse("the mesh has " + number + " quadrilaterals", file_name);
        if (type != 2 && points_and_lines.count(type) == 0)
          refuse("the mesh has " + number +
                   " elements that are neither triangles nor lines",
                 file_name);
      }
      if (counts.count(2) == 0)
        refuse("the mesh has no triangles", file_name);
    }


    /// Checks that cells have an area and do not overlap their neighbours, and that there is one
    /// node only in each place. @throws InputError that names the place.
    void
    check_cells(const Triangulation<2> &triangulation,
                const std::string      &file_name)
    {
      std::set<std::pair<unsigned int, unsigned int>> edges;
      std::set<unsigned int>                          used;
      for (const auto &cell : triangulation.active_cell_iterators())
      {
        std::array<unsigned int, 3> v     = {{cell->vertex_index(0),
                                              cell->vertex_index(1),
                                              cell->vertex_index(2)}};
        const Tensor<1, 2>          a     = cell->vertex(1) - cell->vertex(0);
        const Tensor<1, 2>          b     = cell->vertex(2) - cell->vertex(0);
        const double                area  = a[0] * b[1] - a[1] * b[0];
        const std::string           where = to_string(cell->center());
        if (!(std::abs(area) > 0.) || !std::isfinite(area))
          refuse("the triangle at " + where + " has no area",
                 file_name,
                 "remove it, and draw the mesh in the plane x, y");
        if (area < 0.)
          std::swap(v[1], v[2]);
        // Two triangles that lie on different sides of an edge pass it in different directions.
        for (unsigned int i = 0; i < 3; ++i)
          if (!edges.emplace(v[i], v[(i + 1) % 3]).second)
            refuse("triangles overlap at " + where,
                   file_name,
                   "look for one that is listed twice, and remove it");
        used.insert(v.begin(), v.end());
      }
      std::set<std::pair<double, double>> places;
      for (const unsigned int vertex : used)
      {
        const Point<2> &p = triangulation.get_vertices()[vertex];
        if (!places.emplace(p[0], p[1]).second)
          refuse("the mesh has two nodes at " + to_string(p),
                 file_name,
                 "merge them (gmsh: Coherence Mesh), so that the triangles "
                 "there are connected");
      }
    }
  } // namespace


  MathematicalMesh
  read_gmsh_mesh(const std::string &file_name, const unsigned int degree)
  {
    const std::string text = read_input_file(file_name, "the mesh file");
    check_contents(text, file_name);
    auto      triangulation = std::make_unique<Triangulation<2>>();
    GridIn<2> reader(*triangulation);
    try
    {
      std::istringstream in(text);
      reader.read_msh(in);
    }
    // deal.II 9.6 refuses triangles without area here, and 9.4 does not.
    catch (const std::exception &)
    {
      refuse(
        "the mesh file cannot be read: its lists of nodes and elements do "
        "not fit together, or are damaged, or a triangle has no area",
        file_name);
    }
    check_cells(*triangulation, file_name);
    return MathematicalMesh(std::move(triangulation), degree);
  }
} // namespace NMM
