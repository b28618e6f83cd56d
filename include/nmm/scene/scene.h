#ifndef nmm_scene_scene_h
#define nmm_scene_scene_h

#include <nmm/contact/assembly/term.h>
#include <nmm/contact/contact.h>
#include <nmm/geometry/physical_mesh.h>
#include <nmm/mechanics/loading.h>
#include <nmm/mechanics/static_system.h>
#include <nmm/scene/parameter_tree.h>
#include <nmm/scene/scene_parameters.h>

#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

/**
 * @file
 * The room `scene`: it makes an analysis of a scene file, runs it, and writes its results.
 *
 * What comes in: a scene file, and values that replace single values of the file. What
 * goes out: files of results, by the room `output`, and messages to a Progress.
 *
 * Order of calls, as in run_scene():
 * 1. Scene reads the file into SceneParameters. Each of their structs lists the entries
 *    of its section once, in a function `list_entries` that declares and parses them, and has a
 *    function `check` for what patterns cannot express. Errors are InputErrors.
 * 2. Scene makes the objects that the parameters describe: Geometry, MathematicalMesh,
 *    ElasticityProblem, Loading, ContactParameters.
 * 3. A SceneAnalysis (source/scene: static, with load steps, crack growth, dynamic, relaxation,
 *    safety factor) combines them, solves, and writes the results.
 *
 * To add a section: a struct with `list_entries` and `check` (nmm/scene/scene_parameters_*.h), a
 * member of SceneParameters, and a function of Scene that makes the object of the library.
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
  /**
   * A scene that was read from a file: its parameters, and functions that make the objects they
   * describe. The file format is in doc/scene-format.md.
   */
  class Scene
  {
  public:
    /// Formats in which parameters are printed.
    enum class Format
    {
      prm,
      json,
      markdown
    };

    /**
     * Reads the scene @p file_name and applies @p overrides ("Section/Key=value"). There are two
     * passes: the first one reads the names of lists only, which decide what entries there are.
     * If there are overrides, values of the file that the scene does not use any more have their
     * defaults, see notices(). If @p is_confined is true, the scene may name files in and below its
     * own folder only.
     * @throws InputError for any error in the file or the overrides.
     */
    explicit Scene(const std::string              &file_name,
                   const std::vector<std::string> &overrides   = {},
                   bool                            is_confined = false);

    /// All parameters of the scene, which have been checked.
    const SceneParameters &
    parameters() const;

    /// What is allowed, but may not be meant: values of the file that overrides have made
    /// useless, and those of SceneParameters::notices().
    std::vector<std::string>
    notices() const;

    /// Prints the scene with all values, defaults included.
    void
    print(std::ostream &out, Format format) const;

    /// Prints a small scene that can be run, with all defaults; in the format markdown, a
    /// reference of all parameters with an example name in each list.
    static void
    print_defaults(std::ostream &out, Format format);

    /// The title of the scene, or if it has none, the name of its file without folder and
    /// extension.
    std::string
    title() const;

    /// The amplitudes of loads at rest before the first stage: those of t = 0, and 0 for loads that a
    /// stage adds. Lists are empty if all amplitudes are 1.
    LoadAmplitudes
    loads_before_stages() const;

    /// What changes at the beginning of each stage. @throws InputError for regions to be removed in
    /// which there is no block of the @p mesh.
    std::vector<StageChange>
    make_stages(const PhysicalMesh &mesh) const;

    /// The geometry before cleaning, with traces, regions and joint sets. @p notices, if not null,
    /// receives what is to be reported about drawings. @throws InputError for files that cannot be
    /// read and for joint sets that are wrong.
    Geometry
    make_geometry(std::vector<std::string> *notices = nullptr) const;

    /// The limits of the scene; blocks that lie outside of all of them are removed. If it is
    /// empty, no block is removed.
    std::vector<Curve>
    make_limits() const;

    /// The mathematical mesh, the same on all ranks of @p communicator, which share the memory of
    /// their machine. If it is graded towards crack tips, its cells are not larger than
    /// @p further_sizes. @throws InputError for a curve that does not exist, for a file that cannot
    /// be read, and if the memory does not suffice.
    MathematicalMesh
    make_mathematical_mesh(
      const PhysicalMesh           &physical_mesh,
      MPI_Comm                      communicator  = MPI_COMM_WORLD,
      const std::vector<LocalSize> &further_sizes = {}) const;

    /// Estimate of the memory that an analysis of this scene needs per cell [bytes], from
    /// measurements.
    double
    memory_per_cell() const;

    /// For each region of @p physical_mesh, the mathematical mesh on which it is. @throws
    /// InputError for a block that does not exist.
    std::vector<RegionMesh>
    make_region_meshes(const PhysicalMesh &physical_mesh) const;

    /// The materials, loads and supports. @throws InputError for an expression that cannot be
    /// parsed.
    ElasticityProblem
    make_problem() const;

    /// Adds the loads of water to those of @p problem, which make_problem() has made: those of the
    /// first table, and of each table that a stage moves to. @throws InputError for an expression
    /// that cannot be parsed, and for a face that @p mesh does not have.
    void
    add_water(const PhysicalMesh &mesh, ElasticityProblem &problem) const;

    /// The dependence of the problem's loads and conditions on time, after all stages. Its functions throw
    /// NumericalFailure where an expression has no value. @throws InputError
    /// for an expression that cannot be parsed or has no value at the start or
    /// the end, and for a file that cannot be read.
    Loading
    make_loading() const;

    /// The rigid bodies that the solid can touch, with restraints last. @p releases receives those
    /// that are removed at some time, and may be null. @throws InputError for a shape or an
    /// expression that cannot be parsed, and for a name that a curve of @p physical_mesh has.
    std::vector<RigidObstacle>
    make_obstacles(const PhysicalMesh           &physical_mesh,
                   std::vector<ObstacleRelease> *releases = nullptr) const;

    /// The contact laws between the faces of @p surface; what the scene leaves open is chosen by
    /// choose_contact_parameters(). @throws InputError for a law between faces that do not exist.
    ContactParameters
    make_contact_parameters(const ContactSurface    &surface,
                            const ElasticityProblem &problem) const;

    /**
     * The damping of the motion. Coefficients that the scene leaves open are 0, except for the
     * energy-conserving scheme with friction (@p has_friction): without damping, an elastic block
     * flutters on a face with friction, and creeps where it must stick. A block of height H
     * that is held by a face has its lowest vibration at @f$\omega = \pi c/(2H)@f$,
     * @f$c^2 = E/\rho@f$, whose critical damping by the stiffness is
     * @f[ b = 2/\omega = \frac{4H}{\pi c}. @f]
     * Here @f$H@f$ is the root of the block's area, and the (lower) median of b over all blocks
     * is taken. Slower motions are damped less, and rigid-body motion is not damped.
     */
    RayleighDamping
    make_damping(const PhysicalMesh      &mesh,
                 const ElasticityProblem &problem,
                 bool                     has_friction) const;

  private:
    std::string file_name;
    bool        is_confined;
    /// Values of the file that are not used, by what makes no use of them.
    std::map<std::string, std::vector<std::string>> unused_values;
    SceneNames                                      names;
    SceneParameters                                 scene_parameters;
    std::shared_ptr<dealii::ParameterHandler>       prm;

    /// Reads the parameters of @p prm; values without use become defaults if there are
    /// @p assignments, and none of these sets them. @throws InputError for a value that is refused.
    void
    parse_parameters(const std::vector<ParameterAssignment> &assignments);

    /// Path of a file that the scene names relative to its own folder. @throws InputError if the
    /// scene is confined to that folder and the file is outside of it.
    std::string
    relative_to_scene(const std::string &name) const;

    /// Adds the curves of a file to @p geometry, and what is to be reported to @p notices.
    void
    add_traces(const TraceParameters    &traces,
               Geometry                 &geometry,
               std::vector<std::string> *notices) const;

    /// The dependence of loads and conditions on time, without what stages change.
    Loading
    loads_in_time() const;

    /// The water of the first table, and of each table that a stage moves to.
    std::vector<Water>
    make_water() const;

    /// Number of conditions by which the water of one table acts.
    unsigned int
    n_conditions_of_a_table() const;

    using TimeVector = std::function<dealii::Tensor<1, 2>(double)>;

    /// A vector of two functions of time, which are separated by a semicolon in @p text; null if
    /// @p text is empty.
    TimeVector
    make_vector_function(const std::string &text,
                         const std::string &parameter) const;

    /// Makes joints open or tied as the section `Contact` says.
    void
    set_joint_states(Geometry &geometry) const;

    Curve
    make_region(const RegionParameters &parameters) const;

    /// Adds the regions to @p geometry, and a hole for each one that takes out a part of the solid.
    void
    add_regions(Geometry &geometry) const;

    /// Checks that the names in contact laws are names of faces. @throws InputError otherwise.
    void
    check_law_names(const ContactSurface &surface) const;
  };
} // namespace NMM

#endif
