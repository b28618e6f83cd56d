#ifndef nmm_contact_surface_position_h
#define nmm_contact_surface_position_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  /**
   * A position x = origin + way: a fixed point of the reference configuration nearby, such as the end of
   * an edge, and the way from there, which includes the displacement. Differences are made as
   * @f[ x - y = (\text{origin}_x - \text{origin}_y) + (\text{way}_x - \text{way}_y). @f]
   * The first term is the same whenever it is computed, and exact for origins that are near each other
   * (Sterbenz, Floating-Point Computation, 1974). So the rounding of a difference, such as a gap, is that
   * of the lengths of edges and displacements. It does not depend on where the origin of the coordinates
   * lies: a model in a national grid at (5e5, 6.7e6) m, whose coordinates are rounded to 1e-9 m, has the
   * same gaps as the one at the origin.
   */
  struct ContactPosition
  {
    /// Fixed reference point [m].
    dealii::Point<2> origin;
    /// The position minus the reference point [m].
    dealii::Tensor<1, 2> way;

    /// The position, rounded to a coordinate [m].
    operator dealii::Point<2>() const
    {
      return origin + way;
    }

    /// A rounded coordinate [m].
    double
    operator[](const unsigned int c) const
    {
      return origin[c] + way[c];
    }

    /// Move the position by @p change [m].
    ContactPosition &
    operator+=(const dealii::Tensor<1, 2> &change)
    {
      way += change;
      return *this;
    }

    /// Distance from another position [m].
    double
    distance(const ContactPosition &other) const;

    /// Square of the distance from another position [m^2].
    double
    distance_square(const ContactPosition &other) const;
  };


  /// Way from @p from to @p to [m], see ContactPosition.
  inline dealii::Tensor<1, 2>
  operator-(const ContactPosition &to, const ContactPosition &from)
  {
    return (to.origin - from.origin) + (to.way - from.way);
  }


  /// Way from the point @p from to @p to [m].
  inline dealii::Tensor<1, 2>
  operator-(const ContactPosition &to, const dealii::Point<2> &from)
  {
    return (to.origin - from) + to.way;
  }


  inline double
  ContactPosition::distance(const ContactPosition &other) const
  {
    return (*this - other).norm();
  }


  inline double
  ContactPosition::distance_square(const ContactPosition &other) const
  {
    return (*this - other).norm_square();
  }
} // namespace NMM

#endif
