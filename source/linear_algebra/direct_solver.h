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
     * Solves A x = b by a factorization, and chooses which:
     *
     * | matrix | solver |
     * |---|---|
     * | couplings of bodies of at most BodyMatrix::max_body unknowns | BodyLu |
     * | sparse, uncoupled groups of at most KluFactorization::max_group unknowns | KluFactorization |
     * | any other, any number of ranks | MumpsFactorization |
     *
     * The first two are for one rank. Order of calls: factorize(), then any number of
     * solve(). A factorization of the same pattern reuses what MUMPS found out about
     * the last one; call forget_analysis() before a matrix of another pattern.
     */
    class DirectSolver
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;
      using Vector = Factors::Vector;

      enum class Symmetry
      {
        symmetric,
        unsymmetric
      };

      /// @p unknown_to_body: body of each unknown, for matrices whose couplings
      /// between bodies change from one factorization to the next; else empty.
      explicit DirectSolver(
        Symmetry                         symmetry        = Symmetry::symmetric,
        const std::vector<unsigned int> &unknown_to_body = {});

      DirectSolver(const DirectSolver &) = delete;
      DirectSolver &
      operator=(const DirectSolver &) = delete;

      /// The next matrix has another pattern.
      void
      forget_analysis();

      /**
       * Factorize @p rows and columns, ascending (empty: all; a choice is for one rank).
       * @p couplings: the bodies that each body is coupled with by values other than
       * zero, if bodies are known; with them bodies that are small go to BodyLu.
       * @throws NumericalFailure for a singular matrix or lack of memory.
       */
      void
      factorize(const Matrix                    &matrix,
                const std::vector<unsigned int> &rows      = {},
                const BodyMatrix::Couplings     &couplings = {});

      /// The same for a body matrix. If the matrix of a single body is singular, the
      /// whole is factorized as a sparse matrix.
      void
      factorize(const BodyMatrix                &matrix,
                const std::vector<unsigned int> &rows);

      /// See Factors::solve().
      void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies = {});

      /// Wall time of MUMPS' last analysis [s].
      double
      analysis_time() const;

      /// Entries of the factors of the last factorization, of all ranks.
      double
      n_factor_entries() const;

    private:
      void
      factorize_sparse(const Matrix                    &matrix,
                       const std::vector<unsigned int> &rows);

      MumpsFactorization mumps;
      KluFactorization   klu;
      BodyLu             body_lu;
      /// The last factorization.
      Factors *factors = nullptr;

      bool has_bodies;
      /// Copy of a sparse matrix for BodyLu; null if bodies are too large for it.
      std::unique_ptr<BodyMatrix> body_matrix;
      /// Copy of a body matrix that BodyLu found singular.
      std::unique_ptr<Matrix> sparse_matrix;
    };
  } // namespace internal
} // namespace NMM

#endif
