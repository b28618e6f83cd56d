#ifndef nmm_scene_scene_parameters_h
#define nmm_scene_scene_parameters_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/graded_mesh.h>
#include <nmm/covers/mathematical_mesh.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/mechanics/nonlinear_statics.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/output/probes.h>
#include <nmm/scene/scene_parameters_contact.h>
#include <nmm/scene/scene_parameters_covers.h>
#include <nmm/scene/scene_parameters_dynamics.h>
#include <nmm/scene/scene_parameters_fracture.h>
#include <nmm/scene/scene_parameters_geometry.h>
#include <nmm/solution/newton_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /// Where a graded mathematical mesh is to be fine.
  struct LocalSizeParameters
  {
    /// @throws InputError if what the type needs is missing.
    static void
    list_entries(internal::Entries &entries,
                 LocalSize         &local_size,
                 const std::string &name);
  };


  struct MathematicalMeshParameters
  {
    enum class Type
    {
      regular,
      graded,
      gmsh
    };

    Type                  type = Type::regular;
    RegularMeshParameters regular;
    GradedMeshParameters  graded;
    unsigned int          degree = 2;
    std::string           gmsh_file;

    void
    list_entries(internal::Entries              &entries,
                 const std::vector<std::string> &local_size_names);
    /// @p may_choose_size: a regular mesh need have no cell size.
    void
    check(bool may_choose_size) const;
  };


  struct MaterialParameters
  {
    static void
    list_entries(internal::Entries &entries, Material &material);
  };


  /// How the deformation is described.
  enum class Kinematics
  {
    /// Small displacements: one linear problem, StaticElasticity or SmallModel.
    small,
    /// Total Lagrangian, exact under rotation: FiniteElasticity.
    finite,
    /// One linear problem per load step: IncrementalElasticity.
    incremental
  };

  /// Its name in scene files.
  const std::string &
  to_string(Kinematics kinematics);


  struct ModelParameters
  {
    Kinematics           kinematics  = Kinematics::small;
    PlaneState           plane_state = PlaneState::plane_stress;
    double               thickness   = 1.;
    dealii::Tensor<1, 2> gravity;
    /// "fx; fy", expressions of x and y; empty: none.
    std::string body_force;
    Analysis    analysis = Analysis::statics;
    /// See TimeDependence::amplitude.
    std::string gravity_amplitude, body_force_amplitude;
    /// "ax; ay", each as an amplitude [m/s^2]; empty: none.
    std::string base_acceleration;

    void
    list_entries(internal::Entries &entries);
  };


  struct BoundaryConditionParameters
  {
    std::string name;
    /// Curves of the geometry.
    std::vector<std::string> boundaries;
    BoundaryCondition::Type  type = BoundaryCondition::Type::traction;
    /// Expressions of x and y, separated by semicolons.
    std::string         value;
    std::array<bool, 2> components = {{true, true}};
    TimeDependence      time;

    void
    list_entries(internal::Entries &entries);
    void
    check() const;
  };


  struct PointForceParameters
  {
    std::string    name;
    PointForce     force;
    TimeDependence time;

    void
    list_entries(internal::Entries &entries);
  };


  struct FixedPointParameters
  {
    std::string    name;
    FixedPoint     point;
    TimeDependence time;

    void
    list_entries(internal::Entries &entries);
  };


  struct SolverParameters
  {
    static void
    list_entries(internal::Entries      &entries,
                 LinearSolverParameters &parameters);
  };


  /// The section `Load steps`: load factors at which results are computed.
  struct LoadStepParameters
  {
    unsigned int n_steps  = default_n_steps;
    double       min_step = LoadSteps().min_step;
    /// Incremental kinematics: bound on the displacement of a step [m]; 0: none.
    double max_displacement = 0.;
    /// Load factors [-]; empty: n_steps equal steps up to 1.
    std::vector<double> load_factors;

    static constexpr unsigned int default_n_steps = 10;

    void
    list_entries(internal::Entries &entries);
    /// @throws InputError for a value that is not used.
    void
    check(Kinematics kinematics, Analysis analysis, bool is_nonlinear) const;

    LoadSteps
    load_steps() const;
  };


  /// The section `Newton`.
  struct NewtonSectionParameters
  {
    NewtonParameters newton;

    void
    list_entries(internal::Entries &entries);
    /// @throws InputError for a value that is not used.
    void
    check(Kinematics kinematics, Analysis analysis, bool is_nonlinear) const;
  };


  /// Which files are written, and how pictures look.
  struct OutputParameters : PictureParameters
  {
    bool fields = true;
    /// Fields and pictures of every so many steps too; 0: of the last one alone.
    unsigned int fields_every = 0;
    /// contacts.csv.
    bool contacts = true;
    /// A checkpoint after every so many steps; 0: none.
    unsigned int checkpoint_every = 0;
    /// With a series of pictures: animation.html as well.
    bool        animation = true;
    bool        picture   = true;
    std::string title;

    void
    list_entries(internal::Entries &entries);
    void
    check() const;
  };


  struct ProbeParameters
  {
    /// @throws InputError for a line without length.
    static void
    list_entries(internal::Entries &entries, Probe &probe);
  };


  /**
   * The exact solution the results are compared with. The thick ring takes its
   * centre and radii from the two named curves, its pressures from the
   * conditions on them and its moduli from the material, so that nothing is
   * said twice.
   */
  struct ExactSolutionParameters
  {
    enum class Type
    {
      none,
      thick_ring
    };

    Type        type = Type::none;
    std::string inner_boundary, outer_boundary;

    void
    list_entries(internal::Entries &entries);
    void
    check() const;
  };


  /// The names in a scene's lists: what decides which subsections exist.
  struct SceneNames
  {
    std::vector<std::string> traces, joint_sets, regions, local_sizes,
      block_meshes, materials, boundary_conditions, point_forces, fixed_points,
      contact_laws, obstacles, initial_velocities, probes;

    /// One name each, for the parameter reference.
    static SceneNames
    examples();

    /// Declare the entries `Names` only.
    static void
    declare(dealii::ParameterHandler &prm);

    /// @throws InputError for a name given twice or with a slash in it.
    void
    parse(dealii::ParameterHandler &prm);
  };


  /// A whole scene file.
  struct SceneParameters
  {
    GeometryParameters                       geometry;
    std::vector<TraceParameters>             traces;
    std::vector<JointSet>                    joint_sets;
    std::vector<RegionParameters>            regions;
    MathematicalMeshParameters               mathematical_mesh;
    CoverParameters                          covers;
    std::vector<Material>                    materials;
    ModelParameters                          model;
    std::vector<BoundaryConditionParameters> boundary_conditions;
    std::vector<PointForceParameters>        point_forces;
    std::vector<FixedPointParameters>        fixed_points;
    ContactSectionParameters                 contact;
    std::vector<ObstacleParameters>          obstacles;
    TimeParameters                           time;
    RelaxationSectionParameters              relaxation;
    SafetyFactorSectionParameters            safety_factor;
    std::vector<InitialVelocityParameters>   initial_velocities;
    LinearSolverParameters                   solver;
    LoadStepParameters                       load_steps;
    NewtonSectionParameters                  newton;
    OutputParameters                         output;
    std::vector<Probe>                       probes;
    ExactSolutionParameters                  exact_solution;
    FractureParameters                       fracture;

    /// All parameters, with their defaults.
    static void
    declare(dealii::ParameterHandler &prm, const SceneNames &names);

    void
    parse(dealii::ParameterHandler &prm, const SceneNames &names);

    /// @throws InputError naming the parameter and its value.
    void
    check() const;

    bool
    has_inelastic_material() const;

    /// Whether small displacements make no linear problem: with contact, or a material that
    /// yields.
    bool
    is_nonlinear() const;

  private:
    void
    list_entries(internal::Entries &entries, const SceneNames &names);

    /// What cannot be had together with kinematics and analysis.
    void
    check_kinematics() const;
    void
    check_contact() const;
    void
    check_analysis() const;
    void
    check_safety_factor() const;
    void
    check_safety_output() const;
    void
    check_output_quantities() const;
    void
    check_loads_in_time() const;
    void
    check_restraints() const;
    void
    check_fracture() const;

    /// Is a mesh that is distributed among ranks one that may be?
    void
    check_distribution() const;
  };
} // namespace NMM

#endif
