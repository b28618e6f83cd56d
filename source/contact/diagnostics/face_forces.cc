#include <nmm/contact/diagnostics/face_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;
  namespace Parallel = dealii::Utilities::MPI;

  std::vector<Tensor<1, 2>>
  obstacle_forces(const ContactSurface            &surface,
                  const std::vector<ContactPoint> &points)
  {
    const unsigned int  n_obstacles = surface.obstacles().size();
    const unsigned int  first       = surface.n_bodies() - n_obstacles;
    std::vector<double> sums(2 * n_obstacles, 0.);
    const auto          add = [&](const unsigned int  edge,
                         const double        weight,
                         const Tensor<1, 2> &traction) {
      if (surface.is_rigid(edge))
        for (unsigned int c = 0; c < 2; ++c)
          sums[2 * (surface.edges()[edge].body - first) + c] +=
            weight * traction[c];
    };
    for (const ContactPoint &point : points)
      if (point.state != ContactState::open)
      {
        const Tensor<1, 2> &n = point.normal;
        const Tensor<1, 2>  traction =
          point.pressure * n - point.shear * Point<2>(-n[1], n[0]);
        // Obstacles can be slaves, too, since their corners carry contact points.
        add(point.edge, point.weight, traction);
        add(point.master, -point.weight, traction);
      }
    if (n_obstacles > 0)
      Parallel::sum(sums, surface.cover_system().communicator(), sums);
    std::vector<Tensor<1, 2>> forces(n_obstacles);
    for (unsigned int i = 0; i < n_obstacles; ++i)
      forces[i] = Point<2>(sums[2 * i], sums[2 * i + 1]);
    return forces;
  }


  double
  largest_pressure(const ContactSurface            &surface,
                   const std::vector<ContactPoint> &points)
  {
    double largest = 0.;
    for (const ContactPoint &point : points)
      if (point.state != ContactState::open && point.weight != 0.)
        largest = std::max(largest, point.pressure);
    return Parallel::max(largest, surface.cover_system().communicator());
  }
} // namespace NMM
