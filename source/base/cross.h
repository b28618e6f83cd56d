#ifndef nmm_source_base_cross_h
#define nmm_source_base_cross_h

#include <deal.II/base/tensor.h>

namespace NMM
{
  namespace internal
  {
    /// a_0 b_1 - a_1 b_0, the signed area of the parallelogram: positive if @p b points to the left
    /// of @p a.
    inline double
    cross(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }
  } // namespace internal
} // namespace NMM

#endif
