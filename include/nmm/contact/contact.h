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
    /// Of faces that no pair names.
    std::shared_ptr<const ContactLaw> law;
    /// The first one that fits holds.
    std::vector<ContactPair> pairs;
    /// Augmented Lagrangian: weighted penetration that is allowed, see Contact
    /// [m]; 0: the penalty method.
    double       penetration_tolerance = 0.;
    unsigned int max_augmentations     = 30;
    /// Distance within which faces are looked at [m]; 0: a tenth of the longest
    /// edge. No point may move further than this in a step.
    double reach = 0.;
    /// Gauss-Lobatto points on each piece of an edge, at least 2.
    unsigned int       n_points    = 4;
    ContactIntegration integration = ContactIntegration::length;
    /// Of two blocks the one with the lower number carries the contact points:
    /// the softer or finer one is the better choice. Empty: the block's number.
    std::vector<unsigned int> body_ranks;
    /// Whether points that cannot touch anything within a time step are left out of its
    /// assemblies. Without it results are the same, and assemblies take longer.
    bool skip_clear_points = true;

    /// @throws InputError naming the value.
    void
    check() const;

    /// Does any law have friction?
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
    /// Edge of the surface and parameter on it.
    unsigned int edge = invalid_index;
    double       s    = 0.;
    /// Reference length times the cosine of the angle between both faces [m];
    /// ContactIntegration::points: share of the vertex [-].
    double weight = 0.;
    /// Edge and parameter of the nearest point; invalid_index: none.
    unsigned int master = invalid_index;
    double       t      = 0.;
    /// Positive: open [m].
    double gap = 0.;
    /// By which slip has opened the faces: gap without pressure [m].
    double opening = 0.;
    /// Per reference length of the slave [Pa].
    double       pressure = 0., shear = 0.;
    ContactState state = ContactState::open;
    /// What the shear spring alone would exert [Pa], and whether the slip has just
    /// changed its sign from one iteration to the next.
    double spring_shear = 0.;
    bool   has_turned   = false;
    /// Edge and parameter at which it sticks.
    unsigned int stick_edge = invalid_index;
    double       stick_t    = 0.;
    /// Multiplier of the augmented Lagrangian [Pa].
    double multiplier = 0.;
    /// Of a joint whose strength has not been exceeded.
    bool is_bonded = false;
    /// Current position and normal of the master.
    dealii::Point<2>     x;
    dealii::Tensor<1, 2> normal;
  };


  /// Counts and sums over all ranks.
  struct ContactReport
  {
    unsigned int n_points = 0, n_open = 0, n_stick = 0, n_slip = 0;
    /// States that differ from those of the assembly before.
    unsigned int n_changes = 0;
    /// Points that stick because their bond holds.
    unsigned int n_bonded = 0;
    /// Of what presses, from the nearest face of the other body [m].
    double largest_penetration = 0.;
    /// Was it an assembly between two states, so that penetrations are means of both?
    bool is_between = false;
    /// Stored in springs [J/m].
    double energy = 0.;
    /// On the slaves [N/m].
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
   * q_max = p tan phi + c that point is dragged along (moving friction cone;
   * Wriggers & Krstulovic-Opara, ZAMM 80 (2000)). So the history is a
   * place, and nothing is lost when a point passes from one edge to the next.
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
   * It knows positions and normals, not materials. All per unit thickness.
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

    /// Obstacles move.
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

    /// No candidates on any rank: assemble() would add nothing.
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

    /// In a pattern that holds that of the elasticity, too.
    const Matrix &
    tangent() const;

    /// Who adds to it finds that gone from a row once that is assembled again.
    Matrix &
    tangent();

    /// Until the next assembly tangent() is that plus @p factor times @p matrix, whose pattern
    /// lies within its own, in the rows of active bodies: that of what is in contact.
    void
    add_to_tangent(const Matrix &matrix, double factor = 1.);

    /// Grows whenever the pattern of tangent() changes.
    unsigned int
    pattern_version() const;

    bool
    tangent_is_symmetric() const;

    /// Of the last assembly.
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

    /// By body: does anything press on it in the last assembly? On the points of this rank.
    std::vector<bool>
    pressed_bodies() const;

    /// The step that has begun goes to about @p u: what may touch on the way there will be
    /// in the pattern of the tangent, so that it need not be made anew in the course of
    /// the step. Without this, what may touch until the first assembly with a tangent.
    void
    expect(const Vector &u);

    /// Largest way of a point of a face between two displacements [m].
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
     * @p tangent_factor: tangent() is that many times the derivative. @p body_matrix: to
     * which the tangent is added instead, and tangent() means nothing. On one rank, if
     * constraints couple no unknowns; its blocks are the blocks of the mesh.
     */
    void
    assemble_between(const Vector &end,
                     double        time,
                     bool          with_tangent,
                     double        tangent_factor = 1.,
                     BodyMatrix   *body_matrix    = nullptr);

    /// @name Blocks that are not moved for a while
    /// @{

    /// From now on assemblies leave points between bodies none of which
    /// is active as the last one found them, and leave the rows of others alone, or wrong.
    /// Those that are held do not count as touched(). By block; empty: all are
    /// active, none is held.
    void
    set_active_bodies(const std::vector<bool> &is_active,
                      const std::vector<bool> &is_held);

    /// Blocks that are neither active nor held and that touched an active one in an
    /// assembly since the last call.
    std::vector<unsigned int>
    take_touched();

    /// Of bodies with unknowns: what the last assemble_between() with a tangent has coupled
    /// in rows of active ones, some perhaps several times. One rank.
    const std::vector<BlockPair> &
    coupled_bodies() const;
    /// @}

    /// Work that moving obstacles do [J/m] with the forces of the last assembly
    /// from @p time_begin to @p time_end.
    double
    work_of_obstacles(double time_begin, double time_end);
    /// @}

    /// Why a step from detect() to @p end, at the time that is set, is not to be trusted: points
    /// that moved further than faces were looked for, penetrate half as far, or have passed
    /// through a body on the way. The last assembly was that of @p end.
    StepFault
    find_fault(const Vector &end);

    /// What is remembered of the last accepted state. Collective.
    ContactHistory
    history() const;

    /**
     * From now on these bodies of the surface are not there, see
     * ContactSurface::set_absent_bodies(). What springs against them stored at the last
     * accepted state is forgotten, and does not count as dissipated. detect() has to be called
     * before the next assembly, unless the same bodies were absent before.
     */
    void
    set_absent_bodies(const std::vector<bool> &is_absent);

    /// Take over what history() returned, on any number of ranks.
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
