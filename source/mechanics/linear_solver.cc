#include <nmm/base/exceptions.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <mechanics/linear_solver.h>
#include <mechanics/mumps_solver.h>
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


      /**
       * Translations and the rotation about the solid's centre at the covers'
       * nodes, zero in constrained rows, normalized: the near-null space that
       * smoothed aggregation must keep.
       */
      std::vector<double>
      rigid_body_modes(const CoverSystem                       &covers,
                       const dealii::AffineConstraints<double> &constraints)
      {
        const auto &box = covers.manifold_mesh()
                            .physical_mesh()
                            .bounding_box()
                            .get_boundary_points();
        const dealii::Point<2> center(0.5 * (box.first + box.second));
        const double           size = box.first.distance(box.second);

        const unsigned int  n = 2 * covers.locally_owned_covers().n_elements();
        std::vector<double> modes(3 * n, 0.);
        unsigned int        i = 0;
        for (const unsigned int k : covers.locally_owned_covers())
        {
          const dealii::Tensor<1, 2> d =
            (covers.node(covers.local_cover(k)) - center) / size;
          for (unsigned int c = 0; c < 2; ++c, ++i)
            if (!constraints.is_constrained(2 * k + c))
            {
              modes[c * n + i] = 1.;
              modes[2 * n + i] = c == 0 ? -d[1] : d[0];
            }
        }
        return modes;
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
        report.factorization_time = timer.wall_time();
        report.n_factor_entries   = solver.n_factor_entries();
        timer.restart();
        solver.solve(rhs, solution);
        report.solution_time = timer.wall_time();
      }


      void
      solve_iterative(const Matrix                            &matrix,
                      const Vector                            &rhs,
                      const CoverSystem                       &covers,
                      const dealii::AffineConstraints<double> &constraints,
                      const LinearSolverParameters            &parameters,
                      Vector                                  &solution,
                      LinearSolverReport                      &report)
      {
        dealii::Timer       timer;
        std::vector<double> modes = rigid_body_modes(covers, constraints);

        Teuchos::ParameterList ml;
        ML_Epetra::SetDefaults("SA", ml);
        ml.set("ML output", 0);
        ml.set("PDE equations", 2);
        ml.set("null space: type", "pre-computed");
        ml.set("null space: dimension", 3);
        ml.set("null space: vectors", modes.data());
        ml.set("null space: add default vectors", false);
        ml.set("aggregation: type", "Uncoupled");
        ml.set("aggregation: threshold", 0.);
        ml.set("smoother: type", "Chebyshev");
        // Cut elements stretch the spectrum: a wide interval for the smoother
        // takes a quarter of the iterations away.
        ml.set("smoother: sweeps", 4);
        ml.set("smoother: Chebyshev alpha", 100.);
        ml.set("coarse: max size", 500);
        ml.set("coarse: type", "Amesos-KLU");

        dealii::TrilinosWrappers::PreconditionAMG preconditioner;
        preconditioner.initialize(matrix, ml);
        report.factorization_time = timer.wall_time();
        timer.restart();

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
        report.n_iterations  = control.last_step();
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
      else
        solve_iterative(
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
