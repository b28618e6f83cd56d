#include <nmm/base/exceptions.h>
#include <nmm/dynamics/time_scheme.h>

namespace NMM
{
  TimeScheme
  TimeScheme::newmark(const double beta, const double gamma)
  {
    TimeScheme scheme;
    scheme.beta  = beta;
    scheme.gamma = gamma;
    return scheme;
  }


  TimeScheme
  TimeScheme::generalized_alpha(const double spectral_radius)
  {
    const double rho = spectral_radius;
    AssertThrow(rho >= 0. && rho <= 1.,
                InputError("The spectral radius is " + std::to_string(rho),
                           "the generalized-alpha scheme",
                           "choose it in [0, 1]"));
    TimeScheme scheme;
    scheme.name    = "generalized alpha";
    scheme.alpha_m = (2. * rho - 1.) / (rho + 1.);
    scheme.alpha_f = rho / (rho + 1.);
    scheme.gamma   = 0.5 - scheme.alpha_m + scheme.alpha_f;
    const double x = 1. - scheme.alpha_m + scheme.alpha_f;
    scheme.beta    = 0.25 * x * x;
    return scheme;
  }


  TimeScheme
  TimeScheme::constant_acceleration()
  {
    TimeScheme scheme = newmark(0.5, 1.);
    scheme.name       = "constant acceleration";
    return scheme;
  }


  TimeScheme
  TimeScheme::energy_momentum()
  {
    // a_1 is the mean acceleration, so that u_1 and v_1 follow as in constant_acceleration()
    TimeScheme scheme    = newmark(0.5, 1.);
    scheme.name          = "energy-momentum";
    scheme.alpha_f       = 0.5;
    scheme.is_conserving = true;
    return scheme;
  }


  void
  TimeScheme::check() const
  {
    const auto check = [&](const bool         is_good,
                           const std::string &coefficient,
                           const double       value,
                           const std::string &remedy) {
      AssertThrow(is_good,
                  InputError(coefficient + " is " + std::to_string(value),
                             "the time integration scheme '" + name + "'",
                             remedy));
    };
    check(beta > 0. && beta <= 1., "beta", beta, "choose it in (0, 1]");
    check(gamma >= 0.5 && gamma <= 2.,
          "gamma",
          gamma,
          "choose it in [0.5, 2]; below 0.5 the motion grows without bounds");
    check(alpha_f >= 0. && alpha_f <= 0.5,
          "alpha_f",
          alpha_f,
          "choose it in [0, 0.5]");
    check(alpha_m >= -1. && alpha_m <= alpha_f,
          "alpha_m",
          alpha_m,
          "choose it in [-1, alpha_f]");
  }
} // namespace NMM
