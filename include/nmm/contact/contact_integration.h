#ifndef nmm_contact_contact_integration_h
#define nmm_contact_contact_integration_h

namespace NMM
{
  /// What a spring of a contact stands for.
  enum class ContactIntegration
  {
    /// A length of a face; stiffness per length.
    length,
    /**
     * A vertex: eq. (13) and (h) as the paper has them. Springs are at convex corners,
     * and on arcs where edges meet; their stiffnesses are forces over lengths, per
     * thickness [N/m^2], dashpots [N s/m^2], pressure, shear, cohesion and tensile
     * strength forces per thickness [N/m]. The force does not depend on the mesh, but
     * faces between vertices bear nothing: stress near them is that of point loads.
     */
    points
  };
} // namespace NMM

#endif
