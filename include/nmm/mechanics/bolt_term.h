#ifndef nmm_mechanics_bolt_term_h
#define nmm_mechanics_bolt_term_h

#include <nmm/mechanics/force_term.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  /// A rock bolt or anchor. Quantities are those of one bolt, see `spacing`.
  struct Bolt
  {
    /// How the bar is fastened to the rock.
    enum class Type
    {
      /// By grout along its length, or a part of it at its end.
      grouted,
      /// At both ends only.
      end_anchored
    };

    /// Name for messages.
    std::string name;
    /// Points from the head to the toe in the reference configuration, joined by straight lines [m].
    /// They need not fit the mesh. Both ends lie in rock.
    std::vector<dealii::Point<2>> path;
    /// How it is fastened.
    Type type = Type::grouted;
    /// Young's modulus [Pa] and area [m^2] of the bar.
    double youngs_modulus = 0., area = 0.;
    /// Shear force per length and slip [N/m^2] and largest shear force per length [N/m] of the bond
    /// between bar and rock; of grouted bolts only.
    double bond_stiffness = 0.,
           bond_strength  = std::numeric_limits<double>::infinity();
    /// Length from the toe that is grouted [m].
    double grouted_length = std::numeric_limits<double>::infinity();
    /// Axial force at which the bar yields, in tension and compression [N].
    double yield_force = std::numeric_limits<double>::infinity();
    /// Strain at which it breaks, as a mean over ten diameters 2 (A / pi)^(1/2) [-].
    double rupture_strain = std::numeric_limits<double>::infinity();
    /// Axial force at the head when it is installed [N].
    double pretension = 0.;
    /// Distance between bolts out of the plane [m]. Stiffnesses, strengths and forces are divided by
    /// it to give those per unit thickness.
    double spacing = 1.;
    /// Whether the head of a grouted bolt is fastened to the rock. It is needed for a pretension.
    bool faceplate = false;
    /// Shear force over the slip of a joint that it crosses [N/m]; of grouted bolts only.
    double dowel_stiffness = 0.;
    /// Force per length and deflection of the grout that beds the bar [N/m^2]. If it is not 0, it gives
    /// the dowel stiffness E I beta^3, with I = A^2 / 4 pi of a round bar and beta = (K / 4 E I)^(1/4).
    double bedding_stiffness = 0.;
    /// Time [s] or load factor [-] of its installation; the first step by default.
    double installed_at = std::numeric_limits<double>::lowest();
  };


  /// What a bolt bears. Forces are those of one bolt.
  struct BoltReport
  {
    /// State of the bond at a place.
    enum class Bond
    {
      /// There is none.
      none,
      /// It has not slipped.
      elastic,
      /// It has slipped.
      yielded
    };

    /// A place of the bar.
    struct Place
    {
      /// Arc length from the head [m].
      double s = 0.;
      /// Place in the reference configuration [m].
      dealii::Point<2> x;
      /// Displacement of the rock there [m].
      dealii::Tensor<1, 2> u;
      /// Axial force, positive in tension [N].
      double force = 0.;
      /// Displacement of the bar relative to the rock, positive towards the toe [m]; 0 without bond.
      double slip = 0.;
      /// The bond there.
      Bond bond = Bond::none;
    };

    /// A joint that the bolt crosses.
    struct Crossing
    {
      /// Name of the curve.
      std::string joint;
      /// Arc length from the head [m].
      double s = 0.;
      /// Place in the reference configuration [m].
      dealii::Point<2> x;
      /// Relative displacement of the rock behind the joint to that before it, along the bolt and to
      /// its left [m].
      double opening = 0., slip = 0.;
      /// Axial force, shear force by which the bolt opposes the slip, and the largest moment that it
      /// causes [N, N m].
      double force = 0., dowel_force = 0., moment = 0.;
    };

    /// Whether the bolt acts.
    bool is_installed = false;
    /// Places from the head to the toe.
    std::vector<Place> places;
    /// Crossings from the head to the toe.
    std::vector<Crossing> crossings;
    /// The axial force of largest magnitude [N].
    double largest_force = 0.;
    /// Length of bond that has slipped, and of bar that has yielded [m].
    double slipped_length = 0., yielded_length = 0.;
    /// Number of places where the bar is broken.
    unsigned int n_breaks = 0;
  };


  /**
   * The force term of rock bolts and anchors that cross blocks and joints. The bar of each bolt is
   * elastic-plastic and has its own displacement v(s) along the path, in equilibrium with an
   * elastic-plastic bond to the rock,
   * @f[ (EA\,(v' - e_p))' = k\,(v - r - w_p), \qquad |N| \le N_y, \quad |\tau| \le S. @f]
   * Here r(s) is the displacement of the rock along the bolt: the sum of the elongations of the
   * material lines between points of the path up to s, and where a joint is crossed, the component of
   * its opening along the bolt. r, and not the position, enters because the bar slides around corners of
   * its path as a rope does. v is not an unknown of the solid but is eliminated, see
   * source/mechanics/bolt_bar.h: the term adds the energy Psi(r(u)) = min_v Psi(v, r(u)), the forces
   * dPsi/du and their exact derivative, which couples the covers along the bolt. A bolt has four
   * elements of second order at least in each block, and five per (EA / k)^(1/2), with an error of the
   * pull-out force below 1e-4.
   *
   * A joint that is crossed also shears the bolt by its slip d across the bolt, with the force D d. Both
   * halves of the bar are beams on an elastic foundation without moment in the joint (Hetenyi 1946), so
   * that D = E I beta^3 and the largest moment is D d e^{-pi/4} sin(pi/4) / beta, at pi / 4 beta from the
   * joint. Bending does not yield, and is independent of the axial force.
   *
   * When a bolt is installed, at the beginning of the first step not before Bolt::installed_at, it has
   * no force. A pretension P is that of a head that is drawn out of the hole against the rock at rest
   * and then fastened: at this moment N is P at the head. The rock then gives way, and N changes with
   * it. From then on the bolt follows the displacements that are added.
   *
   * Steel and bond yield without hardening, apart from a millionth of their stiffness. A bar breaks at
   * the end of the step in which its mean strain over ten diameters exceeds the rupture strain, in one
   * place per step. Parts in absent blocks are not fastened to anything.
   *
   * In small kinematics directions are those of the reference configuration. In finite kinematics
   * elongations are differences of current lengths, and opening and slip are components
   * @f$ \bar a\cdot d @f$, @f$ \bar a\times d @f$ of the vector d between both sides of the joint, with
   * the mean direction @f$ \bar a @f$ of the bolt on both sides. A slip does not lengthen the bar.
   * Conserving forces are the mean of both ends of the step, along mean vectors as in SpringTerm, whose
   * work is the change of the energy plus what yielding dissipates.
   *
   * Lifetime: the layout must outlive this object, the cover system is needed by the constructor only.
   */
  class BoltTerm : public ForceTerm
  {
  public:
    /// Collective.
    /// @throws InputError for a path that begins or ends outside the rock, for values out of range, and
    /// for a pretension that the bolt does not bear.
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
