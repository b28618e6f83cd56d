#include "element_frame.h"

#include <nmm/covers/point_location.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// One component of A d, where d is a difference of doubles in exact form, see two_sum().
      DoubleDouble
      apply_row(const std::array<double, 2>       &row,
                const std::array<DoubleDouble, 2> &d)
      {
        return d[0] * row[0] + d[1] * row[1];
      }


      /// The chord of an arc, turned by a right angle towards the bulge of the arc.
      dealii::Tensor<1, 2>
      bulge_direction(const ElementEdge &edge)
      {
        const double               sign = edge.radius > 0. ? 1. : -1.;
        const dealii::Tensor<1, 2> d    = edge.end - edge.start;
        dealii::Tensor<1, 2>       bulge;
        bulge[0] = sign * d[1];
        bulge[1] = -sign * d[0];
        return bulge;
      }


      /// Point of the arc halfway between its ends.
      dealii::Point<2>
      arc_middle(const ElementEdge &edge)
      {
        // The height of the arc over half its chord is (1 - cos phi) / sin phi = tan(phi / 2).
        return edge.start + 0.5 * (edge.end - edge.start) +
               (0.5 * std::tan(0.5 * (0.5 * std::abs(swept_angle(edge))))) *
                 bulge_direction(edge);
      }
    } // namespace


    std::array<double, 2>
    ElementFrame::real_to_scaled(const dealii::Point<2> &x) const
    {
      const std::array<DoubleDouble, 2> d = {
        {two_sum(x[0], -center[0]), two_sum(x[1], -center[1])}};
      return {{apply_row(real_to_scaled_matrix[0], d).hi,
               apply_row(real_to_scaled_matrix[1], d).hi}};
    }


    void
    ElementFrame::choose_axes(const dealii::ArrayView<const ElementEdge> &edges)
    {
      extreme_points.clear();
      for (const ElementEdge &edge : edges)
      {
        extreme_points.push_back(edge.start);
        if (edge.is_arc() && edge.start != edge.end)
          extreme_points.push_back(arc_middle(edge));
      }
      double                  largest = -1.;
      const dealii::Point<2> *first   = nullptr;
      const dealii::Point<2> *second  = nullptr;
      for (std::size_t i = 0; i < extreme_points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
        {
          const double distance =
            extreme_points[i].distance_square(extreme_points[j]);
          if (distance > largest)
          {
            largest = distance;
            first   = &extreme_points[i];
            second  = &extreme_points[j];
          }
        }
      if (largest > 0.)
      {
        axis = *second - *first;
        axis /= axis.norm();
        center = *first + 0.5 * (*second - *first);
      }
      else
        axis = dealii::Tensor<1, 2>();
    }


    std::array<std::array<double, 2>, 2>
    ElementFrame::map_edges(const dealii::ArrayView<const ElementEdge> &edges)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      std::array<std::array<double, 2>, 2> bounds = {
        {{{infinity, -infinity}}, {{infinity, -infinity}}}};
      frame_edges.clear();
      for (const ElementEdge &edge : edges)
      {
        FrameEdge mapped;
        mapped.start = real_to_scaled(edge.start);
        mapped.end   = real_to_scaled(edge.end);
        for (unsigned int d = 0; d < 2; ++d)
        {
          mapped.middle[d] = 0.5 * (mapped.start[d] + mapped.end[d]);
          bounds[d][0]     = std::min(bounds[d][0], mapped.start[d]);
          bounds[d][1]     = std::max(bounds[d][1], mapped.start[d]);
        }
        mapped.is_arc = edge.is_arc() && edge.start != edge.end;
        if (mapped.is_arc)
        {
          const double               phi  = (0.5 * std::abs(swept_angle(edge)));
          const double               sine = std::sin(phi);
          const double               half = std::sin(0.5 * phi);
          const double               tangent          = std::tan(0.5 * phi);
          const dealii::Tensor<1, 2> bulge            = bulge_direction(edge);
          const std::array<DoubleDouble, 2> direction = {
            {DoubleDouble{bulge[0], 0.}, DoubleDouble{bulge[1], 0.}}};
          mapped.half_angle        = phi;
          mapped.half_sine_squared = half * half;
          for (unsigned int d = 0; d < 2; ++d)
          {
            mapped.sine_axis[d] =
              0.5 * (mapped.end[d] - mapped.start[d]) / sine;
            mapped.cosine_axis[d] =
              0.5 * apply_row(real_to_scaled_matrix[d], direction).hi / sine;
            // ds_d/dtau vanishes where tan tau = U_d / V_d.
            const double u = mapped.sine_axis[d];
            const double v = mapped.cosine_axis[d];
            const double t = v == 0. ? 2. : std::tan(0.5 * std::atan(u / v));
            if (std::abs(t) < tangent)
            {
              const double s = mapped.arc_coordinate(d, t);
              bounds[d][0]   = std::min(bounds[d][0], s);
              bounds[d][1]   = std::max(bounds[d][1], s);
            }
          }
        }
        frame_edges.push_back(mapped);
      }
      return bounds;
    }


    void
    ElementFrame::set_cell(const CellFrame &cell)
    {
      const dealii::Tensor<2, 2>       &J      = cell.jacobian;
      const std::array<DoubleDouble, 2> offset = {
        {two_sum(cell.origin[0], -center[0]),
         two_sum(cell.origin[1], -center[1])}};
      for (unsigned int i = 0; i < 2; ++i)
      {
        for (unsigned int j = 0; j < 2; ++j)
          to_scaled[i][j] = two_product(real_to_scaled_matrix[i][0], J[0][j]) +
                            two_product(real_to_scaled_matrix[i][1], J[1][j]);
        scaled_offset[i] = apply_row(real_to_scaled_matrix[i], offset);
      }

      // The cell may be needle-shaped, so the determinant of J is computed with all digits.
      const double det_J =
        (two_product(J[0][0], J[1][1]) + (-two_product(J[0][1], J[1][0]))).hi;
      Assert(det_J != 0., dealii::ExcMessage("The cell has no area."));
      const auto  &A     = real_to_scaled_matrix;
      const double det_A = A[0][0] * A[1][1] - A[0][1] * A[1][0];
      area_ratio         = std::abs(det_A * det_J);

      const double inverse_J[2][2] = {{J[1][1] / det_J, -J[0][1] / det_J},
                                      {-J[1][0] / det_J, J[0][0] / det_J}};
      const double inverse_A[2][2] = {{A[1][1] / det_A, -A[0][1] / det_A},
                                      {-A[1][0] / det_A, A[0][0] / det_A}};
      for (unsigned int i = 0; i < 2; ++i)
      {
        for (unsigned int j = 0; j < 2; ++j)
          to_reference[i][j] = inverse_J[i][0] * inverse_A[0][j] +
                               inverse_J[i][1] * inverse_A[1][j];
        reference_offset[i] =
          -(inverse_J[i][0] * offset[0].hi + inverse_J[i][1] * offset[1].hi);
      }
    }


    void
    ElementFrame::set_resolution(
      const dealii::ArrayView<const ElementEdge> &edges,
      const CellFrame                            &cell)
    {
      // The error of the area is half a unit in the last place of every coordinate times the
      // extent in the other direction. It is taken component by component, since the area of a
      // sliver along y = 0 is known much better than that of one along y = 1.
      dealii::Point<2>     lower = edges[0].start, upper = edges[0].start;
      dealii::Tensor<1, 2> magnitude;
      for (const ElementEdge &edge : edges)
        for (unsigned int d = 0; d < 2; ++d)
        {
          lower[d]     = std::min(lower[d], edge.start[d]);
          upper[d]     = std::max(upper[d], edge.start[d]);
          magnitude[d] = std::max(magnitude[d], std::abs(edge.start[d]));
        }
      constexpr double epsilon = std::numeric_limits<double>::epsilon();
      const double     det_A =
        area_ratio / std::abs(dealii::determinant(cell.jacobian));
      const double real = epsilon * det_A *
                          ((upper[0] - lower[0]) * magnitude[1] +
                           (upper[1] - lower[1]) * magnitude[0]);
      // The same estimate is made for reference coordinates, which are of magnitude one.
      const double length =
        2. * (std::abs(to_reference[0][0]) + std::abs(to_reference[1][0]));
      resolution = 2. * std::max(real, epsilon * length * area_ratio);
    }


    bool
    ElementFrame::reinit(const dealii::ArrayView<const ElementEdge> &edges,
                         const CellFrame                            &cell)
    {
      choose_axes(edges);
      if (axis.norm_square() == 0.)
        return false;

      // Edges are mapped repeatedly: the first pass finds the middle, the second one the
      // half-extents about the rounded middle, and the third one maps by the final frame.
      real_to_scaled_matrix = {{{{axis[0], axis[1]}}, {{-axis[1], axis[0]}}}};
      auto         bounds   = map_edges(edges);
      const double m0       = 0.5 * (bounds[0][0] + bounds[0][1]);
      const double m1       = 0.5 * (bounds[1][0] + bounds[1][1]);
      center[0] += axis[0] * m0 - axis[1] * m1;
      center[1] += axis[1] * m0 + axis[0] * m1;
      bounds = map_edges(edges);
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double half =
          std::max(std::abs(bounds[d][0]), std::abs(bounds[d][1]));
        if (!(half > std::numeric_limits<double>::min()))
          return false;
        for (double &entry : real_to_scaled_matrix[d])
          entry /= half;
      }
      map_edges(edges);
      set_cell(cell);
      set_resolution(edges, cell);
      return true;
    }
  } // namespace internal
} // namespace NMM
