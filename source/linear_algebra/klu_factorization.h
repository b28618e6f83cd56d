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
     * small systems which are not coupled, such as blocks of rock of which few touch.
     * KLU permutes the matrix to block triangular form and factorizes the diagonal
     * blocks one by one (Davis & Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36).
     *
     * Entries that are exactly zero are left out, since the pattern has places for
     * contact that is not closed at present: with those all blocks would be one system.
     * The order of elimination is therefore found anew for each matrix. Numbers are in
     * doc/dependencies.md.
     *
     * KLU has no dense kernels, so that it declines matrices with large groups. One rank;
     * it declines matrices on several.
     */
    class KluFactorization
      : public DirectFactorization<dealii::TrilinosWrappers::SparseMatrix>
    {
    public:
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      /// Unknowns of the largest system for which KLU is always chosen.
      static constexpr unsigned int max_group = 360;

      /// Operations per unknown up to which KLU is chosen for larger systems if the
      /// alternative needs an analysis for this matrix alone.
      static constexpr double max_operations = 5000.;

      KluFactorization();
      ~KluFactorization() override;

      /// Whether the alternative needs an analysis, see max_operations.
      void
      set_analysis_is_needed(bool is_needed);

      bool
      factorize(const Matrix                    &matrix,
                const std::vector<unsigned int> &rows) override;

      double
      n_factor_entries() const override;

      /// @p bodies is not looked at: all chosen rows are solved for.
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
