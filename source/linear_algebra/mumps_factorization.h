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
     * Factorization by MUMPS on the communicator of the matrix: L D L^T for a symmetric
     * matrix (definite or not), L U for any other.
     *
     * It has three stages. The analysis depends on the pattern only and is kept for further
     * matrices of the same pattern. The factorization uses the values. Then systems with any
     * number of right-hand sides can be solved.
     *
     * MUMPS is called directly because Amesos_Mumps offers its unsymmetric
     * factorization only (and converts the matrix twice): 1.2 s instead of 0.4 s and
     * twice the memory for 91,000 unknowns of second order. The library is a part
     * of Trilinos' Amesos, so that nothing more is needed.
     *
     * On several ranks MUMPS sums contributions in the order in which they arrive, so
     * that repeated runs differ in the last digits. Systems of fewer than n_distributed
     * unknowns are therefore factorized by the first rank alone, which gives bitwise
     * reproducible results and takes no longer.
     *
     * The rows of each rank must be consecutive.
     */
    class MumpsFactorization
      : public DirectFactorization<dealii::TrilinosWrappers::SparseMatrix>
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Number of unknowns from which on all ranks take part in the factorization.
      static constexpr unsigned int n_distributed = 30000;

      explicit MumpsFactorization(bool is_symmetric);
      ~MumpsFactorization() override;

      /// Discard the analysis, because the next matrix has another pattern.
      void
      forget_analysis();

      bool
      is_analyzed() const;

      /// Wall time of the last analysis [s].
      double
      analysis_time() const;

      /// Always returns true. Rows and columns that are not in @p rows are replaced by the
      /// equations x = b. If there is an analysis, the pattern must be the same as before.
      /// Messages of exceptions contain MUMPS' error code.
      bool
      factorize(const Matrix                    &matrix,
                const std::vector<unsigned int> &rows) override;

      double
      n_factor_entries() const override;

      /// Solves for all rows; @p bodies is ignored.
      void
      solve(const Vector            &rhs,
            Vector                  &solution,
            const std::vector<bool> &bodies) override;

      /// The factors are read once for all vectors, which is what takes the time: two systems take
      /// as long as one, five 1.5 times as long (92,584 unknowns).
      void
      solve_all(std::vector<Vector> &vectors) override;

    private:
      struct Data;
      std::unique_ptr<Data> data;
    };
  } // namespace internal
} // namespace NMM

#endif
