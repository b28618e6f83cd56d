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


  /**
   * A u = b with pairs of unknowns that hang together, unsymmetric, and places of zero value
   * between all pairs, as for contact that may come. In one group if @p is_chain.
   */
  class Pairs : public NonlinearSystem
  {
  public:
    Pairs(const unsigned int n_pairs, const bool is_chain)
    {
      const unsigned int             n = 2 * n_pairs;
      dealii::DynamicSparsityPattern pattern(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          pattern.add(i, j);
      const dealii::IndexSet all = dealii::complete_index_set(n);
      matrix.reinit(all, pattern, MPI_COMM_SELF);
      forces.reinit(all, MPI_COMM_SELF);
      for (unsigned int i = 0; i < n; ++i)
      {
        matrix.set(i, i, 4. + i);
        matrix.set(i, i % 2 == 0 ? i + 1 : i - 1, i % 2 == 0 ? 2. : -3.);
        if (is_chain && i + 2 < n)
          matrix.set(i, i + 2, 1.);
      }
      matrix.compress(dealii::VectorOperation::insert);
    }

    /// The solution is (1, 2, 3, ...).
    Deformation
    assemble(const Vector &u, const Tangent, const Vector *) override
    {
      Vector difference(u);
      for (unsigned int i = 0; i < u.size(); ++i)
        difference(i) -= 1. + i;
      difference.compress(dealii::VectorOperation::add);
      matrix.vmult(forces, difference);
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
      return false;
    }

    double
    force_scale() const override
    {
      return 1e3;
    }

  private:
    dealii::TrilinosWrappers::SparseMatrix matrix;
    Vector                                 forces;
  };


  // Small groups are KLU's, the chain, of more unknowns than these may have, is
  // MUMPS'. A linear system takes one iteration, and one to see that.
  TEST(Newton, FactorizesPairsAndTheirChain)
  {
    for (const bool is_chain : {false, true})
    {
      const unsigned int                n_pairs = 200;
      Pairs                             system(n_pairs, is_chain);
      dealii::AffineConstraints<double> constraints;
      constraints.close();
      NonlinearSystem::Vector u(dealii::complete_index_set(2 * n_pairs),
                                MPI_COMM_SELF);
      const NewtonReport report = NewtonSolver().solve(system, constraints, u);
      EXPECT_TRUE(report.converged) << report.reason;
      EXPECT_LE(report.iterations.size(), 2u);
      for (unsigned int i = 0; i < u.size(); ++i)
        // rounding of 400 unknowns of up to 400
        EXPECT_NEAR(u(i), 1. + i, 1e-10) << (is_chain ? "chain" : "pairs");
    }
  }


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
