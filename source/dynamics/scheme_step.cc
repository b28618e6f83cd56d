#include <cmath>
#include <dynamics/scheme_step.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    SchemeStep::SchemeStep(const TimeScheme   &scheme,
                           const DynamicState &begin,
                           const ModelLayout  &layout)
      : scheme(scheme)
      , begin(&begin)
    {
      scheme.check();
      for (Vector *vector : {&u, &v, &a})
        vector->reinit(layout.locally_owned, layout.communicator);
    }


    void
    SchemeStep::predict(const double h)
    {
      length = h;
      u      = begin->u;
      // not used in the conserving scheme, whose accelerations alternate in sign after impacts
      if (scheme.is_conserving)
        u.add(h, begin->v);
      else
        u.add(h, begin->v, 0.5 * h * h, begin->a);
    }


    void
    SchemeStep::set_rates(const ChosenItems &rows)
    {
      const double h   = length;
      const auto   u_0 = std::as_const(begin->u).begin(),
                 v_0   = std::as_const(begin->v).begin(),
                 a_0   = std::as_const(begin->a).begin(),
                 u_1   = std::as_const(u).begin();
      const auto   v_1 = v.begin(), a_1 = a.begin();
      const double by_a_0   = h * h * (0.5 - scheme.beta),
                   by_u     = 1. / (scheme.beta * h * h),
                   v_by_a_0 = h * (1. - scheme.gamma),
                   v_by_a   = h * scheme.gamma;
      rows.for_each(u.locally_owned_size(), [&](const unsigned int i) {
        // subtract u_0 first to keep rounding small, because u_1 is close to u_0
        double x = u_1[i] - u_0[i] - h * v_0[i];
        if (by_a_0 != 0.)
          x -= by_a_0 * a_0[i];
        a_1[i]   = by_u * x;
        double y = v_0[i];
        if (v_by_a_0 != 0.)
          y += v_by_a_0 * a_0[i];
        v_1[i] = y + v_by_a * a_1[i];
      });
    }


    /// Write (1 - alpha) x + alpha x_0 into the result.
    void
    SchemeStep::mix(const Vector      &x,
                    const double       alpha,
                    const Vector      &x_0,
                    const ChosenItems &rows,
                    Vector            &result) const
    {
      const auto from = x.begin(), other = x_0.begin();
      const auto to = result.begin();
      rows.for_each(x.locally_owned_size(), [&](const unsigned int i) {
        to[i] =
          alpha == 0. ? from[i] : (1. - alpha) * from[i] + alpha * other[i];
      });
    }


    double
    SchemeStep::closing_share() const
    {
      const ClosingForces &closing = begin->closing;
      return scheme.is_conserving ? closing.mean_share(begin->time, end_time())
                                  : closing.share(time_of_forces());
    }


    double
    SchemeStep::closing_share_in_work() const
    {
      const ClosingForces &closing = begin->closing;
      return scheme.is_conserving
               ? closing.mean_share(begin->time, end_time())
               : 0.5 * (closing.share(begin->time) + closing.share(end_time()));
    }


    double
    SchemeStep::error_factor() const
    {
      const double beta = scheme.is_conserving ? 0.25 : scheme.beta;
      return std::abs(beta - 1. / 6.) * length * length;
    }
  } // namespace internal
} // namespace NMM
