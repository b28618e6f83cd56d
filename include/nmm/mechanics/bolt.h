#ifndef nmm_mechanics_bolt_h
#define nmm_mechanics_bolt_h

#include <deal.II/base/point.h>

#include <limits>
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
    /// Points from the head to the toe in the reference configuration, joined by straight lines
    /// [m]. They need not fit the mesh. Both ends lie in rock.
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
    /// Distance between bolts out of the plane [m]. Stiffnesses, strengths and forces are divided
    /// by it to give those per unit thickness.
    double spacing = 1.;
    /// Whether the head of a grouted bolt is fastened to the rock. It is needed for a pretension.
    bool faceplate = false;
    /// Shear force over the slip of a joint that it crosses [N/m]; of grouted bolts only.
    double dowel_stiffness = 0.;
    /// Force per length and deflection of the grout that beds the bar [N/m^2]. If it is not 0, it
    /// gives the dowel stiffness E I beta^3, with I = A^2 / 4 pi of a round bar and beta = (K / 4 E
    /// I)^(1/4).
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
      /// Displacement of the bar relative to the rock, positive towards the toe [m]; 0 without
      /// bond.
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
      /// Relative displacement of the rock behind the joint to that before it, along the bolt and
      /// to its left [m].
      double opening = 0., slip = 0.;
      /// Axial force, shear force by which the bolt opposes the slip, and the largest moment that
      /// it causes [N, N m].
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
} // namespace NMM

#endif
