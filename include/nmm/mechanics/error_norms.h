#ifndef nmm_mechanics_error_norms_h
#define nmm_mechanics_error_norms_h

#include <nmm/mechanics/displacement_field.h>

#include <functional>

namespace NMM
{
  /// Relative errors over the solid, and the norms of the exact fields.
  struct ErrorNorms
  {
    /// ||u_h - u||_L2 / ||u||_L2 [-]; not divided if u is zero.
    double displacement = 0.;
    /// ||sigma_h - sigma||_L2 / ||sigma||_L2 [-], in-plane components with the
    /// Frobenius norm; not divided if sigma is zero.
    double stress = 0.;
    /// ||u||_L2 [m^2].
    double displacement_norm = 0.;
    /// ||sigma||_L2 [N].
    double stress_norm = 0.;
  };

  /// Exact displacement u(x) [m].
  using ExactDisplacement =
    std::function<dealii::Tensor<1, 2>(const dealii::Point<2> &)>;

  /// Exact in-plane stress sigma(x) [Pa].
  using ExactStress =
    std::function<dealii::SymmetricTensor<2, 2>(const dealii::Point<2> &)>;

  /// Computed stress sigma_h of an element at reference coordinates xi of its cell [Pa].
  using ElementStress =
    std::function<dealii::SymmetricTensor<2, 2>(unsigned int,
                                                const dealii::Point<2> &)>;

  /**
   * Relative L2 errors of displacement and stress over the solid, summed over
   * ranks, with element rules of polynomial degree @p quadrature_degree (0: 2p + 4,
   * for which the quadrature error is far below that of the solution). @p stress is the computed
   * stress, e.g. StressRecovery::stress; if empty, the direct stress of @p field.
   */
  ErrorNorms
  compute_errors(const DisplacementField &field,
                 const ExactDisplacement &exact_displacement,
                 const ExactStress       &exact_stress,
                 const ElementStress     &stress            = {},
                 unsigned int             quadrature_degree = 0);
} // namespace NMM

#endif
