#ifndef nmm_contact_contact_h
#define nmm_contact_contact_h

#include <nmm/base/step_fault.h>
#include <nmm/contact/assembly/report.h>
#include <nmm/contact/parameters.h>
#include <nmm/contact/state/history.h>
#include <nmm/contact/state/point.h>
#include <nmm/contact/surface/surface.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <vector>

/**
 * @file
 * The room `contact`: forces between faces that touch. What comes in are the covers of a solid, laws of
 * contact and, in each assembly, displacements; what goes out are forces, their tangent and reports. It
 * knows positions and normals, and no materials.
 *
 * | folder (in nmm/contact and source/contact) | what is there |
 * |---|---|
 * | surface | faces of the solid and of obstacles, their positions, those of a step (step_states.h), and the initial stress at them |
 * | detection | candidate pairs and contact points of a step (detection.h): broad phase (search.h), points (point_maker.h); the face that a point touches (narrow_phase.h, point_projector.h) and what the point takes over from it (point_updater.h); rules where faces end, with all their numbers (corner_rules.h); paths that cross within a step (crossings.h) |
 * | law | pressure and strength: the interface (law.h), a file for each law, and the list of them (registered_laws.cc); traction of a point by its law now (tractions.h) and in a step that conserves energy (step_tractions.h) |
 * | state | a contact point, what it remembers from step to step (memory.h), multipliers, and how an accepted state is kept (commit.cc) or carried to a solid that is cut again |
 * | assembly | one point from projection to forces (point_forces.cc), their formulas (point_terms.h), the matrix, sums over points, time steps that conserve energy (time_step.h), the force term (term.h) and statics (statics.h) |
 * | diagnostics | why a step must not be accepted, what gives way, corners that lock, overlaps |
 *
 * Order of calls: see Contact. To add a law, see ContactLaw.
 */
namespace NMM
{
  /**
   * Contact forces and their tangent between the faces of a ContactSurface. What comes in are
   * displacements of the covers and the time; what goes out are residual(), tangent(), report()
   * and points(). The class knows positions and normals, not materials. All quantities are per
   * unit thickness.
   *
   * Penalty springs act normal to the master, eq. (13), and along it, the paper's equation (h), with
   * Coulomb's friction (14). They are integrated along the slave edges by Gauss-Lobatto points, so
   * that the ends of edges are contact points, too:
   * @f[ \Pi = \sum_q w_q\left(\tfrac{1}{2\epsilon_n}\langle\lambda - \epsilon_n
   *     g\rangle_+^2 + \tfrac{\epsilon_t}{2} g_t^2\right). @f]
   * A slave edge is divided where edges of the other side end, so that the integrand is a
   * polynomial on each piece, and a round one into short pieces, so that bodies roll on their faces
   * and not on polygons. The paper has springs at corners only, see ContactIntegration; here
   * the stiffness is per length and does not depend on the mesh.
   *
   * Pressure and strength of each point are those of a ContactLaw; each pair of faces may have a law
   * of its own (ContactParameters::pairs). To add a law, see ContactLaw. The formulas here are those of
   * the default, CoulombLaw.
   *
   * Friction: the shear at a point is eps_t times its distance, along the master, from its anchor,
   * the material point of the master where it sticks. If the shear exceeds
   * the strength S the anchor is dragged along (moving friction cone; Wriggers &
   * Krstulovic-Opara, ZAMM 80 (2000)). The history of a point is thus a place on the master, and it
   * stays valid when the point passes from one edge to the next.
   *
   * Corners: faces that are nearly parallel touch along their common length. A convex corner of
   * either side that points at a face touches it as a point with a weight of its own, and is
   * pushed out through the face by which it came in (Shi's entrance edge). Between angles of 18 and
   * 37 degrees both kinds of contact are blended. Where an end of a master lies on a slave, that
   * corner is the contact point, so that it can slide along the slave.
   *
   * Initial stress sigma_0: a point of a slave with the outward normal n and the tangent a/|a| bears
   * in the reference configuration, as far as its strength allows,
   * @f[ p_0 = -n\cdot\sigma_0 n, \qquad q_0 = \frac{a}{|a|}\cdot\sigma_0 n. @f]
   * Its spring is at rest where the faces are V'^{-1}(p_0) apart, and q_0 is added to the shear of
   * the spring. Both are functions of the place on the slave and no history. Corners that touch as
   * points, and springs at vertices, bear none. With the augmented Lagrangian p_0 is added to the
   * multiplier instead.
   *
   * Augmented Lagrangian (Uzawa's iteration; Alart & Curnier 1991): the multipliers lambda_i >= 0
   * belong to functions phi_i that are continuous and linear along the slave's boundary, on
   * stretches about as long as cells. They grow by eps_n times the weighted penetration
   * @f$ -\int g\,\phi_i\,ds / \int \phi_i\,ds @f$
   * until they change by less than eps_n times the tolerance. Where C is the closure of the bodies
   * under a pressure of 1 Pa [m/Pa], an update leaves @f$ 1/(1+\varepsilon_n C) @f$ of a
   * penetration: most of it if springs are soft compared with bodies or cells. That ratio of two
   * updates gives C, and where it is above 1/4, the springs of the stretch become so stiff that it is
   * 1/10. The solution does not depend on them.
   *
   * Order of calls: both assemble(), ContactTimeStep::begin(), augment() and accept() assert (in
   * Debug mode) that they are called at a stage where they are allowed. The table has the stage
   * after the call, and "-" where the call is not allowed.
   * @verbatim
   *   created <----- restore_history(), freeze_geometry(true), set_absent_bodies() if there are
   *                  others than before, from any stage
   *
   *   detected <---- detect(), from any stage
   *
   *   step_begun <-- ContactTimeStep::begin(), from all but created and accepted
   *
   *   stage               assemble()   ContactTimeStep::   augment()   accept()
   *   before                           assemble()
   *   created             -            -                   -           -
   *   detected, accepted  assembled    -                   -           -
   *   step_begun          assembled    step_assembled      -           -
   *   step_assembled      assembled    step_assembled      -           -
   *   assembled           assembled    (step_assembled)    (assembled) accepted
   * @endverbatim
   * At the end of a step of ContactTimeStep::assemble(), that function may follow assemble(), and
   * augment() may not; elsewhere it is the other way round. All other functions may be called at
   * any stage; those that speak of the last assembly are meaningful from an assembly until the next
   * detect(). That an assembly before accept() is at the solution is up to the caller. Where
   * obstacles move, set_time() with the time of the displacements comes before each detect() and
   * assemble().
   *
   * Statics: detect(), then assemble() in each iteration, with detect() between them where
   * faces have moved far; at the solution augment() until it returns less than the tolerance,
   * break_bonds() and new iterations until it breaks none, and accept(). Time steps: detect() and
   * ContactTimeStep::begin() at the beginning of the step, then ContactTimeStep::assemble()
   * (schemes that conserve energy) or assemble() in each iteration; at the end of the step
   * assemble() and accept(), or begin() again if the step is repeated. ContactStatics and
   * ContactTerm make these calls:
   * @code
   * ContactSurface surface(covers);
   * CoulombLaw     law;
   * law.normal_stiffness = 1e11;
   * law.shear_stiffness  = 1e11;
   * law.friction         = std::tan(0.5);
   * ContactParameters parameters;
   * parameters.law = std::make_shared<CoulombLaw>(law);
   * Contact        contact(surface, constraints, parameters);
   * ContactStatics statics(solid, contact);
   * statics.run(LoadSteps::equal(10));
   * @endcode
   *
   * Lifetime: the surface and the constraints must outlive this object.
   */
  class Contact
  {
  public:
    /// Displacements and forces: two unknowns (x, y) for each cover.
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    /// The tangent, in the unknowns of Vector.
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// Contact at stage "created"; @p constraints are those of the unknowns of Vector.
    /// @throws InputError for bad parameters.
    Contact(ContactSurface                          &surface,
            const dealii::AffineConstraints<double> &constraints,
            const ContactParameters                 &parameters);
    ~Contact();

    /// Move the obstacles to their positions at @p time [s].
    void
    set_time(double time);

    /**
     * Linearize the geometry of contact, in static problems of small displacements, and in time
     * steps without conserving forces. Normals, tangents and nearest points are then those of the
     * first assembly after detect(), which should be at the displacements of detect(). Forces are
     * linear in the displacements as long as no point changes its state. The geometry is updated
     * when detect() is called again.
     *
     * In time steps, ContactLaw::cohesion_at() is that of the pressure at the beginning of the
     * step, and acts even if the point opens. Otherwise it changes from nothing to all
     * within a thousandth of its size in pressure, and points in networks of joints pass to and fro
     * between both in the iterations. Nothing is changed in steps with conserving forces.
     */
    void
    freeze_geometry(bool is_frozen);

    /**
     * Find candidate pairs and make contact points at the displacements @p u (locally relevant).
     * Multipliers and anchors are carried over. Faces of two bodies are searched for within the sum
     * of the reaches of both. The reach of a body is half of the parameters' one, or the larger
     * distance [m] that @p least_reaches has for it; these are given for all bodies of the surface
     * or for none.
     */
    void
    detect(const Vector &u, const std::vector<double> &least_reaches = {});

    /// Whether an assembly is possible without a new detect().
    bool
    is_detected() const;

    /// Whether no rank has a candidate pair, so that assemble() would add nothing.
    bool
    is_idle() const;

    /**
     * Forces r = d Pi / du (owned unknowns, 0 for constrained ones) and, if
     * @p with_tangent, K = dr/du, at @p u (locally relevant).
     */
    void
    assemble(const Vector &u, bool with_tangent);

    /// Contact forces r of the last assembly on owned unknowns [N/m].
    const Vector &
    residual() const;

    /// Estimated norm of the rounding of residual(): the root of the sum over all closed points of the
    /// square of stiffness times rounding of the gap [N/m].
    double
    force_rounding() const;

    /// dr/du of the last assembly with a tangent [N/m^2]. Its sparsity pattern includes that of
    /// the elasticity.
    const Matrix &
    tangent() const;

    /// The same for callers that add entries, which are lost when their row is assembled again.
    Matrix &
    tangent();

    /// Add @p factor times @p matrix to the tangent, in the rows of chosen blocks, until the next
    /// assembly. The pattern of the matrix must lie within that of the tangent.
    void
    add_to_tangent(const Matrix &matrix);

    /// A number that grows whenever the sparsity pattern of tangent() changes.
    unsigned int
    pattern_version() const;

    /// Whether tangent() after assemble() is symmetric: if no law has friction.
    bool
    tangent_is_symmetric() const;

    /// The report of the last assembly.
    const ContactReport &
    report() const;

    /// This rank's points, as of the last assembly.
    const std::vector<ContactPoint> &
    points() const;

    /// Add eps_n times the weighted penetrations to the multipliers, after an assemble() at a
    /// solution; for linear springs these are their pressures. Returns the largest change of a
    /// multiplier, divided by eps_n: the weighted penetration that the springs carried until now [m].
    double
    augment();

    /**
     * Break bonds whose stress exceeds their strength in the last assembly and whose ratio of
     * stress to strength is at least @p share of the largest such ratio. The energy that their
     * springs lose counts as dissipated. Returns the number of broken points of all ranks.
     */
    unsigned int
    break_bonds(double share = 0.);

    /**
     * Accept the state of the last assembly: anchors and slip are updated. Returns the energy that
     * friction, breaking bonds and dashpots have dissipated since the last accepted state [J/m].
     */
    double
    accept();

    /// Largest distances that a point of a face of each body moves between two displacements [m].
    /// Obstacles do not move with displacements.
    std::vector<double>
    motions(const Vector &from, const Vector &to);

    /// The reason why a step from detect() to @p end, at the time that is set, must not be
    /// accepted, or an empty one: a point has moved further than the reach of the search,
    /// penetrated by more than half of it in the last assembly, or has passed through a body on
    /// the way.
    StepFault
    find_fault(const Vector &end);

    /// The last of these reasons alone: a load step may go further than the reach, since faces are
    /// looked for again at its end.
    StepFault
    find_crossing(const Vector &end);

    /// The history of the last accepted state. Collective.
    ContactHistory
    history() const;

    /**
     * Remove the bodies that are set, one entry for each body of the surface, see
     * ContactSurface::set_absent_bodies(). The energy that springs against them stored at the last
     * accepted state is lost and does not count as dissipated. detect() has to be called before
     * the next assembly, unless the same bodies were absent before.
     */
    void
    set_absent_bodies(const std::vector<bool> &is_absent);

    /// Restore what history() returned, on any number of ranks. detect() has to be called before
    /// the next assembly.
    void
    restore_history(const ContactHistory &history);

    /// The parameters of the constructor; a reach of 0 is replaced by the value that is used.
    const ContactParameters &
    parameters() const;

    /// The surface of the constructor, at the positions of the last call.
    const ContactSurface &
    surface() const;

  private:
    friend class ContactTimeStep;
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
