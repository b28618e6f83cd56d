#ifndef nmm_mechanics_stress_recovery_h
#define nmm_mechanics_stress_recovery_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/displacement_field.h>

#include <array>
#include <vector>

namespace NMM
{
  /**
   * Stress recovered by polynomial preserving recovery (Zhang & Naga, SIAM J.
   * Sci. Comput. 26 (2005) 1192), adapted to covers. Around each physical cover k
   * of a corner node a polynomial pi_k of degree p + 1 is fitted in the
   * least-squares sense to the displacement at the nodes of whole elements near
   * it and, in cut elements, at the ends and midpoints of their edges. Nodes
   * outside of the solid, where the displacement is only extended, are left out.
   * The recovered gradient blends the fits with the linear weight functions
   * @f[ G(x) = \sum_{k=1}^3 \lambda_k(x)\,\nabla\pi_k(x) @f]
   * on each manifold element, and stress is sigma_0 + C : sym G. It is
   * continuous within a region, exact for displacements of degree p, and of
   * degree p + 1 where the patch's elements are whole.
   *
   * A patch starts with the cover's elements and is extended by up to
   * three further rings of elements until the fit is well-conditioned. Nothing is averaged across
   * a joint or interface, because covers, and hence patches, never cross one. A cover whose
   * support contains both sides of a crack (around its tip), or for which no well-conditioned
   * patch exists (in a body of few elements), keeps the direct stress. Functions of disk covers are
   * known exactly; they are left out of the fits and added to the result.
   *
   * Cost: some 2 microseconds per corner cover. On the thick ring the largest
   * error of the hoop stress is 3 to 15 times smaller than that of the direct stress.
   */
  class StressRecovery
  {
  public:
    /// Fit the polynomials. The cover system of both arguments, and @p field, must outlive this
    /// object.
    StressRecovery(const DisplacementField &field,
                   const Aggregation       &aggregation);

    /// Recovered du_i/dx_j [-] at reference coordinates @p xi of an owned
    /// element's cell.
    dealii::Tensor<2, 2>
    gradient(unsigned int element, const dealii::Point<2> &xi) const;

    /// Recovered stress at reference coordinates @p xi of an owned element's cell [Pa].
    dealii::SymmetricTensor<2, 2>
    stress(unsigned int element, const dealii::Point<2> &xi) const;

    /// Number of corner covers that keep the direct stress.
    unsigned int
    n_direct() const;

  private:
    /// A fitted polynomial of two components, in monomials centred at the
    /// cover's node and scaled by `scale` [m]: 1, x, y, x^2, xy, y^2, and for
    /// p = 2 x^3, x^2 y, x y^2, y^3. Coefficients in [m].
    struct Polynomial
    {
      dealii::Point<2>                      center;
      double                                scale;
      std::array<std::array<double, 10>, 2> coefficients;
    };

    dealii::Tensor<2, 2>
    polynomial_gradient(const Polynomial       &polynomial,
                        const dealii::Point<2> &x) const;

    const DisplacementField  *field;
    std::vector<Polynomial>   polynomials;
    std::vector<unsigned int> cover_to_polynomial;
    unsigned int              direct = 0;
  };
} // namespace NMM

#endif
