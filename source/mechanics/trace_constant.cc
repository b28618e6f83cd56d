#include <nmm/quadrature/element_rule_builder.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mechanics/trace_constant.h>

namespace NMM
{
  namespace internal
  {
    TraceConstants::TraceConstants(
      const CoverSystem                       &covers,
      const QuadratureCollection              &quadrature,
      const dealii::AffineConstraints<double> &constraints,
      const CurveConditions                   &conditions,
      const GhostPenalty                      *ghost_penalty)
      : covers(&covers)
      , quadrature(&quadrature)
      , constraints(&constraints)
      , conditions(&conditions)
      , ghost_penalty(ghost_penalty)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , known(covers.manifold_mesh().n_elements(), -1.)
    {
    }


    TraceConstants::Moments
    TraceConstants::moments(const unsigned int element) const
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      cell              = mesh.cell(element);

      std::vector<dealii::Point<2>> points;
      std::vector<double>           weights;
      if (mesh.is_whole(element))
      {
        // the rule with the midpoints of the edges is exact for quadratic polynomials
        const auto &v = mathematical_mesh.cell_vertices(cell);
        for (unsigned int i = 0; i < 3; ++i)
        {
          points.emplace_back(0.5 *
                              (mathematical_mesh.vertices()[v[i]] +
                               mathematical_mesh.vertices()[v[(i + 1) % 3]]));
          weights.push_back(mathematical_mesh.cell_area(cell) / 3.);
        }
      }
      else
      {
        const auto [first, last]          = covers->locally_owned_elements();
        const CellFrame             frame = cell_frame(mesh, element);
        const dealii::Quadrature<2> rule =
          (element >= first && element < last)
            ? quadrature->rule(element)
            : make_element_rule(mesh.edges(element), frame, 2 * (degree - 1));
        const double det = dealii::determinant(frame.jacobian);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          points.push_back(
            mathematical_mesh.reference_to_real(cell, rule.point(q)));
          weights.push_back(det * rule.weight(q));
        }
      }

      Moments              result;
      dealii::Tensor<1, 2> first_moment;
      for (unsigned int q = 0; q < points.size(); ++q)
      {
        result.area += weights[q];
        first_moment += weights[q] * (points[q] - points[0]);
      }
      if (result.area > 0.)
        result.centroid = points[0] + first_moment / result.area;
      for (unsigned int q = 0; q < points.size(); ++q)
      {
        const dealii::Tensor<1, 2> d = points[q] - result.centroid;
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = a; b < 2; ++b)
            result.second[a][b] += weights[q] * d[a] * d[b];
      }
      return result;
    }


    TraceConstants::BoundaryPoints
    TraceConstants::boundary_points(const unsigned int element) const
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      cell              = mesh.cell(element);
      const CellFrame         frame             = cell_frame(mesh, element);

      BoundaryPoints result;
      for (const ElementEdge &edge : mesh.edges(element))
        if (conditions->is_weakly_held(element, edge))
        {
          const EdgeRule rule = make_edge_rule(edge, frame, 2 * (degree - 1));
          for (unsigned int q = 0; q < rule.points.size(); ++q)
          {
            result.points.push_back(
              mathematical_mesh.reference_to_real(cell, rule.points[q]));
            result.weights.push_back(rule.weights[q]);
          }
        }
      return result;
    }


    double
    TraceConstants::constant(const Moments        &moments,
                             const BoundaryPoints &boundary) const
    {
      if (!(moments.area > 0.))
        return std::numeric_limits<double>::infinity();

      double length = 0.;
      for (const double weight : boundary.weights)
        length += weight;
      if (degree == 1)
        return length / moments.area;

      // In principal axes 1, x and y are orthogonal on the element. The smaller
      // second moment of a sliver is lost in rounding. It is therefore bounded from below
      // by half of that of a strip of the same area and length.
      Eigen::Matrix2d second;
      second << moments.second[0][0], moments.second[0][1],
        moments.second[0][1], moments.second[1][1];
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
      axes.computeDirect(second);
      const double large = axes.eigenvalues()(1);
      if (!(large > 0.))
        return std::numeric_limits<double>::infinity();
      const double extent    = std::sqrt(12. * large / moments.area);
      const double thickness = moments.area / extent;
      const double small     = std::max(axes.eigenvalues()(0),
                                    moments.area * thickness * thickness / 24.);

      Eigen::Matrix3d traces = Eigen::Matrix3d::Zero();
      for (unsigned int q = 0; q < boundary.points.size(); ++q)
      {
        const dealii::Tensor<1, 2> d = boundary.points[q] - moments.centroid;
        const Eigen::Vector2d      along =
          axes.eigenvectors().transpose() * Eigen::Vector2d(d[0], d[1]);
        const Eigen::Vector3d basis(1. / std::sqrt(moments.area),
                                    along(0) / std::sqrt(small),
                                    along(1) / std::sqrt(large));
        traces += boundary.weights[q] * basis * basis.transpose();
      }
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
               traces, Eigen::EigenvaluesOnly)
        .eigenvalues()(2);
    }


    unsigned int
    TraceConstants::find_root(const unsigned int element) const
    {
      if (ghost_penalty != nullptr)
      {
        const unsigned int root = ghost_penalty->element_to_root[element];
        return root == element ? invalid_index : root;
      }
      // all covers on which a constrained cover depends belong to the root
      std::vector<unsigned int> needed;
      for (const unsigned int k : covers->covers(element))
        if (needed.empty() && constraints->is_constrained(unknown_of(k, 0)))
          for (const auto &entry : *constraints->get_constraint_entries(2 * k))
            needed.push_back(cover_of(entry.first));
      if (needed.empty())
        return invalid_index;

      // search for the nearest element that has all of them; roots are a few elements away
      constexpr unsigned int    max_visited = 200;
      std::vector<unsigned int> visited(1, element);
      for (unsigned int i = 0; i < visited.size() && i < max_visited; ++i)
      {
        const auto candidate = covers->covers(visited[i]);
        if (visited[i] != element &&
            std::all_of(
              needed.begin(), needed.end(), [&](const unsigned int k) {
                return std::find(candidate.begin(), candidate.end(), k) !=
                       candidate.end();
              }))
          return visited[i];
        for (const ManifoldMesh::Link &link :
             covers->manifold_mesh().joined(visited[i]))
          if (std::find(visited.begin(), visited.end(), link.neighbor) ==
              visited.end())
            visited.push_back(link.neighbor);
      }
      return invalid_index;
    }


    bool
    TraceConstants::has_polynomial_of(const unsigned int element,
                                      const unsigned int root) const
    {
      const auto of_root    = covers->covers(root);
      const auto is_of_root = [&](const unsigned int k) {
        return std::find(of_root.begin(), of_root.end(), k) != of_root.end();
      };
      for (const unsigned int k : covers->covers(element))
        if (!is_of_root(k))
        {
          const unsigned int unknown = unknown_of(k, 0);
          if (!constraints->is_constrained(unknown))
            return false;
          for (const auto &entry :
               *constraints->get_constraint_entries(unknown))
            if (!is_of_root(cover_of(entry.first)))
              return false;
        }
      return true;
    }


    double
    TraceConstants::operator()(const unsigned int element)
    {
      if (known[element] < 0.)
      {
        const BoundaryPoints boundary = boundary_points(element);
        known[element]                = constant(moments(element), boundary);
        const unsigned int root       = find_root(element);
        if (root != invalid_index)
        {
          const double of_root = constant(moments(root), boundary);
          known[element] =
            std::min(known[element],
                     has_polynomial_of(element, root) ? of_root : 2. * of_root);
        }
      }
      return known[element];
    }
  } // namespace internal
} // namespace NMM
