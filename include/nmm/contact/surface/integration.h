#ifndef nmm_contact_surface_integration_h
#define nmm_contact_surface_integration_h

namespace NMM
{
  /// Where the springs of contact act, and the units of their stiffness.
  enum class ContactIntegration
  {
    /// Springs are distributed along faces; their stiffness is per length [Pa/m].
    length,
    /**
     * Springs act at vertices as in the paper's eq. (13) and (h): at convex corners, and on arcs
     * where edges meet. Their stiffnesses are forces over lengths, per thickness [N/m^2], those of
     * dashpots [N s/m^2]. Pressure, shear, cohesion and tensile strength are forces per thickness
     * [N/m]. The force does not depend on the mesh, but faces between vertices transmit nothing,
     * so that the stress near vertices is that of point loads.
     */
    points
  };
} // namespace NMM

#endif
