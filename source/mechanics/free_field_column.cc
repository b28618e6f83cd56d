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
      using Vector = Eigen::Map<Eigen::VectorXd>;

      Vector
      map(std::vector<double> &values)
      {
        return {values.data(), static_cast<Eigen::Index>(values.size())};
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
      std::vector<Eigen::Triplet<double>> masses, stiffnesses[2];
      for (unsigned int l = 0; l < layers.size(); ++l)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
          {
            const double       h     = layers[l].y_1 - layers[l].y_0;
            const unsigned int first = 2 * l;
            masses.emplace_back(first + i,
                                first + j,
                                layers[l].density * h * of_values[i][j]);
            for (unsigned int c = 0; c < 2; ++c)
              stiffnesses[c].emplace_back(first + i,
                                          first + j,
                                          moduli(layers[l])[c] / h *
                                            of_derivatives[i][j]);
          }
      const auto make = [this](const auto &entries) {
        Matrix result(n_nodes(), n_nodes());
        result.setFromTriplets(entries.begin(), entries.end());
        return result;
      };
      mass        = make(masses);
      mass_solver = std::make_unique<Solver>(mass);
      for (unsigned int c = 0; c < 2; ++c)
      {
        stiffness[c] = make(stiffnesses[c]);
        damping[c]   = rayleigh.mass * mass + rayleigh.stiffness * stiffness[c];
        damping[c].coeffRef(0, 0) += impedance(c);
      }
    }


    double
    FreeFieldColumn::impedance(const unsigned int c) const
    {
      return std::sqrt(layers.front().density * moduli(layers.front())[c]);
    }


    FreeFieldColumn::Motion
    FreeFieldColumn::at(const double y, const double share) const
    {
      const auto above =
        std::lower_bound(layers.begin(),
                         layers.end() - 1,
                         y,
                         [](const Layer &layer, const double place) {
                           return layer.y_1 < place;
                         });
      const double h = above->y_1 - above->y_0, s = (y - above->y_0) / h;
      const double values[3]      = {(1. - s) * (1. - 2. * s),
                                     4. * s * (1. - s),
                                     s * (2. * s - 1.)},
                   derivatives[3] = {(4. * s - 3.) / h,
                                     (4. - 8. * s) / h,
                                     (4. * s - 1.) / h};
      Motion             result;
      const unsigned int first = 2 * (above - layers.begin());
      const auto         mean  = [share](const double a, const double b) {
        return (1. - share) * a + share * b;
      };
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int k = first + i;
          result.velocity[c] += values[i] * mean(state.v[c][k], tried.v[c][k]);
          result.strain[c] +=
            derivatives[i] * mean(state.w[c][k], tried.w[c][k]);
        }
      return result;
    }


    void
    FreeFieldColumn::try_step(const double                 h,
                              const std::array<double, 2> &begin,
                              const std::array<double, 2> &end)
    {
      if (h != factorized_step)
        for (unsigned int c = 0; c < 2; ++c)
          step_solvers[c] = std::make_unique<Solver>(
            Matrix(mass + 0.5 * h * damping[c] + 0.25 * h * h * stiffness[c]));
      factorized_step = h;
      tried           = state;
      for (unsigned int c = 0; c < 2; ++c)
      {
        Vector     w = map(tried.w[c]), v = map(tried.v[c]);
        const auto force = [&](const double at_base) {
          Eigen::VectorXd result = -(damping[c] * v) - stiffness[c] * w;
          result[0] += at_base;
          return result;
        };
        // The acceleration at the beginning is that of the wave then, which may jump.
        const Eigen::VectorXd a_0 = mass_solver->solve(force(begin[c]));
        // w_1 = w + h^2 / 4 a_1, v_1 = v + h / 2 a_1
        w += h * v + 0.25 * h * h * a_0;
        v += 0.5 * h * a_0;
        const Eigen::VectorXd a_1 = step_solvers[c]->solve(force(end[c]));
        w += 0.25 * h * h * a_1;
        v += 0.5 * h * a_1;
      }
    }
  } // namespace internal
} // namespace NMM
