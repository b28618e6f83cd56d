#include <nmm/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <mechanics/bolt_bar.h>
#include <numeric>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Stiffness left after yielding, over the elastic one.
      constexpr double hardening = BoltBar::hardening;
      constexpr double no_limit  = std::numeric_limits<double>::infinity();
      /// Stiffness of a broken element, over the elastic one: what it bears is far below rounding
      /// of forces in the rock.
      constexpr double rest_of_broken = 1e-12;
      /// Stiffness of a tie over EA / L.
      constexpr double of_tie = 1e6;

      /// Abscissas and weights of Gauss rules on [0, 1].
      const double gauss_2[2]   = {0.5 - 0.5 / std::sqrt(3.),
                                   0.5 + 0.5 / std::sqrt(3.)};
      const double gauss_3[3]   = {0.5 - 0.5 * std::sqrt(0.6),
                                   0.5,
                                   0.5 + 0.5 * std::sqrt(0.6)};
      const double weights_3[3] = {5. / 18., 4. / 9., 5. / 18.};


      std::array<double, 3>
      shape(const double xi)
      {
        return {(1. - xi) * (1. - 2. * xi),
                4. * xi * (1. - xi),
                xi * (2. * xi - 1.)};
      }


      /// Derivatives of the shape functions by xi.
      std::array<double, 3>
      slope(const double xi)
      {
        return {4. * xi - 3., 4. - 8. * xi, 4. * xi - 1.};
      }


      /// A spring that yields.
      struct Yielding
      {
        double force, tangent, plastic;
        double stored;
        /// Whether it yields, with the sign of the force.
        int yields;
      };


      Yielding
      yield(const double total,
            const double plastic,
            const double stiffness,
            const double limit,
            const double hardening)
      {
        const double h     = hardening * stiffness;
        const double trial = stiffness * (total - plastic) - h * plastic;
        Yielding     result{stiffness * (total - plastic),
                        stiffness,
                        plastic,
                        0.,
                        std::abs(trial) <= limit ? 0
                            : trial > 0.             ? 1
                                                     : -1};
        if (result.yields != 0)
        {
          const double more =
            std::copysign((std::abs(trial) - limit) / (stiffness + h), trial);
          result.plastic += more;
          result.force   = stiffness * (total - result.plastic);
          result.tangent = stiffness * h / (stiffness + h);
        }
        result.stored = 0.5 * result.force * result.force / stiffness;
        return result;
      }


      /// L D L^T of a symmetric matrix with two bands below the diagonal, in place.
      void
      factorize(std::array<std::vector<double>, 3> &m)
      {
        const std::size_t n = m[0].size();
        for (std::size_t i = 0; i < n; ++i)
        {
          if (i >= 2)
          {
            // row i: entries i-2 (band 2) and i-1 (band 1)
            m[1][i] -= m[2][i] * m[1][i - 1];
            m[2][i] /= m[0][i - 2];
            m[0][i] -= m[2][i] * m[2][i] * m[0][i - 2];
          }
          if (i >= 1)
          {
            m[1][i] /= m[0][i - 1];
            m[0][i] -= m[1][i] * m[1][i] * m[0][i - 1];
          }
        }
      }


      /// Solve with @p n_columns right-hand sides, stored row by row.
      void
      solve(const std::array<std::vector<double>, 3> &m,
            double                                   *x,
            const std::size_t                         n_columns)
      {
        const std::size_t n        = m[0].size();
        const auto        subtract = [&](const std::size_t to,
                                  const std::size_t from,
                                  const double      factor) {
          for (std::size_t c = 0; c < n_columns; ++c)
            x[to * n_columns + c] -= factor * x[from * n_columns + c];
        };
        for (std::size_t i = 0; i < n; ++i)
        {
          if (i >= 1)
            subtract(i, i - 1, m[1][i]);
          if (i >= 2)
            subtract(i, i - 2, m[2][i]);
        }
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t c = 0; c < n_columns; ++c)
            x[i * n_columns + c] /= m[0][i];
        for (std::size_t i = n; i-- > 0;)
        {
          if (i + 1 < n)
            subtract(i, i + 1, m[1][i + 1]);
          if (i + 2 < n)
            subtract(i, i + 2, m[2][i + 2]);
        }
      }
    } // namespace


    /// A guess of v with what it gives.
    struct BoltBar::Trial
    {
      std::vector<double>                v, gradient;
      std::array<std::vector<double>, 3> matrix;
      /// Whether points yield, with the sign of the force.
      std::vector<char> branches;
      Response          response;
    };


    BoltBar::BoltBar(const BarSection    &section,
                     std::vector<Element> elements,
                     const bool           head_is_tied,
                     const bool           toe_is_tied)
      : section(section)
      , all_elements(std::move(elements))
      , head_is_tied(head_is_tied)
      , toe_is_tied(toe_is_tied)
    {
      const unsigned int n      = all_elements.size();
      const double       length = all_elements.back().end;
      tie_stiffness             = of_tie * section.stiffness / length;
      if (head_is_tied)
        all_sites.push_back({0., 0., 0, shape(0.)});
      for (unsigned int e = 0; e < n; ++e)
      {
        const Element &element = all_elements[e];
        const double   h       = element.end - element.begin;
        for (unsigned int q = 0; element.is_bonded && q < 3; ++q)
          all_sites.push_back({element.begin + gauss_3[q] * h,
                               weights_3[q] * h,
                               e,
                               shape(gauss_3[q])});
      }
      if (toe_is_tied)
        all_sites.push_back({length, 0., n - 1, shape(1.)});
    }


    void
    BoltBar::assemble(const State               &state,
                      const std::vector<double> &r,
                      const std::vector<bool>   &is_absent,
                      const double               head_load,
                      const bool                 may_yield,
                      Trial                     &trial) const
    {
      const unsigned int n      = all_elements.size();
      Response          &result = trial.response;
      trial.gradient.assign(n_nodes(), 0.);
      for (auto &band : trial.matrix)
        band.assign(n_nodes(), 0.);
      trial.branches.clear();
      trial.gradient[0] += head_load;
      result.forces.assign(all_sites.size(), 0.);
      result.stiffnesses.assign(all_sites.size(), 0.);
      result.axial.assign(2 * n, 0.);
      result.next   = state;
      result.energy = 0.;
      // a bar that nothing holds stays where it is
      trial.matrix[0][0] +=
        rest_of_broken * section.stiffness / all_elements.back().end;
      const auto add = [&](const unsigned int           e,
                           const std::array<double, 3> &by_node,
                           const double                 force,
                           const double                 tangent) {
        for (unsigned int a = 0; a < 3; ++a)
        {
          trial.gradient[node(e, a)] += by_node[a] * force;
          for (unsigned int b = 0; b <= a; ++b)
            trial.matrix[a - b][node(e, a)] +=
              tangent * by_node[a] * by_node[b];
        }
      };
      for (unsigned int e = 0; e < n; ++e)
      {
        const double h = all_elements[e].end - all_elements[e].begin;
        for (unsigned int q = 0; q < 2; ++q)
        {
          std::array<double, 3> B      = slope(gauss_2[q]);
          double                strain = 0.;
          for (unsigned int a = 0; a < 3; ++a)
          {
            B[a] /= h;
            strain += B[a] * trial.v[node(e, a)];
          }
          const unsigned int here      = point(e, q);
          const bool         is_broken = state.is_broken[e] != 0;
          const double       stiffness =
            section.stiffness * (is_broken ? rest_of_broken : 1.);
          const Yielding now = yield(strain,
                                     is_broken ? 0. : state.strain[here],
                                     stiffness,
                                     may_yield ? section.yield_force : no_limit,
                                     all_elements[e].hardening);
          add(e, B, 0.5 * h * now.force, 0.5 * h * now.tangent);
          trial.branches.push_back(now.yields);
          result.energy += 0.5 * h * now.stored;
          result.axial[here]       = now.force;
          result.next.strain[here] = is_broken ? 0. : now.plastic;
        }
      }
      for (unsigned int i = 0; i < all_sites.size(); ++i)
      {
        const Site &site    = all_sites[i];
        const bool  is_tie  = site.weight == 0.;
        const bool  is_head = is_tie && site.s == 0.;
        if (is_absent[i] || (is_head && head_load != 0.))
          continue;
        double slip = -r[i];
        for (unsigned int a = 0; a < 3; ++a)
          slip += site.shape[a] * trial.v[node(site.element, a)];
        if (is_head)
          slip -= state.head_offset;
        const double   weight = is_tie ? 1. : site.weight;
        const Yielding now =
          yield(slip,
                state.slip[i],
                is_tie ? tie_stiffness : section.bond_stiffness,
                is_tie || !may_yield ? no_limit : section.bond_strength,
                hardening);
        add(site.element, site.shape, weight * now.force, weight * now.tangent);
        trial.branches.push_back(now.yields);
        result.energy += weight * now.stored;
        result.forces[i]      = -weight * now.force;
        result.stiffnesses[i] = weight * now.tangent;
        result.next.slip[i]   = now.plastic;
      }
    }


    /// Newton's method from the elastic solution. The energy is convex, so that its slope along a
    /// step ascends; where it rises at the end of the step, a zero of the slope is sought.
    BoltBar::Trial
    BoltBar::minimize(const State               &state,
                      const std::vector<double> &r,
                      const std::vector<bool>   &is_absent,
                      const double               head_load) const
    {
      constexpr unsigned int max_iterations = 200, max_searches = 40;
      constexpr double       sufficient = 0.5, small = 1e-20;
      const unsigned int     n_all = n_nodes();
      Trial                  trial;
      trial.v.assign(n_all, 0.);
      assemble(state, r, is_absent, head_load, /* may_yield = */ false, trial);
      const auto slope_along = [&](const Trial               &at,
                                   const std::vector<double> &step) {
        return std::inner_product(step.begin(),
                                  step.end(),
                                  at.gradient.begin(),
                                  0.);
      };
      for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        trial.response.factors = trial.matrix;
        factorize(trial.response.factors);
        std::vector<double> step = trial.gradient;
        solve(trial.response.factors, step.data(), 1);
        for (double &value : step)
          value = -value;
        const double descent = slope_along(trial, step);
        const double energy  = trial.response.energy;
        Trial        next;
        const auto   try_length = [&](const double length) {
          next.v = trial.v;
          for (unsigned int i = 0; i < n_all; ++i)
            next.v[i] += length * step[i];
          assemble(
            state, r, is_absent, head_load, /* may_yield = */ true, next);
          return slope_along(next, step);
        };
        double high = try_length(1.);
        if (iteration > 0 &&
            (next.branches == trial.branches || -descent <= small * energy))
        {
          // it is the minimum, since the energy is quadratic up to there
          next.response.factors       = std::move(trial.response.factors);
          next.response.has_converged = true;
          return next;
        }
        double begin = 0., end = 1., low = descent;
        for (unsigned int k = 0;
             iteration > 0 && k < max_searches && high > -sufficient * descent;
             ++k)
        {
          // the secant, unless it would end near an end of the interval
          const double length =
            std::clamp(begin + (end - begin) * low / (low - high),
                       begin + 0.1 * (end - begin),
                       begin + 0.9 * (end - begin));
          const double slope = try_length(length);
          if (std::abs(slope) <= -sufficient * descent)
            break;
          (slope < 0. ? begin : end) = length;
          (slope < 0. ? low : high)  = slope;
        }
        trial = std::move(next);
      }
      trial.response.factors = trial.matrix;
      factorize(trial.response.factors);
      return trial;
    }


    BoltBar::State
    BoltBar::initial_state(const double pretension) const
    {
      State state;
      state.slip.assign(all_sites.size(), 0.);
      state.strain.assign(2 * all_elements.size(), 0.);
      state.is_broken.assign(all_elements.size(), 0);
      if (pretension == 0. || !head_is_tied)
        return state;
      const std::vector<double> at_rest(all_sites.size(), 0.);
      const std::vector<bool>   present(all_sites.size(), false);
      const Trial drawn = minimize(state, at_rest, present, pretension);
      state             = drawn.response.next;
      state.head_offset = drawn.v[0] - pretension / tie_stiffness;
      return state;
    }


    double
    BoltBar::largest_pretension() const
    {
      if (toe_is_tied)
        return section.yield_force;
      double bond = 0.;
      for (const Site &site : all_sites)
        if (site.weight > 0.)
          bond += site.weight * section.bond_strength;
      return std::min(bond, section.yield_force);
    }


    BoltBar::Response
    BoltBar::respond(const State               &state,
                     const std::vector<double> &r,
                     const std::vector<bool>   &is_absent) const
    {
      Trial result      = minimize(state, r, is_absent, 0.);
      result.response.v = std::move(result.v);
      return std::move(result.response);
    }


    dealii::FullMatrix<double>
    BoltBar::condense(const Response                   &response,
                      const dealii::FullMatrix<double> &left,
                      const dealii::FullMatrix<double> &right) const
    {
      const unsigned int         n_nodes = response.v.size();
      dealii::FullMatrix<double> result(left.n(), right.n());
      dealii::FullMatrix<double> b_left(n_nodes, left.n()),
        b_right(n_nodes, right.n());
      const auto gather = [&](const dealii::FullMatrix<double> &rows,
                              dealii::FullMatrix<double>       &b) {
        for (unsigned int i = 0; i < all_sites.size(); ++i)
          for (unsigned int a = 0; a < 3; ++a)
          {
            const double factor =
              response.stiffnesses[i] * all_sites[i].shape[a];
            for (unsigned int c = 0; factor != 0. && c < rows.n(); ++c)
              b(node(all_sites[i].element, a), c) += factor * rows(i, c);
          }
      };
      gather(left, b_left);
      gather(right, b_right);
      for (unsigned int i = 0; i < all_sites.size(); ++i)
        for (unsigned int a = 0; a < left.n(); ++a)
          if (const double factor = response.stiffnesses[i] * left(i, a);
              factor != 0.)
            for (unsigned int b = 0; b < right.n(); ++b)
              result(a, b) += factor * right(i, b);
      solve(response.factors, &b_right(0, 0), right.n());
      for (unsigned int k = 0; k < n_nodes; ++k)
        for (unsigned int a = 0; a < left.n(); ++a)
          if (const double factor = b_left(k, a); factor != 0.)
            for (unsigned int b = 0; b < right.n(); ++b)
              result(a, b) -= factor * b_right(k, b);
      return result;
    }


    std::vector<double>
    BoltBar::axial_at_ends(const Response &response) const
    {
      const unsigned int  n = all_elements.size();
      std::vector<double> at_begin(n, 0.), at_end(n, 0.), result(n + 1, 0.);
      for (unsigned int e = 0; e < n; ++e)
        for (unsigned int q = 0; q < 2; ++q)
        {
          const auto   B     = slope(gauss_2[q]);
          const double force = 0.5 * response.axial[point(e, q)];
          at_begin[e] -= B[0] * force;
          at_end[e] += B[2] * force;
        }
      for (unsigned int i = 0; i < all_sites.size(); ++i)
        if (all_sites[i].weight > 0.)
        {
          at_begin[all_sites[i].element] +=
            all_sites[i].shape[0] * response.forces[i];
          at_end[all_sites[i].element] -=
            all_sites[i].shape[2] * response.forces[i];
        }
      for (unsigned int e = 0; e < n; ++e)
        result[e + 1] = at_end[e];
      result[0] = at_begin[0];
      return result;
    }


    double
    BoltBar::dissipated(const State    &before,
                        const Response *begin,
                        const Response &end) const
    {
      double     sum  = 0.;
      const auto mean = [&](const std::vector<double> Response::*values,
                            const unsigned int                   i) {
        return begin == nullptr
                 ? (end.*values)[i]
                 : 0.5 * ((begin->*values)[i] + (end.*values)[i]);
      };
      for (unsigned int e = 0; e < all_elements.size(); ++e)
        for (unsigned int q = 0; q < 2; ++q)
          sum += 0.5 * (all_elements[e].end - all_elements[e].begin) *
                 mean(&Response::axial, point(e, q)) *
                 (end.next.strain[point(e, q)] - before.strain[point(e, q)]);
      for (unsigned int i = 0; i < all_sites.size(); ++i)
        sum -= mean(&Response::forces, i) * (end.next.slip[i] - before.slip[i]);
      return sum;
    }


    unsigned int
    BoltBar::find_rupture(const Response &response) const
    {
      const unsigned int n      = all_elements.size();
      const double       length = all_elements.back().end,
                   gauge        = std::min(section.gauge_length, length);
      const auto strain         = [&](const unsigned int e) {
        return (response.v[node(e, 2)] - response.v[node(e, 0)]) /
               (all_elements[e].end - all_elements[e].begin);
      };
      // what lies beside a break keeps its strain without force
      const double enough =
        0.5 * std::min(section.yield_force,
                       section.rupture_strain * section.stiffness);
      unsigned int found = n;
      for (unsigned int e = 0; e < n; ++e)
      {
        const double pulled =
          0.5 * (response.axial[point(e, 0)] + response.axial[point(e, 1)]);
        if (response.next.is_broken[e] != 0 || pulled < enough)
          continue;
        const double middle =
          0.5 * (all_elements[e].begin + all_elements[e].end);
        const double begin =
          std::clamp(middle - 0.5 * gauge, 0., length - gauge);
        double elongation = 0.;
        for (unsigned int k = 0; k < n; ++k)
        {
          const double overlap = std::min(all_elements[k].end, begin + gauge) -
                                 std::max(all_elements[k].begin, begin);
          if (overlap > 0. && response.next.is_broken[k] == 0)
            elongation += overlap * strain(k);
        }
        if (elongation > section.rupture_strain * gauge &&
            (found == n || strain(e) > strain(found)))
          found = e;
      }
      return found;
    }


    bool
    BoltBar::has_slipped(const State &state, const unsigned int site) const
    {
      return all_sites[site].weight > 0. && state.slip[site] != 0.;
    }
  } // namespace internal
} // namespace NMM
