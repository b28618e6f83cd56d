#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <dynamics/sleeping_blocks.h>

namespace NMM
{
  namespace internal
  {
    SleepingBlocks::SleepingBlocks(const MechanicalModel &model,
                                   const SleepParameters &parameters)
      : model(&model)
      , parameters(parameters)
      , block_of(&model.blocks_of_unknowns())
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
      const unsigned int n =
        *std::max_element(block_of->begin(), block_of->end()) + 1;
      mass.assign(n, 0.);
      inertia.assign(n, 0.);
      kinetic.assign(n, 0.);

      // masses and moments of inertia of the blocks in their reference positions
      Vector ones(model.locally_owned(), model.communicator());
      Vector positions(ones), moved(ones);
      for (const auto i : ones.locally_owned_elements())
        if (!model.constraints().is_constrained(i))
          ones(i) = 1.;
      ones.compress(dealii::VectorOperation::insert);
      nodal_mass.reinit(ones);
      model.mass().vmult(nodal_mass, ones);
      positions = model.reference_positions();
      positions.scale(ones);
      model.mass().vmult(moved, positions);
      std::vector<double> first(2 * n, 0.);
      auto                m = nodal_mass.begin();
      auto                x = positions.begin();
      auto                w = moved.begin();
      for (unsigned int i = 0; m != nodal_mass.end(); ++m, ++x, ++w, ++i)
      {
        const unsigned int b = (*block_of)[i];
        mass[b] += 0.5 * *m;
        first[2 * b + i % 2] += *w;
        inertia[b] += *x * *w;
      }
      for (unsigned int b = 0; b < n; ++b)
        if (mass[b] > 0.)
          inertia[b] -= (first[2 * b] * first[2 * b] +
                         first[2 * b + 1] * first[2 * b + 1]) /
                        mass[b];
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


    void
    SleepingBlocks::sum_forces(const Vector &forces, const Vector &u)
    {
      const unsigned int  n = mass.size();
      std::vector<double> centers(2 * n, 0.);
      sums.assign(3 * n, 0.);
      const auto for_each = [&](const auto &action) {
        auto         m = nodal_mass.begin();
        auto         x = model->reference_positions().begin();
        auto         d = u.begin();
        auto         r = forces.begin();
        unsigned int i = 0;
        for (; r != forces.end(); m += 2, x += 2, d += 2, r += 2, i += 2)
        {
          const double place[2] = {*x + *d, *(x + 1) + *(d + 1)};
          action((*block_of)[i], place, m, r);
        }
      };
      for_each([&](const unsigned int b, const double *place, auto m, auto) {
        for (unsigned int c = 0; c < 2; ++c)
          centers[2 * b + c] +=
            mass[b] > 0. ? *(m + c) * place[c] / mass[b] : 0.;
      });
      for_each([&](const unsigned int b, const double *place, auto, auto r) {
        sums[3 * b] += *r;
        sums[3 * b + 1] += *(r + 1);
        sums[3 * b + 2] += (place[0] - centers[2 * b]) * *(r + 1) -
                           (place[1] - centers[2 * b + 1]) * *r;
      });
    }


    bool
    SleepingBlocks::wake(const Vector &forces, const Vector &u, Rest &rest)
    {
      if (is_asleep.empty())
        return false;
      sum_forces(forces, u);
      bool is_any = false;
      for (unsigned int b = 0; b < mass.size(); ++b)
      {
        if (!is_asleep[b] || mass[b] <= 0.)
          continue;
        double acceleration =
          std::hypot(sums[3 * b] - rest[b][1], sums[3 * b + 1] - rest[b][2]) /
          mass[b];
        if (inertia[b] > 0.)
          acceleration += std::abs(sums[3 * b + 2] - rest[b][3]) /
                          std::sqrt(inertia[b] * mass[b]);
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
      rest.resize(mass.size(), {{0., 0., 0., 0.}});
      std::fill(kinetic.begin(), kinetic.end(), 0.);
      auto p = momentum.begin();
      auto w = v.begin();
      for (unsigned int i = 0; p != momentum.end(); ++p, ++w, ++i)
        kinetic[(*block_of)[i]] += 0.5 * *p * *w;
      std::vector<unsigned int> sleepy;
      for (unsigned int b = 0; b < mass.size(); ++b)
      {
        if (rest[b][0] == asleep)
          continue;
        const bool is_slow =
          2. * kinetic[b] <= parameters.speed * parameters.speed * mass[b];
        rest[b][0] = is_slow ? rest[b][0] + step : 0.;
        if (is_slow && rest[b][0] >= parameters.time)
          sleepy.push_back(b);
      }
      if (sleepy.empty())
        return false;
      sum_forces(forces, u);
      for (const unsigned int b : sleepy)
        rest[b] = {{asleep, sums[3 * b], sums[3 * b + 1], sums[3 * b + 2]}};
      set_rest(rest);
      return true;
    }
  } // namespace internal
} // namespace NMM
