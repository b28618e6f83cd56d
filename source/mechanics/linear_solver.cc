#include <nmm/base/exceptions.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Amesos_Mumps.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <mechanics/linear_solver.h>
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
       * The upper triangle, for MUMPS' symmetric factorization: half the memory
       * and little more than half the time of the general one.
       */
      Epetra_CrsMatrix
      upper_triangle(const Epetra_CrsMatrix &matrix)
      {
        const Epetra_Map &row_map    = matrix.RowMap();
        const Epetra_Map &column_map = matrix.ColMap();

        std::vector<int> lengths(matrix.NumMyRows(), 0);
        const auto       for_each_entry = [&](const auto &action) {
          int     n;
          double *values;
          int    *indices;
          for (int row = 0; row < matrix.NumMyRows(); ++row)
          {
            matrix.ExtractMyRowView(row, n, values, indices);
            const int global_row = row_map.GID(row);
            for (int i = 0; i < n; ++i)
              if (column_map.GID(indices[i]) >= global_row)
                action(row, indices[i], values[i]);
          }
        };
        for_each_entry([&](const int row, int, double) { ++lengths[row]; });
        Epetra_CrsMatrix result(
          ::Copy, row_map, column_map, lengths.data(), true);
        for_each_entry([&](const int row, int column, double value) {
          result.InsertMyValues(row, 1, &value, &column);
        });
        result.FillComplete(matrix.DomainMap(), matrix.RangeMap());
        return result;
      }


      void
      check_mumps(const int error_code, const std::string &stage)
      {
        AssertThrow(
          error_code == 0,
          NumericalFailure(
            "MUMPS' " + stage + " failed with error code " +
              std::to_string(error_code),
            "",
            "the system is singular or too large for this machine's "
            "memory: check that every block is held and that its "
            "size is above rounding, or choose the iterative solver"));
      }


      void
      solve_direct(const Matrix &matrix, const Vector &rhs, Vector &solution)
      {
        Epetra_CrsMatrix     upper = upper_triangle(matrix.trilinos_matrix());
        Epetra_LinearProblem problem;
        problem.SetOperator(&upper);
        problem.SetLHS(&solution.trilinos_vector());
        problem.SetRHS(
          const_cast<Epetra_MultiVector *>(&rhs.trilinos_vector()));

        Amesos_Mumps           solver(problem);
        Teuchos::ParameterList parameters;
        parameters.set("MatrixProperty", "SPD");
        parameters.set("PrintTiming", false);
        parameters.set("PrintStatus", false);
        parameters.set("OutputLevel", 0);
        solver.SetParameters(parameters);

        check_mumps(solver.SymbolicFactorization(), "analysis");
        check_mumps(solver.NumericFactorization(), "factorization");
        check_mumps(solver.Solve(), "solution");
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
          const dealii::Tensor<1, 2> d = (covers.node(k) - center) / size;
          for (unsigned int c = 0; c < 2; ++c, ++i)
            if (!constraints.is_constrained(2 * k + c))
            {
              modes[c * n + i] = 1.;
              modes[2 * n + i] = c == 0 ? -d[1] : d[0];
            }
        }
        return modes;
      }


      unsigned int
      solve_iterative(const Matrix                            &matrix,
                      const Vector                            &rhs,
                      const CoverSystem                       &covers,
                      const dealii::AffineConstraints<double> &constraints,
                      const LinearSolverParameters            &parameters,
                      Vector                                  &solution)
      {
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
        ml.set("aggregation: threshold", 0.02);
        ml.set("smoother: type", "Chebyshev");
        ml.set("smoother: sweeps", 3);
        ml.set("smoother: Chebyshev alpha", 20.);
        ml.set("coarse: max size", 500);
        ml.set("coarse: type", "Amesos-KLU");

        dealii::TrilinosWrappers::PreconditionAMG preconditioner;
        preconditioner.initialize(matrix, ml);

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
        return control.last_step();
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
        solve_direct(matrix, rhs, solution);
      else
        report.n_iterations = solve_iterative(
          matrix, rhs, covers, constraints, parameters, solution);

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
