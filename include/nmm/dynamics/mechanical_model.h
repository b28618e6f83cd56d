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
  /// Where the unknowns of a model are, and what holds for them whatever the forces.
  struct ModelLayout
  {
    MPI_Comm         communicator = MPI_COMM_SELF;
    dealii::IndexSet locally_owned, locally_relevant;
    /// Homogeneous for increments; inhomogeneities hold from the start.
    const dealii::AffineConstraints<double> *constraints = nullptr;
    /// X_k at the place of u_k [m]; owned unknowns.
    const dealii::TrilinosWrappers::MPI::Vector *reference_positions = nullptr;
  };


  /// What solvers may use of a model's forces r(u, t).
  struct ForceProperties
  {
    /// Whether r is linear in u, with one tangent between events.
    bool is_linear = false;
    /// Whether tangents of assemble() and of assemble_between() are symmetric.
    bool is_symmetric = false, is_symmetric_between = false;
  };


  /**
   * What time integration knows of a discretized body: unknowns u, the mass
   * matrix M and forces r in
   * @f[ M\ddot u + C\dot u + r(u,t) = 0,\qquad
   *     r = \text{internal forces} - \text{loads}. @f]
   * Unknowns come in pairs, u_{2k} and u_{2k+1} being the components [m] of what
   * moves with the reference position X_k; a rigid motion is exact in them.
   * Constrained unknowns follow from the layout's constraints; equations hold for free ones.
   *
   * What only some models have is in interfaces of their own, from which a model is derived as
   * well: SupportModel, SteppedModel, SavedModel, BlockModel, TangentModel. Who needs one asks
   * for it by model_interface().
   *
   * All quantities are per unit thickness. Functions are collective.
   */
  class MechanicalModel
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    virtual ~MechanicalModel() = default;

    virtual const ModelLayout &
    layout() const = 0;

    /// M [kg/m]; constrained unknowns have a diagonal entry that means nothing.
    virtual const Matrix &
    mass() const = 0;

    /// dr/du at u = 0 without loads, for Rayleigh damping [Pa]. Overwrites
    /// tangent().
    virtual const Matrix &
    stiffness_at_rest() = 0;

    /// Properties of the forces at present; contact, for example, makes them nonlinear as soon as
    /// faces are near each other.
    virtual ForceProperties
    force_properties() const = 0;

    /// @name Forces at displacements with locally relevant unknowns
    /// @{

    /// r(u, t) and K = dr/du; see NonlinearSystem::assemble().
    virtual Deformation
    assemble(const Vector &u,
             double        t,
             Tangent       tangent,
             const Vector *increment = nullptr) = 0;

    /**
     * Forces between the states @p begin at @p t_0 and @p end at @p t_1, loads
     * being those of the mean time: internal forces times (@p end - @p begin) is the
     * change of the strain energy and they exert no moment in the mean
     * position. K is the derivative by the mean displacement at given @p begin.
     */
    virtual Deformation
    assemble_between(const Vector &begin,
                     const Vector &end,
                     double        t_0,
                     double        t_1,
                     Tangent       tangent) = 0;

    /// r of the last assembly [N/m]; owned unknowns, 0 for constrained ones.
    virtual const Vector &
    residual() const = 0;

    virtual const Matrix &
    tangent() const = 0;

    /// Size of the forces in balance [N/m], of the last assembly.
    virtual double
    force_scale() const = 0;

    struct Energies
    {
      /// Stored in the material [J/m].
      double strain = 0.;
      /// Energy of displacement conditions, ties, springs and contacts [J/m].
      double conditions = 0.;
    };

    /// Energies at the last assemble(); assemble_between() does not change them.
    virtual Energies
    energies() const = 0;

    /// Loads, those of a moving base included, at @p u and @p t into @p forces
    /// (owned unknowns) [N/m]. Spoils residual().
    virtual void
    external_forces(const Vector &u, double t, Vector &forces) = 0;

    /// @}

    /// @name Parts of the layout
    /// @{
    MPI_Comm
    communicator() const
    {
      return layout().communicator;
    }

    const dealii::IndexSet &
    locally_owned() const
    {
      return layout().locally_owned;
    }

    const dealii::IndexSet &
    locally_relevant() const
    {
      return layout().locally_relevant;
    }

    const dealii::AffineConstraints<double> &
    constraints() const
    {
      return *layout().constraints;
    }

    const Vector &
    reference_positions() const
    {
      return *layout().reference_positions;
    }
    /// @}
  };


  /// A model whose supports move or are taken away.
  class SupportModel
  {
  public:
    using Vector = MechanicalModel::Vector;

    virtual ~SupportModel() = default;

    /// Times at which forces jump [s], e.g. a support is taken away; ascending.
    virtual std::vector<double>
    events() const
    {
      return {};
    }

    /// From now on forces are those after the events up to and including @p t,
    /// and before all later ones.
    virtual void
    pass_events(double /*t*/)
    {
    }

    /**
     * Work that supports do [J/m] by moving from where they are at @p t_0 to where they
     * are at @p t_1, with forces at @p u and the time @p t. 0 if nothing prescribed
     * changes. Spoils the residual.
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
     * forces of assemble_between(): the account is exact if these forces and this
     * work together make the change of the energy of conditions. Unless overridden,
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


  /// A model whose forces depend on more than u and t, e.g. on where contacts stick.
  class SteppedModel
  {
  public:
    using Vector = MechanicalModel::Vector;

    virtual ~SteppedModel() = default;

    /// A step of @p h from @p begin at the time @p t is going to be tried, to about
    /// @p predicted.
    virtual void
    begin_step(const Vector & /*begin*/,
               const Vector & /*predicted*/,
               double /*t*/,
               double /*h*/)
    {
    }

    /// For each block, whether it has a closed contact point where the step begins. Empty: none
    /// has, or all blocks are solved for together.
    virtual std::vector<bool>
    pressed_blocks() const
    {
      return {};
    }

    /// Why the step to @p end must not be accepted.
    virtual StepFault
    find_fault(const Vector & /*end*/)
    {
      return {};
    }

    /// The step to @p end at the time @p t is accepted. Returns the energy that
    /// the model has dissipated in it [J/m].
    virtual double
    accept_step(const Vector & /*end*/, double /*t*/)
    {
      return 0.;
    }
  };


  /// A model that can be saved and continued.
  class SavedModel
  {
  public:
    virtual ~SavedModel() = default;

    /// The same number for the same unknowns, elements and materials only, on any
    /// number of ranks.
    virtual std::uint64_t
    fingerprint() const
    {
      return 0;
    }

    /// All that a continuation needs beside u, as bytes; the same on all ranks.
    virtual std::vector<char>
    internal_state() const
    {
      return {};
    }

    virtual void
    restore_internal_state(const std::vector<char> & /*state*/)
    {
    }
  };


  /// A model that knows its blocks apart: they may leave, and be solved for one by one.
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

    /// Block of each owned unknown; empty if all are solved for together, see NonlinearSystem.
    virtual const std::vector<unsigned int> &
    blocks_of_unknowns() const
    {
      static const std::vector<unsigned int> none;
      return none;
    }

    /// From now on forces are needed in the rows of these blocks only (empty: all); other rows,
    /// energies and force_scale() are undefined. Blocks that @p is_held names are inactive, and
    /// take_touched_blocks() leaves them out.
    virtual void
    set_active_blocks(const std::vector<bool> & /*is_active*/,
                      const std::vector<bool> & /*is_held*/)
    {
    }

    /// Blocks that are neither active nor held and touched one that is since the last call.
    virtual std::vector<unsigned int>
    take_touched_blocks()
    {
      return {};
    }

    /// See NonlinearSystem, for assemble_between().
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


  /// A model that helps to save work where its tangent is made.
  class TangentModel
  {
  public:
    using Matrix = MechanicalModel::Matrix;

    virtual ~TangentModel() = default;

    /**
     * From now on the forces of assemble_between() shall be those of damping in
     * proportion to the stiffness, too, with the @p coefficient [s]; accept_step()
     * says what they dissipated. False if the model leaves that to its caller, who
     * has stiffness_at_rest() for it, which must not turn.
     */
    virtual bool
    set_stiffness_damping(double /*coefficient*/)
    {
      return false;
    }

    /**
     * From now on tangents of assemble_between() are multiplied by @p factor, and may be
     * added to: what was added is gone once a row is assembled again, and stays if
     * another one is. Null, and the factor 1, if tangent() is not to be changed. Saves its
     * caller a matrix of the same size. To be called before each assembly.
     */
    virtual Matrix *
    tangent_to_add_to(double /*factor*/)
    {
      return nullptr;
    }

    /**
     * The tangent of the last assemble_between() for a caller who was to add to it, as
     * said above, if that is a body matrix, and tangent() is not made; otherwise
     * null.
     */
    virtual BodyMatrix *
    body_tangent()
    {
      return nullptr;
    }

    /// Rows that have been assembled so far need not be kept.
    virtual void
    forget_tangent()
    {
    }

    /// Another number whenever tangent() has another pattern.
    virtual unsigned int
    pattern_version() const
    {
      return 0;
    }
  };


  /// An interface that not all models have. If @p model has not, its functions say so: there are
  /// no events, no blocks, nothing is remembered.
  template <class Interface>
  Interface &
  model_interface(MechanicalModel &model)
  {
    static Interface none;
    auto *const      result = dynamic_cast<Interface *>(&model);
    return result == nullptr ? none : *result;
  }


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
