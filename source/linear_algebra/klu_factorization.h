#ifndef nmm_source_linear_algebra_klu_factorization_h
#define nmm_source_linear_algebra_klu_factorization_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <linear_algebra/direct_factorization.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * LU factorization by SuiteSparse's KLU, for a sparse matrix that consists of many
     * small uncoupled systems, such as blocks of rock of which few touch.
     * KLU permutes the matrix to block triangular form and factorizes the diagonal
     * blocks one by one (Davis & Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36).
     *
     * Entries that are exactly zero are left out. The sparsity pattern contains couplings by
     * contacts that are open at present, and with these all blocks would be one system.
     * The order of elimination is therefore computed for each matrix. Measurements are in
     * doc/dependencies.md.
     *
     * KLU has no dense kernels and is slow for large groups of coupled unknowns. factorize()
     * therefore returns false for matrices with large groups, and for matrices on several ranks.
     */
    class KluFactorization
      : public DirectFactorization<dealii::TrilinosWrappers::SparseMatrix>
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Largest number of unknowns of a group of coupled unknowns up to which KLU is always used.
      static constexpr unsigned int max_group = 360;

      /// Largest number of operations per unknown up to which KLU is used for larger groups, if
      /// the alternative solver needs a new analysis for this matrix.
      static constexpr double max_operations = 5000.;

      KluFactorization();
      ~KluFactorization() override;

      /// Set whether the alternative solver needs a new analysis, see max_operations.
      void
      set_analysis_is_needed(bool is_needed);

      bool
      factorize(const Matrix                    &matrix,
                const std::vector<unsigned int> &rows) override;

      double
      n_factor_entries() const override;

      /// Solves for all factorized rows; @p bodies is ignored.
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
