#ifndef nmm_contact_surface_initial_stress_h
#define nmm_contact_surface_initial_stress_h

#include <nmm/contact/parameters.h>
#include <nmm/contact/surface/surface.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * The initial stress at each edge of @p surface for ContactParameters::initial_stress: at a
   * face that touches another one in the reference configuration, the mean of the initial stresses
   * on both sides; at a face that touches an obstacle, that of its block. It is zero at free
   * boundaries, such as the wall of an excavation, and at obstacles. Faces touch if the middle of
   * one lies on the other within a millionth of its length. Empty if no material has an initial
   * stress. Cost: O(n log n) for n edges.
   */
  std::vector<InitialFaceStress>
  initial_stress_at_faces(const ContactSurface    &surface,
                          const ElasticityProblem &problem);


  /// Faces whose strength is less than the traction of the initial stress.
  struct ExceededStrength
  {
    /// Names of the curves or obstacles on both sides.
    std::string first, second;
    /// Length of these faces [m].
    double length = 0.;
    /// Where the traction exceeds the strength most [m].
    dealii::Point<2> place;
    /// Pressure, negative for tension, and the sizes of the shear and of the shear strength there
    /// [Pa].
    double pressure = 0., shear = 0., strength = 0.;

    /// Traction beyond the strength [Pa].
    double
    excess() const
    {
      return std::max(shear - strength, -pressure);
    }
  };

  /// Faces that cannot bear the traction of ContactParameters::initial_stress, one entry for each
  /// pair of names: unbonded faces bear no tension, bonded ones the strength of their bond.
  std::vector<ExceededStrength>
  find_exceeded_strength(const ContactSurface    &surface,
                         const ContactParameters &parameters);
} // namespace NMM

#endif
