#include <nmm/covers/point_location.h>
#include <nmm/fracture/crack_start.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/physics/transformations.h>

#include "geometry/piece_geometry.h"
#include "mechanics/curve_conditions.h"
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace NMM
{
  namespace
  {
    using dealii::Point;
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    Tensor<1, 2>
    left_of(const Tensor<1, 2> &direction)
    {
      return Tensor<1, 2>({-direction[1], direction[0]});
    }


    Tensor<1, 2>
    turned(const Tensor<1, 2> &direction, const double angle)
    {
      return dealii::Physics::Transformations::Rotations::rotation_matrix_2d(
               angle) *
             direction;
    }


    /// The point of an edge at @p t in [0, 1], and the unit normal there that points into the
    /// element.
    std::pair<Point<2>, Tensor<1, 2>>
    point_and_normal(const ElementEdge &edge, const double t)
    {
      if (!edge.is_arc())
      {
        const Tensor<1, 2> along = edge.end - edge.start;
        return {edge.start + t * along, left_of(along / along.norm())};
      }
      const double angle =
        angle_about(edge.center, edge.start) + t * swept_angle(edge);
      const Tensor<1, 2> out({std::cos(angle), std::sin(angle)});
      return {edge.center + std::abs(edge.radius) * out,
              edge.radius > 0. ? -1. * out : out};
    }


    /// The largest value of @p f in [first, last] and where it is.
    template <typename Function>
    std::pair<double, double>
    find_largest(const Function &f, const double first, const double last)
    {
      constexpr int  n_bits = 12;
      std::uintmax_t n_most = 20;
      const auto [x, value] = boost::math::tools::brent_find_minima(
        [&](const double x) { return -f(x); }, first, last, n_bits, n_most);
      return {x, -value};
    }


    /// An edge on a boundary, and the point of it at which the mean stress is largest.
    struct Candidate
    {
      unsigned int element;
      ElementEdge  edge;
      double       t;
      Point<2>     point;
      double       drive;
    };


    /// Leaves the first of all places that are nearer to each other than @p spacing; the largest
    /// drive comes first.
    template <typename Place>
    void
    thin_out(std::vector<Place> &places, const double spacing)
    {
      std::stable_sort(places.begin(),
                       places.end(),
                       [](const Place &a, const Place &b) {
                         return a.drive > b.drive;
                       });
      std::vector<Place> kept;
      for (const Place &place : places)
        if (std::none_of(kept.begin(), kept.end(), [&](const Place &other) {
              return other.point.distance(place.point) < spacing;
            }))
          kept.push_back(place);
      places = std::move(kept);
    }


    /// The search of find_crack_starts().
    class StartSearch
    {
    public:
      StartSearch(const CoverSystem       &covers,
                  const ElasticityProblem &problem,
                  const ElementStress     &stress)
        : mesh(covers.manifold_mesh())
        , solid(mesh.physical_mesh())
        , problem(problem)
        , stress(stress)
        , region_to_material(problem.region_to_material(solid))
        , few_points(3)
        , many_points(dealii::QGauss<1>(3), 5)
      {
        for (unsigned int piece = 0; piece < solid.pieces().size(); ++piece)
        {
          const Curve &curve = solid.curves()[solid.piece_to_curve()[piece]];
          if (curve.role != CurveRole::interface && !curve.is_auxiliary)
            walls.push_back(solid.pieces()[piece]);
        }
      }


      /// The best point of each edge at which a crack may start.
      std::vector<Candidate>
      candidates() const
      {
        const internal::CurveConditions conditions(mesh, problem);
        std::vector<Candidate>          found;
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        {
          if (mesh.n_edges(e) == 0 || material(e).fracture_strength <= 0.)
            continue;
          for (const ElementEdge &edge : mesh.edges(e))
          {
            // Edges of slivers may have no length.
            if (edge.curve_set == invalid_index ||
                edge.neighbor != invalid_index || edge.start == edge.end ||
                conditions.has_displacement(e, edge))
              continue;
            Candidate best{e, edge, 0., {}, 0.};
            for (const double t : {0., 0.5, 1.})
            {
              const double drive = drive_along_normal(e, edge, t);
              if (drive > best.drive)
              {
                best.t     = t;
                best.drive = drive;
              }
            }
            best.point = point_and_normal(edge, best.t).first;
            if (best.drive > 0.)
              found.push_back(std::move(best));
          }
        }
        return found;
      }


      /// Moves a candidate along its edge to where the mean stress is largest.
      void
      move(Candidate &candidate) const
      {
        const auto [t, drive] = find_largest(
          [&](const double t) {
            return drive_along_normal(candidate.element, candidate.edge, t);
          },
          0.,
          1.);
        if (drive <= candidate.drive)
          return;
        candidate.t     = t;
        candidate.drive = drive;
        candidate.point = point_and_normal(candidate.edge, t).first;
      }


      /// The direction at a candidate for which the mean stress is largest.
      std::optional<CrackStart>
      turn(const Candidate &candidate) const
      {
        std::optional<CrackStart> start = turn_at(candidate, candidate.t);
        // The normal does not show how large the stress is in a corner.
        constexpr double near_end = 0.1;
        for (const double end : {0., 1.})
          if (std::abs(candidate.t - end) < near_end)
          {
            const std::optional<CrackStart> other = turn_at(candidate, end);
            if (other && (!start || other->drive > start->drive))
              start = other;
          }
        return start;
      }

    private:
      const ManifoldMesh       &mesh;
      const PhysicalMesh       &solid;
      const ElasticityProblem  &problem;
      const ElementStress      &stress;
      std::vector<unsigned int> region_to_material;
      dealii::QGauss<1>         few_points;
      dealii::QIterated<1>      many_points;
      /// What the line of a crack must not meet.
      std::vector<CurvePiece> walls;


      std::optional<CrackStart>
      turn_at(const Candidate &candidate, const double t) const
      {
        const unsigned int e       = candidate.element;
        const auto [point, normal] = point_and_normal(candidate.edge, t);
        const auto across = [&, x = point, n = normal](const double angle) {
          return stress_across(e, x, turned(n, angle));
        };
        constexpr unsigned int n_directions = 18;
        constexpr double       step = dealii::numbers::PI / n_directions;
        double best_angle = 0., best = -std::numeric_limits<double>::max();
        for (unsigned int k = 0; k < n_directions; ++k)
        {
          const double angle = (k + 0.5) * step - dealii::numbers::PI_2;
          const double value = across(angle);
          if (value > best)
          {
            best       = value;
            best_angle = angle;
          }
        }
        const auto [angle, value] =
          find_largest(across, best_angle - step, best_angle + step);
        if (value <= 0.)
          return std::nullopt;
        CrackStart start;
        start.point       = point;
        start.direction   = turned(normal, angle);
        start.region      = mesh.region(e);
        start.mean_stress = value;
        start.drive       = value / material(e).fracture_strength;
        return start;
      }


      const Material &
      material(const unsigned int element) const
      {
        return problem.materials[region_to_material[mesh.region(element)]];
      }


      /// Mean stress along a line of the averaging length from @p x, a point of the boundary of
      /// @p element [Pa]; none if the line leaves the element's block. The rule is for the square
      /// root of the distance, in which the stress of a crack or corner is nearly smooth.
      std::optional<SymmetricTensor<2, 2>>
      mean_stress(const unsigned int           element,
                  const Point<2>              &x,
                  const Tensor<1, 2>          &direction,
                  const dealii::Quadrature<1> &rule) const
      {
        const double          length = averaging_length(material(element));
        SymmetricTensor<2, 2> mean;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double       root = rule.point(q)[0];
          const Point<2>     y    = x + root * root * length * direction;
          const unsigned int e    = mesh.find_element(y);
          if (e == invalid_index || mesh.block(e) != mesh.block(element))
            return std::nullopt;
          mean +=
            2. * root * rule.weight(q) *
            stress(e,
                   mesh.mathematical_mesh().real_to_reference(mesh.cell(e), y));
        }
        return mean;
      }


      double
      drive_along_normal(const unsigned int element,
                         const ElementEdge &edge,
                         const double       t) const
      {
        const auto [x, normal] = point_and_normal(edge, t);
        const auto mean        = mean_stress(element, x, normal, few_points);
        return mean ? dealii::eigenvalues(*mean)[0] /
                        material(element).fracture_strength
                    : 0.;
      }


      /// Mean of the stress across a line [Pa]; very negative for a line that is no way for a crack.
      double
      stress_across(const unsigned int  element,
                    const Point<2>     &x,
                    const Tensor<1, 2> &direction) const
      {
        constexpr double none   = -std::numeric_limits<double>::max();
        const double     length = averaging_length(material(element));
        const CurvePiece line =
          CurvePiece::segment(x + 1e-6 * length * direction,
                              x + length * direction);
        // A crack beside the boundary that it starts from would only peel a strip off. At the end
        // of the line it is as far from there as a line at 12 degrees to it.
        constexpr double near = 0.1, least_distance = 0.2;
        const auto distance = [](const CurvePiece &wall, const Point<2> &p) {
          return internal::nearest_point(wall, p).distance(p);
        };
        for (const CurvePiece &wall : walls)
          if (!internal::crossings(line, wall).empty() ||
              (distance(wall, x) < near * length &&
               distance(wall, line.end) < least_distance * length))
            return none;
        const auto mean      = mean_stress(element, x, direction, many_points);
        const Tensor<1, 2> n = left_of(direction);
        return mean ? n * (*mean * n) : none;
      }
    };
  } // namespace


  double
  averaging_length(const Material &material)
  {
    const double ratio = material.toughness / material.fracture_strength;
    return 2. / dealii::numbers::PI * ratio * ratio;
  }


  std::vector<CrackStart>
  find_crack_starts(const CoverSystem                   &covers,
                    const ElasticityProblem             &problem,
                    const ElementStress                 &stress,
                    const double                         spacing,
                    const std::vector<dealii::Point<2>> &taken)
  {
    // The first estimate may be this much too low beside the largest one.
    constexpr double       most_underestimate = 0.6, least_drive = 0.8;
    const StartSearch      search(covers, problem, stress);
    std::vector<Candidate> candidates = search.candidates();
    candidates.erase(std::remove_if(candidates.begin(),
                                    candidates.end(),
                                    [&](const Candidate &candidate) {
                                      return std::any_of(
                                        taken.begin(),
                                        taken.end(),
                                        [&](const dealii::Point<2> &x) {
                                          return x.distance(candidate.point) <
                                                 spacing;
                                        });
                                    }),
                     candidates.end());
    double largest = 0.;
    for (const Candidate &candidate : candidates)
      largest = std::max(largest, candidate.drive);
    candidates.erase(std::remove_if(candidates.begin(),
                                    candidates.end(),
                                    [&](const Candidate &candidate) {
                                      return candidate.drive <
                                             most_underestimate * largest;
                                    }),
                     candidates.end());
    for (Candidate &candidate : candidates)
      search.move(candidate);
    thin_out(candidates, spacing);
    std::vector<CrackStart> starts;
    for (const Candidate &candidate : candidates)
      if (const auto start = search.turn(candidate))
        starts.push_back(*start);
    thin_out(starts, spacing);
    const double least =
      starts.empty() ? 0. : least_drive * starts.front().drive;
    starts.erase(std::remove_if(starts.begin(),
                                starts.end(),
                                [&](const CrackStart &start) {
                                  return start.drive < least;
                                }),
                 starts.end());
    return starts;
  }
} // namespace NMM
