#ifndef nmm_mechanics_mechanical_model_h
#define nmm_mechanics_mechanical_model_h

#include <nmm/mechanics/force_term.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class CoupledForces;
  } // namespace internal


  /**
   * The forces r(u, t) of a body as the sum of a list of terms, such as the solid (FiniteSolid,
   * SmallSolid), contact (ContactTerm) and springs (SpringTerm), which are called in the order of the
   * list:
   * @code
   * MechanicalModel model(solid.layout(), {&solid, &contact, &springs});
   * @endcode
   * What terms add to AssembledForces::sink is added last, and only if one of them has
   * ForceTerm::couplings(). Then it costs a copy of the residual in each assembly, and in those with
   * a tangent a copy of the tangent, unless it is a body matrix.
   *
   * Lifetime: layout and terms must outlive this object.
   */
  class MechanicalModel
  {
  public:
    /// See ForceTerm::Vector.
    using Vector = ForceTerm::Vector;
    /// See ForceTerm::Matrix.
    using Matrix = ForceTerm::Matrix;

    /// The sum of @p terms, the first of which is that of the solid. All blocks are there, and no
    /// event has happened.
    MechanicalModel(const ModelLayout &layout, std::vector<ForceTerm *> terms);
    ~MechanicalModel();

    /// The layout of the unknowns.
    const ModelLayout &
    layout() const
    {
      return *unknowns;
    }

    /// @{
    /// See ForceTerm; properties hold if all terms have them, the first fault is the result, and a
    /// block is pressed if a term says so.
    void
    begin_step(const StepBegin &step);

    Deformation
    assemble(const Trial &trial);

    ForceProperties
    properties() const;

    StepFault
    find_fault(const Vector &end);

    std::vector<bool>
    pressed_blocks() const;

    void
    forget();

    StepWork
    commit(const Trial &step);
    /// @}

    /// The sum of the last assembly.
    const AssembledForces &
    forces() const
    {
      return sum;
    }

    /// @{
    /// Change one part of the Presence.
    void
    pass_events(double t);

    void
    set_absent_blocks(const std::vector<bool> &is_absent);
    /// @}

    /// Times at which forces jump, in ascending order [s].
    std::vector<double>
    events() const;

    /// The hash of all terms, see ForceTerm::fingerprint().
    std::uint64_t
    fingerprint() const;

    /// What all terms save, as bytes.
    std::vector<char>
    internal_state() const;

    /// Restore what internal_state() of an equal model returned, on any number of ranks.
    void
    restore_internal_state(std::vector<char> state);

  private:
    const ModelLayout       *unknowns;
    std::vector<ForceTerm *> terms;
    Presence                 presence;
    AssembledForces          sum;
    /// What terms add to the sink; null: no term has couplings.
    std::unique_ptr<internal::CoupledForces> coupled;
  };
} // namespace NMM

#endif
