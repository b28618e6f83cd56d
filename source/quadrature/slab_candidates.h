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
    /// Gauss-Legendre rules on [0, 1], made when first asked for.
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
     * A positive, but not yet short rule with points inside an element.
     *
     * The element is sliced at the first scaled coordinate of every vertex and
     * of every vertical tangent of an arc. Between two slices no edges end;
     * sorted by height they bound trapezoids (with curved top or bottom), each
     * of which gets a tensor product of Gauss rules. With straight edges that
     * is exact for P_m; with arcs it is only near, and the moments correct it.
     *
     * Points are those reference coordinates that the final rule will have,
     * rounded to double; their scaled coordinates belong to the rounded points.
     */
    class SlabCandidates
    {
    public:
      std::vector<double>           s1, s2;
      std::vector<dealii::Point<2>> reference;
      std::vector<double>           weights;

      /// @p level 0 has the fewest points; each next one more in both
      /// directions, at level 2 so many that P_m is determined by one slab.
      void
      reinit(const ElementFrame &frame,
             unsigned int        degree,
             unsigned int        level,
             GaussTable         &gauss);

    private:
      /// Part of an edge whose first coordinate grows or falls all the way.
      struct Piece
      {
        const FrameEdge *edge;
        double           left, right;
        /// Run from left to right: the element is above.
        bool is_bottom;
        /// Arcs: range of tan(tau/2) and the sign of ds_1/dtau.
        double t_min, t_max, slope_sign;

        /// tan(tau/2) where the arc has first coordinate @p s.
        double
        arc_parameter(double s) const;

        /// Second coordinate at first coordinate @p s.
        double
        height(double s) const;

        /// |ds_1/dtau| at @p s.
        double
        arc_speed(double s) const;
      };

      void
      make_pieces(const std::vector<FrameEdge> &edges);

      void
      add_piece(const FrameEdge &edge,
                double           left,
                double           right,
                bool             is_bottom,
                double           t_min,
                double           t_max,
                double           slope_sign);

      void
      fill_slab(const ElementFrame &frame,
                double              left,
                double              right,
                unsigned int        n_along,
                unsigned int        n_across,
                unsigned int        n_arc_extra,
                GaussTable         &gauss);

      void
      fill_trapezoid(const ElementFrame &frame,
                     const Piece        &bottom,
                     const Piece        &top,
                     double              left,
                     double              right,
                     unsigned int        n_along,
                     unsigned int        n_across,
                     GaussTable         &gauss);

      bool
      add_point(const ElementFrame          &frame,
                const Piece                 &bottom,
                const Piece                 &top,
                double                       left,
                double                       right,
                const std::array<double, 2> &s,
                double                       weight);

      std::vector<Piece>  pieces;
      std::vector<double> slices;
      std::vector<bool>   is_cancelled;
      /// (height, piece) of the pieces that span a slab.
      std::vector<std::pair<double, const Piece *>> stack;
    };
  } // namespace internal
} // namespace NMM

#endif
