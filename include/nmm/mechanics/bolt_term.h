#ifndef nmm_mechanics_bolt_term_h
#define nmm_mechanics_bolt_term_h

#include <nmm/mechanics/bolt.h>
#include <nmm/mechanics/force_term.h>

#include <memory>
#include <vector>

namespace NMM
{
  /**
   * The force term of rock bolts and anchors that cross blocks and joints. The bar of each bolt is
   * elastic-plastic and has its own displacement v(s) along the path, in equilibrium with an
   * elastic-plastic bond to the rock,
   * @f[ (EA\,(v' - e_p))' = k\,(v - r - w_p), \qquad |N| \le N_y, \quad |\tau| \le S. @f]
   * Here r(s) is the displacement of the rock along the bolt: the sum of the elongations of the
   * material lines between points of the path up to s, and where a joint is crossed, the component
   * of its opening along the bolt. r, and not the position, enters because the bar slides around
   * corners of its path as a rope does. v is not an unknown of the solid but is eliminated, see
   * source/mechanics/bolt_bar.h: the term adds the energy Psi(r(u)) = min_v Psi(v, r(u)), the
   * forces dPsi/du and their exact derivative, which couples the covers along the bolt. A bolt has
   * four elements of second order at least in each block, and five per (EA / k)^(1/2), with an
   * error of the pull-out force below 1e-4.
   *
   * A joint that is crossed also shears the bolt by its slip d across the bolt, with the force D d.
   * Both halves of the bar are beams on an elastic foundation without moment in the joint (Hetenyi
   * 1946), so that D = E I beta^3 and the largest moment is D d e^{-pi/4} sin(pi/4) / beta, at pi /
   * 4 beta from the joint. Bending does not yield, and is independent of the axial force.
   *
   * When a bolt is installed, at the beginning of the first step not before Bolt::installed_at, it
   * has no force. A pretension P is that of a head that is drawn out of the hole against the rock
   * at rest and then fastened: at this moment N is P at the head. The rock then gives way, and N
   * changes with it. From then on the bolt follows the displacements that are added.
   *
   * Steel and bond yield without hardening, apart from a millionth of their stiffness. A bar breaks
   * at the end of the step in which its mean strain over ten diameters exceeds the rupture strain,
   * in one place per step. Parts in absent blocks are not fastened to anything.
   *
   * In small kinematics directions are those of the reference configuration. In finite kinematics
   * elongations are differences of current lengths, and opening and slip are components
   * @f$ \bar a\cdot d @f$, @f$ \bar a\times d @f$ of the vector d between both sides of the joint, with
   * the mean direction @f$ \bar a @f$ of the bolt on both sides. A slip does not lengthen the bar.
   * Conserving forces are the mean of both ends of the step, along mean vectors as in SpringTerm,
   * whose work is the change of the energy plus what yielding dissipates.
   *
   * Lifetime: the layout must outlive this object, the cover system is needed by the constructor
   * only.
   */
  class BoltTerm : public ForceTerm
  {
  public:
    /// Collective.
    /// @throws InputError for a path that begins or ends outside the rock, for values out of range,
    /// and for a pretension that the bolt does not bear.
    BoltTerm(const CoverSystem &covers,
             const ModelLayout &layout,
             std::vector<Bolt>  bolts,
             Kinematics         kinematics = Kinematics::small);
    ~BoltTerm() override;

    std::vector<Unknowns>
    couplings() const override;

    void
    begin_step(const StepBegin &step) override;

    Deformation
    assemble(const Trial &trial, AssembledForces &sum) override;

    ForceProperties
    properties() const override;

    /// The work by which bolts were tensioned in the step is that of supports.
    StepWork
    commit(const Trial &step) override;

    void
    set_presence(const Presence &presence) override;

    void
    forget() override;

    void
    save(ByteWriter &archive) const override;

    void
    restore(ByteReader &archive) override;

    /// The bolts of the constructor.
    const std::vector<Bolt> &
    bolts() const;

    /// What each bolt bears at the displacements @p u of the last accepted step. Collective.
    std::vector<BoltReport>
    reports(const Vector &u) const;

  private:
    struct Data;
    std::unique_ptr<Data> data;
  };
} // namespace NMM

#endif
