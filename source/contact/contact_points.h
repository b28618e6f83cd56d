#ifndef nmm_source_contact_contact_points_h
#define nmm_source_contact_contact_points_h

#include <nmm/contact/contact.h>

#include <array>
#include <contact/contact_search.h>
#include <unordered_map>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Gauss-Lobatto rule of @p n points on [0, 1].
    void
    lobatto_rule(unsigned int         n,
                 std::vector<double> &points,
                 std::vector<double> &weights);


    /// Multiplier on a slave edge: coefficients of the Legendre polynomials on
    /// [0, 1].
    struct EdgeMultiplier
    {
      static constexpr unsigned int n_modes = 3;
      std::array<double, n_modes>   coefficients{};

      static std::array<double, n_modes>
      modes(const double s)
      {
        const double x = 2. * s - 1.;
        return {{1., x, 0.5 * (3. * x * x - 1.)}};
      }

      double
      operator()(const double s) const
      {
        const auto f   = modes(s);
        double     sum = 0.;
        for (unsigned int m = 0; m < n_modes; ++m)
          sum += coefficients[m] * f[m];
        return sum;
      }
    };


    /// Where the points of a slave edge stick, ascending in s.
    struct StickPlace
    {
      double       s;
      unsigned int edge;
      double       t;
    };

    using StickPlaces =
      std::unordered_map<unsigned int, std::vector<StickPlace>>;

    /// The place for @p s: between places on the same master linear, else the
    /// nearer one; false if there are none.
    bool
    find_stick_place(const std::vector<StickPlace> &places,
                     double                         s,
                     StickPlace                    &result);
  } // namespace internal
} // namespace NMM

#endif
