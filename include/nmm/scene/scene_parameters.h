#ifndef nmm_scene_scene_parameters_h
#define nmm_scene_scene_parameters_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/mechanics/in_situ_stress.h>
#include <nmm/mechanics/nonlinear_statics.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/output/probes.h>
#include <nmm/scene/scene_parameters_bolts.h>
#include <nmm/scene/scene_parameters_contact.h>
#include <nmm/scene/scene_parameters_covers.h>
#include <nmm/scene/scene_parameters_dynamics.h>
#include <nmm/scene/scene_parameters_fracture.h>
#include <nmm/scene/scene_parameters_geometry.h>
#include <nmm/scene/scene_parameters_stages.h>
#include <nmm/scene/scene_parameters_water.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// A local size of a graded mathematical mesh: a subsection of `Mathematical mesh`.
  struct LocalSizeParameters
  {
    /// Declares or reads the entries of @p local_size. @throws InputError if an entry that its type
    /// needs is missing.
    static void
    list_entries(internal::Entries &entries,
                 LocalSize         &local_size,
                 const std::string &name);
  };


  /// The section `Mathematical mesh`.
  struct MathematicalMeshParameters
  {
    /// The ways to make the cells.
    enum class Type
    {
      /// Equal triangles over the bounding box of the solid.
      regular,
      /// Triangles whose size follows the local sizes.
      graded,
      /// Triangles from a file of Gmsh.
      gmsh
    };

    /// The way to make the cells.
    Type type = Type::regular;
    /// Parameters of a regular mesh; its cell size holds for a graded mesh, too.
    RegularMeshParameters regular;
    /// Parameters of a graded mesh.
    GradedMeshParameters graded;
    /// Polynomial degree of the weight functions: 1, or 2 for the second-order method.
    unsigned int degree = 2;
    /// File of a mesh from Gmsh, relative to the scene file; empty for the other types.
    std::string gmsh_file;

    /// Declares or reads the entries of the section, with a subsection for each of
    /// @p local_size_names.
    void
    list_entries(internal::Entries              &entries,
                 const std::vector<std::string> &local_size_names);
    /// Checks all values. A regular mesh needs no cell size if @p may_choose_size. @throws
    /// InputError for a value that is missing or not used.
    void
    check(bool may_choose_size) const;
  };


  /// A material: a subsection of `Materials`.
  struct MaterialParameters
  {
    /// Declares or reads the entries of @p material, and makes its law. @throws InputError for a
    /// parameter of the law that is out of range.
    static void
    list_entries(internal::Entries &entries, Material &material);
  };


  /// The section `In-situ stress`.
  struct InSituStressParameters : InSituStress
  {
    /// Whether materials begin with the stress of their weight.
    bool is_present = false;

    /// Declares or reads the entries of the section. @throws InputError for a value that is out of
    /// range or not used.
    void
    list_entries(internal::Entries &entries);
  };


  /// The name of the kinematics in scene files.
  const std::string &
  to_string(Kinematics kinematics);


  /// The section `Model`.
  struct ModelParameters
  {
    /// The description of the deformation.
    Kinematics kinematics = Kinematics::small;
    /// The assumption about the direction across the plane.
    PlaneState plane_state = PlaneState::plane_stress;
    /// Thickness of the plate or slice [m], > 0.
    double thickness = 1.;
    /// Acceleration of gravity [m/s^2].
    dealii::Tensor<1, 2> gravity;
    /// Force per volume beside gravity, "fx; fy" [N/m^3], expressions of x and y; empty for none.
    std::string body_force;
    /// The kind of analysis.
    Analysis analysis = Analysis::statics;
    /// Factor on gravity over time, see TimeDependence::amplitude.
    std::string gravity_amplitude;
    /// Factor on the body force over time, see TimeDependence::amplitude.
    std::string body_force_amplitude;
    /// Acceleration of the ground "ax; ay" [m/s^2], each an amplitude; empty for none.
    std::string base_acceleration;

    /// Declares or reads the entries of the section. @throws InputError for a thickness of 0.
    void
    list_entries(internal::Entries &entries);
  };


  /// A load or support on boundaries: a subsection of `Boundary conditions`.
  struct BoundaryConditionParameters
  {
    /// Name of the subsection.
    std::string name;
    /// Names of the boundary and hole curves of the geometry on which the condition holds.
    std::vector<std::string> boundaries;
    /// The kind of load or support.
    BoundaryCondition::Type type = BoundaryCondition::Type::traction;
    /// Traction or pressure [Pa] or displacement [m], as expressions of x and y that are separated
    /// by semicolons; empty for 0.
    std::string value;
    /// Which components of a displacement are prescribed.
    std::array<bool, 2> components = {{true, true}};
    /// What the value of an absorbing boundary is; nothing if no wave comes in.
    std::optional<BoundaryCondition::Wave> wave;
    /// See BoundaryCondition::slides_at_rest.
    bool slides_at_rest = false;
    /// The amplitude, and the release of a displacement.
    TimeDependence time;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
    /// Checks that there is a boundary, and components for displacements only. @throws InputError
    /// otherwise.
    void
    check() const;
  };


  /// A force at a point: a subsection of `Point forces`.
  struct PointForceParameters
  {
    /// Name of the subsection.
    std::string name;
    /// The point and the force.
    PointForce force;
    /// The amplitude of the force.
    TimeDependence time;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
  };


  /// A point that is held by a spring: a subsection of `Fixed points`.
  struct FixedPointParameters
  {
    /// Name of the subsection.
    std::string name;
    /// The point, its displacement and the stiffness of the spring.
    FixedPoint point;
    /// The amplitude of the displacement, and the release.
    TimeDependence time;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
  };


  /// The section `Solver`.
  struct SolverParameters
  {
    /// Declares or reads the entries of the section. @throws InputError for a tolerance of 0.
    static void
    list_entries(internal::Entries      &entries,
                 LinearSolverParameters &parameters);
  };


  /// The section `Load steps`: load factors at which results are computed.
  struct LoadStepParameters
  {
    /// Number of equal load steps up to the load factor 1; not used if `load_factors` is given.
    unsigned int n_steps = default_n_steps;
    /// Smallest step over the last load factor [-], > 0; a step that fails is divided down to it.
    double min_step = LoadSteps().min_step;
    /// Ascending load factors [-]; if empty, there are n_steps equal steps up to 1.
    std::vector<double> load_factors;

    /// Number of steps if the scene gives none.
    static constexpr unsigned int default_n_steps = 10;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks all values. @throws InputError for a value that is out of range or not used.
    void
    check(Kinematics kinematics, Analysis analysis, bool is_nonlinear) const;

    /// The load factors and the smallest step, without the bound on displacements.
    LoadSteps
    load_steps() const;
  };


  /// The section `Newton`.
  struct NewtonSectionParameters
  {
    /// The parameters of Newton's method.
    NewtonParameters newton;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks all values. @throws InputError for a value that is out of range or not used.
    void
    check(Kinematics kinematics, Analysis analysis, bool is_nonlinear) const;
  };


  /// The section `Output`: which files are written, and how pictures look.
  struct OutputParameters : PictureParameters
  {
    /// Whether the fields are written for ParaView.
    bool fields = true;
    /// Number of steps after which fields and pictures are written; 0 if only those of the last
    /// step are.
    unsigned int fields_every = 0;
    /// Whether contacts.csv is written.
    bool contacts = true;
    /// Number of steps after which a checkpoint is written; 0 for no checkpoints.
    unsigned int checkpoint_every = 0;
    /// Whether animation.html is written if there is a series of pictures.
    bool animation = true;
    /// Whether picture.png is written.
    bool picture = true;
    /// Title of pictures; if empty, the name of the scene file.
    std::string title;

    /// Declares or reads the entries of the section. A quantity for animations that is given twice,
    /// or that is the picture's, is dropped.
    void
    list_entries(internal::Entries &entries);
    /// Checks the range, the units and the steps. @throws InputError naming the value.
    void
    check() const;
  };


  /// A probe: a subsection of `Probes`.
  struct ProbeParameters
  {
    /// Declares or reads the entries of @p probe. @throws InputError for a line without length.
    static void
    list_entries(internal::Entries &entries, Probe &probe);
  };


  /**
   * The exact solution with which the results are compared. The thick ring takes its
   * centre and radii from the two named curves, its pressures from the
   * conditions on them and its moduli from the material, so that the scene gives nothing
   * twice.
   */
  struct ExactSolutionParameters
  {
    /// The exact solutions that are known.
    enum class Type
    {
      /// There is no comparison.
      none,
      /// Lame's solution of a circular ring under inner pressure.
      thick_ring
    };

    /// The exact solution.
    Type type = Type::none;
    /// Name of the curve that is the inner circle of the ring, or a part of it.
    std::string inner_boundary;
    /// Name of the curve that is the outer circle of the ring, or a part of it.
    std::string outer_boundary;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks that the boundaries of the ring are named. @throws InputError otherwise.
    void
    check() const;
  };


  /// The names in the lists of a scene, which decide what subsections there are.
  struct SceneNames
  {
    /// Names of the files with joints in `Traces`.
    std::vector<std::string> traces;
    /// Names of the sets in `Joint sets`.
    std::vector<std::string> joint_sets;
    /// Names of the places in `Regions`.
    std::vector<std::string> regions;
    /// Names of the local sizes in `Mathematical mesh`.
    std::vector<std::string> local_sizes;
    /// Names of the block meshes in `Covers`.
    std::vector<std::string> block_meshes;
    /// Names in `Materials`.
    std::vector<std::string> materials;
    /// Names in `Boundary conditions`.
    std::vector<std::string> boundary_conditions;
    /// Names in `Point forces`.
    std::vector<std::string> point_forces;
    /// Names in `Fixed points`.
    std::vector<std::string> fixed_points;
    /// Names in `Bolts`.
    std::vector<std::string> bolts;
    /// Names of the laws in `Contact`.
    std::vector<std::string> contact_laws;
    /// Names in `Obstacles`.
    std::vector<std::string> obstacles;
    /// Names in `Initial velocities`.
    std::vector<std::string> initial_velocities;
    /// Names in `Probes`.
    std::vector<std::string> probes;
    /// Names in `Stages`.
    std::vector<std::string> stages;

    /// An example name in each list, for the parameter reference.
    static SceneNames
    examples();

    /// Declares only the entries `Names`.
    static void
    declare(dealii::ParameterHandler &prm);

    /// Reads the entries `Names`. @throws InputError for a name that is given twice or contains a
    /// slash or an equals sign.
    void
    parse(dealii::ParameterHandler &prm);

    /// Removes all names of one section.
    void
    clear(const std::string &section);
  };


  /// The parameters of a scene: a member for each section of the file.
  struct SceneParameters
  {
    /// The section `Geometry`.
    GeometryParameters geometry;
    /// The subsections of `Traces`.
    std::vector<TraceParameters> traces;
    /// The subsections of `Joint sets`.
    std::vector<JointSet> joint_sets;
    /// The subsections of `Regions`.
    std::vector<RegionParameters> regions;
    /// The section `Mathematical mesh`.
    MathematicalMeshParameters mathematical_mesh;
    /// The section `Covers`.
    CoverParameters covers;
    /// The subsections of `Materials`.
    std::vector<Material> materials;
    /// The section `Model`.
    ModelParameters model;
    /// The section `In-situ stress`.
    InSituStressParameters in_situ_stress;
    /// The subsections of `Boundary conditions`.
    std::vector<BoundaryConditionParameters> boundary_conditions;
    /// The subsections of `Point forces`.
    std::vector<PointForceParameters> point_forces;
    /// The subsections of `Fixed points`.
    std::vector<FixedPointParameters> fixed_points;
    /// The subsections of `Bolts`.
    std::vector<BoltParameters> bolts;
    /// The section `Water`.
    WaterParameters water;
    /// The section `Contact`.
    ContactSectionParameters contact;
    /// The subsections of `Obstacles`.
    std::vector<ObstacleParameters> obstacles;
    /// The section `Time`.
    TimeParameters time;
    /// The section `Relaxation`.
    RelaxationSectionParameters relaxation;
    /// The section `Safety factor`.
    SafetyFactorSectionParameters safety_factor;
    /// The subsections of `Initial velocities`.
    std::vector<InitialVelocityParameters> initial_velocities;
    /// The subsections of `Stages`.
    std::vector<StageParameters> stages;
    /// The section `Solver`.
    LinearSolverParameters solver;
    /// The section `Load steps`.
    LoadStepParameters load_steps;
    /// The section `Newton`.
    NewtonSectionParameters newton;
    /// The section `Output`.
    OutputParameters output;
    /// The subsections of `Probes`.
    std::vector<Probe> probes;
    /// The section `Exact solution`.
    ExactSolutionParameters exact_solution;
    /// The section `Fracture`.
    FractureParameters fracture;

    /// Declares all parameters with their defaults, with a subsection for each of @p names.
    static void
    declare(dealii::ParameterHandler &prm, const SceneNames &names);

    /// Reads all parameters, which must have been declared with the same @p names.
    /// @throws InputError for a value that its section refuses.
    void
    parse(dealii::ParameterHandler &prm, const SceneNames &names);

    /// Checks the values of all parameters. What can be combined is checked by
    /// check_capabilities(). @throws InputError naming the parameter and its value.
    void
    check() const;

    /// What is allowed, but may not be meant.
    std::vector<std::string>
    notices() const;

    /// Whether any material of the scene can yield.
    bool
    has_inelastic_material() const;

    /// Whether the problem is nonlinear even for small displacements: with contact, bolts or stages,
    /// or with a material that yields.
    bool
    is_nonlinear() const;

    /// Whether checkpoints can be written and continued: in dynamic analyses with small or finite
    /// kinematics, and where cracks grow in a static analysis.
    bool
    may_be_continued() const;

  private:
    void
    list_entries(internal::Entries &entries, const SceneNames &names);

    /// The following functions check values that depend on those of other sections. @throws
    /// InputError otherwise.
    void
    check_analysis() const;
    void
    check_safety_factor() const;
    void
    check_stages() const;
    void
    check_bolts() const;
    void
    check_water() const;
    void
    check_output_quantities() const;
    void
    check_releases() const;
    void
    check_fracture() const;
    void
    check_gravity() const;
    void
    check_in_situ_stress() const;
  };
} // namespace NMM

#endif
