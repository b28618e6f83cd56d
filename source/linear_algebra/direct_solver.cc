#include <initializer_list>
#include <linear_algebra/direct_solver.h>

namespace NMM
{
  namespace internal
  {
    DirectSolver::DirectSolver(const Symmetry                   symmetry,
                               const std::vector<unsigned int> &unknown_to_body)
      : mumps(symmetry == Symmetry::symmetric)
      , has_bodies(!unknown_to_body.empty())
    {
      if (BodyMatrix::is_suitable(unknown_to_body))
        body_matrix = std::make_unique<BodyMatrix>(unknown_to_body);
    }


    void
    DirectSolver::forget_analysis()
    {
      mumps.forget_analysis();
    }


    void
    DirectSolver::factorize(const Matrix                    &matrix,
                            const std::vector<unsigned int> &rows,
                            const BodyMatrix::Couplings     &couplings)
    {
      if (body_matrix != nullptr && !couplings.empty())
      {
        std::vector<bool> is_chosen(rows.empty() ? 0 : body_matrix->n_bodies());
        for (const unsigned int row : rows)
          is_chosen[body_matrix->body_of(row)] = true;
        body_matrix->read(matrix, is_chosen, couplings);
        if (body_lu.factorize(*body_matrix, rows))
        {
          factors = &body_lu;
          return;
        }
      }
      factorize_sparse(matrix, rows);
    }


    void
    DirectSolver::factorize(const BodyMatrix                &matrix,
                            const std::vector<unsigned int> &rows)
    {
      if (body_lu.factorize(matrix, rows))
      {
        factors = &body_lu;
        return;
      }
      forget_analysis();
      sparse_matrix = std::make_unique<Matrix>(matrix.sparse());
      factorize_sparse(*sparse_matrix, rows);
    }


    void
    DirectSolver::factorize_sparse(const Matrix                    &matrix,
                                   const std::vector<unsigned int> &rows)
    {
      factors = nullptr;
      // If MUMPS needs a new analysis, KLU is faster even for larger groups of unknowns.
      klu.set_analysis_is_needed(has_bodies && !mumps.is_analyzed());
      for (DirectFactorization<Matrix> *candidate :
           std::initializer_list<DirectFactorization<Matrix> *>{&klu, &mumps})
        if (candidate->factorize(matrix, rows))
        {
          factors = candidate;
          return;
        }
      Assert(false, dealii::ExcInternalError());
    }


    void
    DirectSolver::solve(const Vector            &rhs,
                        Vector                  &solution,
                        const std::vector<bool> &bodies)
    {
      Assert(factors != nullptr, dealii::ExcMessage("Call factorize() first."));
      factors->solve(rhs, solution, bodies);
    }


    void
    DirectSolver::solve_all(std::vector<Vector> &vectors)
    {
      Assert(factors != nullptr, dealii::ExcMessage("Call factorize() first."));
      factors->solve_all(vectors);
    }


    double
    DirectSolver::analysis_time() const
    {
      return mumps.analysis_time();
    }


    double
    DirectSolver::n_factor_entries() const
    {
      return factors == nullptr ? 0. : factors->n_factor_entries();
    }
  } // namespace internal
} // namespace NMM
