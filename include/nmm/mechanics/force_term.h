#ifndef nmm_mechanics_force_term_h
#define nmm_mechanics_force_term_h

#include <nmm/base/assembly.h>
#include <nmm/base/step_fault.h>
#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>
#include <nmm/mechanics/force_sink.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace NMM
{
  class ByteReader;
  class ByteWriter;


  /// The description of the deformation.
  enum class Kinematics
  {
    /// Displacements are small: a linear problem if materials are elastic.
    small,
    /// Displacements and rotations are of any size, in total Lagrangian form.
    finite
  };


  /**
   * The unknowns of a body: their distribution over ranks, constraints, positions, masses and
   * blocks. They come in pairs: u_{2k} and u_{2k+1} are the components [m] of the displacement of
   * the reference position X_k. Rigid motions are represented exactly. Constrained unknowns follow
   * from the constraints; equations hold for free ones. All quantities are per unit thickness.
   */
  struct ModelLayout
  {
    /// Ranks that share the unknowns.
    MPI_Comm communicator = MPI_COMM_SELF;
    /// @{
    /// Unknowns that this rank owns, and those whose values it needs for an assembly.
    dealii::IndexSet locally_owned, locally_relevant;
    /// @}
    /// Constraints of u; their inhomogeneities do not change in time. Increments of u satisfy the
    /// homogeneous constraints.
    const dealii::AffineConstraints<double> *constraints = nullptr;
    /// Reference positions of the unknowns: entries 2k and 2k + 1 are the coordinates of X_k [m];
    /// owned unknowns.
    const dealii::TrilinosWrappers::MPI::Vector *reference_positions = nullptr;
    /// Mass matrix M [kg/m]. The rows of constrained unknowns have an arbitrary diagonal entry.
    /// Null for a solid at rest.
    const dealii::TrilinosWrappers::SparseMatrix *mass = nullptr;
    /// Number of blocks, absent ones included; 0 if there are none to distinguish.
    unsigned int n_blocks = 0;
    /// Block of each owned unknown; empty if all unknowns are solved together, as on several
    /// ranks. See NonlinearSystem::blocks_of_unknowns().
    std::vector<unsigned int> blocks_of_unknowns;
    /// Owned unknowns of absent blocks. Only this changes, see ForceTerm::set_presence().
    dealii::IndexSet absent_unknowns;
  };


  /// Properties of forces r(u, t) that solvers may exploit.
  struct ForceProperties
  {
    /// Whether r is linear in u, and its tangent changes at events only and not with the length of
    /// a step.
    bool is_linear = true;
    /// Whether the tangent of forces at one time is symmetric.
    bool is_symmetric = true;
    /// Whether that of conserving forces is.
    bool is_symmetric_between = true;
  };


  /// Which parts of a body are present.
  struct Presence
  {
    /// Events up to and including this time have happened [s].
    double events_passed = std::numeric_limits<double>::lowest();
    /**
     * For each block (ManifoldMesh::block()), whether it is absent; empty: none is. Absent blocks
     * exert and feel no forces, they are not assembled, nothing touches them, and the energy that
     * their contacts held is lost. Their unknowns stay where they are: their equations keep the
     * rows of the mass matrix, with a right-hand side of zero.
     */
    std::vector<bool> absent_blocks;
  };


  /// The beginning of a step.
  struct StepBegin
  {
    /// Displacements at the beginning, locally relevant unknowns [m].
    const dealii::TrilinosWrappers::MPI::Vector &u;
    /// Approximate displacements at the end [m].
    const dealii::TrilinosWrappers::MPI::Vector &predicted;
    /// Time at the beginning, and length of the step [s].
    double time, length;
    /// Forces out of balance at the beginning, see Account::imbalance [-].
    double imbalance;
    /// Whether this is a load step, whose time is the load factor. No imbalance is known then.
    bool is_at_rest = false;
  };


  /**
   * Displacements for which forces are assembled, either those at one time, or the conserving
   * forces of a step. The work of conserving internal forces along u_1 - u_0 is the change of the
   * strain energy, and they exert no moment in the mean position. Loads are then taken at the middle
   * of the step, and tangents are derivatives with respect to the mean displacement at fixed u_0.
   *
   * Trials of assemblies: statics and schemes with alpha_f = 0 use at(), generalized-alpha uses at()
   * with u and t at 1 - alpha_f, and the conserving scheme step(). Only step(), and the trials of
   * ForceTerm::commit() in motion, have a beginning.
   */
  struct Trial
  {
    /// See NonlinearSystem::Vector.
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Displacements u_1, locally relevant unknowns [m].
    const Vector *end = nullptr;
    /// Their time t_1 [s].
    double end_time = 0.;
    /// Displacements u_0 at the beginning of the step; null if there is none [m].
    const Vector *begin = nullptr;
    /// Their time t_0 [s].
    double begin_time = 0.;
    /// Whether the forces of the step are conserving ones.
    bool is_conserving = false;
    /// Derivative that is assembled as well.
    Tangent tangent = Tangent::none;
    /// See NonlinearSystem::assemble(); may be null.
    const Vector *increment = nullptr;
    /// Whether the energies of AssembledForces are wanted, which may cost a further evaluation.
    bool with_energies = true;
    /// Blocks that forces are wanted for; null: all. A term may ignore it.
    const BlockSelection *selection = nullptr;

    /// The value of `selection`.
    const BlockSelection &
    blocks() const
    {
      static const BlockSelection all;
      return selection == nullptr ? all : *selection;
    }

    /// Forces of the displacements @p u at the time @p t [s].
    static Trial
    at(const Vector &u,
       const double  t,
       const Tangent tangent   = Tangent::none,
       const Vector *increment = nullptr)
    {
      Trial trial;
      trial.end       = &u;
      trial.end_time  = t;
      trial.tangent   = tangent;
      trial.increment = increment;
      return trial;
    }

    /// The step from @p begin at @p t_0 to @p end at @p t_1 [s].
    static Trial
    step(const Vector &begin,
         const Vector &end,
         const double  t_0,
         const double  t_1,
         const bool    is_conserving)
    {
      Trial trial         = at(end, t_1);
      trial.begin         = &begin;
      trial.begin_time    = t_0;
      trial.is_conserving = is_conserving;
      return trial;
    }
  };


  /**
   * The sum of the forces r = internal forces - loads that terms have assembled. Each term adds
   * its own. Pointers are to data of the term that has assembled last; a term without a matrix of
   * its own leaves them alone and uses the sink. Numbers are those of all ranks together.
   */
  struct AssembledForces
  {
    /// r on owned unknowns, 0 for constrained ones [N/m].
    dealii::TrilinosWrappers::MPI::Vector *residual = nullptr;
    /// Magnitude of the forces that balance each other [N/m]: a term adds the square of its own
    /// and takes the root. What is added to the sink is counted already.
    double scale = 0.;
    /// Estimated norm of the rounding of the residual, added like the scale [N/m]; 0: it is not
    /// known.
    double rounding = 0.;
    /// @{
    /// Stored energies of the material, and of displacement conditions, ties, springs and
    /// contacts [J/m]. They are used if Trial::with_energies and not Trial::is_conserving; what is
    /// added otherwise is ignored.
    double strain_energy = 0., energy_of_conditions = 0.;
    /// @}
    /// Where terms with couplings add forces and tangent; null: no term has couplings.
    ForceSink *sink = nullptr;
    /// Matrices [kg/(m s)], whose patterns lie within that of the tangent. Their sum is C: the
    /// caller adds C times the velocity to the forces. A term appends its own in each assembly,
    /// and the dissipation is a part of its StepWork.
    std::vector<const dealii::TrilinosWrappers::SparseMatrix *> damping;

    /// K = dr/du of the last assembly with a tangent [Pa].
    const dealii::TrilinosWrappers::SparseMatrix *tangent = nullptr;
    /// `tangent`, if the caller may add entries to it, which saves another matrix. Such entries are
    /// lost when that row is reassembled, and stay otherwise. Null: it may not.
    dealii::TrilinosWrappers::SparseMatrix *writable_tangent = nullptr;
    /// K as a body matrix, if it was assembled as one instead; otherwise null.
    BodyMatrix *body_tangent = nullptr;
    /// A number that changes whenever K has a new sparsity pattern.
    unsigned int pattern_version = 0;
  };


  /// What the forces of a term do in a step, on all ranks together [J/m].
  struct StepWork
  {
    /// Work of loads, the inertia forces of a moving base included.
    double loads = 0.;
    /**
     * Work of supports that move from their positions at the beginning to those at the end. The
     * account of conserving forces is exact if their work and this one add up to the change of the
     * energy of conditions.
     */
    double supports = 0.;
    /// Energy that the term has dissipated.
    double dissipated = 0.;
  };


  /**
   * One kind of force on a body: a part of r in
   * @f[ M\ddot u + C\dot u + r(u,t) = 0. @f]
   * A term knows no other term and no solver. Order of calls: begin_step(), assemble() as often
   * as needed, find_fault(), and commit() if the step is accepted; otherwise begin_step() again.
   * A term that remembers nothing from step to step needs only assemble() and properties(), and
   * couplings() if it uses the sink. All functions are collective.
   *
   * Terms get no velocities: C is AssembledForces::damping. Another force that depends on the rate
   * uses (end - begin) / (end_time - begin_time) of a conserving step; other trials have no rate, and
   * it exerts no force in them.
   *
   * How to write one: derive a class from this one. Forces that do not depend on u are added to
   * AssembledForces::residual. A force that depends on the unknowns of a few covers, of whichever
   * blocks, names them in couplings(), and is added to AssembledForces::sink together with its
   * derivative. The positions of material points, and vectors between them, are functions of the
   * unknowns that material_point() makes: `d = material_point(covers, constraints, end, "The band")
   * - material_point(covers, constraints, start, "The band")`. See SpringTerm for more.
   * @code
   * class Band : public ForceTerm                    // a spring of the natural length 0
   * {
   * public:
   *   Band(const MaterialVector &d, const double k) : d(d), k(k) {}
   *
   *   std::vector<Unknowns>
   *   couplings() const override
   *   {
   *     return {d.unknowns};
   *   }
   *
   *   ForceProperties
   *   properties() const override
   *   {
   *     return {};                                   // linear and symmetric
   *   }
   *
   *   Deformation
   *   assemble(const Trial &trial, AssembledForces &sum) override
   *   {
   *     const auto end   = evaluate({d}, *trial.end)[0];
   *     const auto begin = trial.is_conserving ? evaluate({d}, *trial.begin)[0] : end;
   *     sum.sink->add(d, 0.5 * k * (begin + end), k * dealii::unit_symmetric_tensor<2>());
   *     sum.energy_of_conditions += 0.5 * k * end * end;
   *     return Deformation::admissible;
   *   }
   *
   * private:
   *   MaterialVector d;
   *   double         k;
   * };
   * @endcode
   * A term with stored energy adds it to AssembledForces::energy_of_conditions, and if
   * Trial::is_conserving the work of its forces is the change of that energy plus what commit()
   * returns as dissipated. For a spring that yields the mean of its forces at both ends does that: it
   * dissipates this mean times the plastic extension. In other schemes both differ by an error of the
   * scheme. A term whose tangent depends on the length of the step, as that of a dashpot, is not
   * linear (properties()). What is known of the kinematics, if it matters, is told to the
   * constructor. Where blocks may leave
   * or be removed, set_presence() notes which of MaterialVector::blocks are absent, and assemble()
   * leaves out what belongs to them.
   *
   * The same terms act in motion (MechanicalModel, TimeIntegrator) and at rest: NonlinearStatics
   * and ContactStatics take a list of them. At rest the time is the load factor, and Trial::begin
   * is null. relax() moves the model of a TimeIntegrator: steps are accepted on the way, so that
   * what yields or slides in an overshoot stays so. Scenes know bolts (BoltTerm), but neither
   * springs nor such terms of a program's own yet. In the library a term has a file of its own,
   * which source/mechanics/CMakeLists.txt and the table of files in elasticity_problem.h name, a
   * test in tests/dynamics and a file in doc/news.
   */
  class ForceTerm
  {
  public:
    /// Distributed vector of displacements [m] or forces [N/m].
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    /// Distributed sparse matrix of the unknowns.
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;
    /// Global numbers of unknowns.
    using Unknowns = std::vector<dealii::types::global_dof_index>;

    virtual ~ForceTerm() = default;

    /// Sets of free unknowns, in pairs 2k and 2k + 1, that one force of the term couples with each
    /// other, such as those of both ends of a spring; the same on all ranks. They are asked for
    /// once, by the constructor of MechanicalModel. Empty: the term does not use the sink.
    virtual std::vector<Unknowns>
    couplings() const
    {
      return {};
    }

    /// Prepare a step.
    virtual void
    begin_step(const StepBegin & /*step*/)
    {
    }

    /// Add the forces of a trial and, unless Trial::tangent is Tangent::none, their tangent to
    /// @p sum, which already contains those of the terms before this one.
    virtual Deformation
    assemble(const Trial &trial, AssembledForces &sum) = 0;

    /// Properties of the forces at present; contact, for example, makes them nonlinear as soon as
    /// faces are near each other.
    virtual ForceProperties
    properties() const = 0;

    /// Reason why the step to the displacements @p end must not be accepted, if any.
    virtual StepFault
    find_fault(const Vector & /*end*/)
    {
      return {};
    }

    /// Accept the step to Trial::end, and return its work. What the term remembers becomes that at
    /// Trial::end. It has to be computed from there: the last assembly may have been at another time
    /// (generalized-alpha schemes). The next assembly at the same displacements, with the new memory,
    /// gives the stored energy at the end of the step. Invalidates the residual.
    virtual StepWork
    commit(const Trial & /*step*/)
    {
      return {};
    }

    /// For each block, whether other blocks press on it at the beginning of the step. Empty: none is
    /// pressed, or all blocks are solved together.
    virtual std::vector<bool>
    pressed_blocks() const
    {
      return {};
    }

    /// Apply events, such as the removal of a support, and the absence of blocks to the forces of
    /// all following assemblies.
    virtual void
    set_presence(const Presence & /*presence*/)
    {
    }

    /// Forget what earlier steps have left, since NonlinearStatics::run() begins anew with the unloaded
    /// body.
    virtual void
    forget()
    {
    }

    /// @{
    /// Save and restore all that the term remembers (`archive &plastic_extension`, see
    /// nmm/base/archive.h); the same on all ranks. Otherwise a run that continues from a checkpoint
    /// begins with a term that remembers nothing.
    virtual void
    save(ByteWriter & /*archive*/) const
    {
    }

    virtual void
    restore(ByteReader & /*archive*/)
    {
    }
    /// @}

    /// Times at which the forces jump, e.g. because a support is removed [s].
    const std::vector<double> &
    events() const
    {
      return event_times;
    }

    /// A hash of what the forces depend on, to verify that a saved state fits, for example of all
    /// arguments of the constructor. It does not depend on the number of ranks. 0: the term is not
    /// verified, and a checkpoint of a body without it is accepted.
    std::uint64_t
    fingerprint() const
    {
      return hash;
    }

  protected:
    /// See events().
    std::vector<double> event_times;
    /// See fingerprint().
    std::uint64_t hash = 0;
  };
} // namespace NMM

#endif
