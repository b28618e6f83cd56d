#ifndef nmm_source_output_picture_scale_h
#define nmm_source_output_picture_scale_h

#include <string>

namespace NMM
{
  namespace internal
  {
    /// The text of a number with @p n_digits digits.
    std::string
    number_text(double value, unsigned int n_digits = 4);
  } // namespace internal
} // namespace NMM

#endif
