#ifndef nmm_quadrature_rule_reduction_h
#define nmm_quadrature_rule_reduction_h

#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Reduces a positive rule to at most as many points as there are
     * functions, and keeps its moments. This is Caratheodory's theorem, made into an
     * algorithm for cubature by Tchakaloff (Bull. Sci. Math. 81, 1957).
     *
     * With A the matrix of the functions' values times weights (functions x
     * points) and u = 1 the relative weights, Gauss-Jordan elimination with
     * pivoting over the *points* gives A = A_B [I T]. This yields a well-conditioned basis B of
     * points (discrete Leja points) and a null vector for every other point. As in
     * the simplex method, the other points are removed one by one. If the weight of a basic
     * point reaches zero first, that point is removed and the other one takes its place in the
     * basis. Each function that vanishes on all points to round-off lowers the rank, and the
     * number of points that are left, by one.
     * Cost: O(functions^2 x points + functions x eliminated points^2).
     */
    class RuleReduction
    {
    public:
      /**
       * @param values  values of the functions at the points, (functions x points), row by row.
       * @param moments integrals of the functions that the rule should have.
       * @param noise   round-off of the moments.
       * @param correct whether weights that miss the moments by more than @p noise are
       *   first changed by the smallest relative amounts that restore the
       *   moments; if false, the rule keeps the moments of the given weights.
       * @param weights positive weights; on return they are zero where points were removed.
       * @return false if a corrected weight was not positive.
       */
      bool
      reduce(const std::vector<double> &values,
             const std::vector<double> &moments,
             double                     noise,
             bool                       correct,
             std::vector<double>       &weights);

      /// Solves once more for the weights of the points that are left, at most twice, until no
      /// moment has an error above @p goal or the error does not decrease. Weights stay positive.
      /// @return the largest error of a moment.
      double
      polish(const std::vector<double> &values,
             const std::vector<double> &moments,
             double                     goal,
             std::vector<double>       &weights);

    private:
      void
      make_tableau(const std::vector<double> &values,
                   const std::vector<double> &weights,
                   std::size_t                n_points,
                   double                     rank_tolerance);

      bool
      correct_weights();

      void
      eliminate();

      void
      pivot(std::size_t row, std::size_t column);

      double
      residual_of(const std::vector<double> &values,
                  const std::vector<double> &moments,
                  const std::vector<double> &weights);

      void
      solve_survivors(const std::vector<double> &values,
                      const std::vector<double> &weights);

      double *
      row(const std::size_t i)
      {
        return tableau.data() + rows[i] * stride;
      }

      std::size_t n = 0, n_columns = 0, stride = 0, rank = 0;

      /// The eliminated matrix, (n x stride); columns [rank, n_columns) hold T.
      std::vector<double> tableau;
      /// Row of the tableau for each basic point.
      std::vector<std::size_t> rows;
      /// The point of each column, and a copy of them before the elimination.
      std::vector<std::size_t> columns, active;
      /// Relative weights of the columns.
      std::vector<double> u;
      std::vector<double> right_side, residual;
      std::vector<double> gram, solution, before;
    };
  } // namespace internal
} // namespace NMM

#endif
