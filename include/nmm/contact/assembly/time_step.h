#ifndef nmm_contact_assembly_time_step_h
#define nmm_contact_assembly_time_step_h

#include <nmm/base/assembly.h>
#include <nmm/contact/contact.h>
#include <nmm/linear_algebra/body_matrix.h>

#include <vector>

namespace NMM
{
  /**
   * What a Contact does in time steps only: its states at the beginning and at the end of a step,
   * forces that conserve energy, and those of some blocks only. It has no data of its
   * own, so that it can be made wherever it is needed; the order of calls is that of Contact:
   * @code
   * contact.set_time(t);
   * contact.detect(u_begin);
   * ContactTimeStep step(contact);
   * step.begin(u_begin, t);
   * step.assemble(u_end, t + h, true); // in each iteration; moves obstacles to where they act
   * contact.set_time(t + h);
   * contact.assemble(u_end, false);
   * const double dissipated = contact.accept();
   * @endcode
   *
   * Lifetime: the Contact must outlive this object.
   */
  class ContactTimeStep
  {
  public:
    /// As in Contact.
    using Vector = Contact::Vector;

    /// Time steps of @p contact.
    explicit ContactTimeStep(Contact &contact);

    /**
     * Begin the step at the displacements @p u and the time @p time [s], where detect() was called.
     * The new contact points must not create energy: where the springs between two bodies would
     * store more than at the end of the step before, because positions and weights of points
     * have changed or faces are found that penetrate each other already, their gaps at rest are
     * shifted so that they store the same. Where they store less, the difference is dissipated.
     */
    void
    begin(const Vector &u, double time);

    /// For each body, whether it had a closed contact point of this rank in the last assembly.
    std::vector<bool>
    pressed_bodies() const;

    /// Set @p u as the expected displacements at the end of the step that has begun. The sparsity
    /// pattern of the tangent then has the couplings of all pairs that may touch on the way there,
    /// and need not be rebuilt within the step. Otherwise it has those of pairs that may touch
    /// on the way to the displacements of the first assembly with a tangent.
    void
    expect(const Vector &u);

    /**
     * Assemble the forces of the step from its beginning to the displacements @p end at @p time
     * [s]. They act in the mean position, so that they exert no moment. The pressure
     * @f[ \hat p = -\frac{V(\langle -g_1\rangle) - V(\langle -g_0\rangle)}{\delta},\quad
     *     \delta = n\cdot(\Delta x_s - \Delta x_m), @f]
     * with V of the ContactLaw, does the work by which the energy of the springs changes (Laursen & Chawla, Int.
     * J. Numer. Methods Eng. 40 (1997) 863; Gonzalez 2000). Dashpots add
     * @f[ c\,(\langle -g_1\rangle - \langle -g_0\rangle)/h @f]
     * as far as there is no tension, so that they only dissipate. Likewise, the shear of a point
     * that sticks is the sum of the spring's mean shear during the slip
     * @f$s=\tau\cdot(\Delta x_s - \Delta x_m)@f$ and the dashpot's,
     * @f[ \hat q = q_0 + \tfrac{\epsilon_t}{2}s + \tfrac{c_t}{h}s, @f]
     * with q_0 = 0 where faces come into contact. The point slides where this exceeds the strength.
     * Contact::tangent() is the derivative by the mean displacement with the beginning of the step
     * fixed. It is not symmetric, because forces depend on the mean position and on the gaps at the
     * end. Multipliers are not used.
     *
     * If @p body_matrix is not null, the tangent is added to it instead, and Contact::tangent() is
     * undefined. This needs one rank and constraints that couple no unknowns; the bodies of the matrix
     * are the blocks of the mesh.
     */
    void
    assemble(const Vector &end,
             double        time,
             bool          with_tangent,
             BodyMatrix   *body_matrix = nullptr);

    /// Let assemblies skip points that belong to none of these blocks; they stay as the last assembly
    /// found them, and the rows of other blocks are undefined.
    void
    restrict_to(const BlockSelection &blocks);

    /// Work that moving obstacles do [J/m] with the forces of the last assembly
    /// from @p time_begin to @p time_end.
    double
    work_of_obstacles(double time_begin, double time_end);

  private:
    using Data = Contact::Data;

    Contact *contact;
    Data    *data;
  };
} // namespace NMM

#endif
