#include <algorithm>
#include <cmath>
#include <mechanics/conserving_terms.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    namespace
    {
      /// Norm of E_1 - E_0 below which the means between both states are not corrected [-].
      constexpr double least_change = 1e-2;
      /// Points and weights of the Gauss rule with three points on [0, 1].
      constexpr double positions[3] = {0.11270166537925831,
                                       0.5,
                                       0.88729833462074169};
      constexpr double weights[3]   = {5. / 18., 8. / 18., 5. / 18.};


      /// U - I, U being the right stretch tensor, the positive definite root of C = I + 2 E. With
      /// d = (det C)^(1/2) and t = (tr C + 2 d)^(1/2), U = (C + d I) / t by the Cayley-Hamilton
      /// theorem, and 1 + d - t = 4 det E / (1 + d + t), which keeps the digits of small strains.
      Tensor<2, 2>
      right_stretch_change(const SymmetricTensor<2, 2> &E)
      {
        const double trace    = 2. * dealii::trace(E),
                     det      = dealii::determinant(E);
        const double d        = std::sqrt(1. + trace + 4. * det);
        const double t        = std::sqrt(2. + trace + 2. * d);
        const double diagonal = 4. * det / (1. + d + t);
        Tensor<2, 2> change   = 2. * Tensor<2, 2>(E);
        change[0][0] += diagonal;
        change[1][1] += diagonal;
        return change / t;
      }

    } // namespace


    ConservingLaw::ConservingLaw(std::shared_ptr<const HyperelasticLaw> law,
                                 const SymmetricTensor<2, 2> &initial_stress)
      : law(std::move(law))
      , elasticity(this->law->small_strain())
      , initial_stress(initial_stress)
    {
    }


    /// S and D = dS/dE follow from P and A = dP/dF at F = U, H = U - I, by S = U^-1 P and
    /// A_iJkL = delta_ik S_JL + U_iM U_kN D_MJNL.
    Deformation
    ConservingLaw::second_stress(const SymmetricTensor<2, 2> &E,
                                 const bool                   with_tangent,
                                 SymmetricTensor<2, 2>       &S,
                                 double (&D)[4][4]) const
    {
      const Tensor<2, 2> H       = right_stretch_change(E);
      const Tensor<2, 2> inverse = dealii::invert(deformation_gradient(H));
      HyperelasticLaw::Response response;
      if ((with_tangent
             ? law->evaluate(H, response)
             : law->evaluate_stress(H, response)) != Deformation::admissible)
        return Deformation::inverted;
      S = dealii::symmetrize(inverse * response.stress);
      if (!with_tangent)
        return Deformation::admissible;
      for (unsigned int J = 0; J < 2; ++J)
        for (unsigned int L = 0; L < 2; ++L)
        {
          Tensor<2, 2> B;
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int k = 0; k < 2; ++k)
              B[i][k] = response.tangent[2 * i + J][2 * k + L] -
                        (i == k ? S[J][L] : 0.);
          B = inverse * B * inverse;
          for (unsigned int M = 0; M < 2; ++M)
            for (unsigned int N = 0; N < 2; ++N)
              D[2 * M + J][2 * N + L] = B[M][N];
        }
      return Deformation::admissible;
    }


    Deformation
    ConservingLaw::discrete_gradient(const Tensor<2, 2>    &H_0,
                                     const Tensor<2, 2>    &H_1,
                                     const bool             with_tangent,
                                     SymmetricTensor<2, 2> &S,
                                     double (&D)[4][4]) const
    {
      if (!(determinant_change(H_0) > -1.) || !(determinant_change(H_1) > -1.))
        return Deformation::inverted;
      const SymmetricTensor<2, 2> E_0    = green_strain(H_0);
      const SymmetricTensor<2, 2> change = green_strain(H_1) - E_0;
      S                                  = 0.;
      for (auto &row : D)
        std::fill_n(row, 4, 0.);
      for (unsigned int g = 0; g < 3; ++g)
      {
        SymmetricTensor<2, 2> S_g;
        double                D_g[4][4];
        if (second_stress(E_0 + positions[g] * change,
                          with_tangent,
                          S_g,
                          D_g) != Deformation::admissible)
          return Deformation::inverted;
        S += weights[g] * S_g;
        if (with_tangent)
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int b = 0; b < 4; ++b)
              D[a][b] += 2. * positions[g] * weights[g] * D_g[a][b];
      }
      const double square = change * change;
      if (square < least_change * least_change)
        return Deformation::admissible;

      HyperelasticLaw::Response response_0, response_1;
      if (law->evaluate_stress(H_0, response_0) != Deformation::admissible ||
          law->evaluate_stress(H_1, response_1) != Deformation::admissible)
        return Deformation::inverted;
      const SymmetricTensor<2, 2> S_mean = S;
      const double                factor =
        (response_1.energy - response_0.energy - S_mean * change) / square;
      S += factor * change;
      if (!with_tangent)
        return Deformation::admissible;

      const SymmetricTensor<2, 2> S_1 = dealii::symmetrize(
        dealii::invert(deformation_gradient(H_1)) * response_1.stress);
      // slope is 2 d(factor)/dE_1
      Tensor<2, 2> slope = 2. * (S_1 - S_mean) - 4. * factor * change;
      for (unsigned int N = 0; N < 2; ++N)
        for (unsigned int L = 0; L < 2; ++L)
        {
          for (unsigned int M = 0; M < 2; ++M)
            for (unsigned int J = 0; J < 2; ++J)
              slope[N][L] -= D[2 * M + J][2 * N + L] * change[M][J];
          slope[N][L] /= square;
        }
      for (unsigned int M = 0; M < 2; ++M)
        for (unsigned int J = 0; J < 2; ++J)
          for (unsigned int N = 0; N < 2; ++N)
            for (unsigned int L = 0; L < 2; ++L)
              D[2 * M + J][2 * N + L] +=
                change[M][J] * slope[N][L] +
                factor *
                  ((M == N && J == L ? 1. : 0.) + (M == L && J == N ? 1. : 0.));
      return Deformation::admissible;
    }


    Deformation
    ConservingLaw::secant_moduli(const SymmetricTensor<2, 2> &E_0,
                                 const SymmetricTensor<2, 2> &E_1,
                                 double (&moduli)[4][4]) const
    {
      const SymmetricTensor<2, 2> change = E_1 - E_0;
      SymmetricTensor<2, 2>       S;
      double                      D[4][4];
      for (auto &row : moduli)
        std::fill_n(row, 4, 0.);
      for (unsigned int g = 0; g < 3; ++g)
      {
        if (second_stress(E_0 + positions[g] * change,
                          /* with_tangent = */ true,
                          S,
                          D) != Deformation::admissible)
          return Deformation::inverted;
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int b = 0; b < 4; ++b)
            moduli[a][b] += weights[g] * D[a][b];
      }
      const double square = change * change;
      if (square < least_change * least_change)
        return Deformation::admissible;

      SymmetricTensor<2, 2> S_0, S_1;
      if (second_stress(E_0, false, S_0, D) != Deformation::admissible ||
          second_stress(E_1, false, S_1, D) != Deformation::admissible)
        return Deformation::inverted;
      const Tensor<2, 2> missing =
        S_1 - S_0 - multiply(moduli, Tensor<2, 2>(change));
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int b = 0; b < 4; ++b)
          moduli[a][b] += missing[a / 2][a % 2] * change[b / 2][b % 2] / square;
      return Deformation::admissible;
    }


    Deformation
    ConservingLaw::secant(const Tensor<2, 2> &H_0,
                          const Tensor<2, 2> &H_1,
                          Secant             &result) const
    {
      result.E_0 = green_strain(H_0);
      result.E_1 = green_strain(H_1);
      if (!law->is_linear_in_green_strain())
      {
        if (!(determinant_change(H_0) > -1.) ||
            !(determinant_change(H_1) > -1.))
          return Deformation::inverted;
        SymmetricTensor<2, 2> S_0, S_1;
        double                D[4][4];
        if (second_stress(result.E_0, false, S_0, D) !=
              Deformation::admissible ||
            second_stress(result.E_1, true, S_1, result.end_moduli) !=
              Deformation::admissible)
          return Deformation::inverted;
        result.mean_stress = 0.5 * (S_0 + S_1);
        return secant_moduli(result.E_0, result.E_1, result.moduli);
      }

      hooke_moduli(elasticity, result.moduli);
      std::copy(&result.moduli[0][0],
                &result.moduli[0][0] + 16,
                &result.end_moduli[0][0]);
      result.mean_stress =
        initial_stress +
        dealii::symmetrize(
          multiply(result.moduli,
                   Tensor<2, 2>(0.5 * (result.E_0 + result.E_1))));
      return Deformation::admissible;
    }


    Deformation
    ConservingLaw::secant_derivative(const Secant       &secant,
                                     const Tensor<2, 2> &X,
                                     double (&derivative)[4][3]) const
    {
      for (auto &row : derivative)
        std::fill_n(row, 3, 0.);
      if (law->is_linear_in_green_strain())
        return Deformation::admissible;
      // step of central differences [-], whose errors of truncation and rounding are about 1e-10
      constexpr double step = 1e-5;
      for (unsigned int c = 0; c < 3; ++c)
        for (const double sign : {1., -1.})
        {
          SymmetricTensor<2, 2> E_1 = secant.E_1;
          E_1[c == 1 ? 1 : 0][c == 0 ? 0 : 1] += sign * step;
          double moduli[4][4];
          if (secant_moduli(secant.E_0, E_1, moduli) != Deformation::admissible)
            return Deformation::inverted;
          const Tensor<2, 2> value = multiply(moduli, X);
          for (unsigned int a = 0; a < 4; ++a)
            derivative[a][c] += sign * value[a / 2][a % 2] / (2. * step);
        }
      return Deformation::admissible;
    }


    Deformation
    ConservingLaw::evaluate(const Tensor<2, 2> &H_0,
                            const Tensor<2, 2> &H_1,
                            const bool          with_tangent,
                            const double        damping,
                            Response           &response) const
    {
      const Tensor<2, 2>    F = deformation_gradient(0.5 * (H_0 + H_1));
      SymmetricTensor<2, 2> S;
      double                D[4][4];
      if (!law->is_linear_in_green_strain())
      {
        if (discrete_gradient(H_0, H_1, with_tangent, S, D) !=
            Deformation::admissible)
          return Deformation::inverted;
      }
      else
      {
        const SymmetricTensor<2, 2> E =
          0.5 * (green_strain(H_0) + green_strain(H_1));
        S                     = initial_stress + 2. * elasticity.mu * E;
        const double pressure = elasticity.lambda * dealii::trace(E);
        S[0][0] += pressure;
        S[1][1] += pressure;
      }
      response.dissipated = 0.;
      if (damping > 0.)
      {
        const SymmetricTensor<2, 2> change =
          green_strain(H_1) - green_strain(H_0);
        SymmetricTensor<2, 2> viscous = (2. * damping * elasticity.mu) * change;
        const double          pressure =
          damping * elasticity.lambda * dealii::trace(change);
        viscous[0][0] += pressure;
        viscous[1][1] += pressure;
        response.dissipated = viscous * change;
        S += viscous;
      }
      response.stress = F * Tensor<2, 2>(S);
      if (!with_tangent)
        return Deformation::admissible;

      // 2 dS/dE_1 divided by the moduli of the undeformed state: 1 for a stress at the mean of both
      // strains, and twice the damping
      const double moduli =
        (law->is_linear_in_green_strain() ? 1. : 0.) + 2. * damping;
      const double       lambda = moduli * elasticity.lambda;
      const double       mu     = moduli * elasticity.mu;
      const Tensor<2, 2> F_1    = deformation_gradient(H_1);
      const Tensor<2, 2> b      = F * dealii::transpose(F_1);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int J = 0; J < 2; ++J)
          for (unsigned int k = 0; k < 2; ++k)
            for (unsigned int L = 0; L < 2; ++L)
            {
              double a = (i == k ? S[J][L] : 0.);
              if (!law->is_linear_in_green_strain())
              {
                for (unsigned int M = 0; M < 2; ++M)
                  for (unsigned int N = 0; N < 2; ++N)
                    a += F[i][M] * D[2 * M + J][2 * N + L] * F_1[k][N];
              }
              if (moduli > 0.)
                a += lambda * F[i][J] * F_1[k][L] +
                     mu * (F[i][L] * F_1[k][J] + (J == L ? b[i][k] : 0.));
              response.tangent[2 * i + J][2 * k + L] = a;
            }
      return Deformation::admissible;
    }


    namespace
    {
      template <unsigned int n>
      Deformation
      add(const ConservingLaw       &law,
          const ElementTables::View &table,
          const LocalDisplacement   &begin,
          const LocalDisplacement   &end,
          const double               damping,
          LocalSystem               &local)
      {
        ConservingLaw::Response response;
        for (unsigned int q = 0; q < table.n_points; ++q)
        {
          const double(*g)[2] = table.gradients + q * n;
          const double weight = table.weights[q];
          if (law.evaluate(displacement_gradient(n, begin.values, g),
                           displacement_gradient(n, end.values, g),
                           local.with_matrix,
                           damping,
                           response) != Deformation::admissible)
            return Deformation::inverted;
          local.dissipated += weight * response.dissipated;
          add_stress(n, g, weight * response.stress, local.rhs);
          if (local.with_matrix)
            add_moduli(n, g, weight, response.tangent, local.matrix, 2 * n);
        }
        return Deformation::admissible;
      }
    } // namespace


    Deformation
    add_conserving_terms(const ConservingLaw       &law,
                         const ElementTables::View &table,
                         const LocalDisplacement   &begin,
                         const LocalDisplacement   &end,
                         const double               damping,
                         LocalSystem               &local)
    {
      return (local.n_covers == 3
                ? add<3>
                : add<6>)(law, table, begin, end, damping, local);
    }
  } // namespace internal
} // namespace NMM
