#include <nmm/base/exceptions.h>
#include <nmm/contact/surface/surface.h>

#include <algorithm>
#include <cmath>
#include <contact/detection/points.h>
#include <sstream>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace internal
  {
    double
    nearest_parameter(const ContactSurface::Edge &edge, const Point<2> &x)
    {
      if (edge.radius == 0.)
      {
        const Tensor<1, 2> d = edge.end - edge.start;
        const double       t = ((x - edge.start) * d) / d.norm_square();
        return std::min(1., std::max(0., t));
      }
      const Tensor<1, 2> d     = x - edge.center;
      const double       range = edge.last_angle - edge.first_angle;
      const double       turn  = 2. * dealii::numbers::PI;
      double             angle = std::atan2(d[1], d[0]) - edge.first_angle;
      angle -= turn * std::floor(angle / turn);
      if (range < 0.)
        angle -= turn;
      const double t = angle / range;
      if (t <= 1.)
        return std::max(0., t);
      return x.distance(edge.start) < x.distance(edge.end) ? 0. : 1.;
    }
  } // namespace internal


  ContactSurface::Nearest
  ContactSurface::nearest_of_obstacle(const unsigned int obstacle,
                                      const Point<2>    &x) const
  {
    Nearest            result;
    Tensor<1, 2>       normal;
    const Tensor<1, 2> shift = obstacle_displacements[obstacle];
    for (unsigned int e = obstacle_begins[obstacle];
         e < obstacle_begins[obstacle + 1];
         ++e)
    {
      const Edge  &edge  = all_edges[e];
      const double t     = internal::nearest_parameter(edge, x - shift);
      Place        place = reference_place(e, t);
      place.x += shift;
      const Tensor<1, 2> d    = -(place.x - x);
      const double       same = 1e-12 * (d.norm() + edge.length);
      if (d.norm() < result.distance - same)
      {
        result.distance = d.norm();
        normal          = Tensor<1, 2>();
      }
      if (d.norm() <= result.distance + same)
      {
        // At a corner, the mean of both normals determines the side.
        normal += place.normal();
        result.gap         = d * normal > 0. ? d.norm() : -d.norm();
        result.is_open_end = (t == 0. && edge.previous == invalid_index) ||
                             (t == 1. && edge.next == invalid_index);
      }
    }
    return result;
  }


  void
  ContactSurface::check_initial_overlap(const double tolerance) const
  {
    constexpr unsigned int n_samples = 4;
    for (unsigned int i = 0; i < rigid_obstacles.size(); ++i)
    {
      bool is_closed = !rigid_obstacles[i].pieces.empty();
      for (const Edge &edge : all_edges)
        if (edge.body == n_blocks + i)
          is_closed = is_closed && edge.next != invalid_index;

      std::vector<double>   deepest(n_blocks, 0.);
      std::vector<Point<2>> where(n_blocks);
      std::vector<bool>     is_in_front(n_blocks, false);
      for (unsigned int e = 0; e < all_edges.size(); ++e)
        if (!is_rigid(e))
          for (unsigned int k = 0; k < n_samples; ++k)
          {
            const Point<2>     x = reference_place(e, k / double(n_samples)).x;
            const Nearest      nearest = nearest_of_obstacle(i, x);
            const unsigned int block   = all_edges[e].body;
            if (nearest.is_open_end)
              continue;
            if (nearest.gap > tolerance)
              is_in_front[block] = true;
            if (nearest.gap < deepest[block])
            {
              deepest[block] = nearest.gap;
              where[block]   = x;
            }
          }
      // Find obstacles inside of a block.
      for (const Edge &edge : all_edges)
        if (edge.body == n_blocks + i)
        {
          const Point<2>      x    = edge.start + obstacle_displacements[i];
          const ManifoldMesh &mesh = cover_pointer->manifold_mesh();
          const unsigned int  e    = mesh.find_element(x);
          if (e == invalid_index)
            continue;
          double distance = std::numeric_limits<double>::max();
          for (unsigned int k = 0; k < all_edges.size(); ++k)
            if (all_edges[k].body == mesh.block(e))
              distance =
                std::min(distance,
                         x.distance(
                           reference_place(
                             k, internal::nearest_parameter(all_edges[k], x))
                             .x));
          if (distance > tolerance && -distance < deepest[mesh.block(e)])
          {
            deepest[mesh.block(e)]     = -distance;
            where[mesh.block(e)]       = x;
            is_in_front[mesh.block(e)] = true;
          }
        }
      for (unsigned int block = 0; block < n_blocks; ++block)
        if (deepest[block] < -tolerance && (is_closed || is_in_front[block]))
        {
          std::ostringstream text;
          text << "Block " << block << " and the obstacle '"
               << rigid_obstacles[i].name << "' overlap by " << -deepest[block]
               << " m";
          AssertThrow(
            false,
            InputError(text.str(),
                       NMM::to_string(where[block]),
                       "move one of them so that they touch at most"));
        }
    }
  }
} // namespace NMM
