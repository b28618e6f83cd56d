#ifndef nmm_contact_diagnostics_face_forces_h
#define nmm_contact_diagnostics_face_forces_h

#include <nmm/contact/contact.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace NMM
{
  /// Force that the solid exerts on each obstacle, per unit thickness [N/m], in the order of the
  /// obstacles of @p surface. Collective.
  std::vector<dealii::Tensor<1, 2>>
  obstacle_forces(const ContactSurface            &surface,
                  const std::vector<ContactPoint> &points);

  /// Largest pressure per reference length over the closed points of all ranks [Pa]; 0 if there is
  /// none. Collective.
  double
  largest_pressure(const ContactSurface            &surface,
                   const std::vector<ContactPoint> &points);
} // namespace NMM

#endif
