#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>

#include <Epetra_Import.h>
#include <Epetra_MultiVector.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <linear_algebra/direct_solver.h>
#include <linear_algebra/linear_solver.h>
#include <linear_algebra/matrix_rows.h>
#include <linear_algebra/two_level_preconditioner.h>
#include <memory>
#include <ml_MultiLevelPreconditioner.h>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;
      using Vector = dealii::TrilinosWrappers::MPI::Vector;
      using AllRhs = std::vector<const Vector *>;
      /// |b - A x| / |b| [-]; |A x| if b = 0.
      double
      relative_residual(const Matrix &matrix,
                        const Vector &rhs,
                        const Vector &x)
      {
        Vector       residual(rhs);
        const double norm = rhs.l2_norm();
        matrix.vmult(residual, x);
        residual.sadd(-1., rhs);
        return norm > 0. ? residual.l2_norm() / norm : residual.l2_norm();
      }


      /// Samples of +-epsilon (sum_j |K_ij x_j| + |f_i|) [N], see solve_linear_system(). It reads
      /// the entries of K in place, because a copy would take as long as a substitution.
      std::vector<Vector>
      samples_of_rounding(const Matrix      &matrix,
                          const Vector      &rhs,
                          const Vector      &x,
                          const unsigned int n_samples)
      {
        const Epetra_CrsMatrix &K = matrix.trilinos_matrix();
        Epetra_MultiVector      imported(K.ColMap(), 1);
        const double           *x_of_columns = x.begin();
        if (K.Importer() != nullptr)
        {
          imported.Import(x.trilinos_vector(), *K.Importer(), Insert);
          x_of_columns = imported[0];
        }
        const MatrixRows            rows(K);
        std::vector<Vector>         samples(n_samples, rhs);
        std::mt19937                generator(matrix.local_range().first);
        std::bernoulli_distribution is_positive;
        for (int r = 0; r < K.NumMyRows(); ++r)
        {
          double sum = std::abs(*(rhs.begin() + r));
          for (int j = rows.begins[r]; j < rows.begins[r + 1]; ++j)
            sum += std::abs(rows.values[j] * x_of_columns[rows.columns[j]]);
          sum *= std::numeric_limits<double>::epsilon();
          for (Vector &sample : samples)
            *(sample.begin() + r) = is_positive(generator) ? sum : -sum;
        }
        return samples;
      }


      /// Solve for all right-hand sides and estimate the effect of rounding, see
      /// solve_linear_system().
      void
      solve_direct(const Matrix   &matrix,
                   const AllRhs   &rhs,
                   LinearSolution &result)
      {
        std::vector<Vector>   &solutions    = result.solutions;
        LinearSolverReport    &report       = result.report;
        constexpr double       worth_a_look = 1e-8;
        constexpr unsigned int n_samples    = 4;

        dealii::Timer timer;
        DirectSolver  solver;
        solver.factorize(matrix);
        report.direct             = true;
        report.analysis_time      = solver.analysis_time();
        report.factorization_time = timer.wall_time() - report.analysis_time;
        report.n_factor_entries   = solver.n_factor_entries();
        timer.restart();
        Vector zero(*rhs[0]), one(*rhs[0]);
        zero = 0.;
        one  = 1.;
        for (unsigned int i = 0; i < rhs.size(); ++i)
          solutions[i] = *rhs[i];
        solutions.push_back(samples_of_rounding(matrix, zero, one, 1)[0]);
        solver.solve_all(solutions);
        const double size = solutions[0].l2_norm();
        if (size > 0.)
          report.rounding_effect =
            2. * solutions[0].linfty_norm() * solutions.back().l2_norm() / size;
        solutions.pop_back();
        if (report.rounding_effect > worth_a_look)
        {
          result.effects =
            samples_of_rounding(matrix, *rhs[0], solutions[0], n_samples);
          solver.solve_all(result.effects);
          report.rounding_effect = 0.;
          for (const Vector &effect : result.effects)
            report.rounding_effect =
              std::max(report.rounding_effect, effect.l2_norm() / size);
        }
        report.solution_time = timer.wall_time();
      }


      /// Preconditioner for first order: smoothed aggregation multigrid (ML) of the matrix itself.
      class OneLevelPreconditioner
      {
      public:
        OneLevelPreconditioner(
          const Matrix                            &matrix,
          const CoverSystem                       &covers,
          const dealii::AffineConstraints<double> &constraints)
        {
          std::vector<unsigned int> owned;
          for (const unsigned int k : covers.locally_owned_covers())
            owned.push_back(k);
          // Cut elements widen the spectrum. A wide interval for the Chebyshev smoother
          // saves a quarter of the iterations.
          ml = make_aggregation_multigrid(matrix.trilinos_matrix(),
                                          rigid_body_modes(covers,
                                                           constraints,
                                                           owned),
                                          4,
                                          100.);
        }

        void
        vmult(Vector &dst, const Vector &src) const
        {
          ml->ApplyInverse(src.trilinos_vector(), dst.trilinos_vector());
        }

      private:
        std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> ml;
      };


      /// Number of rows on all ranks that no constraint eliminates.
      dealii::types::global_dof_index
      count_unknowns(const Matrix                            &matrix,
                     const dealii::AffineConstraints<double> &constraints)
      {
        const auto [first, last]          = matrix.local_range();
        dealii::types::global_dof_index n = 0;
        for (auto i = first; i < last; ++i)
          n += !constraints.is_constrained(i);
        return dealii::Utilities::MPI::sum(n, matrix.get_mpi_communicator());
      }


      /// Solve by conjugate gradients. Returns the reason if they did not converge for one of the
      /// right-hand sides, otherwise an empty string. If the choice is automatic, all right-hand
      /// sides together may take no more iterations than one may, and iterations end as soon as
      /// the first of them shows that they would take more: the factors of a direct
      /// solver serve all of them.
      template <typename Preconditioner>
      std::string
      solve_iterative(const Matrix                            &matrix,
                      const AllRhs                            &all_rhs,
                      const CoverSystem                       &covers,
                      const dealii::AffineConstraints<double> &constraints,
                      const LinearSolverParameters            &parameters,
                      LinearSolution                          &result)
      {
        LinearSolverReport  &report = result.report;
        dealii::Timer        timer;
        const Preconditioner preconditioner(matrix, covers, constraints);
        report.direct             = false;
        report.factorization_time = timer.wall_time();
        timer.restart();
        report.n_iterations = 0;
        const bool is_automatic =
          parameters.type == LinearSolverParameters::Type::automatic;
        unsigned int n_left = parameters.max_iterations;
        std::string  failure;
        for (unsigned int i = 0; i < all_rhs.size() && failure.empty(); ++i)
        {
          const double             norm = all_rhs[i]->l2_norm();
          dealii::SolverControl    control(n_left, parameters.tolerance * norm);
          dealii::SolverCG<Vector> solver(control);
          try
          {
            if (norm > 0.)
              solver.solve(matrix,
                           result.solutions[i],
                           *all_rhs[i],
                           preconditioner);
          }
          catch (const dealii::SolverControl::NoConvergence &error)
          {
            std::ostringstream what;
            what << "Conjugate gradients did not converge: after "
                 << error.last_step << " iterations the relative residual is "
                 << error.last_residual / norm << " instead of "
                 << parameters.tolerance;
            failure = what.str();
          }
          if (norm == 0.)
            continue;
          report.n_iterations =
            std::max(report.n_iterations, control.last_step());
          if (!is_automatic || !failure.empty())
            continue;
          n_left -= control.last_step();
          const std::size_t n_more = all_rhs.size() - i - 1;
          if (n_more * control.last_step() > n_left)
            failure =
              "Conjugate gradients would take too many iterations for "
              "all right-hand sides";
        }
        report.solution_time = timer.wall_time();
        return failure;
      }
    } // namespace


    LinearSolution
    solve_linear_system(const Matrix                            &matrix,
                        const AllRhs                            &rhs,
                        const CoverSystem                       &covers,
                        const dealii::AffineConstraints<double> &constraints,
                        const LinearSolverParameters            &parameters)
    {
      using Type = LinearSolverParameters::Type;
      LinearSolution      result;
      LinearSolverReport &report = result.report;
      result.solutions.assign(rhs.size(), *rhs.front());
      for (Vector &solution : result.solutions)
        solution = 0.;
      // Without loads the solution is zero, and the relative residual is undefined.
      if (std::all_of(rhs.begin(), rhs.end(), [](const Vector *b) {
            return b->l2_norm() == 0.;
          }))
        return result;

      if (parameters.type == Type::direct ||
          (parameters.type == Type::automatic &&
           count_unknowns(matrix, constraints) <= parameters.direct_limit))
        solve_direct(matrix, rhs, result);
      else
      {
        const auto solve =
          covers.manifold_mesh().mathematical_mesh().degree() == 2
            ? &solve_iterative<TwoLevelPreconditioner>
            : &solve_iterative<OneLevelPreconditioner>;
        const std::string failure =
          solve(matrix, rhs, covers, constraints, parameters, result);
        AssertThrow(failure.empty() || parameters.type == Type::automatic,
                    NumericalFailure(failure,
                                     "",
                                     "choose the direct solver, more "
                                     "iterations, or aggregation of covers if "
                                     "it is off"));
        if (!failure.empty())
          solve_direct(matrix, rhs, result);
      }

      report.relative_residual = 0.;
      for (unsigned int i = 0; i < rhs.size(); ++i)
      {
        const double residual =
          relative_residual(matrix, *rhs[i], result.solutions[i]);
        // written so that the report has a residual that is not a number
        if (!(residual <= report.relative_residual))
          report.relative_residual = residual;
      }
      AssertThrow(
        std::isfinite(report.relative_residual) &&
          report.relative_residual < 1e-5,
        NumericalFailure("The linear system is singular to rounding: the "
                         "solution's relative residual is " +
                           std::to_string(report.relative_residual),
                         "",
                         "look for parts that hardly anything holds, or for "
                         "materials of extreme stiffness contrast"));
      return result;
    }
  } // namespace internal
} // namespace NMM
