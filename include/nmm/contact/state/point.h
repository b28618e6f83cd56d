#ifndef nmm_contact_state_point_h
#define nmm_contact_state_point_h

#include <nmm/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  /// State of a contact point.
  enum class ContactState
  {
    /// The faces are apart: there is neither pressure nor shear.
    open,
    /// The point is closed, and its shear is that of the elastic spring.
    stick,
    /// The point is closed, and its shear equals the strength. Closed points whose law transmits
    /// no shear are counted here.
    slip
  };


  /// A point at which a slave edge may touch a master.
  struct ContactPoint
  {
    /// Number of the slave edge, an index for ContactSurface::edges().
    unsigned int edge = invalid_index;
    /// Parameter of the point on the slave edge, from 0 to 1 [-].
    double s = 0.;
    /// Integration weight: reference length times the cosine of the angle between both faces [m].
    /// With ContactIntegration::points it is the share of the vertex [-].
    double weight = 0.;
    /// Number of the nearest master edge; invalid_index if there is none within reach.
    unsigned int master = invalid_index;
    /// Parameter of the nearest point on the master edge [-]; outside of [0, 1] where the edge is
    /// continued beyond its ends.
    double t = 0.;
    /// Distance from the master along its normal, negative for penetration [m]; the reach of the
    /// search if there is no master.
    double gap = 0.;
    /// Gap at which the pressure vanishes [m]: where dilation has opened the faces, and by how much
    /// the initial stress has closed them before.
    double opening = 0.;
    /// Normal force per reference length of the slave, positive for compression [Pa].
    double pressure = 0.;
    /// Tangential force per reference length of the slave [Pa], positive if it pushes the
    /// master in the direction of increasing t.
    double shear = 0.;
    /// State in the last assembly.
    ContactState state = ContactState::open;
    /// Shear that the spring would exert if its strength were not limited [Pa].
    double spring_shear = 0.;
    /// Whether the slip changed its sign in the last iteration; the secant stiffness is used then.
    bool has_turned = false;
    /// Edge of the anchor, the material point of the master at which the point sticks;
    /// invalid_index as long as there is none.
    unsigned int stick_edge = invalid_index;
    /// Parameter of the anchor on its edge [-].
    double stick_t = 0.;
    /// Multiplier of the augmented Lagrangian [Pa].
    double multiplier = 0.;
    /// Whether the point belongs to a bonded joint whose strength has not been exceeded.
    bool is_bonded = false;
    /// Current position of the point [m].
    dealii::Point<2> x;
    /// Unit normal of the master at the nearest point, pointing out of the master's body [-].
    dealii::Tensor<1, 2> normal;
  };
} // namespace NMM

#endif
