#ifndef nmm_applications_current_stress_h
#define nmm_applications_current_stress_h

#include <nmm/io/field_samples.h>
#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/quadrature/element_quadrature.h>

#include <vector>

/// Stress in large displacements: Cauchy stress [Pa] on the axes x, y, as a
/// FieldEvaluator wants it.
namespace CurrentStress
{
  /// Of the materials' laws. All arguments must outlive the law.
  NMM::FieldEvaluator::StressLaw
  finite(const NMM::FiniteElasticity &elasticity);

  /// Linear in each element, fitted to the stress that IncrementalElasticity
  /// carries along at the quadrature points of owned elements. Covers and problem
  /// must outlive the law.
  NMM::FieldEvaluator::StressLaw
  incremental(const NMM::CoverSystem                           &covers,
              const NMM::QuadratureCollection                  &quadrature,
              const NMM::ElasticityProblem                     &problem,
              const std::vector<dealii::SymmetricTensor<2, 2>> &stresses);

  /// Of the stress carried along, initial stress included, per unit thickness
  /// [J/m]. Collective.
  double
  incremental_strain_energy(
    const NMM::DisplacementField                     &field,
    const NMM::QuadratureCollection                  &quadrature,
    const NMM::ElasticityProblem                     &problem,
    const std::vector<dealii::SymmetricTensor<2, 2>> &stresses);

  /// Integral of det F, the area of the deformed solid [m^2]. Collective.
  double
  area(const NMM::DisplacementField    &field,
       const NMM::QuadratureCollection &quadrature);
} // namespace CurrentStress

#endif
