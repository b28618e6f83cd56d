#ifndef nmm_mechanics_static_system_h
#define nmm_mechanics_static_system_h

#include <nmm/mechanics/mechanical_model.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/solution/newton_solver.h>

#include <vector>

namespace NMM
{
  /**
   * The static equations of a solid and further force terms, such as contact or springs, in the form
   * that NewtonSolver solves. Their time is the load factor lambda.
   *
   * The forces r_0 by which an initial stress is out of balance without loads, such as at the wall of
   * an excavation, are released with the load factor, since friction and yielding depend on the
   * loading path:
   * @f[ r(u) = \sum_\mathrm{terms} r_i(u) - \langle 1 - \lambda\rangle_+\,r_0. @f]
   * So a state that is in balance with all loads stays at rest in all load steps. What has been
   * released is not held back again. r_0 is that of inelastic materials; ContactStatics holds the sum
   * of all terms, also the pretension of springs, if joints have an initial stress.
   *
   * Order of calls in a load step: begin_step(), assemble() as often as needed, commit() if the
   * step is accepted; otherwise begin_step() again.
   *
   * Lifetime: all terms must outlive this object.
   */
  class StaticSystem : public NonlinearSystem
  {
  public:
    /// The forces of @p solid and of @p others. Holds the initial stress of inelastic materials.
    /// @throws NumericalFailure if the initial stress of a material cannot be returned to its yield
    /// surface.
    explicit StaticSystem(SolidTerm                      &solid,
                          const std::vector<ForceTerm *> &others = {});

    /// The solid given to the constructor.
    SolidTerm &
    solid() const
    {
      return *solid_term;
    }

    /// Set the load factor of the next assemblies [-]; begin_step() does so, too.
    void
    set_load_factor(double load_factor);

    /// Begin the load step from the displacements @p u at the load factor @p from to the factor
    /// @p to, where they will be about @p predicted.
    void
    begin_step(const Vector &u,
               double        from,
               const Vector &predicted,
               double        to);

    Deformation
    assemble(const Vector         &u,
             Tangent               tangent,
             const Vector         *increment,
             const BlockSelection &blocks = {}) override;

    /// Let r_0 be the sum of all terms at the undeformed state @p u and the load factor 0.
    /// @throws NumericalFailure if it cannot be assembled.
    void
    hold_initial_forces(const Vector &u);

    /// Accept the step to @p u, whose forces were the last ones assembled: what terms remember becomes
    /// that at @p u. Returns what they did.
    StepWork
    commit(const Vector &u);

    /// Begin again in the undeformed state: terms forget theirs (ForceTerm::forget()), and r_0 is held
    /// again.
    void
    begin_anew();

  private:
    SolidTerm      *solid_term;
    MechanicalModel model;
    double          factor = 0., largest_factor = 0.;
    /// r_0 [N/m]; empty if nothing is held.
    Vector held_forces;
  };
} // namespace NMM

#endif
