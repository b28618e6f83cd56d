#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <dynamics/sleeping_blocks.h>

namespace NMM
{
  namespace internal
  {
    SleepingBlocks::SleepingBlocks(const ModelLayout     &layout,
                                   const SleepParameters &parameters)
      : parameters(parameters)
      , block_of(&layout.blocks_of_unknowns)
    {
      AssertThrow(
        parameters.speed > 0. && parameters.time >= 0. &&
          parameters.acceleration > 0.,
        InputError("Blocks cannot sleep below a speed of " +
                     std::to_string(parameters.speed) + " m/s, after " +
                     std::to_string(parameters.time) + " s, and wake at " +
                     std::to_string(parameters.acceleration) + " m/s^2",
                   "the sleep of blocks",
                   "choose speed and acceleration above 0 and no "
                   "negative time"));
      AssertThrow(
        !block_of->empty(),
        InputError("Blocks can sleep only if there are several, and on "
                   "one rank",
                   "the sleep of blocks",
                   "run it on one rank, or without sleep"));
      inertia.emplace(layout);
      kinetic.assign(inertia->n_blocks(), 0.);
    }


    void
    SleepingBlocks::set_rest(const Rest &rest)
    {
      is_asleep.clear();
      for (const auto &entry : rest)
        is_asleep.push_back(entry[0] == asleep);
      if (std::find(is_asleep.begin(), is_asleep.end(), true) ==
          is_asleep.end())
        is_asleep.clear();
    }


    void
    SleepingBlocks::set_zero(Vector &vector) const
    {
      if (is_asleep.empty())
        return;
      auto x = vector.begin();
      for (unsigned int i = 0; x != vector.end(); ++x, ++i)
        if (is_asleep[(*block_of)[i]])
          *x = 0.;
    }


    bool
    SleepingBlocks::wake(const Vector &forces, const Vector &u, Rest &rest)
    {
      if (is_asleep.empty())
        return false;
      const auto &sums   = inertia->sum(forces, u);
      bool        is_any = false;
      for (unsigned int b = 0; b < inertia->n_blocks(); ++b)
      {
        const double mass = inertia->mass(b);
        if (!is_asleep[b] || mass <= 0.)
          continue;
        const auto &[center, force, moment] = sums[b];
        double acceleration =
          std::hypot(force[0] - rest[b][1], force[1] - rest[b][2]) / mass;
        if (inertia->inertia(b) > 0.)
          acceleration += std::abs(moment - rest[b][3]) /
                          std::sqrt(inertia->inertia(b) * mass);
        if (acceleration <= parameters.acceleration)
          continue;
        rest[b] = {{0., 0., 0., 0.}};
        is_any  = true;
      }
      if (is_any)
        set_rest(rest);
      return is_any;
    }


    bool
    SleepingBlocks::let_sleep(const double  step,
                              const Vector &momentum,
                              const Vector &v,
                              const Vector &forces,
                              const Vector &u,
                              Rest         &rest)
    {
      rest.resize(inertia->n_blocks(), {{0., 0., 0., 0.}});
      std::fill(kinetic.begin(), kinetic.end(), 0.);
      auto p = momentum.begin();
      auto w = v.begin();
      for (unsigned int i = 0; p != momentum.end(); ++p, ++w, ++i)
        kinetic[(*block_of)[i]] += 0.5 * *p * *w;
      std::vector<unsigned int> sleepy;
      for (unsigned int b = 0; b < inertia->n_blocks(); ++b)
      {
        if (rest[b][0] == asleep)
          continue;
        const bool is_slow =
          2. * kinetic[b] <=
          parameters.speed * parameters.speed * inertia->mass(b);
        rest[b][0] = is_slow ? rest[b][0] + step : 0.;
        if (is_slow && rest[b][0] >= parameters.time)
          sleepy.push_back(b);
      }
      if (sleepy.empty())
        return false;
      const auto &sums = inertia->sum(forces, u);
      for (const unsigned int b : sleepy)
        rest[b] = {
          {asleep, sums[b].resultant[0], sums[b].resultant[1], sums[b].moment}};
      set_rest(rest);
      return true;
    }
  } // namespace internal
} // namespace NMM
