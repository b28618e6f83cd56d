#ifndef nmm_contact_assembly_term_h
#define nmm_contact_assembly_term_h

#include <nmm/contact/contact.h>
#include <nmm/mechanics/mechanical_model.h>

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


  /// When a contact term looks for the nearest place and the normal of the face that a point touches.
  enum class ContactUpdate
  {
    /// In each assembly: forces and tangents are exact. The only choice with conserving forces.
    every_iteration,
    /**
     * At the beginning of each step, as in discontinuous deformation analysis, as long as
     * StepBegin::imbalance is above 1e-4; see Contact::freeze_geometry(). The forces in a step are
     * then linear as long as no point changes its state. It is meant for relaxations: with exact
     * forces, points at corners pass from one face to another in the iterations of Newton's
     * method, which often finds no solution in networks of some hundred blocks. The forces
     * of accepted states are exact, so that rest does not depend on this choice. Near rest, steps
     * are exact as well: they are long, and loose blocks would pass to and fro between two faces.
     */
    every_step
  };


  /**
   * The force term of a Contact between the faces of a body. Obstacles have their positions at the
   * current time. Candidate pairs are searched for at the beginning of each step, within the
   * distance that the step may cover. While there are none, nothing is added, and linear forces
   * remain linear.
   *
   * Energies: the energy of the contacts' penalty springs is one of conditions, friction
   * dissipates, and moving obstacles are supports. Conserving forces
   * (Trial::is_conserving) conserve the energy of contact, too (see ContactTimeStep::assemble()). With other schemes, points that
   * come into contact gain or lose energy, as usual with penalties.
   *
   * Lifetime: layout and contact must outlive this object. Multipliers of the contact
   * are not updated.
   */
  class ContactTerm : public ForceTerm
  {
  public:
    /// Forces of @p contact, which was made for the unknowns of @p layout. @p releases may have
    /// any order.
    ContactTerm(const ModelLayout           &layout,
                Contact                     &contact,
                std::vector<ObstacleRelease> releases = {},
                ContactUpdate update = ContactUpdate::every_iteration);
    ~ContactTerm() override;

    void
    begin_step(const StepBegin &step) override;

    /// The tangent is a body matrix if that may be scaled, all blocks are small
    /// (BodyMatrix::is_suitable()) and only contact couples them.
    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

    ForceProperties
    properties() const override;

    StepFault
    find_fault(const Vector &end) override;

    StepWork
    commit(const Trial &step) override;

    void
    set_presence(const Presence &presence) override;

    void
    save(ByteWriter &archive) const override;

    void
    restore(ByteReader &archive) override;

    /// Continue with the @p history of contact only, e.g. the one that carry_history() returns.
    void
    restore_history(const ContactHistory &history);

    std::vector<bool>
    pressed_blocks() const override;

    /// Energy that friction, dashpots and breaking bonds dissipated in the last step [J/m].
    double
    dissipated() const;

    /// The contact given to the constructor, in the state of the last assembly.
    const Contact &
    contact() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
