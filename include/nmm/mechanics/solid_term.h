#ifndef nmm_mechanics_solid_term_h
#define nmm_mechanics_solid_term_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/inelastic_terms.h>
#include <nmm/mechanics/loading.h>
#include <nmm/mechanics/mechanical_model.h>
#include <nmm/mechanics/solid_layout.h>

#include <functional>
#include <memory>
#include <optional>

namespace NMM
{
  /**
   * The force term of a solid: the common part of `small` and `finite` kinematics, with loads as
   * functions of time, releases, and the inertia forces of a moving base. The energy that inelastic
   * materials dissipate in a step of motion is the work of their forces minus the change of the
   * stored energy, so that the energy balance closes. See make_solid(), and
   * make_solid_at_rest() for statics, where the time is the load factor.
   *
   * Lifetime: the elasticity must outlive this object, and from then on only this object may set
   * its load amplitudes.
   */
  class SolidTerm : public ForceTerm
  {
  public:
    /// The unknowns of the solid, for a MechanicalModel.
    const ModelLayout &
    layout() const
    {
      return unknowns.unknowns();
    }

    void
    set_presence(const Presence &presence) override;

    /**
     * From now on let forces be damped as @p damping says. K(u = 0) is the stiffness without loads
     * and without supports, which would be held back where they move. It does not rotate with a
     * body. In finite kinematics conserving forces do (FiniteSolid) if @p is_conserving, and all
     * trials of steps must be so then.
     * @throws InputError for a negative coefficient.
     */
    virtual void
    damp(const RayleighDamping &damping, bool is_conserving);

    /// Evaluates inelastic materials at the beginning of a step of motion.
    void
    begin_step(const StepBegin &step) override;

    /// Work of loads and of supports, and energy that damping and inelastic materials dissipate.
    StepWork
    commit(const Trial &step) override;

    /// @{
    /// States of inelastic materials.
    void
    forget() override;

    void
    save(ByteWriter &archive) const override;

    void
    restore(ByteReader &archive) override;
    /// @}

    /// The theory whose forces these are.
    virtual Kinematics
    kinematics() const = 0;

    /// Forces of inelastic materials, or null if all materials are elastic.
    InelasticTerms *
    inelastic_terms() const
    {
      return inelastic.get();
    }

    /// The elasticity given to the constructor.
    FiniteElasticity &
    elasticity() const
    {
      return *elastic;
    }

    /// Residual of the solid alone at @p u and the time @p t [s], on owned unknowns [N/m].
    Vector
    residual_at(const Vector &u, double t);

    /// Energy stored in the material at @p u and the time @p t [J/m].
    double
    strain_energy_at(const Vector &u, double t);

    /// Whether supports that the last forces have are removed at the time @p t [s].
    bool
    loses_supports_at(double t) const;

  protected:
    /**
     * @p mass is the matrix of ModelLayout::mass, see make_mass_matrix(). TimeIntegrator needs it,
     * and so does a base that moves.
     * @throws InputError for the release of a load, or of a condition or fixed point that does not
     * exist, and for a base acceleration without mass.
     */
    SolidTerm(FiniteElasticity             &elasticity,
              Loading                       loading,
              std::shared_ptr<const Matrix> mass);

    /// Amplitudes at the time @p t [s], with the releases passed so far. Loads get the amplitude
    /// 0 unless @p with_loads.
    LoadAmplitudes
    amplitudes_at(double t, bool with_loads = true) const;

    /// Those of a step that conserves energy: loads have their amplitudes in the middle of the step,
    /// and prescribed displacements the mean of both ends.
    LoadAmplitudes
    amplitudes_between(double t_0, double t_1) const;

    /// Write the loads at @p u and @p t [s], inertia forces of a moving base included, into
    /// @p forces (owned unknowns) [N/m].
    virtual void
    external_forces(const Vector &u, double t, Vector &forces) = 0;

    /// Work that supports do [J/m] by moving from their positions at @p t_0 to those at @p t_1, with
    /// the forces at the displacements @p u and the time @p t [s].
    double
    work_of_supports(const Vector &u, double t, double t_0, double t_1);

    /// The same with the conserving forces of a step, which @p mean is the middle of.
    virtual double
    work_of_supports_between(const Trial &step, const Vector &mean) = 0;

    /// Energy of displacement conditions, ties and fixed points at @p u with the given amplitudes
    /// [J/m].
    virtual double
    energy_of_conditions(const Vector &u, const LoadAmplitudes &amplitudes) = 0;

    /// Set inelastic terms and fingerprint(); to be called at the end of constructors.
    void
    finish_construction();

    /// Whether the inelastic forces of a step are InelasticTerms::assemble() between both ends, not
    /// the mean of those at the ends.
    bool
    is_between(const Trial &step) const
    {
      return step.is_conserving && kinematics() == Kinematics::finite;
    }

    /// Work that supports do against the tractions of inelastic terms by moving from their positions
    /// at @p t_0 to those at @p t_1 [J/m].
    double
    work_on_inelastic(const InelasticTerms::Totals &totals,
                      double                        t_0,
                      double                        t_1) const;

    /// Pass amplitudes on to the elasticity. Returns whether they differ from the last ones.
    bool
    set_amplitudes(const LoadAmplitudes &amplitudes);

    /// Whether loads or prescribed displacements are given as functions of time.
    bool
    loads_change() const;

    /// Add @p scale times M a_g(t), a_g being the base acceleration, to @p forces [N/m].
    void
    add_base_force(double t, double scale, Vector &forces) const;

    /// A number that changes whenever forces or tangents that were known are no longer so.
    unsigned int
    version() const
    {
      return n_passed + (loading.releases.size() + 1) * n_changes;
    }

    /// C of damp(); null: it is 0.
    const Matrix *
    damping() const
    {
      return damping_matrix.get();
    }

    /// Forces of the solid.
    FiniteElasticity *elastic;
    /// Amplitudes, releases and base acceleration given to the constructor.
    Loading loading;
    /// The undeformed state: locally relevant unknowns, zero except for inhomogeneities of the
    /// constraints [m].
    Vector zero;
    /// Forces of inelastic materials; null if there are none.
    std::unique_ptr<InelasticTerms> inelastic;
    /// Inelastic forces at the beginning of the step [N/m].
    Vector forces_at_begin;

  private:
    void
    set_mass_of_translation();

    /// Makes `damping_matrix` for the blocks that are there.
    void
    make_damping_matrix();

    /// Work of loads and of supports in a step of motion.
    StepWork
    work_of(const Trial &step);

    /// Accepts the states at the end of a step of motion. Returns the energy that inelastic
    /// materials dissipate in it [J/m].
    double
    accept_inelastic(const Trial &step);

    /// Number of releases passed so far, and of changes of absent blocks, of supports, or of the
    /// tangent by damp().
    unsigned int n_passed = 0, n_changes = 0;
    SolidLayout  unknowns;
    /// The forces of a unit acceleration of the base [kg/m]; empty if the base does not move.
    Vector         mass_of_translation[2];
    LoadAmplitudes current;
    Presence       presence;
    /// See damping().
    std::unique_ptr<Matrix> damping_matrix;
    /// The coefficients with which it is made.
    RayleighDamping damping_by_matrix;
    /// Loads at the end of the last step that was committed [N/m] and its time [s], unless they
    /// have changed since.
    Vector                last_loads;
    std::optional<double> last_loads_at;
    /// Sums of inelastic terms, displacements [m] and time [s] at the beginning of the step.
    InelasticTerms::Totals totals_at_begin;
    Vector                 begin_of_step;
    double                 time_at_begin = 0.;
  };


  /// The term of a solid in total Lagrangian kinematics, see FiniteElasticity. In conserving steps
  /// stiffness-proportional damping acts on the rate of the Green-Lagrange strain, and hence
  /// neither on rigid rotation nor on supports and ties. Inelastic materials add their forces, and
  /// make all tangents unsymmetric.
  class FiniteSolid : public SolidTerm
  {
  public:
    /// See the constructor of SolidTerm for arguments and errors.
    explicit FiniteSolid(FiniteElasticity             &elasticity,
                         Loading                       loading = {},
                         std::shared_ptr<const Matrix> mass    = nullptr);

    void
    damp(const RayleighDamping &damping, bool is_conserving) override;

    Kinematics
    kinematics() const override
    {
      return Kinematics::finite;
    }

    ForceProperties
    properties() const override;

    Deformation
    assemble(const Trial &trial, AssembledForces &forces) override;

    /// A step is faulty if displacement conditions or ties are violated by a considerable part of
    /// the size of an element, see FiniteElasticity::largest_jump().
    StepFault
    find_fault(const Vector &end) override;

    StepWork
    commit(const Trial &step) override;

  private:
    void
    external_forces(const Vector &u, double t, Vector &forces) override;

    double
    work_of_supports_between(const Trial &step, const Vector &mean) override;

    double
    energy_of_conditions(const Vector         &u,
                         const LoadAmplitudes &amplitudes) override;

    Deformation
    assemble_elasticity(const Trial &trial);

    Vector       sum, known_forces;
    unsigned int known_at  = 0;
    bool         has_known = false;
    bool         has_follower;
    /// Coefficient of the stiffness in the damping [s], and the energy that damping dissipates in
    /// the step of the last conserving forces [J/m].
    double damping_between = 0., dissipated_between = 0.;
  };


  /**
   * The term of a solid with small displacements, see FiniteElasticity::assemble_linearized(),
   * @f[ r(u,t) = K u - f(t). @f]
   * Displacement conditions contribute to K, and prescribed displacements to f. K is assembled again
   * only when a support is released or a block leaves. f has two parts, that of the loads and that
   * of the supports, so that the work of each is known; a part is assembled again when its
   * amplitudes change.
   *
   * Inelastic materials add their forces (InelasticTerms). Conserving forces contain the mean of
   * these forces at both ends of a step. Stiffness-proportional damping uses the stiffness of the
   * elastic solid.
   */
  class SmallSolid : public SolidTerm
  {
  public:
    /// See the constructor of SolidTerm for arguments and errors.
    explicit SmallSolid(FiniteElasticity             &elasticity,
                        Loading                       loading = {},
                        std::shared_ptr<const Matrix> mass    = nullptr);
    ~SmallSolid() override;

    Kinematics
    kinematics() const override
    {
      return Kinematics::small;
    }

    /// The tangent is symmetric as long as nothing has yielded in the last assembly.
    ForceProperties
    properties() const override;

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

  private:
    /// A part of f [N/m], its scale [N/m] and the amplitudes that it was assembled for.
    struct Part
    {
      Vector         forces;
      double         scale = 0.;
      LoadAmplitudes amplitudes;
      bool           is_known = false;
    };

    void
    external_forces(const Vector &u, double t, Vector &forces) override;

    double
    work_of_supports_between(const Trial &step, const Vector &mean) override;

    double
    energy_of_conditions(const Vector         &u,
                         const LoadAmplitudes &amplitudes) override;

    /// Assemble a part of f unless it is known for these amplitudes.
    void
    update(Part &part, const LoadAmplitudes &amplitudes);

    /// Assemble K and f as far as they have changed.
    void
    update(const LoadAmplitudes &amplitudes);

    /// Compute the elastic forces at the displacements in `owned`.
    void
    assemble_owned(double t, const LoadAmplitudes &amplitudes);

    /// Add the energies of the material and of conditions at @p u.
    void
    add_energies(const Vector         &u,
                 const LoadAmplitudes &amplitudes,
                 AssembledForces      &sum);

    /// Magnitude of all forces of the solid at rest, in its reference position [N/m].
    double
    scale_at_rest() const;

    /// Add @p share times the inelastic forces at @p u to the forces, and their tangent and energy to
    /// @p sum.
    Deformation
    add_inelastic(const Vector    &u,
                  double           share,
                  bool             with_tangent,
                  AssembledForces &sum);

    Vector       owned, forces;
    unsigned int stiffness_at  = 0;
    bool         has_stiffness = false;
    /// Forces of initial stress, and these together with loads or with prescribed displacements.
    Part initial, with_loads, with_supports;
    /// Force scale of the last forces whose energies were computed, without inelastic terms [N/m].
    double elastic_scale = 0.;
  };


  /// The term of a solid in the given kinematics; see the constructor of SolidTerm.
  std::unique_ptr<SolidTerm>
  make_solid(FiniteElasticity                        &elasticity,
             Kinematics                               kinematics,
             Loading                                  loading = {},
             std::shared_ptr<const SolidTerm::Matrix> mass    = nullptr);


  /// The term of a solid at rest, whose time is the load factor: by it all loads and prescribed
  /// displacements are multiplied, and by their amplitudes @p full.
  std::unique_ptr<SolidTerm>
  make_solid_at_rest(FiniteElasticity     &elasticity,
                     Kinematics            kinematics,
                     const LoadAmplitudes &full = {});


  /// Interpolate a velocity field v(X) [m/s], given for each block (ManifoldMesh::block()), at the
  /// nodes of the covers. Returns owned unknowns, which satisfy @p constraints.
  ForceTerm::Vector
  interpolate_velocity(
    const CoverSystem                                             &covers,
    const dealii::AffineConstraints<double>                       &constraints,
    const std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &,
                                             unsigned int block)> &velocity);


  /// The velocity field of a rigid motion: a translation and a rotation about a point.
  struct RigidVelocity
  {
    /// Velocity of the point `center` [m/s].
    dealii::Tensor<1, 2> translation;
    /// Angular velocity, positive counter-clockwise [rad/s].
    double angular_velocity = 0.;
    /// Centre of the rotation [m].
    dealii::Point<2> center;

    /// Velocity at the point @p x [m/s].
    dealii::Tensor<1, 2>
    operator()(const dealii::Point<2> &x) const;
  };
} // namespace NMM

#endif
