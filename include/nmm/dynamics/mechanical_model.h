#ifndef nmm_dynamics_mechanical_model_h
#define nmm_dynamics_mechanical_model_h

#include <nmm/base/exceptions.h>
#include <nmm/base/step_fault.h>
#include <nmm/base/types.h>
#include <nmm/linear_algebra/body_matrix.h>
#include <nmm/materials/hyperelasticity.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <cstdint>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * What time integration knows of a discretized body: unknowns u, the mass
   * matrix M and forces r in
   * @f[ M\ddot u + C\dot u + r(u,t) = 0,\qquad
   *     r = \text{internal forces} - \text{loads}. @f]
   * Unknowns come in pairs, u_{2k} and u_{2k+1} being the components [m] of what
   * moves with the reference position X_k; a rigid motion is exact in them.
   * Constrained unknowns follow from @p constraints(); equations hold for free ones.
   *
   * All quantities are per unit thickness. Functions are collective.
   */
  class MechanicalModel
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    virtual ~MechanicalModel() = default;

    /// @name Layout
    /// @{
    virtual MPI_Comm
    communicator() const = 0;

    virtual dealii::IndexSet
    locally_owned() const = 0;

    virtual dealii::IndexSet
    locally_relevant() const = 0;

    /// Homogeneous for increments; inhomogeneities hold from the start.
    virtual const dealii::AffineConstraints<double> &
    constraints() const = 0;

    /// X_k at the place of u_k [m]; owned unknowns.
    virtual const Vector &
    reference_positions() const = 0;

    /// The same number for the same unknowns, elements and materials only, on any
    /// number of ranks.
    virtual std::uint64_t
    fingerprint() const = 0;
    /// @}

    /// M [kg/m]; constrained unknowns have a diagonal entry that means nothing.
    virtual const Matrix &
    mass() const = 0;

    /// dr/du at u = 0 without loads, for Rayleigh damping [Pa]. Overwrites
    /// tangent().
    virtual const Matrix &
    stiffness_at_rest() = 0;

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

    /// Is r linear in u, with one tangent between events?
    virtual bool
    is_linear() const = 0;

    virtual bool
    tangent_is_symmetric() const = 0;

    /// The same for assemble_between().
    virtual bool
    tangent_between_is_symmetric() const = 0;

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

    /// Size of the forces in balance [N/m], of the last assembly.
    virtual double
    force_scale() const = 0;

    struct Energies
    {
      /// Stored in the material [J/m].
      double strain = 0.;
      /// Of displacement conditions, ties, springs and contacts [J/m].
      double conditions = 0.;
    };

    /// Of the last assemble(), not assemble_between().
    virtual Energies
    energies() const = 0;

    /// Loads, those of a moving base included, at @p u and @p t into @p forces
    /// (owned unknowns) [N/m]. Spoils residual().
    virtual void
    external_forces(const Vector &u, double t, Vector &forces) = 0;

    /**
     * Work that supports do [J/m] by moving from where they are at @p t_0 to where they
     * are at @p t_1, with forces at @p u and the time @p t. 0 if nothing prescribed
     * changes. Spoils residual().
     */
    virtual double
    work_of_supports(const Vector &u, double t, double t_0, double t_1) = 0;

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
    /// @}

    /// @name What forces depend on beside u and t, e.g. where contacts stick
    /// @{

    /// A step of @p h from @p begin at the time @p t is going to be tried, to about
    /// @p predicted.
    virtual void
    begin_step(const Vector & /*begin*/,
               const Vector & /*predicted*/,
               double /*t*/,
               double /*h*/)
    {
    }

    /// By block: does anything press on it where the step begins? Empty: nothing does, or
    /// blocks are not told apart.
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
    /// @}

    /// @name Blocks that have left
    /// @{

    /**
     * These blocks (ManifoldMesh::block(), by number) exert and feel no forces from
     * now on and are nowhere: nothing of theirs is assembled, nobody touches
     * them, what their contacts held is forgotten. Their unknowns
     * stay in the layout, held where they are: of their equations the rows of
     * mass() are left, with nothing on the other side. Empty: all
     * blocks are there. @throws InputError if the model has no blocks to leave.
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

    /// Blocks that there are, absent ones included; 0: there are none to leave.
    virtual unsigned int
    n_blocks() const
    {
      return 0;
    }

    /// Block of each owned unknown; empty: they are not told apart, see
    /// NonlinearSystem.
    virtual const std::vector<unsigned int> &
    blocks_of_unknowns() const
    {
      static const std::vector<unsigned int> none;
      return none;
    }

    /// From now on forces are needed in the rows of these blocks, and those of
    /// others may be wrong, as energies and force_scale() are. Empty: all.
    /// @p is_held: not active, and nobody wants to know who touches them.
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
      return dealii::IndexSet(locally_owned().size());
    }
    /// @}

    /// @name Events: times at which forces jump, e.g. a support is taken away
    /// @{

    /// Ascending.
    virtual std::vector<double>
    events() const = 0;

    /// From now on forces are those after the events up to and including @p t,
    /// and before all later ones.
    virtual void
    pass_events(double t) = 0;
    /// @}
  };
} // namespace NMM

#endif
