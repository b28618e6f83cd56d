#ifndef nmm_source_scene_current_stress_h
#define nmm_source_scene_current_stress_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/inelastic_terms.h>
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

      /// The stress at quadrature points in the last assembly of @p terms, fitted by a linear
      /// function in each element; where the material is elastic, Hooke's law. Covers and problem
      /// must outlive the law.
      FieldEvaluator::StressLaw
      inelastic(const InelasticTerms       &terms,
                const CoverSystem          &covers,
                const QuadratureCollection &quadrature,
                const ElasticityProblem    &problem);

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
