#ifndef nmm_scene_scene_h
#define nmm_scene_scene_h

#include <nmm/contact/contact.h>
#include <nmm/dynamics/contact_model.h>
#include <nmm/dynamics/loading.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/scene/scene_parameters.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

/**
 * @file
 * The room `scene`: a scene file becomes an analysis, and that its results.
 *
 * What comes in: a scene file and single values that take the place of its own. What
 * goes out: files of results, by the room `output`, and messages to a Progress.
 *
 * Order of calls, as in run_scene():
 * 1. Scene reads the file into SceneParameters. Each struct of these lists the entries
 *    of its section once, which declares and parses them, and checks what patterns
 *    cannot express. What is wrong is an InputError.
 * 2. Scene makes what the parameters describe: Geometry, MathematicalMesh,
 *    ElasticityProblem, Loading, ContactParameters.
 * 3. A SceneAnalysis (static, with load steps, dynamic, safety factor) puts them
 *    together, solves, and writes.
 *
 * @code
 *   const Scene scene("beam.prm", {"Mathematical mesh/Cell size=0.1"});
 *   Progress progress(std::cout, false, MPI_COMM_WORLD);
 *   bool has_output = false;
 *   SceneRunOptions options;
 *   options.output = "results";
 *   run_scene(scene, options, progress, MPI_COMM_WORLD, has_output);
 * @endcode
 */
namespace NMM
{
  /// What moves and takes away the obstacles of a scene.
  struct ObstacleSwitches
  {
    std::vector<ObstacleRelease> releases;
    /// While true, obstacles are where they are at t = 0, whatever the time.
    std::shared_ptr<bool> is_frozen;
  };


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

    /// The geometry before cleaning, with traces, regions and joint sets. @throws
    /// InputError for files that cannot be read, sets that are wrong.
    Geometry
    make_geometry() const;

    /// Limits of the scene: blocks that leave all of them are dropped. Empty: no block is.
    std::vector<Curve>
    make_limits() const;

    /// The mathematical mesh; the ranks of @p communicator share it if the scene says so.
    /// @throws InputError for a curve that does not exist, an unreadable file.
    MathematicalMesh
    make_mathematical_mesh(const PhysicalMesh &physical_mesh,
                           MPI_Comm communicator = MPI_COMM_WORLD) const;

    /// What an analysis of this scene uses for each cell [bytes], measured.
    double
    memory_per_cell() const;

    /// Which mathematical mesh each region is on. @throws InputError for a block
    /// that does not exist.
    std::vector<RegionMesh>
    make_region_meshes(const PhysicalMesh &physical_mesh) const;

    /// @throws InputError for an expression that cannot be parsed.
    ElasticityProblem
    make_problem() const;

    /// How the problem's loads and conditions change in time. @throws InputError
    /// for an expression that cannot be parsed or has no value at the start or
    /// the end, or a file that cannot be read. Its functions throw
    /// NumericalFailure where an expression has no value.
    Loading
    make_loading() const;

    /// Rigid bodies that the solid touches, restraints last. @p switches: null if
    /// none is ever released. @throws InputError for a shape or an expression that
    /// cannot be parsed, a name that a curve of @p physical_mesh has.
    std::vector<RigidObstacle>
    make_obstacles(const PhysicalMesh &physical_mesh,
                   ObstacleSwitches   *switches = nullptr) const;

    /**
     * How the faces of @p surface act on each other. What the scene leaves open, E
     * being that of the softest block and h contact_cell_size(): the normal
     * stiffness is 10 E/h (30 in a static analysis by penalty); the shear
     * stiffness E/h (in dynamics 10), but not more than the normal one; the
     * penetration tolerance of augmented Lagrangian 1e-5 h. Of two blocks the
     * softer one carries the contact points.
     * @throws InputError for a law between faces that do not exist.
     */
    ContactParameters
    make_contact_parameters(const ContactSurface    &surface,
                            const ElasticityProblem &problem) const;

    /**
     * Damping of the motion. What the scene leaves open is 0, but for conserving steps of
     * blocks that rub on each other (@p has_friction): an elastic block that nothing damps
     * flutters on a face with friction, and creeps where it must stick. A block of height H
     * that a face holds has its lowest vibration at @f$\omega = \pi c/(2H)@f$,
     * @f$c^2 = E/\rho@f$, whose critical damping by the stiffness is
     * @f[ b = 2/\omega = \frac{4H}{\pi c}, @f]
     * taken with @f$H@f$ the root of the area, and of blocks the (lower) median: what is
     * slower is damped less, motion as a rigid body not at all.
     */
    RayleighDamping
    make_damping(const PhysicalMesh      &mesh,
                 const ElasticityProblem &problem,
                 bool                     has_friction) const;

  private:
    std::string                               file_name;
    SceneNames                                names;
    SceneParameters                           scene_parameters;
    std::shared_ptr<dealii::ParameterHandler> prm;

    std::string
    relative_to_scene(const std::string &name) const;

    using TimeVector = std::function<dealii::Tensor<1, 2>(double)>;

    /// Two functions of time, separated by a semicolon; null if @p text is empty.
    TimeVector
    make_vector_function(const std::string &text,
                         const std::string &parameter) const;

    /// What the section `Contact` says of joints.
    void
    set_joint_states(Geometry &geometry) const;

    Curve
    make_region(const RegionParameters &parameters) const;

    /// As places, and the holes they make.
    void
    add_regions(Geometry &geometry) const;

    /// @throws InputError unless a law's names are faces that touch.
    void
    check_law_names(const ContactSurface &surface) const;
  };


  /// Edge length of the cells at faces, that of the smaller ones: one in ten edges
  /// belongs to a smaller cell [m]. Slivers (PhysicalMesh::Region::is_sliver) have no
  /// part in it.
  double
  contact_cell_size(const ContactSurface &surface);
} // namespace NMM

#endif
