#include <nmm/geometry/physical_mesh.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <mechanics/nodal_values.h>
#include <scene/fastest_turn.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    namespace
    {
      /// Sums of n numbers for each block, over all ranks.
      class BlockSums
      {
      public:
        BlockSums(const CoverSystem &covers, const unsigned int n)
          : covers(&covers)
          , n(n)
          , sums(n * covers.manifold_mesh().physical_mesh().n_blocks(), 0.)
        {
        }

        /// Call @p add(k, block, sums of the block) for each cover k of each owned element.
        template <typename Add>
        void
        take(const Add &add)
        {
          const auto [first, end] = covers->locally_owned_elements();
          for (unsigned int e = first; e < end; ++e)
          {
            const unsigned int block = covers->manifold_mesh().block(e);
            for (const unsigned int k : covers->covers(e))
              add(k, block, &sums[n * block]);
          }
          dealii::Utilities::MPI::sum(sums, covers->communicator(), sums);
        }

        const double *
        operator[](const unsigned int block) const
        {
          return &sums[n * block];
        }

      private:
        const CoverSystem  *covers;
        unsigned int        n;
        std::vector<double> sums;
      };
    } // namespace


    FastestTurn
    find_fastest_turn(const CoverSystem              &covers,
                      const FiniteElasticity::Vector &u,
                      const FiniteElasticity::Vector &v)
    {
      std::vector<Tensor<1, 2>> displacements(covers.n_covers()),
        velocities(covers.n_covers());
      read_nodal_values(covers, u, displacements);
      read_nodal_values(covers, v, velocities);
      const auto position = [&](const unsigned int k) {
        return covers.node(k) + displacements[k];
      };

      // Means first, so that no digits are lost far from the origin.
      BlockSums sums(covers, 5);
      sums.take([&](const unsigned int k, unsigned int, double *const sum) {
        sum[0] += 1.;
        for (unsigned int c = 0; c < 2; ++c)
        {
          sum[1 + c] += position(k)[c];
          sum[3 + c] += velocities[k][c];
        }
      });
      BlockSums moments(covers, 2);
      moments.take(
        [&](const unsigned int k, const unsigned int block, double *const sum) {
          const double *const mean = sums[block];
          Tensor<1, 2>        x, w;
          for (unsigned int c = 0; c < 2; ++c)
          {
            x[c] = position(k)[c] - mean[1 + c] / mean[0];
            w[c] = velocities[k][c] - mean[3 + c] / mean[0];
          }
          sum[0] += x[0] * w[1] - x[1] * w[0];
          sum[1] += x.norm_square();
        });

      FastestTurn fastest;
      for (unsigned int b = 0;
           b < covers.manifold_mesh().physical_mesh().n_blocks();
           ++b)
      {
        const double rate = std::abs(moments[b][0] / moments[b][1]);
        if (rate > fastest.rate)
          fastest = {b, rate};
      }
      return fastest;
    }
  } // namespace internal
} // namespace NMM
