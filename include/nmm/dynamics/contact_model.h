#ifndef nmm_dynamics_contact_model_h
#define nmm_dynamics_contact_model_h

#include <nmm/contact/contact.h>
#include <nmm/dynamics/mechanical_model.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * A rigid obstacle that holds until a time and is gone from then on, with the
   * springs of its contacts: what they hold is taken out of the account as external
   * work.
   */
  struct ObstacleRelease
  {
    /// Index into ContactSurface::obstacles().
    unsigned int obstacle = 0;
    /// [s]
    double time = 0.;
  };


  /**
   * A mechanical model whose faces touch: forces, energies and tangent are those of
   * the model plus those of a Contact; obstacles are where they are at the time.
   * Candidates are looked for at the beginning of each step, as far as the step may
   * go. While there are none, it is the model alone, a linear one included.
   *
   * Energies: that of the contact's springs counts as `conditions`, friction as
   * dissipated, what moving obstacles do as work of supports. With
   * TimeScheme::energy_momentum() contact forces conserve, too (see
   * Contact::assemble_between()). Other schemes let points that
   * come into contact gain or lose energy, as penalties do.
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
    using Vector = MechanicalModel::Vector;
    using Matrix = MechanicalModel::Matrix;

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

    /// Without contact.
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

    /// If blocks are small, and nothing but contact couples them.
    BodyMatrix *
    body_tangent() override;

    void
    forget_tangent() override;

    unsigned int
    pattern_version() const override;

    double
    force_scale() const override;

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

    /// What friction, dashpots and breaking bonds dissipated in the step accepted last [J/m].
    double
    dissipated_by_contact() const;

    const Contact &
    contact() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;

    /// Tell the contact which blocks and obstacles are not there.
    void
    take_bodies_away();
  };
} // namespace NMM

#endif
