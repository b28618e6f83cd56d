#ifndef nmm_mechanics_static_system_h
#define nmm_mechanics_static_system_h

#include <nmm/mechanics/mechanical_model.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/solution/newton_solver.h>

#include <optional>
#include <vector>

namespace NMM
{
  /**
   * What changes at the beginning of a stage, between two static equilibria: blocks are removed, as
   * by an excavation, supports are removed, and loads are added or taken away. The tractions that
   * removed blocks and supports exerted on the rest of the body do not vanish at once. A
   * share `released` of them is taken away in proportion to the load factor until the end of the
   * stage, and the rest is held until a later stage releases more: the load that the rock in front of
   * the face, or a support that is not modelled, still bears (the convergence-confinement method).
   */
  struct StageChange
  {
    /// Blocks (ManifoldMesh::block()) that are removed for good.
    std::vector<unsigned int> removed_blocks;
    /// Share of the tractions of all blocks and supports removed so far that is released at the end of
    /// the stage, from 0 to 1 [-]. Where more has been released before, it stays so: nothing is held
    /// again.
    double released = 1.;
    /// Loads and prescribed displacements at the end of the stage, which they reach in proportion to
    /// the load factor, and the supports that are gone from its beginning on; empty: they stay as
    /// they are. This is carried out by Equilibrium, and with equations of one's own by their Loading.
    std::optional<LoadAmplitudes> loads = std::nullopt;
  };


  /**
   * The static equations of a solid and further force terms, such as contact or springs, in the form
   * that NewtonSolver solves. Their time is the load factor lambda.
   *
   * The forces r_0 by which an initial stress is out of balance without loads, such as at the wall of
   * an excavation, are released with the load factor, since friction and yielding depend on the
   * loading path:
   * @f[ r(u) = \sum_\mathrm{terms} r_i(u) - \langle 1 - \lambda\rangle_+\,r_0
   *     - \sum_k h_k(\lambda)\,f_k. @f]
   * So a state that is in balance with all loads stays at rest in all load steps. f_k are the forces
   * out of balance when blocks or supports were removed, and h_k is the share of them that is still held, see
   * StageChange. What has been released is not held back again. r_0 is that of inelastic materials; ContactStatics holds the sum
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

    /// The sum of all terms at the undeformed state @p u and the load factor @p load_factor: what is
    /// out of balance there [N/m]. @throws NumericalFailure if it cannot be assembled.
    const Vector &
    initial_forces(const Vector &u, double load_factor);

    /// Let r_0 be the sum of all terms at the undeformed state @p u and the load factor 0.
    /// @throws NumericalFailure if it cannot be assembled.
    void
    hold_initial_forces(const Vector &u);

    /// Accept the step to @p u, whose forces were the last ones assembled: what terms remember becomes
    /// that at @p u. Returns what they did.
    StepWork
    commit(const Vector &u);

    /// Begin a stage that takes the load factor from @p begin to @p end, at the equilibrium @p u of
    /// the stage before. Supports are removed by the amplitudes of the solid's Loading at @p begin, which
    /// are those of the new stage.
    /// @throws InputError for a block that does not exist or is gone already, and for a share that is
    /// out of range, or that would change nothing since more of all blocks has been released. @throws NumericalFailure if forces cannot be assembled.
    void
    begin_stage(const StageChange &change,
                const Vector      &u,
                double             begin,
                double             end);

    /// Begin again in the undeformed state: terms forget theirs (ForceTerm::forget()), and r_0 is held
    /// again.
    void
    begin_anew();

  private:
    SolidTerm      *solid_term;
    MechanicalModel model;
    double          factor = 0., largest_factor = 0.;
    /// Forces of which a part still acts. This part changes linearly with the load factor, from
    /// `at_begin` where the stage begins to `at_end` where it ends [-].
    struct Held
    {
      Vector forces;
      double begin = 0., end = 1.;
      double at_begin = 1., at_end = 0.;

      /// The part that acts at a load factor [-].
      double
      share(double load_factor) const;
    };

    const Vector &
    assemble_residual(const Vector &u, double load_factor, const char *where);

    /// r_0 [N/m]; its forces are empty if nothing is held.
    Held initial;
    /// f_k [N/m].
    std::vector<Held> removed;
    std::vector<bool> is_removed;
  };
} // namespace NMM

#endif
