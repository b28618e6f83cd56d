#include <algorithm>
#include <mechanics/conserving_terms.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    namespace
    {
      /// Quantities of one side of a point, in the notation of conserving_fluxes().
      struct SideState
      {
        Tensor<2, 2>          F_1, F_m;
        Tensor<1, 2>          d_1, d_m;
        ConservingLaw::Secant secant;
        Tensor<2, 2>          M;
        /// The traction S_m N [Pa].
        Tensor<1, 2> stress;
        /// Derivative of M with respect to E_1.
        double M_derivative[4][3];
      };


      /// Set the derivatives of the flux with respect to the means of both states, at a fixed first
      /// state: twice those with respect to the second one.
      void
      set_derivatives(const SideState    &state,
                      const Tensor<1, 2> &normal,
                      WeakFlux           &flux)
      {
        flux.has_conjugate_by_gradient = true;
        for (unsigned int b = 0; b < 4; ++b)
        {
          Tensor<2, 2> H;
          H[b / 2][b % 2]       = 1.;
          const Tensor<2, 2> dE = dealii::transpose(state.F_1) * H;
          const Tensor<1, 2> S_H =
            multiply(state.secant.end_moduli, dE) * normal;
          Tensor<2, 2> M_H =
            multiply(state.secant.moduli,
                     dealii::outer_product(state.d_1 * H, normal));
          const double components[3] = {2. * dE[0][0],
                                        2. * dE[1][1],
                                        dE[0][1] + dE[1][0]};
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int c = 0; c < 3; ++c)
              M_H[a / 2][a % 2] += state.M_derivative[a][c] * components[c];
          const Tensor<2, 2> Q = dealii::outer_product(state.d_m, S_H) +
                                 H * state.M + state.F_m * M_H;
          const Tensor<1, 2> t = H * state.stress + state.F_m * S_H;
          for (unsigned int a = 0; a < 4; ++a)
            flux.conjugate_by_gradient[a][b] = Q[a / 2][a % 2];
          for (unsigned int a = 0; a < 2; ++a)
            flux.traction_by_gradient[a][b] = t[a];
        }
        for (unsigned int b = 0; b < 2; ++b)
        {
          Tensor<1, 2> jump;
          jump[b] = 1.;
          const Tensor<2, 2> Q =
            dealii::outer_product(jump, state.stress) +
            state.F_m *
              multiply(state.secant.moduli,
                       dealii::outer_product(jump * state.F_1, normal));
          for (unsigned int a = 0; a < 4; ++a)
            flux.conjugate_by_jump[a][b] = Q[a / 2][a % 2];
        }
      }
    } // namespace


    Deformation
    conserving_fluxes(const std::vector<ConservingLaw>  &region_to_law,
                      const LocalDisplacement           &begin,
                      const LocalDisplacement           &end,
                      const std::array<Tensor<1, 2>, 2> &d,
                      const Tangent                      tangent,
                      NitscheTerms                      &terms)
    {
      const WeakPoint &point = terms.point;
      terms.d                = 0.5 * (d[0] + d[1]);
      const bool is_close =
        std::max(d[0].norm(), d[1].norm()) * point.trace_constant < close_jump;
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        const ConservingLaw &law = region_to_law[point.sides[s].region];
        const Tensor<2, 2>   H_0 = terms.gradient(begin, s),
                           H_1   = terms.gradient(end, s),
                           F_0   = deformation_gradient(H_0);
        SideState state;
        state.F_1 = deformation_gradient(H_1);
        state.F_m = 0.5 * (F_0 + state.F_1);
        if (law.secant(H_0, H_1, state.secant) != Deformation::admissible)
          return Deformation::inverted;
        const Tensor<2, 2> X =
          dealii::outer_product(0.5 * (d[0] * F_0 + d[1] * state.F_1),
                                point.normal);
        state.M        = multiply(state.secant.moduli, X);
        state.stress   = state.secant.mean_stress * point.normal;
        WeakFlux &flux = terms.fluxes[s];
        flux.traction  = state.F_m * state.stress;
        flux.conjugate =
          dealii::outer_product(terms.d, state.stress) + state.F_m * state.M;
        if (tangent == Tangent::none)
          continue;
        if (law.secant_derivative(state.secant, X, state.M_derivative) !=
            Deformation::admissible)
          return Deformation::inverted;
        state.d_1 = d[1];
        state.d_m = terms.d;
        if (tangent == Tangent::robust && !is_close)
        {
          state.d_1 = state.d_m = Tensor<1, 2>();
          state.M               = 0.;
          std::fill_n(&state.M_derivative[0][0], 12, 0.);
        }
        set_derivatives(state, point.normal, flux);
      }
      return Deformation::admissible;
    }
  } // namespace internal
} // namespace NMM
