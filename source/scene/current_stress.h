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
    /// Cauchy stress [Pa] on the axes x, y, as a FieldEvaluator wants it, where it is not linear
    /// in the displacements: large displacements and inelastic materials.
    namespace CurrentStress
    {
      /// Of the materials' laws. All arguments must outlive the law.
      FieldEvaluator::StressLaw
      finite(const FiniteElasticity &elasticity);

      /// Linear in each element, fitted to the stress that IncrementalElasticity
      /// carries along at the quadrature points of owned elements. Covers and problem
      /// must outlive the law.
      FieldEvaluator::StressLaw
      incremental(const CoverSystem                                &covers,
                  const QuadratureCollection                       &quadrature,
                  const ElasticityProblem                          &problem,
                  const std::vector<dealii::SymmetricTensor<2, 2>> &stresses);

      /// Linear in each element, fitted to the values at quadrature points in the last assembly
      /// of @p terms; where the material is elastic, Hooke's law. Covers and problem must outlive
      /// the law.
      FieldEvaluator::StressLaw
      inelastic(const InelasticTerms       &terms,
                const CoverSystem          &covers,
                const QuadratureCollection &quadrature,
                const ElasticityProblem    &problem);

      /// Equivalent plastic strain [-], fitted likewise; 0 where the material is elastic.
      FieldEvaluator::ScalarField
      plastic_strain(const InelasticTerms       &terms,
                     const CoverSystem          &covers,
                     const QuadratureCollection &quadrature);

      /// Of the stress carried along, initial stress included, per unit thickness
      /// [J/m]. Collective.
      double
      incremental_strain_energy(
        const DisplacementField                          &field,
        const QuadratureCollection                       &quadrature,
        const ElasticityProblem                          &problem,
        const std::vector<dealii::SymmetricTensor<2, 2>> &stresses);

      /// Integral of det F, the area of the deformed solid [m^2]. Collective.
      double
      area(const DisplacementField    &field,
           const QuadratureCollection &quadrature);
    } // namespace CurrentStress
  }   // namespace internal
} // namespace NMM

#endif
