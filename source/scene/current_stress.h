#ifndef nmm_source_scene_current_stress_h
#define nmm_source_scene_current_stress_h

#include <nmm/fracture/crack_start.h>
#include <nmm/mechanics/solid_term.h>
#include <nmm/output/field_samples.h>
#include <nmm/quadrature/element_quadrature.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Functions that give the Cauchy stress [Pa] in the axes x and y to a FieldEvaluator, if it is
    /// not linear in the displacements: for large displacements and inelastic materials.
    namespace CurrentStress
    {
      /// The Cauchy stress of the materials' hyperelastic laws. All arguments must outlive the law.
      FieldEvaluator::StressLaw
      finite(const FiniteElasticity &elasticity);

      /// The Cauchy stress at the displacements @p field, in axes that turn with the material at each point,
      /// without viscous stress [Pa]. The elasticity must outlive it.
      ElementStress
      in_material_axes(const DisplacementField &field,
                       const FiniteElasticity  &elasticity,
                       Kinematics               kinematics);

      /// The stress in @p solid; null if it is linear in the displacements. Where the material is
      /// inelastic, the stress at quadrature points in the last assembly of the solid's inelastic
      /// terms, fitted by a linear function in each element; elsewhere finite() or Hooke's law. The
      /// solid must outlive the law.
      FieldEvaluator::StressLaw
      of(const SolidTerm &solid, const QuadratureCollection &quadrature);

      /// The equivalent plastic strain [-], fitted in the same way. It is 0 where the material is
      /// elastic.
      FieldEvaluator::ScalarField
      plastic_strain(const InelasticTerms       &terms,
                     const CoverSystem          &covers,
                     const QuadratureCollection &quadrature);

      /// Area of the deformed solid, the integral of det F [m^2]. Collective.
      double
      area(const DisplacementField    &field,
           const QuadratureCollection &quadrature);
    } // namespace CurrentStress
  }   // namespace internal
} // namespace NMM

#endif
