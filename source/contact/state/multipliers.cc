#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <contact/detection/points.h>
#include <contact/state/multipliers.h>

namespace NMM
{
  namespace internal
  {
    MultiplierSpace::MultiplierSpace(const ContactSurface &surface)
      : on_edges(surface.edges().size())
    {
      const auto       &edges = surface.edges();
      std::vector<bool> is_done(edges.size(), false);
      const auto        starts_anew = [&](const unsigned int e) {
        return edges[e].previous == invalid_index ||
               edges[e].at_start != ContactSurface::Corner::smooth;
      };
      // Begin with chains that start at corners and ends; closed smooth curves remain.
      for (const bool from_corners : {true, false})
        for (unsigned int first = 0; first < edges.size(); ++first)
          if (!is_done[first] && !surface.is_rigid(first) &&
              (!from_corners || starts_anew(first)))
          {
            std::vector<unsigned int> chain;
            for (unsigned int e = first; e != invalid_index && !is_done[e] &&
                                         (chain.empty() || !starts_anew(e));
                 e = edges[e].next)
            {
              is_done[e] = true;
              chain.push_back(e);
            }
            add_stretch(surface, chain);
          }
    }


    /// Divide a smooth chain of edges into stretches.
    void
    MultiplierSpace::add_stretch(const ContactSurface            &surface,
                                 const std::vector<unsigned int> &chain)
    {
      const auto               &edges = surface.edges();
      std::vector<unsigned int> ends;
      double                    length = 0.;
      for (unsigned int i = 0; i < chain.size(); ++i)
      {
        length += edges[chain[i]].length;
        if (length >= 0.75 * cell_size(edges[chain[i]]))
        {
          ends.push_back(i + 1);
          length = 0.;
        }
      }
      // The rest belongs to the last stretch.
      if (ends.empty())
        ends.push_back(chain.size());
      ends.back() = chain.size();

      unsigned int begin = 0;
      for (const unsigned int end : ends)
      {
        double total = 0.;
        for (unsigned int i = begin; i < end; ++i)
          total += edges[chain[i]].length;
        double passed = 0.;
        for (unsigned int i = begin; i < end; ++i)
        {
          OnEdge &f  = on_edges[chain[i]];
          f.first    = n_functions;
          f.second   = n_functions + 1;
          f.at_start = passed / total;
          passed += edges[chain[i]].length;
          f.at_end = passed / total;
        }
        ++n_functions;
        begin = end;
      }
      ++n_functions;
    }


    Multipliers::Multipliers(const ContactSurface &surface,
                             const double          tolerance)
      : tolerance(tolerance)
    {
      if (!are_used())
        return;
      space.emplace(surface);
      values.assign(space->size(), 0.);
      factors.assign(space->size(), 1.);
      is_stiff_enough.assign(space->size(), false);
    }


    void
    Multipliers::forget_stiffening()
    {
      std::fill(factors.begin(), factors.end(), 1.);
      forget_penetrations();
    }


    void
    Multipliers::forget_penetrations()
    {
      is_stiff_enough.assign(values.size(), false);
      last_penetrations.clear();
    }


    void
    Multipliers::restore(const std::vector<double> &history)
    {
      if (history.size() == values.size())
        values = history;
      forget_penetrations();
    }


    double
    Multipliers::update(const std::vector<Point> &points,
                        const double              stiffness,
                        const MPI_Comm            communicator)
    {
      const unsigned int n = values.size();
      // Integrals along the slaves of four products: spring pressure times function, function,
      // stiffness times function, and pressure of the initial stress times function.
      std::vector<double> sums(4 * n, 0.);
      for (const Point &point : points)
      {
        const auto  &f     = (*space)[point.slave];
        const double share = f.share(point.s);
        const auto   add   = [&](const unsigned int i, const double weight) {
          sums[i] -= point.stiffness * weight * point.gap;
          sums[n + i] += weight;
          sums[2 * n + i] += point.stiffness * weight;
          sums[3 * n + i] += point.initial * weight;
        };
        add(f.first, point.weight * (1. - share));
        add(f.second, point.weight * share);
      }
      dealii::Utilities::MPI::sum(sums, communicator, sums);

      double              change = 0.;
      std::vector<double> penetrations(n, 0.);
      for (unsigned int i = 0; i < n; ++i)
      {
        double value = 0.;
        if (sums[n + i] > 0.)
          value = std::max(-sums[3 * n + i] / sums[n + i],
                           values[i] + sums[i] / sums[n + i]);
        const double difference = std::abs(value - values[i]);
        penetrations[i] =
          difference /
          (sums[n + i] > 0. ? sums[2 * n + i] / sums[n + i] : stiffness);
        // Stiffer springs must not make the pressure less accurate.
        change    = std::max(change, factors[i] * penetrations[i]);
        values[i] = value;
      }
      if (change > tolerance)
        stiffen(penetrations);
      else
        last_penetrations.clear();
      return change;
    }


    /// Make springs stiffer where the weighted penetrations [m] of an update are not much smaller
    /// than those of the one before, see Contact.
    void
    Multipliers::stiffen(const std::vector<double> &penetrations)
    {
      // A ratio of successive penetrations above the first one is slow; springs are made so stiff
      // that it becomes the second one. The last two bound a change, and all changes, since a ratio
      // near 1 is known badly. A good ratio shows once and for all that springs are stiff enough:
      // later ones tell of faces that open and close at the rim of a contact, and stiffer springs
      // would make the pressure there rough.
      constexpr double slow = 0.25, wanted = 0.1, most = 100.,
                       most_in_all = 1e6;
      std::vector<double> last     = penetrations;
      for (unsigned int i = 0; i < last_penetrations.size(); ++i)
      {
        const double ratio = penetrations[i] / last_penetrations[i];
        if (ratio > 0. && ratio <= slow)
          is_stiff_enough[i] = true;
        if (!(penetrations[i] > tolerance) || is_stiff_enough[i] ||
            !(ratio < 1.))
          continue;
        factors[i] *= std::min(most, (1. / wanted - 1.) / (1. / ratio - 1.));
        factors[i] = std::min(factors[i], most_in_all);
        // The next ratio is that of springs of both kinds, and says nothing.
        last[i] = 0.;
      }
      last_penetrations = last;
    }
  } // namespace internal
} // namespace NMM
