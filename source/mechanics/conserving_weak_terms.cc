#include <algorithm>
#include <cmath>
#include <mechanics/conserving_terms.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    namespace
    {
      /// Quantities of one side of a point, in the notation of add_conserving_weak_point().
      struct SideState
      {
        Tensor<2, 2>          F_1, F_m;
        ConservingLaw::Secant secant;
        Tensor<2, 2>          M;
        /// The traction S_m N [Pa].
        Tensor<1, 2> stress;
        /// Derivative of M with respect to E_1.
        double M_derivative[4][3];
      };


      /// The coefficients Q and T of a residual r(v) = -(Q : grad v + T . Bv).
      struct Flux
      {
        Tensor<2, 2> Q;
        Tensor<1, 2> T;
      };


      Deformation
      evaluate(const ConservingLaw   &law,
               const WeakPoint::Side &side,
               const unsigned int     n_per_cell,
               const double (*begin)[2],
               const double (*end)[2],
               const Tensor<1, 2> &d_0,
               const Tensor<1, 2> &d_1,
               const Tensor<1, 2> &normal,
               const bool          with_tangent,
               SideState          &state)
      {
        const Tensor<2, 2> H_0 =
          displacement_gradient(n_per_cell, begin, side.gradients);
        const Tensor<2, 2> H_1 =
          displacement_gradient(n_per_cell, end, side.gradients);
        const Tensor<2, 2> F_0 = with_identity(H_0);
        state.F_1              = with_identity(H_1);
        state.F_m              = 0.5 * (F_0 + state.F_1);
        if (law.secant(H_0, H_1, state.secant) != Deformation::admissible)
          return Deformation::inverted;
        const Tensor<1, 2> a = 0.5 * (d_0 * F_0 + d_1 * state.F_1);
        const Tensor<2, 2> X = dealii::outer_product(a, normal);
        state.M              = multiply(state.secant.moduli, X);
        state.stress         = state.secant.mean_stress * normal;
        return with_tangent
                 ? law.secant_derivative(state.secant, X, state.M_derivative)
                 : Deformation::admissible;
      }


      /// Twice the derivative of the flux with respect to the displacement at the end, in the
      /// direction of a displacement with the gradient @p H and the jump @p jump.
      Flux
      derivative(const SideState    &state,
                 const Tensor<1, 2> &d_1,
                 const Tensor<1, 2> &d_m,
                 const Tensor<1, 2> &normal,
                 const Tensor<2, 2> &H,
                 const Tensor<1, 2> &jump)
      {
        const Tensor<2, 2> dE  = dealii::transpose(state.F_1) * H;
        const Tensor<1, 2> S_w = multiply(state.secant.end_moduli, dE) * normal;
        const Tensor<1, 2> a_w = d_1 * H + jump * state.F_1;
        Tensor<2, 2>       M_w =
          multiply(state.secant.moduli, dealii::outer_product(a_w, normal));
        const double components[3] = {2. * dE[0][0],
                                      2. * dE[1][1],
                                      dE[0][1] + dE[1][0]};
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            M_w[a / 2][a % 2] += state.M_derivative[a][c] * components[c];
        Flux flux;
        flux.Q = dealii::outer_product(jump, state.stress) +
                 dealii::outer_product(d_m, S_w) + H * state.M +
                 state.F_m * M_w;
        flux.T = H * state.stress + state.F_m * S_w;
        return flux;
      }


      /// Add the columns of the matrix for the unknowns of side @p of.
      void
      add_columns(const WeakPoint   &point,
                  const unsigned int n_per_cell,
                  const double       penalty,
                  const SideState (&states)[2],
                  const unsigned int  of,
                  const Tensor<1, 2> &d_1,
                  const Tensor<1, 2> &d_m,
                  LocalSystem        &local)
      {
        const unsigned int n = point.n_sides * n_per_cell;
        for (unsigned int j = 0; j < n_per_cell; ++j)
          for (unsigned int e = 0; e < 2; ++e)
          {
            const unsigned int column = 2 * (of * n_per_cell + j) + e;
            Tensor<1, 2>       direction;
            direction[e]             = point.jump[of * n_per_cell + j];
            const Tensor<1, 2> jump  = point.projection * direction;
            Tensor<1, 2>       force = penalty * jump;
            for (unsigned int s = 0; s < point.n_sides; ++s)
            {
              const WeakPoint::Side &side = point.sides[s];
              Tensor<2, 2>           H;
              if (s == of)
                for (unsigned int L = 0; L < 2; ++L)
                  H[e][L] = side.gradients[j][L];
              const Flux flux =
                derivative(states[s], d_1, d_m, point.normal, H, jump);
              force -= side.share * (point.projection * flux.T);
              const double weight = point.weight * side.share;
              for (unsigned int i = 0; i < n_per_cell; ++i)
                for (unsigned int c = 0; c < 2; ++c)
                  local.row(s * n_per_cell + i, c)[column] -=
                    weight * (flux.Q[c][0] * side.gradients[i][0] +
                              flux.Q[c][1] * side.gradients[i][1]);
            }
            for (unsigned int k = 0; k < n; ++k)
              for (unsigned int c = 0; c < 2; ++c)
                local.row(k, c)[column] +=
                  point.weight * point.jump[k] * force[c];
          }
      }
    } // namespace


    Deformation
    add_conserving_weak_point(const WeakPoint                   &point,
                              const std::vector<ConservingLaw>  &region_to_law,
                              const unsigned int                 n_per_cell,
                              const std::array<Tensor<1, 2>, 2> &prescribed,
                              const double                       growth,
                              const LocalDisplacement           &begin,
                              const LocalDisplacement           &end,
                              const Tangent                      tangent,
                              LocalSystem                       &local,
                              double                            &work,
                              double                            &largest_jump)
    {
      const unsigned int n = point.n_sides * n_per_cell;
      AssertDimension(n, local.n_covers);
      Tensor<1, 2> jump_0, jump_1;
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
        {
          jump_0[c] += point.jump[k] * begin.values[k][c];
          jump_1[c] += point.jump[k] * end.values[k][c];
        }
      Tensor<1, 2> d_0 = point.projection * jump_0 - prescribed[0];
      Tensor<1, 2> d_1 = point.projection * jump_1 - prescribed[1];
      Tensor<1, 2> d_m = 0.5 * (d_0 + d_1);

      const bool   with_tangent  = tangent != Tangent::none;
      const double relative_jump = d_1.norm() * point.trace_constant;
      if (std::isfinite(relative_jump))
        largest_jump = std::max(largest_jump, relative_jump);

      const double penalty = growth * point.penalty;
      Tensor<1, 2> force   = penalty * d_m;
      SideState    states[2];
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const WeakPoint::Side &side  = point.sides[s];
        SideState             &state = states[s];
        if (evaluate(region_to_law[side.region],
                     side,
                     n_per_cell,
                     begin.values + s * n_per_cell,
                     end.values + s * n_per_cell,
                     d_0,
                     d_1,
                     point.normal,
                     with_tangent,
                     state) != Deformation::admissible)
          return Deformation::inverted;
        const Tensor<2, 2> Q =
          dealii::outer_product(d_m, state.stress) + state.F_m * state.M;
        force -= side.share * (point.projection * (state.F_m * state.stress));
        const double weight = point.weight * side.share;
        for (unsigned int i = 0; i < n_per_cell; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            local.rhs[2 * (s * n_per_cell + i) + c] -=
              weight *
              (Q[c][0] * side.gradients[i][0] + Q[c][1] * side.gradients[i][1]);
      }
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < 2; ++c)
          local.rhs[2 * k + c] += point.weight * point.jump[k] * force[c];
      work -= point.weight * (force * (prescribed[1] - prescribed[0]));
      if (!with_tangent)
        return Deformation::admissible;

      const bool is_close =
        std::max(d_0.norm(), d_1.norm()) * point.trace_constant < close_jump;
      if (tangent == Tangent::robust && !is_close)
      {
        d_0 = d_1 = d_m = Tensor<1, 2>();
        for (SideState &state : states)
        {
          state.M = 0.;
          for (auto &row : state.M_derivative)
            std::fill_n(row, 3, 0.);
        }
      }
      for (unsigned int s = 0; s < point.n_sides; ++s)
        add_columns(point, n_per_cell, penalty, states, s, d_1, d_m, local);
      return Deformation::admissible;
    }
  } // namespace internal
} // namespace NMM
