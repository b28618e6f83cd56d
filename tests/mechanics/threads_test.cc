// The same bits on any number of threads.

#include <nmm/materials/material.h>

#include <deal.II/base/multithread_info.h>

#include <base/in_order.h>
#include <gtest/gtest.h>
#include <mechanics/finite_model.h>
#include <numeric>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  /// As many threads as said, until the end of the scope; then one.
  class ThreadLimit
  {
  public:
    explicit ThreadLimit(const unsigned int n)
    {
      dealii::MultithreadInfo::set_thread_limit(n);
    }

    ~ThreadLimit()
    {
      dealii::MultithreadInfo::set_thread_limit(1);
    }
  };


  void
  append(const dealii::TrilinosWrappers::SparseMatrix &matrix,
         std::vector<double>                          &numbers)
  {
    for (const auto &entry : matrix)
      numbers.push_back(entry.value());
  }


  void
  append(const Vector &vector, std::vector<double> &numbers)
  {
    for (unsigned int i = 0; i < vector.size(); ++i)
      numbers.push_back(vector(i));
  }


  /// Rules, the static system and the finite one with its energies, of some thousand
  /// elements.
  std::vector<double>
  all_numbers(const unsigned int n_threads)
  {
    const ThreadLimit limit(n_threads);
    const auto        model = jointed_box(2,
                                   material_law("neo-Hookean"),
                                   PlaneState::plane_strain,
                                   0.03,
                                   MPI_COMM_SELF);
    model->problem.gravity  = Tensor<1, 2>({0.1, -0.2});
    model->problem.boundary_conditions.resize(1);
    model->problem.boundary_conditions[0].curve = "left";
    model->problem.boundary_conditions[0].type =
      BoundaryCondition::Type::displacement;
    EXPECT_GT(model->manifold_mesh.n_elements(), 4000U);

    std::vector<double> numbers;
    for (unsigned int e = 0; e < model->manifold_mesh.n_elements(); ++e)
    {
      const auto &rule = model->quadrature->rule(e);
      numbers.push_back(model->quadrature->area_fraction(e));
      for (unsigned int q = 0; q < rule.size(); ++q)
        for (const double number :
             {rule.point(q)[0], rule.point(q)[1], rule.weight(q)})
          numbers.push_back(number);
    }
    StaticElasticity system(model->covers,
                            *model->quadrature,
                            model->constraints,
                            model->problem);
    system.assemble();
    append(system.system_matrix(), numbers);
    append(system.system_rhs(), numbers);

    const auto   finite = finite_elasticity(*model);
    const Vector u      = interpolate(*model, [](const Point<2> &x) {
      return Tensor<1, 2>({0.02 * std::sin(3. * x[1]), 0.05 * x[0] * x[1]});
    });
    EXPECT_EQ(finite->assemble(u, 1., Tangent::consistent),
              Deformation::admissible);
    append(finite->tangent(), numbers);
    append(finite->residual(), numbers);
    numbers.push_back(finite->energies().strain);
    numbers.push_back(finite->energies().conditions);
    numbers.push_back(finite->force_scale());

    // turned inside out
    const Vector bad = interpolate(*model, [](const Point<2> &x) {
      return Tensor<1, 2>({-2. * x[0], 0.});
    });
    EXPECT_EQ(finite->assemble(bad, 1., Tangent::consistent),
              Deformation::inverted);
    return numbers;
  }


  TEST(Threads, SystemsHaveTheSameBits)
  {
    const std::vector<double> one = all_numbers(1);
    ASSERT_GT(one.size(), 100000U);
    for (const unsigned int n_threads : {2U, 4U})
    {
      const std::vector<double> many = all_numbers(n_threads);
      ASSERT_EQ(many.size(), one.size());
      unsigned int n_different = 0;
      for (std::size_t i = 0; i < one.size(); ++i)
        n_different += one[i] != many[i];
      EXPECT_EQ(n_different, 0U) << n_threads << " threads";
    }
  }


  /// Work that takes long now and then finishes out of order, and is still taken in
  /// order.
  TEST(Threads, ResultsAreTakenInOrder)
  {
    for (const unsigned int n_threads : {1U, 2U, 4U})
    {
      const ThreadLimit         limit(n_threads);
      std::vector<unsigned int> taken;
      internal::for_each_in_order<double>(
        5,
        1005,
        [](const unsigned int i, double &result) {
          result = 0.;
          for (unsigned int k = 0; k < (i % 97 == 0 ? 200000U : 10U); ++k)
            result += std::sin(k + i);
        },
        [&](const unsigned int i, double &) { taken.push_back(i); });
      std::vector<unsigned int> expected(1000);
      std::iota(expected.begin(), expected.end(), 5U);
      EXPECT_EQ(taken, expected) << n_threads << " threads";
    }
  }
} // namespace
