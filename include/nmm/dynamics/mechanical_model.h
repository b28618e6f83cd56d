#ifndef nmm_dynamics_mechanical_model_h
#define nmm_dynamics_mechanical_model_h

#include <nmm/base/assembly.h>
#include <nmm/base/exceptions.h>
#include <nmm/base/step_fault.h>
#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <cstdint>
#include <string>
#include <vector>

namespace NMM
{
  /// Distribution of the unknowns of a model over ranks, and their constraints and positions.
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
  };


  /// Properties of a model's forces r(u, t) that solvers may exploit.
  struct ForceProperties
  {
    /// Whether r is linear in u and its tangent changes at events only.
    bool is_linear = false;
    /// @{
    /// Whether the tangents of assemble() and of assemble_between() are symmetric.
    bool is_symmetric = false, is_symmetric_between = false;
    /// @}
  };


  /**
   * The interface between time integration and a discretized body: unknowns u, the mass
   * matrix M and forces r in
   * @f[ M\ddot u + C\dot u + r(u,t) = 0,\qquad
   *     r = \text{internal forces} - \text{loads}. @f]
   * Unknowns come in pairs: u_{2k} and u_{2k+1} are the components [m] of the displacement of
   * the reference position X_k. Rigid motions are represented exactly.
   * Constrained unknowns follow from the layout's constraints; equations hold for free ones.
   *
   * Capabilities that only some models have are in interfaces of their own, from which such a
   * model is derived as well: SupportModel, SteppedModel, SavedModel, BlockModel, TangentModel.
   * Use model_interface() to get one of them.
   *
   * All quantities are per unit thickness. Functions are collective.
   */
  class MechanicalModel
  {
  public:
    /// Distributed vector of displacements [m], velocities [m/s] or forces [N/m].
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    /// Distributed sparse matrix of the unknowns.
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    virtual ~MechanicalModel() = default;

    /// The layout of the unknowns, which never changes.
    virtual const ModelLayout &
    layout() const = 0;

    /// M [kg/m]. The rows of constrained unknowns have an arbitrary diagonal entry.
    virtual const Matrix &
    mass() const = 0;

    /// The stiffness of the solid at u = 0, without loads and without supports, for Rayleigh damping
    /// [Pa]: supports that move would be held back by it. Overwrites tangent().
    virtual const Matrix &
    stiffness_at_rest() = 0;

    /// Properties of the forces at present; contact, for example, makes them nonlinear as soon as
    /// faces are near each other.
    virtual ForceProperties
    force_properties() const = 0;

    /// @name Forces. Displacements that are passed have the locally relevant unknowns.
    /// @{

    /// Assemble r(u, t) and K = dr/du at the time @p t [s]; see NonlinearSystem::assemble().
    virtual Deformation
    assemble(const Vector &u,
             double        t,
             Tangent       tangent,
             const Vector *increment = nullptr) = 0;

    /**
     * Assemble the conserving forces of a step from @p begin at @p t_0 to @p end at @p t_1. The
     * work of internal forces along (@p end - @p begin) is the change of the strain energy, and
     * they exert no moment in the mean position. Loads are those of the mean time. K is the
     * derivative with respect to the mean displacement at fixed @p begin.
     */
    virtual Deformation
    assemble_between(const Vector &begin,
                     const Vector &end,
                     double        t_0,
                     double        t_1,
                     Tangent       tangent) = 0;

    /// r of the last assembly on owned unknowns, 0 for constrained ones [N/m].
    virtual const Vector &
    residual() const = 0;

    /// K of the last assembly with a tangent [Pa].
    virtual const Matrix &
    tangent() const = 0;

    /// Magnitude of the forces that balance each other in the last assembly [N/m].
    virtual double
    force_scale() const = 0;

    /// Estimated norm of the rounding of residual() in the last assembly [N/m]; 0: it is not known.
    virtual double
    force_rounding() const
    {
      return 0.;
    }

    /// Stored energies of a model.
    struct Energies
    {
      /// Strain energy of the material [J/m].
      double strain = 0.;
      /// Energy of displacement conditions, ties, springs and contacts [J/m].
      double conditions = 0.;
    };

    /// Energies at the displacements of the last assemble(); undefined after assemble_between().
    virtual Energies
    energies() const = 0;

    /// Write the loads at @p u and @p t, inertia forces of a moving base included, into
    /// @p forces (owned unknowns) [N/m]. Invalidates residual().
    virtual void
    external_forces(const Vector &u, double t, Vector &forces) = 0;

    /// @}

    /// @name Parts of the layout
    /// @{

    /// ModelLayout::communicator.
    MPI_Comm
    communicator() const
    {
      return layout().communicator;
    }

    /// ModelLayout::locally_owned.
    const dealii::IndexSet &
    locally_owned() const
    {
      return layout().locally_owned;
    }

    /// ModelLayout::locally_relevant.
    const dealii::IndexSet &
    locally_relevant() const
    {
      return layout().locally_relevant;
    }

    /// ModelLayout::constraints.
    const dealii::AffineConstraints<double> &
    constraints() const
    {
      return *layout().constraints;
    }

    /// ModelLayout::reference_positions.
    const Vector &
    reference_positions() const
    {
      return *layout().reference_positions;
    }
    /// @}
  };


  /// The interface of models whose supports move or are removed.
  class SupportModel
  {
  public:
    /// See MechanicalModel::Vector.
    using Vector = MechanicalModel::Vector;

    virtual ~SupportModel() = default;

    /// Times at which forces jump, e.g. because a support is removed, in ascending order [s].
    virtual std::vector<double>
    events() const
    {
      return {};
    }

    /// Apply exactly the events up to and including the time @p t [s] to the forces of all
    /// following assemblies.
    virtual void
    pass_events(double /*t*/)
    {
    }

    /**
     * Work that supports do [J/m] by moving from their positions at @p t_0 to those
     * at @p t_1, with the forces at the displacements @p u and the time @p t. 0 if no prescribed
     * displacement changes. Invalidates the residual.
     */
    virtual double
    work_of_supports(const Vector & /*u*/,
                     double /*t*/,
                     double /*t_0*/,
                     double /*t_1*/)
    {
      return 0.;
    }

    /**
     * The same for a step from @p begin at @p t_0 to @p end at @p t_1 with the
     * forces of assemble_between(). The energy account is exact if the work of these forces and
     * this work add up to the change of the energy of conditions. Unless overridden, this is
     * work_of_supports() in the mean position @p mean.
     */
    virtual double
    work_of_supports_between(const Vector &begin,
                             const Vector &end,
                             const Vector &mean,
                             double        t_0,
                             double        t_1)
    {
      (void)begin;
      (void)end;
      return work_of_supports(mean, 0.5 * (t_0 + t_1), t_0, t_1);
    }
  };


  /// The interface of models whose forces depend on more than u and t, e.g. on the anchors of
  /// sticking contact points. Order of calls: begin_step(), assemblies, find_fault(), and
  /// accept_step() if the step is accepted; otherwise begin_step() again.
  class SteppedModel
  {
  public:
    /// See MechanicalModel::Vector.
    using Vector = MechanicalModel::Vector;

    virtual ~SteppedModel() = default;

    /// Prepare a step of @p h [s] from the displacements @p begin at the time @p t. @p predicted
    /// are approximate displacements at its end.
    virtual void
    begin_step(const Vector & /*begin*/,
               const Vector & /*predicted*/,
               double /*t*/,
               double /*h*/)
    {
    }

    /// For each block, whether it has a closed contact point at the beginning of the step. Empty:
    /// no block has, or all blocks are solved together.
    virtual std::vector<bool>
    pressed_blocks() const
    {
      return {};
    }

    /// Reason why the step to the displacements @p end must not be accepted, if any.
    virtual StepFault
    find_fault(const Vector & /*end*/)
    {
      return {};
    }

    /// Accept the step to the displacements @p end at the time @p t: the internal state becomes
    /// that at the end. Returns the energy that the model has dissipated in the step [J/m].
    virtual double
    accept_step(const Vector & /*end*/, double /*t*/)
    {
      return 0.;
    }
  };


  /// The interface of models whose state can be saved and restored.
  class SavedModel
  {
  public:
    virtual ~SavedModel() = default;

    /// A hash of unknowns, elements and materials, to verify that a saved state fits the model.
    /// It does not depend on the number of ranks.
    virtual std::uint64_t
    fingerprint() const
    {
      return 0;
    }

    /// All data besides u that a continuation needs, as bytes; the same on all ranks.
    virtual std::vector<char>
    internal_state() const
    {
      return {};
    }

    /// Restore what internal_state() of an equal model returned, on any number of ranks.
    virtual void
    restore_internal_state(const std::vector<char> & /*state*/)
    {
    }
  };


  /// The interface of models that distinguish blocks, which may leave the scene and be solved
  /// separately.
  class BlockModel
  {
  public:
    virtual ~BlockModel() = default;

    /**
     * Make blocks (ManifoldMesh::block(), by number) absent: from now on they exert and feel no
     * forces, they are not assembled, nothing touches them, and the energy that their contacts
     * held is lost. Their unknowns stay in the layout and are held where they are: their equations
     * keep the rows of mass(), with a right-hand side of zero. Empty: no block is absent.
     * @throws InputError if the model has no blocks.
     */
    virtual void
    set_absent_blocks(const std::vector<bool> &is_absent)
    {
      AssertThrow(is_absent.empty(),
                  InputError("Blocks are to leave a model that does not know "
                             "of any",
                             "",
                             "keep them"));
    }

    /// Number of blocks, absent ones included; 0 if the model has none.
    virtual unsigned int
    n_blocks() const
    {
      return 0;
    }

    /// Block of each owned unknown; empty if all unknowns are solved together. See
    /// NonlinearSystem::blocks_of_unknowns().
    virtual const std::vector<unsigned int> &
    blocks_of_unknowns() const
    {
      static const std::vector<unsigned int> none;
      return none;
    }

    /// From now on forces are needed in the rows of active blocks only (empty: all); other rows,
    /// energies and force_scale() are undefined. Blocks in @p is_held do not move: they are
    /// inactive, and take_touched_blocks() does not report them.
    virtual void
    set_active_blocks(const std::vector<bool> & /*is_active*/,
                      const std::vector<bool> & /*is_held*/)
    {
    }

    /// Blocks that are neither active nor held, and that have been in contact with an active one
    /// since the last call of this function.
    virtual std::vector<unsigned int>
    take_touched_blocks()
    {
      return {};
    }

    /// See NonlinearSystem::coupled_blocks(); for the tangent of assemble_between().
    virtual const std::vector<BlockPair> *
    coupled_blocks() const
    {
      return nullptr;
    }

    /// Owned unknowns of absent blocks.
    virtual dealii::IndexSet
    absent_unknowns() const
    {
      return dealii::IndexSet();
    }
  };


  /// The interface of models that can assemble the tangent of a time step with less work. All
  /// functions may be left to their defaults.
  class TangentModel
  {
  public:
    /// See MechanicalModel::Matrix.
    using Matrix = MechanicalModel::Matrix;

    virtual ~TangentModel() = default;

    /**
     * Let the forces of assemble_between() include stiffness-proportional damping with the
     * @p coefficient [s] from now on; SteppedModel::accept_step() returns the energy that it
     * dissipates. False if the model does not do so: the caller then adds damping by
     * stiffness_at_rest(), which does not rotate with a body.
     */
    virtual bool
    set_stiffness_damping(double /*coefficient*/)
    {
      return false;
    }

    /**
     * Let the next tangent of assemble_between() be multiplied by @p factor, and return the
     * matrix, to which the caller may add entries. This saves the caller a matrix of the same
     * size. Entries that the caller adds are lost when that row is reassembled, and stay
     * otherwise. Null if tangent() must not be changed; the factor is then 1. To be called before
     * each assembly.
     */
    virtual Matrix *
    tangent_to_add_to(double /*factor*/)
    {
      return nullptr;
    }

    /**
     * The tangent of the last assemble_between() if it was assembled as a body matrix instead of
     * tangent(). This happens only after tangent_to_add_to() has returned a matrix, and the caller
     * adds its entries to this one instead. Otherwise null.
     */
    virtual BodyMatrix *
    body_tangent()
    {
      return nullptr;
    }

    /// Tell the model that rows assembled so far need not be kept.
    virtual void
    forget_tangent()
    {
    }

    /// A number that changes whenever tangent() has a new sparsity pattern.
    virtual unsigned int
    pattern_version() const
    {
      return 0;
    }
  };


  /// Return an interface of @p model that not all models have, such as BlockModel. If the model
  /// does not have it, an object with the defaults is returned: no events, no blocks, no state.
  template <class Interface>
  Interface &
  model_interface(MechanicalModel &model)
  {
    static Interface none;
    auto *const      result = dynamic_cast<Interface *>(&model);
    return result == nullptr ? none : *result;
  }


  /// The same for a constant model.
  template <class Interface>
  const Interface &
  model_interface(const MechanicalModel &model)
  {
    static const Interface none;
    auto *const            result = dynamic_cast<const Interface *>(&model);
    return result == nullptr ? none : *result;
  }
} // namespace NMM

#endif
