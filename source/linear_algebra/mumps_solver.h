#ifndef nmm_source_linear_algebra_mumps_solver_h
#define nmm_source_linear_algebra_mumps_solver_h

#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Solves A x = b by MUMPS' factorization on the matrix's communicator:
     * LDL^T of a symmetric matrix (definite or not), LU of any other.
     *
     * The three stages can be called apart: analyze() looks at the pattern
     * only, so that matrices of equal pattern share it; factorize() takes the
     * values; solve() can then be called for any number of right-hand sides.
     *
     * MUMPS is called itself because Amesos_Mumps fixes the unsymmetric
     * factorization (and converts the matrix twice): 1.2 s instead of 0.4 s and
     * twice the memory for 91,000 unknowns of second order. The library comes
     * with Trilinos' Amesos, so that nothing more is needed.
     *
     * On several ranks MUMPS adds what other ranks send in the order it arrives, so
     * that the same run has other last digits each time. Systems below
     * n_distributed unknowns are therefore factorized by the first rank alone, which
     * gives the same bits always and takes no longer.
     *
     * Small blocks that touch here and there go to BodyLu instead, and what falls apart
     * into small systems to KluSolver, on one rank.
     *
     * Rows are consecutive per rank.
     */
    class DirectSolver
    {
    public:
      enum class Symmetry
      {
        symmetric,
        unsymmetric
      };

      static constexpr unsigned int n_distributed = 30000;

      /// @p unknown_to_block: if it is of blocks that touch here and there, and elsewhere the
      /// next time. Small ones are then BodyLu's, and with others KLU is tried with large
      /// groups, too.
      explicit DirectSolver(
        Symmetry                         symmetry         = Symmetry::symmetric,
        const std::vector<unsigned int> &unknown_to_block = {});
      ~DirectSolver();

      /// The next matrix has another pattern.
      void
      forget_analysis();

      /// Order the unknowns for the pattern of @p matrix, for MUMPS. @throws
      /// NumericalFailure for lack of memory.
      void
      analyze(const dealii::TrilinosWrappers::SparseMatrix &matrix);

      /// Factorize; analyze() is called if it has not been. The pattern must be
      /// the one analyzed. @throws NumericalFailure with MUMPS' error code for a
      /// singular matrix or lack of memory.
      /// @p rows: only these rows and columns are solved for, ascending, on one rank;
      /// solutions mean nothing in the others. Empty: all. @p couplings: with which blocks
      /// each block is coupled by values other than zero, if there are blocks.
      void
      factorize(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                const std::vector<unsigned int>              &rows      = {},
                const std::vector<std::vector<unsigned int>> &couplings = {});

      /// The same of a matrix of small blocks; of a sparse matrix if a block is singular.
      void
      factorize(const BodyMatrix                &matrix,
                const std::vector<unsigned int> &rows);

      /// @p solution has the layout of @p rhs; may be the same vector. @p blocks: see
      /// Factors.
      void
      solve(const dealii::TrilinosWrappers::MPI::Vector &rhs,
            dealii::TrilinosWrappers::MPI::Vector       &solution,
            const std::vector<bool>                     &blocks = {});

      /// Wall time of the last analyze() [s].
      double
      analysis_time() const;

      /// Entries of the factors of the last factorization, of all ranks.
      double
      n_factor_entries() const;

    private:
      /// By KLU or MUMPS.
      void
      factorize_entries(const dealii::TrilinosWrappers::SparseMatrix &matrix);

      void
      set_controls();

      struct Data;
      std::unique_ptr<Data> data;
    };
  } // namespace internal
} // namespace NMM

#endif
