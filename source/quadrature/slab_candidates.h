#ifndef nmm_quadrature_slab_candidates_h
#define nmm_quadrature_slab_candidates_h

#include "element_frame.h"
#include <array>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Gauss-Legendre rules on [0, 1]. Each is made when it is first asked for.
    class GaussTable
    {
    public:
      struct Rule
      {
        std::vector<double> points, weights;
      };

      const Rule &
      rule(unsigned int n_points);

    private:
      std::vector<Rule> rules;
    };


    /**
     * A positive rule with points inside an element, which RuleReduction then reduces to few
     * points.
     *
     * The element is sliced at the first scaled coordinate of every vertex and
     * of every vertical tangent of an arc. No edges end between two slices;
     * sorted by height they bound trapezoids (with a curved top or bottom), each
     * of which gets a tensor product of Gauss rules. With straight edges this rule
     * is exact for polynomials of degree m; with arcs it is not, and the moments correct it.
     *
     * Points have the reference coordinates that they will have in the final rule,
     * rounded to double. Their scaled coordinates are those of the rounded points.
     */
    class SlabCandidates
    {
    public:
      std::vector<double>           s1, s2;
      std::vector<dealii::Point<2>> reference;
      std::vector<double>           weights;

      /// Makes the rule for polynomials of degree @p degree. Level 0 has the fewest points, and
      /// each higher level has more in both directions. From level 2 on, the points of one slab
      /// determine a polynomial of that degree.
      void
      reinit(const ElementFrame &frame,
             unsigned int        degree,
             unsigned int        level,
             GaussTable         &gauss);

    private:
      /// Part of an edge along which the first scaled coordinate is monotonic.
      struct Piece
      {
        const FrameEdge *edge;
        double           left, right;
        /// Whether the edge runs from left to right, so that the element is above it.
        bool is_bottom;
        /// Of arcs only: the range of tan(tau/2) and the sign of ds_1/dtau.
        double t_min, t_max, slope_sign;

        /// tan(tau/2) at the point of the arc with the first coordinate @p s.
        double
        arc_parameter(double s) const;

        /// Second coordinate of the point with the first coordinate @p s.
        double
        height(double s) const;

        /// |ds_1/dtau| at the point of the arc with the first coordinate @p s.
        double
        arc_speed(double s) const;
      };

      void
      make_pieces(const std::vector<FrameEdge> &edges);

      /// The part of a slab from `left` to `right` between two pieces.
      struct Trapezoid
      {
        const Piece *bottom, *top;
        double       left, right;
      };

      /// Numbers of Gauss points along a slab and across it, and of further points along it where
      /// an arc bounds it.
      struct PointCounts
      {
        unsigned int along, across, extra_on_arcs;
      };

      void
      fill_slab(const ElementFrame &frame,
                double              left,
                double              right,
                const PointCounts  &counts,
                GaussTable         &gauss);

      void
      fill_trapezoid(const ElementFrame &frame,
                     const Trapezoid    &trapezoid,
                     const PointCounts  &counts,
                     GaussTable         &gauss);

      bool
      add_point(const ElementFrame          &frame,
                const Trapezoid             &trapezoid,
                const std::array<double, 2> &s,
                double                       weight);

      std::vector<Piece>  pieces;
      std::vector<double> slices;
      std::vector<bool>   is_cancelled;
      /// The pieces that span a slab, each with its height in the middle of the slab.
      std::vector<std::pair<double, const Piece *>> stack;
    };
  } // namespace internal
} // namespace NMM

#endif
