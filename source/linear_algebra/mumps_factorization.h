#ifndef nmm_source_linear_algebra_mumps_factorization_h
#define nmm_source_linear_algebra_mumps_factorization_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <linear_algebra/direct_factorization.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Factorization by MUMPS on the matrix's communicator: L D L^T of a symmetric
     * matrix (definite or not), L U of any other.
     *
     * It has three stages. The analysis looks at the pattern only, and is kept for further
     * matrices of the same pattern; the factorization takes the values; then any number of
     * right-hand sides can be solved.
     *
     * MUMPS is called directly because Amesos_Mumps offers its unsymmetric
     * factorization only (and converts the matrix twice): 1.2 s instead of 0.4 s and
     * twice the memory for 91,000 unknowns of second order. The library is a part
     * of Trilinos' Amesos, so that nothing more is needed.
     *
     * On several ranks MUMPS adds up contributions in the order in which they arrive, so
     * that repeated runs differ in the last digits. Systems of fewer than n_distributed
     * unknowns are therefore factorized by the first rank alone, which always gives the
     * same bits and takes no longer.
     *
     * Rows are consecutive per rank.
     */
    class MumpsFactorization
      : public DirectFactorization<dealii::TrilinosWrappers::SparseMatrix>
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      static constexpr unsigned int n_distributed = 30000;

      explicit MumpsFactorization(bool is_symmetric);
      ~MumpsFactorization() override;

      /// The next matrix has another pattern.
      void
      forget_analysis();

      bool
      is_analyzed() const;

      /// Wall time of the last analysis [s].
      double
      analysis_time() const;

      /// Always returns true. Rows and columns that are not chosen become equations
      /// x = b. The pattern is the one of the last analysis, if there is one. Exceptions
      /// have MUMPS' error code.
      bool
      factorize(const Matrix                    &matrix,
                const std::vector<unsigned int> &rows) override;

      double
      n_factor_entries() const override;

      /// @p bodies is not looked at: all rows are solved for.
      void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies) override;

    private:
      struct Data;
      std::unique_ptr<Data> data;
    };
  } // namespace internal
} // namespace NMM

#endif
