#ifndef nmm_io_scene_h
#define nmm_io_scene_h

#include <nmm/dynamics/loading.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/io/scene_parameters.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * A scene as read: its parameters, and the objects of the other modules they
   * describe. The file format is in doc/scene-format.md.
   */
  class Scene
  {
  public:
    enum class Format
    {
      prm,
      json,
      markdown
    };

    /**
     * Read @p file_name in two passes, the first for the names of lists only,
     * and apply @p overrides ("Section/Key=value") to both.
     * @throws InputError for anything wrong with file or overrides.
     */
    explicit Scene(const std::string              &file_name,
                   const std::vector<std::string> &overrides = {});

    const SceneParameters &
    parameters() const;

    /// The scene with all values, defaults included.
    void
    print(std::ostream &out, Format format) const;

    /// All parameters there are, with an example name in each list.
    static void
    print_defaults(std::ostream &out, Format format);

    /// Title, or the file's name without folder and extension.
    std::string
    title() const;

    /// The geometry before cleaning.
    Geometry
    make_geometry() const;

    /// @throws InputError for a curve that does not exist, an unreadable file.
    MathematicalMesh
    make_mathematical_mesh(const PhysicalMesh &physical_mesh) const;

    /// @throws InputError for an expression that cannot be parsed.
    ElasticityProblem
    make_problem() const;

    /// How the problem's loads and conditions change in time. @throws InputError
    /// for an expression that cannot be parsed or has no value at the start or
    /// the end, or a file that cannot be read. Its functions throw
    /// NumericalFailure where an expression has no value.
    Loading
    make_loading() const;

  private:
    std::string                               file_name;
    SceneNames                                names;
    SceneParameters                           scene_parameters;
    std::shared_ptr<dealii::ParameterHandler> prm;

    std::string
    relative_to_scene(const std::string &name) const;

    /// Null if there is none.
    std::function<dealii::Tensor<1, 2>(double)>
    make_base_acceleration() const;
  };
} // namespace NMM

#endif
