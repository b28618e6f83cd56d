#include <nmm/base/exceptions.h>
#include <nmm/covers/graded_mesh.h>

#include <deal.II/grid/grid_in.h>

#include <fstream>

namespace NMM
{
  using namespace dealii;

  MathematicalMesh
  read_gmsh_mesh(const std::string &file_name, const unsigned int degree)
  {
    std::ifstream file(file_name);
    AssertThrow(file,
                InputError("the mesh file cannot be read",
                           file_name,
                           "check its name and permissions"));
    auto      triangulation = std::make_unique<Triangulation<2>>();
    GridIn<2> reader(*triangulation);
    try
    {
      reader.read_msh(file);
    }
    catch (const std::exception &exception)
    {
      AssertThrow(false,
                  InputError("deal.II cannot read the mesh file (" +
                               std::string(exception.what()) + ")",
                             file_name,
                             "save it as gmsh format 2 or 4, ASCII, with "
                             "triangles only"));
    }
    return MathematicalMesh(std::move(triangulation), degree);
  }
} // namespace NMM
