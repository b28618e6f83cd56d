#include <algorithm>
#include <cmath>
#include <dynamics/block_inertia.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    BlockInertia::BlockInertia(const ModelLayout &layout)
      : block_of(&layout.blocks_of_unknowns)
    {
      Assert(!block_of->empty(), dealii::ExcInternalError());
      const unsigned int n =
        *std::max_element(block_of->begin(), block_of->end()) + 1;
      masses.assign(n, 0.);
      inertias.assign(n, 0.);

      Vector ones(layout.locally_owned, layout.communicator);
      Vector scaled(ones), moved(ones);
      for (const auto i : ones.locally_owned_elements())
        if (!layout.constraints->is_constrained(i))
          ones(i) = 1.;
      ones.compress(dealii::VectorOperation::insert);
      nodal_mass.reinit(ones);
      layout.mass->vmult(nodal_mass, ones);
      // Moments about the origin of the coordinates would lose the digits of its distance.
      positions                      = *layout.reference_positions;
      const auto                from = layout.reference_positions->begin();
      std::vector<unsigned int> first_unknown(n, invalid_index);
      for (unsigned int i = 0; i < block_of->size(); i += 2)
      {
        unsigned int &origin = first_unknown[(*block_of)[i]];
        if (origin == invalid_index)
          origin = i;
        for (unsigned int c = 0; c < 2; ++c)
          positions.begin()[i + c] -= from[origin + c];
      }
      scaled = positions;
      scaled.scale(ones);
      layout.mass->vmult(moved, scaled);
      std::vector<Tensor<1, 2>> first(n);
      auto                      m = nodal_mass.begin();
      auto                      x = scaled.begin();
      auto                      w = moved.begin();
      for (unsigned int i = 0; m != nodal_mass.end(); ++m, ++x, ++w, ++i)
      {
        const unsigned int b = (*block_of)[i];
        masses[b] += 0.5 * *m;
        first[b][component_of(i)] += *w;
        inertias[b] += *x * *w;
      }
      for (unsigned int b = 0; b < n; ++b)
        if (masses[b] > 0.)
          inertias[b] -= first[b].norm_square() / masses[b];
    }


    const std::vector<BlockInertia::Sum> &
    BlockInertia::sum(const Vector &r, const Vector &u)
    {
      sums.assign(n_blocks(), Sum());
      const auto X = std::as_const(positions).begin();
      const auto d = u.begin(), f = r.begin();
      const auto m        = std::as_const(nodal_mass).begin();
      const auto for_each = [&](const auto &action) {
        for (unsigned int i = 0; i < block_of->size(); i += 2)
          action(sums[(*block_of)[i]],
                 (*block_of)[i],
                 Point<2>(X[i] + d[i], X[i + 1] + d[i + 1]),
                 i);
      };
      for_each([&](Sum &sum, const unsigned int b, const Point<2> &x, auto i) {
        if (masses[b] > 0.)
          sum.center +=
            Point<2>(m[i] * x[0] / masses[b], m[i + 1] * x[1] / masses[b]);
      });
      for_each([&](Sum &sum, unsigned int, const Point<2> &x, auto i) {
        const Tensor<1, 2> arm = x - sum.center;
        sum.resultant += Point<2>(f[i], f[i + 1]);
        sum.moment += arm[0] * f[i + 1] - arm[1] * f[i];
      });
      return sums;
    }


    void
    BlockInertia::fly(const Vector            &momentum,
                      const Vector            &u,
                      const double             h,
                      const std::vector<bool> &is_meant,
                      Vector                  &moved)
    {
      sum(momentum, u);
      const auto X  = std::as_const(positions).begin();
      const auto d  = u.begin();
      const auto to = moved.begin();
      for (unsigned int i = 0; i < block_of->size(); i += 2)
      {
        const unsigned int b = (*block_of)[i];
        if (!is_meant[b] || masses[b] <= 0. || inertias[b] <= 0.)
          continue;
        const Sum         &sum = sums[b];
        const Tensor<1, 2> arm =
          Point<2>(X[i] + d[i], X[i + 1] + d[i + 1]) - sum.center;
        const double angle = 2. * std::atan(0.5 * h * sum.moment / inertias[b]);
        const double c = std::cos(angle) - 1., s = std::sin(angle);
        const Tensor<1, 2> way = h / masses[b] * sum.resultant;
        to[i]                  = d[i] + way[0] + c * arm[0] - s * arm[1];
        to[i + 1]              = d[i + 1] + way[1] + s * arm[0] + c * arm[1];
      }
    }
  } // namespace internal
} // namespace NMM
