#ifndef nmm_source_mechanics_trace_constant_h
#define nmm_source_mechanics_trace_constant_h

#include <nmm/covers/aggregation.h>
#include <nmm/covers/cover_system.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/affine_constraints.h>

#include <mechanics/curve_conditions.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The constants of the discrete trace inequality that determine Nitsche's penalty. For
     * stresses of degree p - 1 on an element E, and the part Gamma of its boundary on which
     * displacement conditions and ties hold, the inequality is
     * @f[ \int_\Gamma q^2\,ds \le \Lambda_E \int_E q^2\,dA
     *     \quad\forall q\in P_{p-1}. @f]
     * For p = 1, Lambda = |Gamma| / |E|. For p = 2 it is the largest eigenvalue
     * of the moment matrix (3 x 3) on Gamma of a basis that is orthonormal on E and follows
     * directly from the second moments of E. This is sharp for any shape of E, in contrast to
     * formulas with a cell size h.
     *
     * A sliver has a large constant, 4 / thickness. Where aggregation ties its
     * unknowns to a root element R, the energy of the polynomial on R bounds its
     * trace on Gamma as well, with the constant Lambda_R (with the area of R and the boundary of
     * E), which is mostly of order 1/h. If E has the same polynomial as R, the constant is the
     * smaller of Lambda_E and Lambda_R, so that a vanishing sliver has no influence. (Lambda_R is
     * larger by up to (distance / thickness)^2 if R is a thin strip that does not point at E.)
     * If E has free covers of its own, or if the ghost penalty bounds only the
     * difference of the polynomials, it is the smaller of Lambda_E and 2 Lambda_R.
     */
    class TraceConstants
    {
    public:
      TraceConstants(const CoverSystem                       &covers,
                     const QuadratureCollection              &quadrature,
                     const dealii::AffineConstraints<double> &constraints,
                     const CurveConditions                   &conditions,
                     const GhostPenalty *ghost_penalty = nullptr);

      /// The constant Lambda of an element [1/m]; infinite for an element without area.
      double
      operator()(unsigned int element);

    private:
      /// Area [m^2], centroid [m] and second moments about it [m^4].
      struct Moments
      {
        double                        area = 0.;
        dealii::Point<2>              centroid;
        dealii::SymmetricTensor<2, 2> second;
      };

      struct BoundaryPoints
      {
        std::vector<dealii::Point<2>> points;
        std::vector<double>           weights;
      };

      Moments
      moments(unsigned int element) const;

      BoundaryPoints
      boundary_points(unsigned int element) const;

      double
      constant(const Moments &moments, const BoundaryPoints &boundary) const;

      /// The root of @p element: the element to whose polynomial its covers are constrained,
      /// or to which the ghost penalty ties it. invalid_index if there is none.
      unsigned int
      find_root(unsigned int element) const;

      /// Whether each cover of @p element is one of @p root or constrained to those of @p root.
      bool
      has_polynomial_of(unsigned int element, unsigned int root) const;

      const CoverSystem                       *covers;
      const QuadratureCollection              *quadrature;
      const dealii::AffineConstraints<double> *constraints;
      const CurveConditions                   *conditions;
      const GhostPenalty                      *ghost_penalty;
      unsigned int                             degree;
      std::vector<double>                      known;
    };
  } // namespace internal
} // namespace NMM

#endif
