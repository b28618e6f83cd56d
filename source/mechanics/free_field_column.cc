#include <nmm/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <mechanics/free_field_column.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Solve A x = b for a symmetric positive definite A with two bands, by elimination without
      /// pivots. A[i][k] is the entry (i, i + k).
      std::vector<double>
      solve(std::vector<std::array<double, 3>> A, std::vector<double> b)
      {
        const unsigned int n = A.size();
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 1; k < 3 && i + k < n; ++k)
          {
            const double factor = A[i][k] / A[i][0];
            for (unsigned int l = k; l < 3 && i + l < n; ++l)
              A[i + k][l - k] -= factor * A[i][l];
            b[i + k] -= factor * b[i];
          }
        for (unsigned int i = n; i-- > 0;)
        {
          for (unsigned int k = 1; k < 3 && i + k < n; ++k)
            b[i] -= A[i][k] * b[i + k];
          b[i] /= A[i][0];
        }
        return b;
      }


      /// Subtract A x from @p b.
      void
      subtract(const std::vector<std::array<double, 3>> &A,
               const std::vector<double>                &x,
               std::vector<double>                      &b)
      {
        const unsigned int n = A.size();
        for (unsigned int i = 0; i < n; ++i)
        {
          b[i] -= A[i][0] * x[i];
          for (unsigned int k = 1; k < 3 && i + k < n; ++k)
          {
            b[i] -= A[i][k] * x[i + k];
            b[i + k] -= A[i][k] * x[i];
          }
        }
      }


      std::array<double, 2>
      moduli(const FreeFieldColumn::Layer &layer)
      {
        return {{layer.mu, layer.lambda + 2. * layer.mu}};
      }
    } // namespace


    FreeFieldColumn::FreeFieldColumn(std::vector<Layer>     layers_in,
                                     const RayleighDamping &rayleigh,
                                     const std::string     &where)
      : layers(std::move(layers_in))
    {
      std::sort(layers.begin(),
                layers.end(),
                [](const Layer &a, const Layer &b) { return a.y_0 < b.y_0; });
      AssertThrow(!layers.empty(),
                  InputError("A free field has no ground beside it",
                             where,
                             "name a side of the solid"));
      const double size = layers.back().y_1 - layers.front().y_0;
      for (unsigned int l = 0; l + 1 < layers.size(); ++l)
      {
        AssertThrow(std::abs(layers[l + 1].y_0 - layers[l].y_1) < 1e-9 * size,
                    InputError("The side of a free field has a gap or an "
                               "overlap at y = " +
                                 std::to_string(layers[l].y_1) + " m",
                               where,
                               "choose one side that is connected"));
        layers[l + 1].y_0 = layers[l].y_1;
      }
      make_matrices(rayleigh);
      for (unsigned int c = 0; c < 2; ++c)
        state.w[c].assign(n_nodes(), 0.);
      for (unsigned int c = 0; c < 2; ++c)
        state.v[c] = state.w[c];
      tried = state;
    }


    void
    FreeFieldColumn::make_matrices(const RayleighDamping &rayleigh)
    {
      // integrals of products of functions, and of derivatives, over a length of 1
      constexpr double of_values[3][3]      = {{4. / 30., 2. / 30., -1. / 30.},
                                               {2. / 30., 16. / 30., 2. / 30.},
                                               {-1. / 30., 2. / 30., 4. / 30.}};
      constexpr double of_derivatives[3][3] = {{7. / 3., -8. / 3., 1. / 3.},
                                               {-8. / 3., 16. / 3., -8. / 3.},
                                               {1. / 3., -8. / 3., 7. / 3.}};
      for (Banded *matrix :
           {&mass, &stiffness[0], &stiffness[1], &damping[0], &damping[1]})
        matrix->assign(n_nodes(), {{0., 0., 0.}});
      for (unsigned int l = 0; l < layers.size(); ++l)
      {
        const double       h     = layers[l].y_1 - layers[l].y_0;
        const unsigned int first = 2 * l;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
          {
            const double m = layers[l].density * h * of_values[i][j];
            mass[first + i][j - i] += m;
            for (unsigned int c = 0; c < 2; ++c)
            {
              const double k = moduli(layers[l])[c] / h * of_derivatives[i][j];
              stiffness[c][first + i][j - i] += k;
              damping[c][first + i][j - i] +=
                rayleigh.mass * m + rayleigh.stiffness * k;
            }
          }
      }
      for (unsigned int c = 0; c < 2; ++c)
        damping[c][0][0] += impedance(c);
    }


    double
    FreeFieldColumn::impedance(const unsigned int c) const
    {
      return std::sqrt(layers.front().density * moduli(layers.front())[c]);
    }


    FreeFieldColumn::Place
    FreeFieldColumn::find(const double y) const
    {
      unsigned int l = 0;
      while (l + 1 < layers.size() && y > layers[l].y_1)
        ++l;
      const double h = layers[l].y_1 - layers[l].y_0;
      const double s = (y - layers[l].y_0) / h;
      return {2 * l,
              {(1. - s) * (1. - 2. * s), 4. * s * (1. - s), s * (2. * s - 1.)},
              {(4. * s - 3.) / h, (4. - 8. * s) / h, (4. * s - 1.) / h},
              moduli(layers[l])};
    }


    void
    FreeFieldColumn::try_step(const double                 h,
                              const std::array<double, 2> &begin,
                              const std::array<double, 2> &end)
    {
      tried = state;
      for (unsigned int c = 0; c < 2; ++c)
      {
        // The acceleration at the beginning is that of the wave then, which may jump.
        std::vector<double> force(n_nodes(), 0.);
        force[0] = begin[c];
        subtract(damping[c], state.v[c], force);
        subtract(stiffness[c], state.w[c], force);
        const std::vector<double> a_0 = solve(mass, force);
        // w_1 = w + h^2 / 4 a_1, v_1 = v + h / 2 a_1
        std::vector<double> &w = tried.w[c], &v = tried.v[c];
        for (unsigned int k = 0; k < n_nodes(); ++k)
        {
          w[k] += h * v[k] + 0.25 * h * h * a_0[k];
          v[k] += 0.5 * h * a_0[k];
        }
        std::fill(force.begin(), force.end(), 0.);
        force[0] = end[c];
        subtract(damping[c], v, force);
        subtract(stiffness[c], w, force);
        Banded sum = mass;
        for (unsigned int k = 0; k < n_nodes(); ++k)
          for (unsigned int b = 0; b < 3; ++b)
            sum[k][b] +=
              0.5 * h * damping[c][k][b] + 0.25 * h * h * stiffness[c][k][b];
        const std::vector<double> a_1 = solve(sum, force);
        for (unsigned int k = 0; k < n_nodes(); ++k)
        {
          w[k] += 0.25 * h * h * a_1[k];
          v[k] += 0.5 * h * a_1[k];
        }
      }
    }


    double
    FreeFieldColumn::displacement(const unsigned int c,
                                  const unsigned int k,
                                  const double       share) const
    {
      return (1. - share) * state.w[c][k] + share * tried.w[c][k];
    }


    double
    FreeFieldColumn::velocity(const unsigned int c,
                              const unsigned int k,
                              const double       share) const
    {
      return (1. - share) * state.v[c][k] + share * tried.v[c][k];
    }
  } // namespace internal
} // namespace NMM
