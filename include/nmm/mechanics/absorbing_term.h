#ifndef nmm_mechanics_absorbing_term_h
#define nmm_mechanics_absorbing_term_h

#include <nmm/mechanics/force_term.h>
#include <nmm/mechanics/loading.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The force term of boundaries that absorb waves (BoundaryCondition::Type::absorbing). Beyond
   * them the solid goes on without end. With the density rho and the moduli of the element at the
   * boundary, of the undeformed state, the traction on the solid is
   * @f[ t = t_s + 2 Z v_i - Z v, \qquad
   *     Z = \rho\,(c_p\,n n^T + c_s\,(1 - n n^T)), \quad
   *     c_p^2 = \frac{\lambda + 2\mu}{\rho}, \quad c_s^2 = \frac{\mu}{\rho}, @f]
   * lambda being that of the plane state (Lysmer & Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969)
   * 859). A wave at normal incidence leaves without reflection, and a plane wave at 30 degrees to
   * the normal keeps up to 0.17 of its amplitude.
   *
   * The factor 2: an incoming wave of velocity v_i exerts the traction Z v_i. The dashpots hold it
   * back by the same, and the solid is moved by the wave alone only if twice its traction acts.
   * v_i is the velocity of the incoming wave, which is half of what a free surface that it reaches
   * shows. A value of the kind BoundaryCondition::Wave::stress is Z v_i itself, and is doubled in
   * the same way.
   *
   * The static part t_s, given by hold(), is what supports exerted before the motion. Their forces
   * on covers are kept, so that a solid in equilibrium stays at rest.
   *
   * Beside a free field (BoundaryCondition::Type::free_field), a vertical side, a column of the
   * ground moves by itself, with the layers of the elements at the side and the wave that comes in
   * at its base. With its velocity v_f and stress sigma_f, which are 0 before the motion,
   * @f[ t = t_s + \sigma_f n - Z (v - v_f), @f]
   * so that waves that go up pass along the side as if the ground had no end, and what comes from
   * within leaves (Wolf, Soil-structure-interaction analysis in time domain, 1988). The column
   * does not feel the solid; it is linear and elastic, see source/mechanics/free_field_column.h.
   *
   * Normals and areas are those of the reference configuration, in finite kinematics as well. Z v
   * is a part of C, see AssembledForces::damping, so that all schemes have it, and other damping
   * does not act on the boundary. Its dissipation is int v Z v. The work of all other parts is
   * that of loads.
   *
   * The term is one of motion only: while the solid is at rest, the boundaries are supports
   * (BoundaryCondition::is_support()), which a motion releases from its beginning, see
   * releases_of_absorbing(). In MechanicalModel it follows the term of the solid.
   *
   * Lifetime: the arguments of the constructor must outlive this object.
   */
  class AbsorbingTerm : public ForceTerm
  {
  public:
    /// @p amplitudes are Loading::amplitudes, those of incoming waves among them; may be empty.
    /// @p damping is that of the columns of free fields. Collective.
    /// @throws InputError for a free field on a side that is not vertical or has gaps.
    AbsorbingTerm(const CoverSystem                    &covers,
                  const ModelLayout                    &layout,
                  const ElasticityProblem              &problem,
                  std::function<LoadAmplitudes(double)> amplitudes,
                  const RayleighDamping                &damping = {});
    ~AbsorbingTerm() override;

    /// Set the forces of the supports that have been removed, as a part of r: owned unknowns [N/m].
    void
    hold(const Vector &forces);

    void
    begin_step(const StepBegin &step) override;

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

    ForceProperties
    properties() const override
    {
      return {};
    }

    StepWork
    commit(const Trial &step) override;

    void
    set_presence(const Presence &presence) override;

    /// @{
    /// The forces of hold(), and the motion of free fields.
    void
    save(ByteWriter &archive) const override;

    void
    restore(ByteReader &archive) override;
    /// @}

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };


  /// Whether any boundary of @p problem absorbs waves.
  bool
  has_absorbing_boundary(const ElasticityProblem &problem);


  /// Releases of the supports of absorbing boundaries that are in effect before any time.
  std::vector<Release>
  releases_of_absorbing(const ElasticityProblem &problem);
} // namespace NMM

#endif
