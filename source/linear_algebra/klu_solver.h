#ifndef nmm_source_linear_algebra_klu_solver_h
#define nmm_source_linear_algebra_klu_solver_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <linear_algebra/factors.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Solves A x = b for many small systems in one: blocks that hang
     * together where they touch and else not at all. SuiteSparse's KLU permutes A to
     * block triangular form and factorizes its diagonal blocks one by one (Davis &
     * Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36).
     *
     * Entries that are exactly zero are left out: places that are kept for contact
     * that may come would make one system of all. Ordering is therefore done anew each
     * time, for a tenth of what MUMPS takes per matrix: 2,000 blocks of 12 unknowns
     * of which every tenth touches another take 7 instead of 38 us per block and matrix.
     *
     * Rows and columns can be left out: those of what is not being solved for.
     *
     * One rank.
     */
    class KluSolver : public Factors
    {
    public:
      /// Of a system that hangs together: about larger ones one has to ask
      /// operations_per_unknown().
      static constexpr unsigned int max_group = 360;

      KluSolver();
      ~KluSolver() override;

      /// Does no group of unknowns that are coupled by values other than zero have more
      /// than max_group? Looks no further than to the first that has.
      /// Of @p rows, ascending; empty: of all.
      bool
      is_suitable(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                  const std::vector<unsigned int>              &rows);

      /// Take values of @p rows and columns (empty: all) and order them. Returns how
      /// many operations the factorization is going to take per unknown: KLU has no dense
      /// kernels, what takes many is done better by others.
      double
      analyze(const dealii::TrilinosWrappers::SparseMatrix &matrix,
              const std::vector<unsigned int>              &rows);

      /// After analyze(). @throws NumericalFailure for a singular matrix or lack of memory.
      void
      factorize();

      double
      n_factor_entries() const override;

      void
      solve(const dealii::TrilinosWrappers::MPI::Vector &rhs,
            dealii::TrilinosWrappers::MPI::Vector       &solution,
            const std::vector<bool>                     &blocks) override;

    private:
      struct Data;
      std::unique_ptr<Data> data;
    };
  } // namespace internal
} // namespace NMM

#endif
