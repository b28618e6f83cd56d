#ifndef nmm_quadrature_element_frame_h
#define nmm_quadrature_element_frame_h

#include <nmm/quadrature/element_quadrature.h>

#include <array>
#include <base/double_double.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * An edge in the scaled coordinates s of its element, with the parameter @f$t\in[-1,1]@f$
     * from start to end. A straight edge is
     * @f$s(t)=\bar s+t\,(s_{end}-s_{start})/2@f$, where @f$\bar s@f$ is the middle
     * of the chord. An arc of half-angle @f$\varphi\le\pi/2@f$ is
     * @f[ s(\tau)=\bar s+U\sin\tau+V(\cos\tau-\cos\varphi),\qquad
     *     \tau=\varphi t. @f]
     * This form runs through both ends to the last digit, however large
     * the radius is; the form with the centre of the circle does not.
     */
    struct FrameEdge
    {
      std::array<double, 2> start, end, middle;
      /// U and V, and the half-angle [rad]; zero for straight edges.
      std::array<double, 2> sine_axis   = {{0., 0.}};
      std::array<double, 2> cosine_axis = {{0., 0.}};
      double                half_angle  = 0.;
      /// @f$\sin^2(\varphi/2)@f$.
      double half_sine_squared = 0.;
      bool   is_arc            = false;

      /// Coordinate @p d of the arc at the angle @f$\tau@f$ that is given by @p t = tan(tau/2). It
      /// uses @f$\cos\tau-\cos\varphi=2(\sin^2(\varphi/2)-\sin^2(\tau/2))@f$, which
      /// does not cancel for small angles.
      double
      arc_coordinate(const unsigned int d, const double t) const
      {
        const double inverse = 1. / (1. + t * t);
        return middle[d] + sine_axis[d] * (2. * t * inverse) +
               cosine_axis[d] * (2. * (half_sine_squared - t * t * inverse));
      }
    };


    /**
     * The scaled frame of one element, @f$s=A(x-c)@f$ with s in [-1,1]^2. The
     * first axis runs along the longest distance in the element, so that a
     * sliver of any aspect ratio looks like a well-shaped piece. A and c are doubles
     * *by definition*. Hence s of an input point and of a rounded quadrature
     * point are known to the last digit (with double-double arithmetic in between), and no
     * error of the frame itself can enter a rule.
     */
    class ElementFrame
    {
    public:
      /// Computes the frame and the mapped edges of an element. Returns false if the element has
      /// no extent in some direction.
      bool
      reinit(const dealii::ArrayView<const ElementEdge> &edges,
             const CellFrame                            &cell);

      const std::vector<FrameEdge> &
      edges() const
      {
        return frame_edges;
      }

      /// Area in scaled coordinates over area in reference coordinates of the cell [-].
      double
      reference_to_scaled_area() const
      {
        return area_ratio;
      }

      /// Areas in scaled coordinates below this are within the round-off of the input coordinates
      /// and of the coordinates in the reference cell.
      double
      area_resolution() const
      {
        return resolution;
      }

      /// Reference coordinates of the scaled point @p s, with rounding errors.
      std::array<double, 2>
      scaled_to_reference(const std::array<double, 2> &s) const
      {
        return {{reference_offset[0] +
                   (to_reference[0][0] * s[0] + to_reference[0][1] * s[1]),
                 reference_offset[1] +
                   (to_reference[1][0] * s[0] + to_reference[1][1] * s[1])}};
      }

      /// Increment of reference coordinates for an increment of s.
      std::array<double, 2>
      scaled_to_reference_increment(const std::array<double, 2> &ds) const
      {
        return {{to_reference[0][0] * ds[0] + to_reference[0][1] * ds[1],
                 to_reference[1][0] * ds[0] + to_reference[1][1] * ds[1]}};
      }

      /// Scaled coordinates of the reference point @p xi, whose coordinates are taken as exact.
      std::array<double, 2>
      reference_to_scaled(const std::array<double, 2> &xi) const
      {
        std::array<double, 2> s;
        for (unsigned int d = 0; d < 2; ++d)
        {
          const DoubleDouble a = two_product(to_scaled[d][0].hi, xi[0]);
          const DoubleDouble b = two_product(to_scaled[d][1].hi, xi[1]);
          const DoubleDouble c = two_sum(a.hi, b.hi);
          const DoubleDouble e = two_sum(c.hi, scaled_offset[d].hi);
          s[d] = e.hi + (e.lo + (c.lo + (a.lo + to_scaled[d][0].lo * xi[0]) +
                                 (b.lo + to_scaled[d][1].lo * xi[1]) +
                                 scaled_offset[d].lo));
        }
        return s;
      }

    private:
      std::array<double, 2>
      real_to_scaled(const dealii::Point<2> &x) const;

      void
      choose_axes(const dealii::ArrayView<const ElementEdge> &edges);

      void
      set_cell(const CellFrame &cell);

      /// Maps the edges into frame_edges. Returns the lower and upper bounds of each scaled
      /// coordinate, which include the extreme points of arcs.
      std::array<std::array<double, 2>, 2>
      map_edges(const dealii::ArrayView<const ElementEdge> &edges);

      void
      set_resolution(const dealii::ArrayView<const ElementEdge> &edges,
                     const CellFrame                            &cell);

      std::vector<FrameEdge>        frame_edges;
      std::vector<dealii::Point<2>> extreme_points;

      dealii::Point<2>     center;
      dealii::Tensor<1, 2> axis;
      /// The matrix A of s = A (x - c) [1/m].
      std::array<std::array<double, 2>, 2> real_to_scaled_matrix;

      /// The map from reference to scaled coordinates: A J and A (origin - c).
      std::array<std::array<DoubleDouble, 2>, 2> to_scaled;
      std::array<DoubleDouble, 2>                scaled_offset;
      /// The inverse of this map, rounded.
      std::array<std::array<double, 2>, 2> to_reference;
      std::array<double, 2>                reference_offset;

      double area_ratio = 0.;
      double resolution = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
