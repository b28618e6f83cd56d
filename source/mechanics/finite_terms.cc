#include <algorithm>
#include <cmath>
#include <mechanics/finite_terms.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using dealii::Tensor;

      /// Add delta_ik dS_JL with dS = -C : H^T H / 2 to A_iJkL, see add_volume_terms().
      void
      linearize_stress(const PlaneElasticity &c,
                       const Tensor<2, 2>    &H,
                       double (&A)[4][4])
      {
        const double h00 = H[0][0], h01 = H[0][1], h10 = H[1][0], h11 = H[1][1];
        const double x00      = 0.5 * (h00 * h00 + h10 * h10),
                     x11      = 0.5 * (h01 * h01 + h11 * h11),
                     x01      = 0.5 * (h00 * h01 + h10 * h11);
        const double pressure = c.lambda * (x00 + x11);
        const double s00      = pressure + 2. * c.mu * x00,
                     s11 = pressure + 2. * c.mu * x11, s01 = 2. * c.mu * x01;
        for (unsigned int i = 0; i < 4; i += 2)
        {
          A[i][i] -= s00;
          A[i][i + 1] -= s01;
          A[i + 1][i] -= s01;
          A[i + 1][i + 1] -= s11;
        }
      }


      /// Set the 2 x 2 entries (i, j) with j < i of a symmetric matrix from those with j > i.
      void
      symmetrize(LocalSystem &local)
      {
        const unsigned int n = 2 * local.n_covers;
        for (unsigned int r = 2; r < n; ++r)
          for (unsigned int c = 0; c < unknown_of(cover_of(r), 0); ++c)
            local.matrix[n * r + c] = local.matrix[n * c + r];
      }


      /// Add the sum over (J, L) of weight g_iJ A_cJdL g_jL to the 2 x 2 entries (i, j) with j >= i
      /// of a matrix of n covers, a number that the compiler knows.
      template <unsigned int n>
      void
      add_stiffness(const double weight,
                    const double (*g)[2],
                    const double (&A)[4][4],
                    double *matrix)
      {
        for (unsigned int i = 0; i < n; ++i)
        {
          double       M[2][4];
          const double g0 = weight * g[i][0], g1 = weight * g[i][1];
          for (unsigned int b = 0; b < 4; ++b)
          {
            M[0][b] = g0 * A[0][b] + g1 * A[1][b];
            M[1][b] = g0 * A[2][b] + g1 * A[3][b];
          }
          double *row0 = matrix + 4 * n * i;
          double *row1 = row0 + 2 * n;
          for (unsigned int j = i; j < n; ++j)
          {
            row0[unknown_of(j, 0)] += M[0][0] * g[j][0] + M[0][1] * g[j][1];
            row0[unknown_of(j, 1)] += M[0][2] * g[j][0] + M[0][3] * g[j][1];
            row1[unknown_of(j, 0)] += M[1][0] * g[j][0] + M[1][1] * g[j][1];
            row1[unknown_of(j, 1)] += M[1][2] * g[j][0] + M[1][3] * g[j][1];
          }
        }
      }


      template <unsigned int n>
      Deformation
      add_volume(const HyperelasticLaw     &law,
                 const ElementTables::View &table,
                 const LocalDisplacement   &u,
                 const LocalDisplacement   *increment,
                 LocalSystem               &local)
      {
        HyperelasticLaw::Response response;
        for (unsigned int q = 0; q < table.n_points; ++q)
        {
          const double(*g)[2]       = table.gradients + q * n;
          const double       weight = table.weights[q];
          const Tensor<2, 2> H      = displacement_gradient(n, u.values, g);
          if ((local.with_matrix
                 ? law.evaluate(H, response)
                 : law.evaluate_stress(H, response)) != Deformation::admissible)
            return Deformation::inverted;

          local.energy += weight * response.energy;
          add_stress(n, g, weight * response.stress, local.rhs);
          if (!local.with_matrix)
            continue;
          if (increment != nullptr)
            linearize_stress(law.small_strain(),
                             displacement_gradient(n, increment->values, g),
                             response.tangent);
          add_stiffness<n>(weight, g, response.tangent, local.matrix);
        }
        if (local.with_matrix)
          symmetrize(local);
        return Deformation::admissible;
      }
    } // namespace


    Deformation
    add_volume_terms(const HyperelasticLaw     &law,
                     const ElementTables::View &table,
                     const LocalDisplacement   &u,
                     const LocalDisplacement   *increment,
                     LocalSystem               &local)
    {
      return (local.n_covers == 3
                ? add_volume<3>
                : add_volume<6>)(law, table, u, increment, local);
    }


    Deformation
    elastic_fluxes(const RegionLaws        &region_to_law,
                   const LocalDisplacement &u,
                   const Tangent            tangent,
                   NitscheTerms            &terms)
    {
      const WeakPoint   &point = terms.point;
      const Tensor<2, 2> G     = dealii::outer_product(terms.d, point.normal);
      const bool         with_third_derivative =
        tangent == Tangent::consistent ||
        (tangent == Tangent::robust &&
         terms.d.norm() * point.trace_constant < close_jump);
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const HyperelasticLaw    &law  = *region_to_law[point.sides[s].region];
        WeakFlux                 &flux = terms.fluxes[s];
        const Tensor<2, 2>        H    = terms.gradient(u, s);
        HyperelasticLaw::Response response;
        if (law.evaluate(H, response) != Deformation::admissible)
          return Deformation::inverted;
        flux.set_elastic(response.stress,
                         response.tangent,
                         point.normal,
                         terms.d);
        flux.has_conjugate_by_gradient = with_third_derivative;
        if (with_third_derivative &&
            law.tangent_derivative(H, G, flux.conjugate_by_gradient) !=
              Deformation::admissible)
          return Deformation::inverted;
      }
      return Deformation::admissible;
    }


    double
    growth_of_moduli(const WeakPoint         &point,
                     const RegionLaws        &region_to_law,
                     const unsigned int       n_per_cell,
                     const LocalDisplacement &u)
    {
      const auto largest_row = [](const double(&A)[4][4]) {
        double largest = 0.;
        for (const auto &row : A)
          largest = std::max(largest,
                             std::abs(row[0]) + std::abs(row[1]) +
                               std::abs(row[2]) + std::abs(row[3]));
        return largest;
      };
      double result = 1.;
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const WeakPoint::Side    &side = point.sides[s];
        const HyperelasticLaw    &law  = *region_to_law[side.region];
        HyperelasticLaw::Response now, at_rest;
        if (law.evaluate(displacement_gradient(n_per_cell,
                                               u.values + s * n_per_cell,
                                               side.gradients),
                         now) == Deformation::admissible &&
            law.evaluate(Tensor<2, 2>(), at_rest) == Deformation::admissible)
          result =
            std::max(result,
                     largest_row(now.tangent) / largest_row(at_rest.tangent));
      }
      return result;
    }


    void
    add_follower_point(const EdgeTables::FollowerPoint &point,
                       const double                     factor,
                       const LocalDisplacement         &u,
                       LocalSystem                     &local)
    {
      const unsigned int n = local.n_covers;
      Tensor<1, 2>       t = point.tangent;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int c = 0; c < 2; ++c)
          t[c] += point.tangential[j] * u.values[j][c];
      const double pressure = factor * point.weighted_pressure;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double p = pressure * point.values[i];
        local.rhs[unknown_of(i, 0)] += p * t[1];
        local.rhs[unknown_of(i, 1)] -= p * t[0];
        if (!local.with_matrix)
          continue;
        double *row0 = local.row(i, 0), *row1 = local.row(i, 1);
        for (unsigned int j = 0; j < n; ++j)
        {
          row0[unknown_of(j, 1)] += p * point.tangential[j];
          row1[unknown_of(j, 0)] -= p * point.tangential[j];
        }
      }
    }
  } // namespace internal
} // namespace NMM
