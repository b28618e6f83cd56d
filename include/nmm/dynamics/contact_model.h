#ifndef nmm_dynamics_contact_model_h
#define nmm_dynamics_contact_model_h

#include <nmm/contact/contact.h>
#include <nmm/dynamics/mechanical_model.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The removal of a rigid obstacle at a time, together with its contacts. The energy that their
   * penalty springs hold then is counted as (negative) external work.
   */
  struct ObstacleRelease
  {
    /// Index into ContactSurface::obstacles().
    unsigned int obstacle = 0;
    /// Time of the removal [s].
    double time = 0.;
  };


  /**
   * A mechanical model with contact between its faces: forces, energies and tangent are those of
   * the model plus those of a Contact. Obstacles have their positions at the current time.
   * Candidate pairs are searched for at the beginning of each step, within the distance that the
   * step may cover. While there are none, forces and tangent are those of the model alone, and a
   * linear model remains linear.
   *
   * Energies: the energy of the contacts' penalty springs counts as `conditions`, friction as
   * dissipated energy, the work of moving obstacles as work of supports. With
   * TimeScheme::energy_momentum() contact forces conserve energy, too (see
   * ContactTimeStep::assemble()). With other schemes, points that come into contact gain or lose
   * energy, as usual with penalties.
   *
   * Lifetime: model and contact must outlive this object. Multipliers of the contact
   * are not updated.
   */
  class ContactModel : public MechanicalModel,
                       public SupportModel,
                       public SteppedModel,
                       public SavedModel,
                       public BlockModel,
                       public TangentModel
  {
  public:
    /// See MechanicalModel::Vector.
    using Vector = MechanicalModel::Vector;
    /// See MechanicalModel::Matrix.
    using Matrix = MechanicalModel::Matrix;

    /// Add @p contact, which was made for the same unknowns, to @p model. @p releases may have
    /// any order.
    ContactModel(MechanicalModel             &model,
                 Contact                     &contact,
                 std::vector<ObstacleRelease> releases = {});
    ~ContactModel() override;

    const ModelLayout &
    layout() const override;

    std::uint64_t
    fingerprint() const override;

    const Matrix &
    mass() const override;

    /// The stiffness of the model without contact [Pa].
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

    const Matrix &
    tangent() const override;

    Matrix *
    tangent_to_add_to(double factor) override;

    /// The tangent as a body matrix if all blocks are small (BodyMatrix::is_suitable()) and only
    /// contact couples them; null otherwise, or if there are no candidate pairs.
    BodyMatrix *
    body_tangent() override;

    void
    forget_tangent() override;

    unsigned int
    pattern_version() const override;

    double
    force_scale() const override;

    double
    force_rounding() const override;

    Energies
    energies() const override;

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

    void
    begin_step(const Vector &begin,
               const Vector &predicted,
               double        t,
               double        h) override;

    StepFault
    find_fault(const Vector &end) override;

    double
    accept_step(const Vector &end, double t) override;

    std::vector<char>
    internal_state() const override;

    void
    restore_internal_state(const std::vector<char> &state) override;

    /// Continue with the @p history of contact only, e.g. the one that carry_history() returns.
    void
    restore_history(const ContactHistory &history);

    void
    set_absent_blocks(const std::vector<bool> &is_absent) override;

    unsigned int
    n_blocks() const override;

    dealii::IndexSet
    absent_unknowns() const override;

    std::vector<bool>
    pressed_blocks() const override;

    const std::vector<unsigned int> &
    blocks_of_unknowns() const override;

    void
    set_active_blocks(const std::vector<bool> &is_active,
                      const std::vector<bool> &is_held) override;

    std::vector<unsigned int>
    take_touched_blocks() override;

    const std::vector<BlockPair> *
    coupled_blocks() const override;

    std::vector<double>
    events() const override;

    void
    pass_events(double t) override;

    /// Energy that friction, dashpots and breaking bonds dissipated in the last accepted step
    /// [J/m].
    double
    dissipated_by_contact() const;

    /// The contact given to the constructor, in the state of the last assembly.
    const Contact &
    contact() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;

    /// Pass the absent blocks and removed obstacles on to the contact.
    void
    take_bodies_away();
  };
} // namespace NMM

#endif
