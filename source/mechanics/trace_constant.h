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
     * The constants of the discrete trace inequality that Nitsche's penalty is
     * made of: for stresses of degree p - 1 on an element E with weakly held
     * boundary Gamma (all its displacement conditions and ties together)
     * @f[ \int_\Gamma q^2\,ds \le \Lambda_E \int_E q^2\,dA
     *     \quad\forall q\in P_{p-1}. @f]
     * For p = 1, Lambda = |Gamma| / |E|. For p = 2 it is the largest eigenvalue
     * of the traces' moments in a basis that is orthonormal on E (3 x 3), which
     * second moments of E give directly; this is sharp for any shape of E, where
     * formulas in a cell size h are not.
     *
     * A sliver has a large constant: 4 / thickness. Where aggregation ties its
     * unknowns to a root element R, the polynomial's energy on R bounds its
     * trace on Gamma as well, and Lambda_R (with R's area and E's boundary),
     * which is mostly of order 1/h, is taken if E's polynomial is R's and it is the
     * smaller one, so that a sliver that vanishes changes nothing. (It is the larger one
     * by up to (distance / thickness)^2 if R is a thin strip that does not point at E.)
     * Where E has free covers of its own, or the ghost penalty bounds only the
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

      /// Lambda [1/m], infinite for an element without area.
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

      /// The element to whose polynomial covers of @p element are constrained,
      /// or that the ghost penalty ties it to, or invalid_index.
      unsigned int
      find_root(unsigned int element) const;

      /// Is every cover of @p element one of @p root or constrained to those?
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
