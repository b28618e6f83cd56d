#ifndef nmm_contact_contact_h
#define nmm_contact_contact_h

#include <nmm/base/step_fault.h>
#include <nmm/contact/contact_history.h>
#include <nmm/contact/contact_integration.h>
#include <nmm/contact/contact_law.h>
#include <nmm/contact/contact_surface.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// The law of two faces, which may be the same one.
  struct ContactPair
  {
    /// Names of curves or obstacles; empty: any.
    std::string                       first, second;
    std::shared_ptr<const ContactLaw> law;
  };


  struct ContactParameters
  {
    /// The law of faces that no pair names.
    std::shared_ptr<const ContactLaw> law;
    /// Laws between certain faces; the first pair that fits is used.
    std::vector<ContactPair> pairs;
    /// Augmented Lagrangian: the weighted penetration that is allowed [m], see Contact;
    /// 0 stands for the penalty method.
    double       penetration_tolerance = 0.;
    unsigned int max_augmentations     = 30;
    /// Candidate pairs of faces are searched for within this distance [m]; 0 stands for a tenth
    /// of the longest edge. No point may move further than this in a step.
    double reach = 0.;
    /// Gauss-Lobatto points on each piece of an edge, at least 2.
    unsigned int       n_points    = 4;
    ContactIntegration integration = ContactIntegration::length;
    /// Of two blocks the one with the lower rank is the slave, which carries the contact points;
    /// the softer or finer one is the better choice. Empty: a block's number is its rank.
    std::vector<unsigned int> body_ranks;
    /// Whether assemblies of a time step skip points that cannot touch anything within it.
    /// This changes the time that assemblies take, and no result.
    bool skip_clear_points = true;

    /// @throws InputError naming the value.
    void
    check() const;

    /// Whether any of the laws has friction.
    bool
    has_friction() const;
  };


  enum class ContactState
  {
    open,
    stick,
    slip
  };


  /// A point at which a slave edge may touch a master.
  struct ContactPoint
  {
    /// Slave edge of the surface, and the parameter of the point on it.
    unsigned int edge = invalid_index;
    double       s    = 0.;
    /// Reference length times the cosine of the angle between both faces [m];
    /// ContactIntegration::points: share of the vertex [-].
    double weight = 0.;
    /// Master edge and parameter of the nearest point on it; invalid_index if there is none.
    unsigned int master = invalid_index;
    double       t      = 0.;
    /// Distance from the master along its normal, negative for penetration [m].
    double gap = 0.;
    /// Gap at which the pressure vanishes, where dilation has opened the faces [m].
    double opening = 0.;
    /// Force per reference length of the slave [Pa].
    double       pressure = 0., shear = 0.;
    ContactState state = ContactState::open;
    /// Shear that the spring alone would exert [Pa], and whether the slip changed its sign in the
    /// last iteration.
    double spring_shear = 0.;
    bool   has_turned   = false;
    /// Edge and parameter of the anchor, the material point of the master at which it sticks.
    unsigned int stick_edge = invalid_index;
    double       stick_t    = 0.;
    /// Multiplier of the augmented Lagrangian [Pa].
    double multiplier = 0.;
    /// Whether the point belongs to a bonded joint whose strength has not been exceeded.
    bool is_bonded = false;
    /// Current position of the point, and normal of the master there.
    dealii::Point<2>     x;
    dealii::Tensor<1, 2> normal;
  };


  /// Counts and sums over all ranks.
  struct ContactReport
  {
    unsigned int n_points = 0, n_open = 0, n_stick = 0, n_slip = 0;
    /// Number of states that differ from those of the previous assembly.
    unsigned int n_changes = 0;
    /// Number of points that stick because their bond holds.
    unsigned int n_bonded = 0;
    /// Largest penetration over all closed points, from the nearest face of the other body [m].
    double largest_penetration = 0.;
    /// Whether it was an assembly between two states, so that penetrations are means of both.
    bool is_between = false;
    /// Energy that is stored in springs [J/m].
    double energy = 0.;
    /// Sum of the forces on the slaves [N/m].
    dealii::Tensor<1, 2> force;
  };


  /**
   * Contact of the faces of a ContactSurface: penalty springs normal to the master,
   * eq. (13), and along it, (h), with Coulomb's friction (14), integrated along the slave
   * edges by Gauss-Lobatto points so that corners are points too:
   * @f[ \Pi = \sum_q w_q\left(\tfrac{1}{2\epsilon_n}\langle\lambda - \epsilon_n
   *     g\rangle_+^2 + \tfrac{\epsilon_t}{2} g_t^2\right). @f]
   * Edges are divided where the other side's edges end, so that the
   * rule is exact. The paper has springs at corners only, see ContactIntegration; here
   * their stiffness is per length, and refinement does not change it.
   *
   * Friction: the shear at a point is eps_t times the distance, along the
   * master, from the material point of the master where it sticks; beyond
   * q_max = p tan phi + c that anchor is dragged along (moving friction cone;
   * Wriggers & Krstulovic-Opara, ZAMM 80 (2000)). So the history of a point is a place on the
   * master, and nothing is lost when the point passes from one edge to the next.
   *
   * Corners: faces that are nearly parallel touch along the length that they have in
   * common; a convex corner, of either side, that points at a face touches it as a point
   * with a weight of its own, and is pushed out through the face by which it came
   * in (Shi's entrance edge). Between 18 and 37 degrees one passes into the other. Where
   * an end of a master lies on a slave, that corner is the contact point, so that it may
   * slide along.
   *
   * Augmented Lagrangian (Uzawa's iteration; Alart & Curnier 1991): multipliers
   * lambda_i >= 0 of functions phi_i that are continuous and linear along the slave's
   * boundary, on stretches about as long as cells, grow by eps_n times the weighted
   * penetration
   * @f$ -\int g\,\phi_i\,ds / \int \phi_i\,ds @f$
   * until they change by less than eps_n times the tolerance.
   *
   * The class knows positions and normals, not materials. All quantities are per unit thickness.
   *
   * Order of calls. Each function asserts that it is called at one of the stages from which an
   * arrow leads to it; set_time() and functions that only tell something may be called at any.
   * @verbatim
   *   created <------------------------- set_absent_bodies(), from any stage
   *      | detect()
   *   detected <------------------------ detect(), from any stage
   *      |      \ begin_step()
   *      |       step_begun ----------------------------.
   *      |           | assemble()                       | assemble_between()
   *      | assemble()|                                  |
   *   assembled <----'  (assemble(), augment(): stays)  step_assembled  (assemble(),
   *      | accept()                                     |  assemble_between(): stays)
   *      |                                              | accept()
   *   accepted          (assemble(): assembled)         step_accepted   (assemble(): stays)
   * @endverbatim
   * Statics: detect(), then assemble() in each iteration, with detect() between them where
   * faces have moved far; accept() at the solution. Time steps: detect() and begin_step() at the
   * begin of the step, then assemble_between() (schemes that conserve energy) or assemble() in
   * each iteration; at the end assemble() there, and accept(); or begin_step() again.
   *
   * Lifetime: the surface and the constraints must outlive this object.
   */
  class Contact
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    Contact(ContactSurface                          &surface,
            const dealii::AffineConstraints<double> &constraints,
            const ContactParameters                 &parameters);
    ~Contact();

    /// Move the obstacles to where they are at @p time [s].
    void
    set_time(double time);

    /**
     * Static problems of small displacements: between two calls of detect() normals, tangents and
     * the places of masters stay what they are at the first assembly after it, which should be
     * at the same displacements. So forces are linear in the displacements as long as no point
     * opens, closes, sticks or slips anew, and what geometry changes, by as little as
     * displacements are small, follows when detect() is called again.
     */
    void
    freeze_geometry(bool is_frozen);

    /**
     * Find candidates and make contact points at the displacements @p u (locally
     * relevant). Multipliers and places of sticking are carried over. Faces are
     * looked for within the larger of @p least_reach [m] and the parameters' reach.
     */
    void
    detect(const Vector &u, double least_reach = 0.);

    /// Whether no rank has a candidate pair, so that assemble() would add nothing.
    bool
    is_idle() const;

    /**
     * Forces r = d Pi / du (owned unknowns, 0 for constrained ones) and, if
     * @p with_tangent, K = dr/du, at @p u (locally relevant).
     */
    void
    assemble(const Vector &u, bool with_tangent);

    const Vector &
    residual() const;

    /// dr/du; its sparsity pattern contains that of the elasticity, too.
    const Matrix &
    tangent() const;

    /// Entries that a caller adds are lost when their row is assembled again.
    Matrix &
    tangent();

    /// Add @p factor times @p matrix to the tangent, in the rows of active bodies, until the next
    /// assembly. The pattern of the matrix must lie within that of the tangent.
    void
    add_to_tangent(const Matrix &matrix, double factor = 1.);

    /// A number that grows whenever the sparsity pattern of tangent() changes.
    unsigned int
    pattern_version() const;

    bool
    tangent_is_symmetric() const;

    /// The report of the last assembly.
    const ContactReport &
    report() const;

    /// This rank's points, as of the last assembly.
    const std::vector<ContactPoint> &
    points() const;

    /// Take over pressures as multipliers, after an assemble() at a solution.
    /// Returns the largest change of a multiplier over eps_n where there is
    /// contact: the penetration that springs still held [m].
    double
    augment();

    /**
     * Break bonds whose strength the last assembly exceeds: those whose stress over
     * strength is at least @p share of the largest such ratio. What their springs held
     * counts as dissipated. Returns the number of points of all ranks.
     */
    unsigned int
    break_bonds(double share = 0.);

    /**
     * The last assembly was that of an accepted state: points stick from now
     * on where they are. Returns the work that friction and breaking bonds have
     * dissipated since the last accepted state [J/m].
     */
    double
    accept();

    /// @name Time steps that conserve energy
    /// @{

    /**
     * A step begins at @p u and the time @p time, where detect() was called. What is
     * found there must not bring energy with it: where the springs between
     * two bodies would store more than at the end of the step before, because places and
     * weights of points are others or faces come into sight that penetrate each
     * other already, their gaps at rest are moved by so much that they store the same.
     * Where they store less, the difference is dissipated.
     */
    void
    begin_step(const Vector &u, double time);

    /// For each body, whether it had a closed contact point of this rank in the last assembly.
    std::vector<bool>
    pressed_bodies() const;

    /// Say that the step that has begun goes to about @p u. The sparsity pattern of the tangent
    /// then has the couplings of all pairs that may touch on the way there, and need not be made
    /// anew within the step. Otherwise it has those of pairs that may touch until the first
    /// assembly with a tangent.
    void
    expect(const Vector &u);

    /// Largest distance that a point of a face moves between two displacements [m].
    double
    largest_motion(const Vector &from, const Vector &to);

    /**
     * Forces between the begin of the step and the displacements @p end at @p time,
     * acting in the mean position, so that they exert no moment: the pressure
     * @f[ \hat p = -\frac{V(g_1) - V(g_0)}{\delta},\quad
     *     V = \tfrac{\epsilon_n}{2}\langle -g\rangle_+^2,\quad
     *     \delta = n\cdot(\Delta x_s - \Delta x_m) @f]
     * does the work by which the energy of the springs changes (Laursen & Chawla, Int.
     * J. Numer. Methods Eng. 40 (1997) 863; Gonzalez 2000). Dashpots add
     * @f[ c\,(\langle -g_1\rangle - \langle -g_0\rangle)/h, @f] but not so much
     * that there would be tension: what they do is always a loss. In the same way the
     * shear of what sticks is the mean of the spring's at both ends of the slip
     * @f$s=\tau\cdot(\Delta x_s - \Delta x_m)@f$ and the dashpot's,
     * @f[ \hat q = q_0 + \tfrac{\epsilon_t}{2}s + \tfrac{c_t}{h}s, @f]
     * beginning with 0 where faces come into contact; beyond the strength it slides.
     * tangent() is the derivative by the mean displacement at given begin: of forces
     * in the mean position and gaps at the end, so it is not symmetric.
     * Multipliers are not used.
     * tangent() is multiplied by @p tangent_factor. If @p body_matrix is not null, the tangent is
     * added to it instead, and tangent() is undefined: on one rank, if constraints couple no
     * unknowns; its bodies are the blocks of the mesh.
     */
    void
    assemble_between(const Vector &end,
                     double        time,
                     bool          with_tangent,
                     double        tangent_factor = 1.,
                     BodyMatrix   *body_matrix    = nullptr);

    /// @name Inactive blocks, which do not move for a while
    /// @{

    /// From now on assemblies skip points between two inactive bodies, which stay as the last
    /// assembly found them; the rows of inactive bodies are undefined. Bodies that are held are
    /// not returned by take_touched(). One entry for each block; empty: all are active, and none
    /// is held.
    void
    set_active_bodies(const std::vector<bool> &is_active,
                      const std::vector<bool> &is_held);

    /// Blocks that are neither active nor held and that touched an active one in an assembly
    /// since the last call of this function.
    std::vector<unsigned int>
    take_touched();

    /// Pairs of bodies with unknowns that the last assemble_between() with a tangent has coupled
    /// in rows of active bodies; a pair may occur several times. For one rank.
    const std::vector<BlockPair> &
    coupled_bodies() const;
    /// @}

    /// Work that moving obstacles do [J/m] with the forces of the last assembly
    /// from @p time_begin to @p time_end.
    double
    work_of_obstacles(double time_begin, double time_end);
    /// @}

    /// The reason why a step from detect() to @p end, at the time that is set, must not be
    /// accepted: a point has moved further than the reach of the search, penetrates by half of
    /// it, or has passed through a body on the way. The last assembly must be that of @p end.
    StepFault
    find_fault(const Vector &end);

    /// The history of the last accepted state. Collective.
    ContactHistory
    history() const;

    /**
     * From now on these bodies of the surface are absent, see
     * ContactSurface::set_absent_bodies(). The energy that springs against them stored at the last
     * accepted state is lost and does not count as dissipated. detect() has to be called before
     * the next assembly, unless the same bodies were absent before.
     */
    void
    set_absent_bodies(const std::vector<bool> &is_absent);

    /// Restore what history() returned, on any number of ranks.
    void
    restore_history(const ContactHistory &history);

    const ContactParameters &
    parameters() const;

    const ContactSurface &
    surface() const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
