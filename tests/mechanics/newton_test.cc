// NewtonSolver on equations that are known.

#include <nmm/mechanics/newton_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <gtest/gtest.h>

using namespace NMM;

namespace
{
  /**
   * A spring that is soft once it has slipped, on both sides, as a point of contact
   * with friction is: r(u) = 3 u where |u| < 1, u + 2 sign(u) elsewhere. From 2 Newton's
   * method goes to -2, and from there to 2, with the same |r . du| each time.
   */
  class SlippingSpring : public NonlinearSystem
  {
  public:
    SlippingSpring()
    {
      dealii::DynamicSparsityPattern pattern(1);
      pattern.add(0, 0);
      const dealii::IndexSet all = dealii::complete_index_set(1);
      matrix.reinit(all, pattern, MPI_COMM_SELF);
      forces.reinit(all, MPI_COMM_SELF);
    }

    Deformation
    assemble(const Vector &u, const Tangent tangent, const Vector *) override
    {
      const double x     = u(0);
      const bool   slips = std::abs(x) >= 1.;
      forces(0)          = slips ? x + std::copysign(2., x) : 3. * x;
      if (tangent != Tangent::none)
      {
        matrix.set(0, 0, slips ? 1. : 3.);
        matrix.compress(dealii::VectorOperation::insert);
      }
      return Deformation::admissible;
    }

    const Vector &
    residual() const override
    {
      return forces;
    }

    const dealii::TrilinosWrappers::SparseMatrix &
    tangent() const override
    {
      return matrix;
    }

    bool
    tangent_is_symmetric() const override
    {
      return true;
    }

    double
    force_scale() const override
    {
      return 1.;
    }

  private:
    dealii::TrilinosWrappers::SparseMatrix matrix;
    Vector                                 forces;
  };


  // Six iterations go round, the seventh is found out and takes half of the way, to 0.
  TEST(Newton, EndsWhereItWouldGoRound)
  {
    SlippingSpring                    system;
    dealii::AffineConstraints<double> constraints;
    constraints.close();
    NonlinearSystem::Vector u(dealii::complete_index_set(1), MPI_COMM_SELF);
    u(0) = 2.;
    NewtonParameters parameters;
    parameters.n_robust_iterations = 0;
    const NewtonReport report =
      NewtonSolver(parameters).solve(system, constraints, u);
    EXPECT_TRUE(report.converged) << report.reason;
    EXPECT_LE(report.iterations.size(), 9u);
    EXPECT_NEAR(u(0), 0., 1e-12);
  }
} // namespace
