#ifndef nmm_source_linear_algebra_direct_factorization_h
#define nmm_source_linear_algebra_direct_factorization_h

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Triangular factors of chosen rows and columns of a matrix, with which any
    /// number of right-hand sides can be solved.
    class Factors
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

      virtual ~Factors() = default;

      /// Entries that are stored, of both factors and all ranks.
      virtual double
      n_factor_entries() const = 0;

      /**
       * Solve A x = b for the chosen rows and columns. Other rows of @p solution are
       * unchanged or undefined. @p solution has the layout of @p rhs and may be the
       * same vector.
       * @p bodies: only rows of these bodies are wanted, which must not be coupled with
       * any other body; more may be solved for. Empty: all rows.
       */
      virtual void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies) = 0;
    };


    /**
     * A direct solver for one type of matrix. DirectSolver chooses between them.
     * Who adds a solver implements this in a file of its own and adds it there.
     */
    template <typename MatrixType>
    class DirectFactorization : public Factors
    {
    public:
      /**
       * Factorize the rows and columns @p rows of @p matrix, ascending; empty: all.
       * Returns false if this solver is not suitable for the matrix, so that another
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
