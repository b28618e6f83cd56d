#ifndef nmm_source_linear_algebra_direct_solver_h
#define nmm_source_linear_algebra_direct_solver_h

#include <linear_algebra/body_lu.h>
#include <linear_algebra/klu_factorization.h>
#include <linear_algebra/mumps_factorization.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Solves A x = b by a factorization, and selects the factorization:
     *
     * | matrix | solver |
     * |---|---|
     * | couplings of bodies of at most BodyMatrix::max_body unknowns | BodyLu |
     * | sparse, uncoupled groups of at most KluFactorization::max_group unknowns, or larger ones with few operations if MUMPS needs a new analysis (KluFactorization::max_operations) | KluFactorization |
     * | any other, any number of ranks | MumpsFactorization |
     *
     * The first two work on one rank only. Order of calls: factorize(), then solve() any number
     * of times. Factorizations of matrices of the same pattern share MUMPS' analysis;
     * call forget_analysis() before a matrix of another pattern.
     */
    class DirectSolver
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;
      using Vector = Factors::Vector;

      /// All entries of a matrix are stored in both cases.
      enum class Symmetry
      {
        /// Symmetric, whether positive definite or not.
        symmetric,
        unsymmetric
      };

      /// @p unknown_to_body is the body of each unknown, for matrices whose couplings
      /// between bodies change from one factorization to the next; otherwise it is empty.
      explicit DirectSolver(
        Symmetry                         symmetry        = Symmetry::symmetric,
        const std::vector<unsigned int> &unknown_to_body = {});

      DirectSolver(const DirectSolver &) = delete;
      DirectSolver &
      operator=(const DirectSolver &) = delete;

      /// Discard MUMPS' analysis, because the next matrix has another sparsity pattern.
      void
      forget_analysis();

      /**
       * Factorize the rows and columns @p rows (ascending; empty: all, which is required on
       * several ranks). @p couplings are the bodies with which each body is coupled by nonzero
       * values; if they are given and bodies are small, BodyLu is used.
       * @throws NumericalFailure for a singular matrix or lack of memory.
       */
      void
      factorize(const Matrix                    &matrix,
                const std::vector<unsigned int> &rows      = {},
                const BodyMatrix::Couplings     &couplings = {});

      /// Factorize a body matrix. If BodyLu finds no sufficient pivots, the matrix is converted to
      /// a sparse one.
      void
      factorize(const BodyMatrix                &matrix,
                const std::vector<unsigned int> &rows);

      /// See Factors::solve().
      void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies = {});

      /// See Factors::solve_all().
      void
      solve_all(std::vector<Vector> &vectors);

      /// Wall time of MUMPS' last analysis [s].
      double
      analysis_time() const;

      /// Number of entries of the last factors, summed over ranks.
      double
      n_factor_entries() const;

    private:
      void
      factorize_sparse(const Matrix                    &matrix,
                       const std::vector<unsigned int> &rows);

      MumpsFactorization mumps;
      KluFactorization   klu;
      BodyLu             body_lu;
      /// The last factors, those of one of the solvers above.
      Factors *factors = nullptr;

      bool has_bodies;
      /// Copy of a sparse matrix for BodyLu; null if bodies are too large for BodyLu.
      std::unique_ptr<BodyMatrix> body_matrix;
      /// Sparse copy of a body matrix that BodyLu could not factorize.
      std::unique_ptr<Matrix> sparse_matrix;
    };
  } // namespace internal
} // namespace NMM

#endif
