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
                       const Tensor<2, 2>    &H_plus_identity,
                       double (&A)[4][4])
      {
        const Tensor<2, 2> &f   = H_plus_identity;
        const double        h00 = f[0][0] - 1., h01 = f[0][1], h10 = f[1][0],
                     h11      = f[1][1] - 1.;
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
          for (unsigned int c = 0; c < r / 2 * 2; ++c)
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
            row0[2 * j] += M[0][0] * g[j][0] + M[0][1] * g[j][1];
            row0[2 * j + 1] += M[0][2] * g[j][0] + M[0][3] * g[j][1];
            row1[2 * j] += M[1][0] * g[j][0] + M[1][1] * g[j][1];
            row1[2 * j + 1] += M[1][2] * g[j][0] + M[1][3] * g[j][1];
          }
        }
      }


      template <unsigned int n>
      Deformation
      add_volume(const HyperelasticLaw     &law,
                 const ElementTables::View &table,
                 const LocalDisplacement   &u,
                 const LocalDisplacement   *increment,
                 const bool                 with_tangent,
                 LocalSystem               &local,
                 double                    &energy)
      {
        HyperelasticLaw::Response response;
        for (unsigned int q = 0; q < table.n_points; ++q)
        {
          const double(*g)[2]       = table.gradients + q * n;
          const double       weight = table.weights[q];
          const Tensor<2, 2> F      = deformation_gradient(n, u.values, g);
          if ((with_tangent
                 ? law.evaluate(F, response)
                 : law.evaluate_stress(F, response)) != Deformation::admissible)
            return Deformation::inverted;

          energy += weight * response.energy;
          const Tensor<2, 2> P = weight * response.stress;
          for (unsigned int i = 0; i < n; ++i)
          {
            local.rhs[2 * i] += P[0][0] * g[i][0] + P[0][1] * g[i][1];
            local.rhs[2 * i + 1] += P[1][0] * g[i][0] + P[1][1] * g[i][1];
          }
          if (!with_tangent)
            continue;
          if (increment != nullptr)
            linearize_stress(law.small_strain(),
                             deformation_gradient(n, increment->values, g),
                             response.tangent);
          add_stiffness<n>(weight, g, response.tangent, local.matrix);
        }
        if (with_tangent)
          symmetrize(local);
        return Deformation::admissible;
      }
    } // namespace


    Deformation
    add_volume_terms(const HyperelasticLaw     &law,
                     const unsigned int         n_per_cell,
                     const ElementTables::View &table,
                     const LocalDisplacement   &u,
                     const LocalDisplacement   *increment,
                     const bool                 with_tangent,
                     LocalSystem               &local,
                     double                    &energy)
    {
      return n_per_cell == 3
               ? add_volume<3>(
                   law, table, u, increment, with_tangent, local, energy)
               : add_volume<6>(
                   law, table, u, increment, with_tangent, local, energy);
    }


    Deformation
    add_weak_point(const WeakPoint         &point,
                   const RegionLaws        &region_to_law,
                   const unsigned int       n_per_cell,
                   const Tensor<1, 2>      &prescribed,
                   const double             growth,
                   const LocalDisplacement &u,
                   const Tangent            tangent,
                   LocalSystem             &local,
                   double                  &energy,
                   double                  &largest_jump)
    {
      const unsigned int n = point.n_sides * n_per_cell;
      AssertDimension(n, local.n_covers);
      const Tensor<1, 2> &N = point.normal;
      const auto         &B = point.projection;

      Tensor<1, 2> jump;
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          jump[c] += point.jump[k] * u.values[k][c];
      const Tensor<1, 2> d = B * jump - prescribed;
      const Tensor<2, 2> G = dealii::outer_product(d, N);

      const double penalty       = growth * point.penalty;
      const bool   with_tangent  = tangent != Tangent::none;
      const double relative_jump = d.norm() * point.trace_constant;
      if (std::isfinite(relative_jump))
        largest_jump = std::max(largest_jump, relative_jump);
      const bool with_third_derivative =
        tangent == Tangent::consistent ||
        (with_tangent && relative_jump < close_jump);

      // mean traction, and its derivative with respect to unknown c of cover k
      Tensor<1, 2> traction;
      double       flux[LocalSystem::max_covers][2][2];
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const WeakPoint::Side    &side = point.sides[s];
        const HyperelasticLaw    &law  = *region_to_law[side.region];
        const Tensor<2, 2>        F    = deformation_gradient(n_per_cell,
                                                    u.values + s * n_per_cell,
                                                    side.gradients);
        HyperelasticLaw::Response response;
        if (law.evaluate(F, response) != Deformation::admissible)
          return Deformation::inverted;
        traction += side.share * (response.stress * N);
        for (unsigned int i = 0; i < n_per_cell; ++i)
          for (unsigned int a = 0; a < 2; ++a)
            for (unsigned int c = 0; c < 2; ++c)
            {
              double f = 0.;
              for (unsigned int J = 0; J < 2; ++J)
                for (unsigned int L = 0; L < 2; ++L)
                  f += response.tangent[2 * a + J][2 * c + L] * N[J] *
                       side.gradients[i][L];
              flux[s * n_per_cell + i][a][c] = side.share * f;
            }
        if (!with_third_derivative)
          continue;
        double derivative[4][4];
        if (law.tangent_derivative(F, G, derivative) != Deformation::admissible)
          return Deformation::inverted;
        const double weight = -point.weight * side.share;
        for (unsigned int i = 0; i < n_per_cell; ++i)
          for (unsigned int c = 0; c < 2; ++c)
          {
            double *row = local.row(s * n_per_cell + i, c) + 2 * s * n_per_cell;
            double  M[4];
            for (unsigned int b = 0; b < 4; ++b)
              M[b] = weight * (side.gradients[i][0] * derivative[2 * c][b] +
                               side.gradients[i][1] * derivative[2 * c + 1][b]);
            for (unsigned int j = 0; j < n_per_cell; ++j)
              for (unsigned int e = 0; e < 2; ++e)
                row[2 * j + e] += M[2 * e] * side.gradients[j][0] +
                                  M[2 * e + 1] * side.gradients[j][1];
          }
      }

      energy += point.weight * (0.5 * penalty * d.norm_square() - traction * d);
      const Tensor<1, 2> force = penalty * d - B * traction;
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          local.rhs[2 * k + c] +=
            point.weight * (point.jump[k] * force[c] - flux[k][0][c] * d[0] -
                            flux[k][1][c] * d[1]);
      if (!with_tangent)
        return Deformation::admissible;

      double projected[LocalSystem::max_covers][2][2];
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int c = 0; c < 2; ++c)
            projected[k][a][c] =
              B[a][0] * flux[k][0][c] + B[a][1] * flux[k][1][c];
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
        {
          double *row = local.row(k, c);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int e = 0; e < 2; ++e)
              row[2 * j + e] +=
                point.weight *
                (-projected[k][e][c] * point.jump[j] -
                 point.jump[k] * projected[j][c][e] +
                 penalty * point.jump[k] * point.jump[j] * B[c][e]);
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
        if (law.evaluate(deformation_gradient(n_per_cell,
                                              u.values + s * n_per_cell,
                                              side.gradients),
                         now) == Deformation::admissible &&
            law.evaluate(dealii::unit_symmetric_tensor<2>(), at_rest) ==
              Deformation::admissible)
          result =
            std::max(result,
                     largest_row(now.tangent) / largest_row(at_rest.tangent));
      }
      return result;
    }


    void
    add_follower_point(const EdgeTables::FollowerPoint &point,
                       const unsigned int               n_per_cell,
                       const double                     factor,
                       const LocalDisplacement         &u,
                       const bool                       with_tangent,
                       LocalSystem                     &local)
    {
      Tensor<1, 2> t = point.tangent;
      for (unsigned int j = 0; j < n_per_cell; ++j)
        for (unsigned int c = 0; c < 2; ++c)
          t[c] += point.tangential[j] * u.values[j][c];
      const double pressure = factor * point.weighted_pressure;
      for (unsigned int i = 0; i < n_per_cell; ++i)
      {
        const double p = pressure * point.values[i];
        local.rhs[2 * i] += p * t[1];
        local.rhs[2 * i + 1] -= p * t[0];
        if (!with_tangent)
          continue;
        double *row0 = local.row(i, 0), *row1 = local.row(i, 1);
        for (unsigned int j = 0; j < n_per_cell; ++j)
        {
          row0[2 * j + 1] += p * point.tangential[j];
          row1[2 * j] -= p * point.tangential[j];
        }
      }
    }


    double
    add_fixed_point(const CoverSystem       &covers,
                    const unsigned int       element,
                    const FixedPoint        &fixed,
                    const double             stiffness,
                    const double             factor,
                    const LocalDisplacement &u,
                    const bool               with_tangent,
                    LocalSystem             &local)
    {
      const ManifoldMesh     &mesh              = covers.manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      n                 = local.n_covers;
      double                  w[WeightFunctions::max_per_cell];
      WeightFunctions::values(
        mathematical_mesh.degree(),
        mathematical_mesh.real_to_reference(mesh.cell(element), fixed.point),
        w);
      double energy = 0.;
      for (unsigned int c = 0; c < 2; ++c)
      {
        if (!fixed.components[c])
          continue;
        double distance = -factor * fixed.displacement[c];
        for (unsigned int i = 0; i < n; ++i)
          distance += w[i] * u.values[i][c];
        energy += 0.5 * stiffness * distance * distance;
        for (unsigned int i = 0; i < n; ++i)
        {
          local.rhs[2 * i + c] += stiffness * w[i] * distance;
          if (with_tangent)
            for (unsigned int j = 0; j < n; ++j)
              local.row(i, c)[2 * j + c] += stiffness * w[i] * w[j];
        }
      }
      return energy;
    }
  } // namespace internal
} // namespace NMM
