#include <nmm/base/exceptions.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>
#include <linear_algebra/linear_solver.h>
#include <linear_algebra/mumps_solver.h>
#include <linear_algebra/two_level_preconditioner.h>
#include <ml_MultiLevelPreconditioner.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;
      using Vector = dealii::TrilinosWrappers::MPI::Vector;

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


      void
      solve_direct(const Matrix       &matrix,
                   const Vector       &rhs,
                   Vector             &solution,
                   LinearSolverReport &report)
      {
        dealii::Timer timer;
        DirectSolver  solver;
        solver.factorize(matrix);
        report.analysis_time      = solver.analysis_time();
        report.factorization_time = timer.wall_time() - report.analysis_time;
        report.n_factor_entries   = solver.n_factor_entries();
        timer.restart();
        solver.solve(rhs, solution);
        report.solution_time = timer.wall_time();
      }


      template <typename Preconditioner>
      void
      iterate(const Matrix                 &matrix,
              const Vector                 &rhs,
              const Preconditioner         &preconditioner,
              const LinearSolverParameters &parameters,
              Vector                       &solution,
              LinearSolverReport           &report)
      {
        const double             norm = rhs.l2_norm();
        dealii::SolverControl    control(parameters.max_iterations,
                                      parameters.tolerance * norm);
        dealii::SolverCG<Vector> solver(control);
        try
        {
          solver.solve(matrix, solution, rhs, preconditioner);
        }
        catch (const dealii::SolverControl::NoConvergence &failure)
        {
          std::ostringstream what;
          what << "Conjugate gradients did not converge: after "
               << failure.last_step << " iterations the relative residual is "
               << failure.last_residual / norm << " instead of "
               << parameters.tolerance;
          AssertThrow(
            false,
            NumericalFailure(what.str(),
                             "",
                             "choose the direct solver, more iterations, or "
                             "aggregation of covers if it is off"));
        }
        report.n_iterations = control.last_step();
      }


      /// Smoothed aggregation of the matrix itself.
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
          // Cut elements stretch the spectrum: a wide interval for the smoother
          // takes a quarter of the iterations away.
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


      template <typename Preconditioner>
      void
      solve_iterative(const Matrix                            &matrix,
                      const Vector                            &rhs,
                      const CoverSystem                       &covers,
                      const dealii::AffineConstraints<double> &constraints,
                      const LinearSolverParameters            &parameters,
                      Vector                                  &solution,
                      LinearSolverReport                      &report)
      {
        dealii::Timer        timer;
        const Preconditioner preconditioner(matrix, covers, constraints);
        report.factorization_time = timer.wall_time();
        timer.restart();
        iterate(matrix, rhs, preconditioner, parameters, solution, report);
        report.solution_time = timer.wall_time();
      }
    } // namespace


    LinearSolverReport
    solve_linear_system(const Matrix                            &matrix,
                        const Vector                            &rhs,
                        const CoverSystem                       &covers,
                        const dealii::AffineConstraints<double> &constraints,
                        const LinearSolverParameters            &parameters,
                        Vector                                  &solution)
    {
      LinearSolverReport report;
      report.direct =
        parameters.type == LinearSolverParameters::Type::direct ||
        (parameters.type == LinearSolverParameters::Type::automatic &&
         matrix.m() <= parameters.direct_limit);

      solution.reinit(rhs, true);
      solution = 0.;
      // without loads the solution is zero, and no residual is relative to it
      if (rhs.l2_norm() == 0.)
        return report;

      if (report.direct)
        solve_direct(matrix, rhs, solution, report);
      else if (covers.manifold_mesh().mathematical_mesh().degree() == 2)
        solve_iterative<TwoLevelPreconditioner>(
          matrix, rhs, covers, constraints, parameters, solution, report);
      else
        solve_iterative<OneLevelPreconditioner>(
          matrix, rhs, covers, constraints, parameters, solution, report);

      report.relative_residual = relative_residual(matrix, rhs, solution);
      AssertThrow(
        std::isfinite(report.relative_residual) &&
          report.relative_residual < 1e-5,
        NumericalFailure("The linear system is singular to rounding: the "
                         "solution's relative residual is " +
                           std::to_string(report.relative_residual),
                         "",
                         "look for parts that hardly anything holds, or for "
                         "materials of extreme stiffness contrast"));
      return report;
    }
  } // namespace internal
} // namespace NMM
