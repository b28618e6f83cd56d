#ifndef nmm_tests_support_contact_bars_expect_holds_h
#define nmm_tests_support_contact_bars_expect_holds_h

#include <gtest/gtest.h>
#include <support/contact_bars/measurements.h>

namespace NMM
{
  namespace ContactBars
  {
    /// There are some, and all hold.
    inline void
    expect_holds(const Measurements &measurements)
    {
      EXPECT_FALSE(measurements.all().empty());
      EXPECT_EQ(measurements.failures(), "");
    }
  } // namespace ContactBars
} // namespace NMM

#endif
