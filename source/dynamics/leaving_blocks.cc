#include <nmm/covers/point_location.h>
#include <nmm/dynamics/leaving_blocks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    constexpr double arc_step = dealii::numbers::PI / 18.;

    std::vector<Point<2>>
    polygon_of(const Curve &curve)
    {
      std::vector<Point<2>> polygon;
      for (const CurvePiece &piece : curve.pieces)
      {
        const double spacing = piece.kind == CurvePiece::Kind::segment
                                 ? std::numeric_limits<double>::max()
                                 : 0.1 * arc_step * piece.radius;
        for_each_sample(piece, spacing, [&](const Point<2> &x) {
          polygon.push_back(x);
        });
      }
      return polygon;
    }


    /// Whether a polygon encloses a point, by counting the edges that a ray crosses.
    bool
    encloses(const std::vector<Point<2>> &polygon, const Point<2> &x)
    {
      bool is_inside = false;
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Point<2> &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a[1] > x[1]) != (b[1] > x[1]) &&
            x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
          is_inside = !is_inside;
      }
      return is_inside;
    }
  } // namespace


  LeavingBlocks::LeavingBlocks(
    const CoverSystem                                        &covers,
    const std::vector<Curve>                                 &limits,
    const std::vector<std::pair<unsigned int, unsigned int>> &ties)
    : covers(&covers)
  {
    for (const Curve &curve : limits)
      polygons.push_back(polygon_of(curve));
    const auto [first, last] = covers.locally_owned_elements();
    for (unsigned int element = first; element < last; ++element)
      add_samples(element);

    const unsigned int n_blocks =
      covers.manifold_mesh().physical_mesh().n_blocks();
    block_to_group.resize(n_blocks);
    for (unsigned int b = 0; b < n_blocks; ++b)
      block_to_group[b] = b;
    const auto all =
      dealii::Utilities::MPI::all_gather(covers.communicator(), ties);
    // repeat until the lowest number has been passed on along all chains of ties
    for (bool is_changed = true; is_changed;)
    {
      is_changed = false;
      for (const auto &pairs : all)
        for (const auto &[a, b] : pairs)
        {
          const unsigned int group =
            std::min(block_to_group[a], block_to_group[b]);
          is_changed = is_changed || group != block_to_group[a] ||
                       group != block_to_group[b];
          block_to_group[a] = block_to_group[b] = group;
        }
    }
  }


  void
  LeavingBlocks::add_samples(const unsigned int element)
  {
    const ManifoldMesh     &mesh              = covers->manifold_mesh();
    const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
    const auto              add               = [&](const Point<2> &x) {
      samples.push_back(
        {element,
         mesh.block(element),
         x,
         mathematical_mesh.real_to_reference(mesh.cell(element), x)});
    };
    for (const ElementEdge &edge : mesh.edges(element))
    {
      if (edge.curve_set == invalid_index)
        continue;
      add(edge.start);
      if (!edge.is_arc())
      {
        add(edge.start + 0.5 * (edge.end - edge.start));
        continue;
      }
      const double sweep = swept_angle(edge);
      const double begin = angle_about(edge.center, edge.start);
      const auto   n     = static_cast<unsigned int>(
        std::max(2., std::ceil(std::abs(sweep) / arc_step)));
      for (unsigned int k = 1; k < n; ++k)
      {
        const double angle = begin + sweep * k / n;
        add(edge.center +
            std::abs(edge.radius) *
              dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
      }
    }
  }


  bool
  LeavingBlocks::is_within(const Point<2> &x) const
  {
    return std::any_of(polygons.begin(),
                       polygons.end(),
                       [&](const Polygon &polygon) {
                         return encloses(polygon, x);
                       });
  }


  std::vector<LeavingBlocks::Departure>
  LeavingBlocks::find(const DisplacementField         &field,
                      const std::vector<unsigned int> &gone) const
  {
    constexpr double   nowhere  = -std::numeric_limits<double>::max();
    const unsigned int n_blocks = block_to_group.size();
    // for each block the maxima over all its samples of: 1 if within the limits, x, -x, y, -y
    constexpr unsigned int n_entries = 5;
    std::vector<double>    extremes(n_entries * n_blocks, nowhere);
    for (const Sample &sample : samples)
    {
      const Point<2> x =
        sample.x + field.displacement(sample.element, sample.xi);
      double *entry = extremes.data() + n_entries * sample.block;
      double *group =
        extremes.data() + n_entries * block_to_group[sample.block];
      // positions that are not finite count as within the limits
      if (group[0] < 1. && (!std::isfinite(x[0] + x[1]) || is_within(x)))
        group[0] = 1.;
      for (unsigned int d = 0; d < 2; ++d)
      {
        entry[1 + 2 * d] = std::max(entry[1 + 2 * d], x[d]);
        entry[2 + 2 * d] = std::max(entry[2 + 2 * d], -x[d]);
      }
    }
    std::vector<double> all(extremes.size());
    dealii::Utilities::MPI::max(extremes, covers->communicator(), all);

    std::vector<Departure> departures;
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (all[n_entries * block_to_group[b]] < 1. &&
          std::find(gone.begin(), gone.end(), b) == gone.end())
      {
        const double *entry = all.data() + n_entries * b;
        departures.push_back(
          {b, Point<2>(-entry[2], -entry[4]), Point<2>(entry[1], entry[3])});
      }
    return departures;
  }
} // namespace NMM
