#include <nmm/covers/point_location.h>
#include <nmm/quadrature/element_quadrature.h>

#include "edge_rule.h"
#include "element_frame.h"
#include "moments.h"
#include "slab_candidates.h"
#include <cmath>

namespace NMM
{
  CellFrame
  cell_frame(const ManifoldMesh &mesh, const unsigned int element)
  {
    const MathematicalMesh &cells = mesh.mathematical_mesh();
    const unsigned int      cell  = mesh.cell(element);
    return {cells.vertices()[cells.cell_vertices(cell)[0]],
            cells.jacobian(cell)};
  }


  EdgeRule
  make_edge_rule(const ElementEdge &edge,
                 const CellFrame   &frame,
                 const unsigned int degree)
  {
    EdgeRule rule;
    internal::set_edge_rule(edge, frame, degree, rule);
    return rule;
  }


  void
  internal::set_edge_rule(const ElementEdge &edge,
                          const CellFrame   &frame,
                          const unsigned int degree,
                          EdgeRule          &rule)
  {
    thread_local internal::GaussTable gauss;

    rule.points.clear();
    rule.normals.clear();
    rule.weights.clear();
    const dealii::Tensor<1, 2> chord = edge.end - edge.start;
    if (chord.norm_square() == 0.)
      return;

    const dealii::Tensor<2, 2> to_reference = dealii::invert(frame.jacobian);
    // Differences are taken first, since the cell may be far from the origin.
    const dealii::Tensor<1, 2> from_origin =
      0.5 * ((edge.start - frame.origin) + (edge.end - frame.origin));
    dealii::Tensor<1, 2> right;
    right[0] = chord[1];
    right[1] = -chord[0];

    if (!edge.is_arc())
    {
      const internal::GaussTable::Rule &line   = gauss.rule(degree / 2 + 1);
      const double                      length = chord.norm();
      for (std::size_t q = 0; q < line.points.size(); ++q)
      {
        rule.points.emplace_back(
          to_reference * (from_origin + (line.points[q] - 0.5) * chord));
        rule.normals.push_back(right / length);
        rule.weights.push_back(line.weights[q] * length);
      }
      return;
    }

    // The arc is x = middle + sin(tau)/sin(phi) chord/2
    //                       + (cos(tau) - cos(phi))/sin(phi) bulge/2.
    // The vector bulge points away from the centre. That is to the right of a counter-clockwise
    // arc, whose outward normal points away from the centre, and to the left of a clockwise one,
    // whose outward normal points to the centre.
    const double               phi    = 0.5 * std::abs(swept_angle(edge));
    const double               sine   = std::sin(phi);
    const double               sign   = edge.radius > 0. ? 1. : -1.;
    const dealii::Tensor<1, 2> bulge  = sign * right;
    const double               radius = 0.5 * chord.norm() / sine;
    const double half_sine_squared = std::sin(0.5 * phi) * std::sin(0.5 * phi);
    const internal::GaussTable::Rule &angles =
      gauss.rule(internal::n_arc_points(degree, phi));
    for (std::size_t q = 0; q < angles.points.size(); ++q)
    {
      const double tau  = phi * (2. * angles.points[q] - 1.);
      const double half = std::sin(0.5 * tau);
      rule.points.emplace_back(
        to_reference * (from_origin + (0.5 * std::sin(tau) / sine) * chord +
                        ((half_sine_squared - half * half) / sine) * bulge));
      dealii::Tensor<1, 2> radial =
        std::sin(tau) * chord + std::cos(tau) * bulge;
      rule.normals.push_back(sign * radial / radial.norm());
      rule.weights.push_back(2. * phi * radius * angles.weights[q]);
    }
  }


  dealii::NonMatching::ImmersedSurfaceQuadrature<2>
  make_surface_rule(const ElementEdge &edge,
                    const CellFrame   &frame,
                    const unsigned int degree)
  {
    const EdgeRule      rule = make_edge_rule(edge, frame, degree);
    std::vector<double> weights;
    std::vector<dealii::Tensor<1, 2>> normals;
    const double det = std::abs(dealii::determinant(frame.jacobian));
    // Nanson's formula n dS = |det J| J^{-T} n_ref dS_ref is solved for n_ref dS_ref.
    for (std::size_t q = 0; q < rule.points.size(); ++q)
    {
      const dealii::Tensor<1, 2> surface =
        (rule.weights[q] / det) *
        (dealii::transpose(frame.jacobian) * rule.normals[q]);
      weights.push_back(surface.norm());
      normals.push_back(surface / surface.norm());
    }
    return {rule.points, weights, normals};
  }
} // namespace NMM
