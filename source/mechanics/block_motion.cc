#include <nmm/mechanics/block_motion.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;

  double
  BlockMotion::size() const
  {
    return std::hypot(translation.norm(), rotation * radius);
  }


  std::vector<BlockMotion>
  block_motions(const DisplacementField    &before,
                const DisplacementField    &after,
                const QuadratureCollection &quadrature)
  {
    const CoverSystem      &covers            = before.cover_system();
    const ManifoldMesh     &mesh              = covers.manifold_mesh();
    const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
    const unsigned int      n_blocks          = mesh.physical_mesh().n_blocks();

    const auto for_each_point = [&](const auto &action) {
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
      {
        const ElementRule rule = quadrature.rule(e);
        const double      determinant =
          2. * mathematical_mesh.cell_area(mesh.cell(e));
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Point<2> xi = rule.point(q);
          action(mesh.block(e),
                 determinant * rule.weight(q),
                 mathematical_mesh.reference_to_real(mesh.cell(e), xi),
                 after.displacement(e, xi) - before.displacement(e, xi));
        }
      }
    };
    const auto sum = [&](std::vector<double> &values) {
      dealii::Utilities::MPI::sum(values, covers.communicator(), values);
    };

    // for each block: area, first moments, and integral of the difference d
    constexpr unsigned int n_first = 5;
    std::vector<double>    first_sums(n_first * n_blocks);
    for_each_point([&](const unsigned int  block,
                       const double        weight,
                       const Point<2>     &x,
                       const Tensor<1, 2> &d) {
      double *sums = first_sums.data() + n_first * block;
      sums[0] += weight;
      for (unsigned int c = 0; c < 2; ++c)
      {
        sums[1 + c] += weight * x[c];
        sums[3 + c] += weight * d[c];
      }
    });
    sum(first_sums);
    std::vector<BlockMotion> result(n_blocks);
    for (unsigned int b = 0; b < n_blocks; ++b)
    {
      const double *sums = first_sums.data() + n_first * b;
      BlockMotion  &one  = result[b];
      one.block          = b;
      one.area           = sums[0];
      if (one.area <= 0.)
        continue;
      one.center      = Point<2>(sums[1], sums[2]) / one.area;
      one.translation = Point<2>(sums[3], sums[4]) / one.area;
    }

    std::vector<double> second_sums(2 * n_blocks);
    for_each_point([&](const unsigned int  block,
                       const double        weight,
                       const Point<2>     &x,
                       const Tensor<1, 2> &d) {
      const Tensor<1, 2> r = x - result[block].center;
      second_sums[2 * block] += weight * r.norm_square();
      second_sums[2 * block + 1] += weight * (r[0] * d[1] - r[1] * d[0]);
    });
    sum(second_sums);
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (second_sums[2 * b] > 0.)
      {
        result[b].radius   = std::sqrt(second_sums[2 * b] / result[b].area);
        result[b].rotation = second_sums[2 * b + 1] / second_sums[2 * b];
      }
    return result;
  }
} // namespace NMM
