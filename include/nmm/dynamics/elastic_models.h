#ifndef nmm_dynamics_elastic_models_h
#define nmm_dynamics_elastic_models_h

#include <nmm/covers/aggregation.h>
#include <nmm/dynamics/loading.h>
#include <nmm/dynamics/mechanical_model.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/inelastic_terms.h>

#include <functional>
#include <memory>

namespace NMM
{
  /**
   * What bodies in `small` and `finite` kinematics share: consistent mass (8),
   * loads in time, releases, base acceleration.
   *
   * Lifetime: the elasticity must outlive this object. Its amplitudes are this
   * object's business from now on.
   */
  class ElasticModel : public MechanicalModel,
                       public SupportModel,
                       public SavedModel,
                       public BlockModel
  {
  public:
    using Vector = MechanicalModel::Vector;
    using Matrix = MechanicalModel::Matrix;

    const ModelLayout &
    layout() const override;

    std::uint64_t
    fingerprint() const override;

    const Matrix &
    mass() const override;

    const Matrix &
    tangent() const override;

    double
    force_scale() const override;

    void
    set_absent_blocks(const std::vector<bool> &is_absent) override;

    unsigned int
    n_blocks() const override;

    dealii::IndexSet
    absent_unknowns() const override;

    const std::vector<unsigned int> &
    blocks_of_unknowns() const override;

    void
    set_active_blocks(const std::vector<bool> &is_active,
                      const std::vector<bool> &is_held) override;

    std::vector<double>
    events() const override;

    void
    pass_events(double t) override;

  protected:
    /**
     * @p mass_quadrature: exact for degree 2p.
     * @throws InputError for a material without density, or a release of what is not
     * there.
     */
    ElasticModel(FiniteElasticity           &elasticity,
                 const QuadratureCollection &mass_quadrature,
                 Loading                     loading,
                 const GhostPenalty         *ghost_penalty);

    /// Amplitudes at @p t with releases, without loads if not @p with_loads.
    LoadAmplitudes
    amplitudes_at(double t, bool with_loads = true) const;

    /// Hand over to the elasticity; true if they differ from the last ones.
    bool
    set_amplitudes(const LoadAmplitudes &amplitudes);

    /// Are loads a function of time beside releases?
    bool
    loads_change() const;

    /// forces += scale * M a_g(t)
    void
    add_base_force(double t, double scale, Vector &forces) const;

    /// Another number whenever events or absent blocks have changed forces.
    unsigned int
    version() const
    {
      return n_passed + (loading.releases.size() + 1) * n_departures;
    }

    FiniteElasticity *elasticity;
    Loading           loading;
    Vector            zero;
    /// Owned unknowns of absent blocks.
    dealii::IndexSet absent;

  private:
    void
    check_loading() const;

    void
    set_blocks();

    void
    set_mass_of_translation();

    /// Number of passed events that changed something, and of calls of
    /// set_absent_blocks().
    unsigned int n_passed = 0, n_departures = 0;
    /// Empty on several ranks, or of a single block.
    std::vector<unsigned int> unknown_to_block;
    Matrix                    mass_matrix;
    Vector                    positions, mass_of_translation[2];
    ModelLayout               unknowns;
    LoadAmplitudes            current;
    double                    passed_until;
  };


  /// Total Lagrangian kinematics: FiniteElasticity in time. In conserving steps damping
  /// in proportion to the stiffness acts on rates of the Green-Lagrange strain of
  /// the material, not on turning, supports and ties.
  class FiniteModel : public ElasticModel,
                      public SteppedModel,
                      public TangentModel
  {
  public:
    using Vector = MechanicalModel::Vector;
    using Matrix = MechanicalModel::Matrix;

    /// See ElasticModel.
    FiniteModel(FiniteElasticity           &elasticity,
                const QuadratureCollection &mass_quadrature,
                Loading                     loading = {});

    const Matrix &
    stiffness_at_rest() override;

    bool
    set_stiffness_damping(double coefficient) override;

    ForceProperties
    force_properties() const override;

    Deformation
    assemble(const Vector &u,
             double        t,
             Tangent       tangent,
             const Vector *increment = nullptr) override;

    Deformation
    assemble_between(const Vector &begin,
                     const Vector &end,
                     double        t_0,
                     double        t_1,
                     Tangent       tangent) override;

    const Vector &
    residual() const override;

    Energies
    energies() const override;

    /// Displacement conditions and ties may not be missed by a good part of an element, see
    /// FiniteElasticity::largest_jump().
    StepFault
    find_fault(const Vector &end) override;

    double
    accept_step(const Vector &end, double t) override;

    void
    external_forces(const Vector &u, double t, Vector &forces) override;

    double
    work_of_supports(const Vector &u,
                     double        t,
                     double        t_0,
                     double        t_1) override;

    double
    work_of_supports_between(const Vector &begin,
                             const Vector &end,
                             const Vector &mean,
                             double        t_0,
                             double        t_1) override;

  private:
    double
    energy_of_conditions(const Vector &u, const LoadAmplitudes &amplitudes);

    Vector       sum, known_forces;
    unsigned int known_at  = 0;
    bool         has_known = false;
    bool         has_follower;
    /// Coefficient of the stiffness [s]; dissipated by the last assemble_between().
    double damping = 0., dissipated_between = 0.;
  };


  /**
   * Small displacements: FiniteElasticity linearized at u = 0,
   * @f[ r(u,t) = K u - f(t), @f]
   * with the geometric stiffness of initial stresses. Follower pressure keeps its
   * direction. K contains the conditions; the energy of conditions
   * therefore counts as strain energy u.K u / 2, and prescribed displacements as
   * loads. K changes with releases only; f is assembled when amplitudes change.
   *
   * Inelastic materials add their forces (InelasticTerms). assemble_between() takes the mean of
   * these forces at both ends of a step. What a step dissipates is the work of that mean less the
   * change of the stored energy, so that the energy balance closes. Damping in proportion to the
   * stiffness is that of the elastic solid.
   */
  class SmallModel : public ElasticModel, public SteppedModel
  {
  public:
    using Vector = MechanicalModel::Vector;
    using Matrix = MechanicalModel::Matrix;

    /// See ElasticModel.
    SmallModel(FiniteElasticity           &elasticity,
               const QuadratureCollection &mass_quadrature,
               Loading                     loading       = {},
               const GhostPenalty         *ghost_penalty = nullptr);
    ~SmallModel() override;

    const Matrix &
    stiffness_at_rest() override;

    const Matrix &
    tangent() const override;

    double
    force_scale() const override;

    void
    begin_step(const Vector &begin,
               const Vector &predicted,
               double        t,
               double        h) override;

    double
    accept_step(const Vector &end, double t) override;

    std::vector<char>
    internal_state() const override;

    void
    restore_internal_state(const std::vector<char> &state) override;

    /// Null: all materials are elastic.
    InelasticTerms *
    inelastic_terms() const;

    ForceProperties
    force_properties() const override;

    Deformation
    assemble(const Vector &u,
             double        t,
             Tangent       tangent,
             const Vector *increment = nullptr) override;

    Deformation
    assemble_between(const Vector &begin,
                     const Vector &end,
                     double        t_0,
                     double        t_1,
                     Tangent       tangent) override;

    const Vector &
    residual() const override;

    Energies
    energies() const override;

    void
    external_forces(const Vector &u, double t, Vector &forces) override;

    double
    work_of_supports(const Vector &u,
                     double        t,
                     double        t_0,
                     double        t_1) override;

  private:
    /// K and f for the time @p t.
    void
    update(double t);

    /// Elastic forces at the displacements in `owned`.
    void
    assemble_owned(double t);

    /// Add @p share of inelastic forces at @p u.
    Deformation
    add_inelastic(const Vector &u, double share, bool with_tangent);

    Vector                          owned, forces, load;
    unsigned int                    stiffness_at  = 0;
    bool                            has_stiffness = false, has_load = false;
    double                          strain_energy = 0.;
    std::unique_ptr<InelasticTerms> inelastic;
    /// With inelastic materials: that of the last assembly.
    const Matrix *current_tangent = nullptr;
    /// Inelastic forces [N/m] and energy [J/m] where the step begins, and u there.
    Vector forces_at_begin, begin_of_step;
    double energy_at_begin = 0.;
  };


  /// v(X) of the solid of a block (ManifoldMesh::block()) at X, interpolated at the
  /// covers' nodes; owned unknowns.
  MechanicalModel::Vector
  interpolate_velocity(
    const CoverSystem                                             &covers,
    const dealii::AffineConstraints<double>                       &constraints,
    const std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &,
                                             unsigned int block)> &velocity);


  /// Rigid motion of a block: translation [m/s] plus a turn with the angular
  /// velocity [rad/s], counter-clockwise, about a point.
  struct RigidVelocity
  {
    dealii::Tensor<1, 2> translation;
    double               angular_velocity = 0.;
    dealii::Point<2>     center;

    dealii::Tensor<1, 2>
    operator()(const dealii::Point<2> &x) const;
  };
} // namespace NMM

#endif
