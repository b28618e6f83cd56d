#include <mechanics/nitsche_terms.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    void
    WeakFlux::set_traction_derivative(const double (&A)[4][4],
                                      const Tensor<1, 2> &normal)
    {
      for (unsigned int a = 0; a < 2; ++a)
        for (unsigned int b = 0; b < 4; ++b)
          traction_by_gradient[a][b] =
            A[2 * a][b] * normal[0] + A[2 * a + 1][b] * normal[1];
    }


    void
    WeakFlux::set_elastic(const Tensor<2, 2> &P,
                          const double (&A)[4][4],
                          const Tensor<1, 2> &normal,
                          const Tensor<1, 2> &d)
    {
      traction = P * normal;
      set_traction_derivative(A, normal);
      for (unsigned int b = 0; b < 4; ++b)
      {
        conjugate[b / 2][b % 2] = 0.;
        for (unsigned int a = 0; a < 2; ++a)
        {
          conjugate[b / 2][b % 2] += d[a] * traction_by_gradient[a][b];
          conjugate_by_jump[b][a] = traction_by_gradient[a][b];
        }
      }
    }


    Tensor<1, 2>
    NitscheTerms::jump(const LocalDisplacement &u, const double factor) const
    {
      Tensor<1, 2> result;
      for (unsigned int k = 0; k < point.n_sides * n_per_cell; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          result[c] += point.jump[k] * u.values[k][c];
      return point.projection * result - factor * point.prescribed;
    }


    Tensor<1, 2>
    NitscheTerms::force() const
    {
      Tensor<1, 2> traction;
      for (unsigned int s = 0; s < point.n_sides; ++s)
        traction += point.sides[s].share * fluxes[s].traction;
      return penalty * d - point.projection * traction;
    }


    void
    NitscheTerms::traction_derivatives(
      double (&derivatives)[LocalSystem::max_covers][2][2]) const
    {
      for (unsigned int k = 0; k < point.n_sides * n_per_cell; ++k)
      {
        const unsigned int     s    = k / n_per_cell;
        const WeakPoint::Side &side = point.sides[s];
        const double          *g    = side.gradients[k % n_per_cell];
        const double           g0 = side.share * g[0], g1 = side.share * g[1];
        for (unsigned int a = 0; a < 2; ++a)
        {
          const double *t = fluxes[s].traction_by_gradient[a];
          for (unsigned int c = 0; c < 2; ++c)
            derivatives[k][a][c] = t[2 * c] * g0 + t[2 * c + 1] * g1;
        }
      }
    }


    void
    NitscheTerms::add(LocalSystem &local) const
    {
      AssertDimension(point.n_sides * n_per_cell, local.n_covers);
      // d lies in the range of B, so that B t . d = t . d
      const Tensor<1, 2> f = force();
      local.energy += point.weight * (f * d - 0.5 * penalty * d.norm_square());
      for (unsigned int k = 0; k < local.n_covers; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          local.rhs[unknown_of(k, c)] += point.weight * point.jump[k] * f[c];
      for (unsigned int s = 0; s < point.n_sides; ++s)
        add_stress(n_per_cell,
                   point.sides[s].gradients,
                   -point.weight * point.sides[s].share * fluxes[s].conjugate,
                   local.rhs + 2 * s * n_per_cell);
      if (local.with_matrix)
        add_matrix(local);
    }


    void
    NitscheTerms::add_matrix(LocalSystem &local) const
    {
      const unsigned int n = local.n_covers;
      const double B[2][2] = {{point.projection[0][0], point.projection[0][1]},
                              {point.projection[1][0], point.projection[1][1]}};
      double       derivatives[LocalSystem::max_covers][2][2];
      traction_derivatives(derivatives);
      // B times the derivatives of {t} in the direction (j, e), and those of {Q : grad v} for v in
      // the direction (k, c) by d, times B
      double traction[LocalSystem::max_covers][2][2],
        conjugate[LocalSystem::max_covers][2][2];
      for (unsigned int k = 0; k < n; ++k)
      {
        const unsigned int     s    = k / n_per_cell;
        const WeakPoint::Side &side = point.sides[s];
        const double          *g    = side.gradients[k % n_per_cell];
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double(*Q)[2] = fluxes[s].conjugate_by_jump + 2 * c;
          const double q[2]   = {side.share * (g[0] * Q[0][0] + g[1] * Q[1][0]),
                                 side.share * (g[0] * Q[0][1] + g[1] * Q[1][1])};
          for (unsigned int a = 0; a < 2; ++a)
          {
            traction[k][a][c] =
              B[a][0] * derivatives[k][0][c] + B[a][1] * derivatives[k][1][c];
            conjugate[k][c][a] = q[0] * B[0][a] + q[1] * B[1][a];
          }
        }
      }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
        {
          const double jump  = point.weight * point.jump[k];
          const double stiff = jump * penalty;
          double      *row   = local.row(k, c);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int e = 0; e < 2; ++e)
              row[unknown_of(j, e)] +=
                (stiff * B[c][e] - point.weight * conjugate[k][c][e]) *
                  point.jump[j] -
                jump * traction[j][c][e];
        }
      for (unsigned int s = 0; s < point.n_sides; ++s)
        if (fluxes[s].has_conjugate_by_gradient)
          add_moduli(n_per_cell,
                     point.sides[s].gradients,
                     -point.weight * point.sides[s].share,
                     fluxes[s].conjugate_by_gradient,
                     local.row(s * n_per_cell, 0) + 2 * s * n_per_cell,
                     2 * n);
    }
  } // namespace internal
} // namespace NMM
