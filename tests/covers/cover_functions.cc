#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_functions.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include "support/random_scenes.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace dealii;
using namespace NMM;
using namespace NMM::Testing;


namespace
{
  class Exponential : public Function<2>
  {
  public:
    double
    value(const Point<2> &x, unsigned int = 0) const override
    {
      return std::exp(x[0]);
    }

    Tensor<1, 2>
    gradient(const Point<2> &x, unsigned int = 0) const override
    {
      return Tensor<1, 2>({std::exp(x[0]), 0.});
    }
  };


  class Sine : public Function<2>
  {
  public:
    double
    value(const Point<2> &x, unsigned int = 0) const override
    {
      return std::sin(2. * x[0] + x[1]);
    }

    Tensor<1, 2>
    gradient(const Point<2> &x, unsigned int = 0) const override
    {
      return std::cos(2. * x[0] + x[1]) * Tensor<1, 2>({2., 1.});
    }
  };


  double
  polynomial(const Point<2> &x)
  {
    return 1. + 2. * x[0] - 3. * x[1] + x[0] * x[0] - 0.5 * x[0] * x[1];
  }


  Tensor<1, 2>
  slope(const Point<2> &x)
  {
    return Tensor<1, 2>({2. + 2. * x[0] - 0.5 * x[1], -3. - 0.5 * x[0]});
  }


  /**
   * A square that a crack cuts in part, on triangles that do not fit it. One cover beside the crack
   * has a second and a third function for each component. Solves
   * @f[ \int C\nabla u:\nabla v + u\cdot v = \int C\nabla u_*:\nabla v + u_*\cdot v, @f]
   * where u_* is a quadratic polynomial and those two functions times the weight function, which
   * FE_SimplexP and a mapping of deal.II give. As u_* is in the space, it is the solution.
   */
  class PatchTest
  {
  public:
    static constexpr double of_exponential = 3., of_sine = -2.;

    explicit PatchTest(const unsigned int n_components)
      : n_components(n_components)
      , physical(cracked_square())
      , mesh(make_regular_mesh(physical, skew_mesh(0.4), 2))
      , elements(mesh, physical)
      , covers(elements, MPI_COMM_SELF)
      , enriched(find_enriched())
      , functions(covers,
                  n_components,
                  {{enriched,
                    {std::make_shared<Exponential>(),
                     std::make_shared<Sine>()}}})
    {
    }

    /// The unknowns of the solution.
    Vector<double>
    solve() const
    {
      // 2p for the mass, and some more for the functions; the same rule is on both sides.
      const QuadratureCollection rules(elements,
                                       6,
                                       6,
                                       {0, elements.n_elements()});
      FullMatrix<double>         matrix(functions.n_unknowns());
      Vector<double>             rhs(functions.n_unknowns());
      for (unsigned int e = 0; e < elements.n_elements(); ++e)
      {
        const Quadrature<2> rule = rules.rule(e);
        FEValues<2>         weights(mesh.mapping(),
                            mesh.fe(),
                            rule,
                            update_values | update_gradients |
                              update_quadrature_points | update_JxW_values);
        weights.reinit(mesh.cell_iterator(elements.cell(e)));
        for (const unsigned int q : weights.quadrature_point_indices())
          add(e, rule.point(q), weights, q, matrix, rhs);
      }
      matrix.gauss_jordan();
      Vector<double> solution(rhs);
      matrix.vmult(solution, rhs);
      return solution;
    }

    /// What the unknowns are to be: component c is (c + 1) times the scalar field.
    Vector<double>
    expected() const
    {
      Vector<double> result(functions.n_unknowns());
      unsigned int   i   = 0;
      const auto     add = [&](const double value) {
        for (unsigned int c = 0; c < n_components; ++c)
          result(i++) = (c + 1.) * value;
      };
      for (unsigned int k = 0; k < covers.n_covers(); ++k)
      {
        add(polynomial(covers.node(k)));
        if (k == enriched)
        {
          add(of_exponential);
          add(of_sine);
        }
      }
      return result;
    }

  private:
    static Geometry
    cracked_square()
    {
      Geometry geometry = make_box(1., 1.);
      geometry.add_polyline({Point<2>(-0.1, 0.43), Point<2>(0.61, 0.52)},
                            "crack",
                            CurveRole::joint);
      geometry.curves().back().is_clipped = true;
      return geometry;
    }

    /// The cover beside the crack that has the largest area.
    unsigned int
    find_enriched() const
    {
      std::vector<double> area(covers.n_covers(), 0.);
      std::vector<bool>   is_beside(covers.n_covers(), false);
      for (unsigned int e = 0; e < elements.n_elements(); ++e)
        for (const unsigned int k : covers.covers(e))
        {
          area[k] += elements.area(e);
          for (const ElementEdge &edge : elements.edges(e))
            is_beside[k] = is_beside[k] || (edge.curve_set != invalid_index &&
                                            edge.neighbor != invalid_index);
        }
      unsigned int result = 0;
      for (unsigned int k = 0; k < covers.n_covers(); ++k)
        if (is_beside[k] && (!is_beside[result] || area[k] > area[result]))
          result = k;
      EXPECT_TRUE(is_beside[result]);
      return result;
    }

    /// C : grad u of plane elasticity with lambda = mu = 1, or of the scalar problem.
    Tensor<2, 2>
    flux(const Tensor<2, 2> &gradient) const
    {
      if (n_components == 1)
        return gradient;
      return gradient + transpose(gradient) +
             trace(gradient) * Tensor<2, 2>(unit_symmetric_tensor<2>());
    }

    void
    add(const unsigned int  e,
        const Point<2>     &xi,
        const FEValues<2>  &weights,
        const unsigned int  q,
        FullMatrix<double> &matrix,
        Vector<double>     &rhs) const
    {
      // the exact field of one component
      const Point<2> &x        = weights.quadrature_point(q);
      double          value    = polynomial(x);
      Tensor<1, 2>    gradient = slope(x);
      for (unsigned int i = 0; i < 6; ++i)
        if (covers.covers(e)[i] == enriched)
        {
          const double f =
            of_exponential * Exponential().value(x) + of_sine * Sine().value(x);
          value += weights.shape_value(i, q) * f;
          gradient += f * weights.shape_grad(i, q) +
                      weights.shape_value(i, q) *
                        (of_exponential * Exponential().gradient(x) +
                         of_sine * Sine().gradient(x));
        }
      Tensor<2, 2> exact;
      for (unsigned int c = 0; c < n_components; ++c)
        exact[c] = (c + 1.) * gradient;

      CoverFunctions::Basis                basis;
      std::vector<types::global_dof_index> unknowns;
      functions.evaluate(e, xi, basis);
      functions.get_dof_indices(e, unknowns);
      ASSERT_EQ(unknowns.size(), n_components * basis.values.size());
      const auto gradient_of = [&](const unsigned int i) {
        Tensor<2, 2> result;
        result[i % n_components] = basis.gradients[i / n_components];
        return result;
      };
      for (unsigned int i = 0; i < unknowns.size(); ++i)
      {
        const unsigned int c    = i % n_components;
        const double       v    = basis.values[i / n_components];
        const Tensor<2, 2> test = gradient_of(i);
        rhs(unknowns[i]) +=
          (scalar_product(flux(exact), test) + (c + 1.) * value * v) *
          weights.JxW(q);
        for (unsigned int j = 0; j < unknowns.size(); ++j)
          matrix(unknowns[i], unknowns[j]) +=
            (scalar_product(flux(gradient_of(j)), test) +
             (j % n_components == c ? basis.values[j / n_components] * v
                                    : 0.)) *
            weights.JxW(q);
      }
    }

    const unsigned int     n_components;
    const PhysicalMesh     physical;
    const MathematicalMesh mesh;
    const ManifoldMesh     elements;
    const CoverSystem      covers;
    const unsigned int     enriched;
    const CoverFunctions   functions;
  };
} // namespace


// Unknowns of small pieces of covers are hardly determined, so that rounding leaves 1e-9 to 1e-8
// in them. Without the gradient of the functions, say, errors are of size 1.
TEST(CoverFunctions, PatchTestOfAScalarProblem)
{
  const PatchTest patch(1);
  Vector<double>  error = patch.solve();
  error -= patch.expected();
  EXPECT_LT(error.linfty_norm(), 1e-7);
}


TEST(CoverFunctions, PatchTestOfAVectorProblem)
{
  const PatchTest patch(2);
  Vector<double>  error = patch.solve();
  error -= patch.expected();
  EXPECT_LT(error.linfty_norm(), 1e-7);
}


TEST(CoverFunctionsMPI, UnknownsAreThoseOfTheCoversAndOneMoreForEachFunction)
{
  const PhysicalMesh     physical(make_box(1., 1.));
  const MathematicalMesh mesh = make_regular_mesh(physical, skew_mesh(0.2), 2);
  const ManifoldMesh     elements(mesh, physical);
  const CoverSystem      covers(elements, MPI_COMM_WORLD);
  const CoverFunctions   constants(covers, 2);
  std::vector<types::global_dof_index> of_covers, of_functions;
  for (unsigned int e = 0; e < elements.n_elements(); ++e)
  {
    covers.get_dof_indices(e, 2, of_covers);
    constants.get_dof_indices(e, of_functions);
    EXPECT_EQ(of_covers, of_functions);
  }
  EXPECT_EQ(constants.locally_owned_dofs(), covers.locally_owned_dofs(2));
  EXPECT_EQ(constants.locally_relevant_dofs(), covers.locally_relevant_dofs(2));

  // three more for the cover 7, one more for the last one
  const unsigned int   last     = covers.n_global_covers() - 1;
  const auto           function = std::make_shared<Sine>();
  const CoverFunctions more(
    covers, 2, {{7, {function, function, function}}, {last, {function}}});
  EXPECT_EQ(more.n_unknowns(), 2 * (last + 1 + 4));
  const IndexSet owned = more.locally_owned_dofs();
  EXPECT_TRUE(owned.is_contiguous());
  EXPECT_EQ(Utilities::MPI::sum(owned.n_elements(), MPI_COMM_WORLD),
            more.n_unknowns());
  for (unsigned int e = 0; e < elements.n_elements(); ++e)
  {
    of_covers.clear();
    for (const unsigned int k : covers.covers(e))
    {
      const unsigned int first = 2 * (k + (k > 7 ? 3 : 0)),
                         n     = 2 * (1 + (k == 7 ? 3 : 0) + (k == last));
      for (unsigned int i = 0; i < n; ++i)
        of_covers.push_back(first + i);
    }
    more.get_dof_indices(e, of_functions);
    EXPECT_EQ(of_covers, of_functions);
  }

  EXPECT_THROW(CoverFunctions(covers, 2, {{last + 1, {function}}}), InputError);
}
