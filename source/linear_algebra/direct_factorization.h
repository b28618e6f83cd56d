#ifndef nmm_source_linear_algebra_direct_factorization_h
#define nmm_source_linear_algebra_direct_factorization_h

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The interface of triangular factors of selected rows and columns of a matrix, with which
    /// systems with any number of right-hand sides can be solved.
    class Factors
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      virtual ~Factors() = default;

      /// Number of stored entries of both factors, summed over ranks.
      virtual double
      n_factor_entries() const = 0;

      /**
       * Solve A x = b for the selected rows and columns. Other rows of @p solution are
       * unchanged or undefined. @p solution has the layout of @p rhs and may be the
       * same vector. Only the rows of @p bodies (empty: all) need be solved; these bodies must not
       * be coupled with any other body.
       */
      virtual void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies) = 0;

      /// Solve A x = b for all selected rows and several right-hand sides: each of @p vectors is b
      /// before and x afterwards.
      virtual void
      solve_all(std::vector<Vector> &vectors)
      {
        for (Vector &vector : vectors)
          solve(vector, vector, {});
      }
    };


    /**
     * The interface of a direct solver for one type of matrix. DirectSolver asks its solvers in
     * turn, until factorize() of one returns true; the last one must be suitable for any matrix.
     * To add a solver, see linear_algebra.h.
     */
    template <typename MatrixType>
    class DirectFactorization : public Factors
    {
    public:
      /**
       * Factorize the rows and columns @p rows of @p matrix (ascending; empty: all).
       * Returns false if this solver is not suitable for the matrix and another
       * one has to factorize it.
       * @throws NumericalFailure for a singular matrix or lack of memory.
       */
      [[nodiscard]] virtual bool
      factorize(const MatrixType                &matrix,
                const std::vector<unsigned int> &rows) = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
