#ifndef nmm_contact_assembly_report_h
#define nmm_contact_assembly_report_h

#include <deal.II/base/tensor.h>

namespace NMM
{
  /// Counts and sums of the last assembly, over all ranks.
  struct ContactReport
  {
    /// Number of contact points.
    unsigned int n_points = 0;
    /// Number of points that are open.
    unsigned int n_open = 0;
    /// Number of points that stick.
    unsigned int n_stick = 0;
    /// Number of points that slip; all closed ones if there is no friction.
    unsigned int n_slip = 0;
    /// Number of states that differ from those of the previous assembly.
    unsigned int n_changes = 0;
    /// Number of points that stick because their bond holds.
    unsigned int n_bonded = 0;
    /// Largest penetration over all closed points, from the nearest face of the other body [m]. On
    /// round faces it is that of the deepest place, which may lie between points.
    double largest_penetration = 0.;
    /// Whether the assembly was one of ContactTimeStep::assemble(), whose penetrations are those in
    /// the mean position of the step, or one at the end of such a step.
    bool is_between = false;
    /// Energy that is stored in springs [J/m].
    double energy = 0.;
    /// Sum of the contact forces on the slaves [N/m].
    dealii::Tensor<1, 2> force;
  };
} // namespace NMM

#endif
