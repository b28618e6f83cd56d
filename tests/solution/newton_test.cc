// NewtonSolver on equations that are known.

#include <nmm/solution/newton_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

using namespace NMM;

namespace
{
  /// What all systems here have.
  class MatrixAndForces : public NonlinearSystem
  {
  public:
    MatrixAndForces(const bool is_symmetric, const double force_scale)
    {
      result.residual     = &forces;
      result.tangent      = &matrix;
      result.is_symmetric = is_symmetric;
      result.force_scale  = force_scale;
    }

  protected:
    dealii::TrilinosWrappers::SparseMatrix matrix;
    Vector                                 forces;
  };


  /**
   * A spring that is soft once it has slipped, on both sides, as a point of contact
   * with friction is: r(u) = 3 u where |u| < 1, u + 2 sign(u) elsewhere. From 2 Newton's
   * method goes to -2, and from there to 2, with the same |r . du| each time.
   */
  class SlippingSpring : public MatrixAndForces
  {
  public:
    SlippingSpring()
      : MatrixAndForces(/* is_symmetric = */ true, /* force_scale = */ 1.)
    {
      dealii::DynamicSparsityPattern pattern(1);
      pattern.add(0, 0);
      const dealii::IndexSet all = dealii::complete_index_set(1);
      matrix.reinit(all, pattern, MPI_COMM_SELF);
      forces.reinit(all, MPI_COMM_SELF);
    }

    Deformation
    assemble(const Vector &u,
             const Tangent tangent,
             const Vector *,
             const BlockSelection &) override
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
  };


  /**
   * A u = b with pairs of unknowns that hang together, unsymmetric, and places of zero value
   * between all pairs, as for contact that may come. In one group if @p is_chain.
   */
  class Pairs : public MatrixAndForces
  {
  public:
    Pairs(const unsigned int n_pairs, const bool is_chain)
      : MatrixAndForces(/* is_symmetric = */ false, /* force_scale = */ 1e3)
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
    assemble(const Vector &u,
             const Tangent,
             const Vector *,
             const BlockSelection &) override
    {
      Vector difference(u);
      for (unsigned int i = 0; i < u.size(); ++i)
        difference(i) -= 1. + i;
      difference.compress(dealii::VectorOperation::add);
      matrix.vmult(forces, difference);
      return Deformation::admissible;
    }
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


  /**
   * Blocks of one unknown each: cubic springs r_i = u_i + u_i^3 - f_i, between which
   * nothing acts but that the first two must not come nearer than @p gap, by a spring
   * c <u_0 - u_1 - gap>. Only rows of selected blocks are made; how many is counted.
   */
  class CubicSprings : public MatrixAndForces
  {
  public:
    CubicSprings(const std::vector<double> &f, const double gap)
      : MatrixAndForces(/* is_symmetric = */ false, /* force_scale = */ 1.)
      , gap(gap)
      , f(f)
    {
      const unsigned int             n = f.size();
      dealii::DynamicSparsityPattern pattern(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        pattern.add(i, i);
        blocks.push_back(i);
      }
      pattern.add(0, 1);
      pattern.add(1, 0);
      const dealii::IndexSet all = dealii::complete_index_set(n);
      matrix.reinit(all, pattern, MPI_COMM_SELF);
      forces.reinit(all, MPI_COMM_SELF);
    }

    Deformation
    assemble(const Vector &u,
             const Tangent tangent,
             const Vector *,
             const BlockSelection &wanted) override
    {
      const double overlap = std::max(0., u(0) - u(1) - gap);
      for (unsigned int i = 0; i < f.size(); ++i)
      {
        // what is not asked for is not right
        forces(i) = 1e10;
        if (!wanted.empty() && !wanted[i])
          continue;
        ++n_rows;
        const double sign = i == 0 ? 1. : -1.;
        forces(i) =
          u(i) + u(i) * u(i) * u(i) - f[i] + (i < 2 ? sign * c * overlap : 0.);
        if (tangent == Tangent::none)
          continue;
        const double k = i < 2 && overlap > 0. ? c : 0.;
        matrix.set(i, i, 1. + 3. * u(i) * u(i) + k);
        if (i < 2)
          matrix.set(i, 1 - i, -k);
      }
      forces.compress(dealii::VectorOperation::insert);
      matrix.compress(dealii::VectorOperation::insert);
      return Deformation::admissible;
    }

    const std::vector<unsigned int> &
    blocks_of_unknowns() const override
    {
      return blocks;
    }

    using NonlinearSystem::sleeping_blocks;
    unsigned int n_rows = 0;

  private:
    static constexpr double c = 100.;

    double gap;

    std::vector<double>       f;
    std::vector<unsigned int> blocks;
  };


  NewtonReport
  solve(CubicSprings            &system,
        NonlinearSystem::Vector &u,
        const bool               always_search = false)
  {
    dealii::AffineConstraints<double> constraints;
    constraints.close();
    NewtonParameters parameters;
    parameters.n_robust_iterations = 0;
    parameters.max_iterations      = 30;
    parameters.always_search       = always_search;
    return NewtonSolver(parameters).solve(system, constraints, u);
  }


  // One of 100 springs is far from its end, the others are there: after the first
  // iteration its row alone is made.
  TEST(Newton, GroupsEndOnTheirOwn)
  {
    const unsigned int  n = 100;
    std::vector<double> f(n, 0.);
    f[7] = 1000. + 10.; // of u = 10
    CubicSprings            system(f, 1e6);
    NonlinearSystem::Vector u(dealii::complete_index_set(n), MPI_COMM_SELF);
    const NewtonReport      report = solve(system, u);
    ASSERT_TRUE(report.converged) << report.reason;
    // Newton's method is at 10 to rounding of 1000
    EXPECT_NEAR(u(7), 10., 1e-12);
    EXPECT_NEAR(u(8), 0., 1e-12);
    ASSERT_GT(report.iterations.size(), 5u);
    EXPECT_EQ(report.iterations[0].solved_share, 1.);
    for (unsigned int i = 1; i < report.iterations.size(); ++i)
      EXPECT_EQ(report.iterations[i].solved_share, 1. / n);
    // all rows for the first tangent, its residual and the last look, one row each
    // time in between: two per iteration, and what line searches take
    EXPECT_LE(system.n_rows,
              3 * n + 2 * report.iterations.size() + report.n_line_search_cuts);
  }


  // The second spring has converged when the first one comes to press on it.
  TEST(Newton, WhatIsTouchedWakes)
  {
    CubicSprings            system({1010., 0., 0.}, 5.);
    NonlinearSystem::Vector u(dealii::complete_index_set(3), MPI_COMM_SELF);
    const NewtonReport      report = solve(system, u);
    ASSERT_TRUE(report.converged) << report.reason;
    const double press = 100. * (u(0) - u(1) - 5.);
    EXPECT_GT(press, 10.);
    // tolerance 1e-9 of forces of 1, and rounding of 1000
    EXPECT_NEAR(u(0) + u(0) * u(0) * u(0) + press, 1010., 1e-8);
    EXPECT_NEAR(u(1) + u(1) * u(1) * u(1), press, 1e-8);
    EXPECT_NEAR(u(2), 0., 1e-12);
  }


  // From -30 over 4 the fifth correction goes to 21, through the second spring's place,
  // which is done by then; but only a share of it is taken.
  TEST(Newton, WhatIsTouchedInVainIsLeftAlone)
  {
    CubicSprings            system({1010., 0., 0.}, 12.);
    NonlinearSystem::Vector u(dealii::complete_index_set(3), MPI_COMM_SELF);
    u(0)                      = -30.;
    const NewtonReport report = solve(system, u, /* always_search = */ true);
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_NEAR(u(0), 10., 1e-10);
    EXPECT_GT(report.n_line_search_cuts, 0U);
    ASSERT_GT(report.iterations.size(), 6u);
    for (unsigned int i = 1; i < report.iterations.size(); ++i)
      EXPECT_EQ(report.iterations[i].solved_share, 1. / 3.);
  }


  // It does not move, and is felt: u^3 + u + 100 (u - 5) = 1010.
  TEST(Newton, WhatSleepsStays)
  {
    CubicSprings            system({1010., 3., 0.}, 5.);
    NonlinearSystem::Vector u(dealii::complete_index_set(3), MPI_COMM_SELF);
    system.sleeping_blocks    = {false, true, false};
    const NewtonReport report = solve(system, u);
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_EQ(u(1), 0.);
    EXPECT_NEAR(u(0) * u(0) * u(0) + u(0) + 100. * (u(0) - 5.), 1010., 1e-8);
  }
} // namespace
