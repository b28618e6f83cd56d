#ifndef nmm_tests_support_contact_bars_measurements_h
#define nmm_tests_support_contact_bars_measurements_h

#include <ostream>
#include <string>
#include <support/contact_bars/moving_bodies.h>
#include <vector>

namespace NMM
{
  namespace ContactBars
  {
    /// One number of one scenario.
    struct Measurement
    {
      unsigned int bar = 0;
      std::string  scenario, quantity;
      double       value = 0., expected = 0.;
      /// Relative to what the bar says, see each scenario [-].
      double error = 0.;
      /// Largest |error| allowed; 0: reported only.
      double       bound   = 0.;
      double       seconds = 0.;
      unsigned int n_steps = 0;

      /// False also for an error that is no number.
      bool
      holds() const;
    };


    /// What was measured, in order; printed as it comes.
    class Measurements
    {
    public:
      explicit Measurements(std::ostream *out = nullptr);

      /// error = (value - expected) / scale; scale 0: the expected value.
      void
      add(unsigned int       bar,
          const std::string &scenario,
          const std::string &quantity,
          double             value,
          double             expected,
          double             scale,
          double             bound,
          const Run         &run);

      const std::vector<Measurement> &
      all() const;

      /// Lines of those that do not hold; empty: all hold.
      std::string
      failures() const;

      void
      write_csv(std::ostream &csv) const;

    private:
      std::ostream            *out;
      std::vector<Measurement> list;
    };
  } // namespace ContactBars
} // namespace NMM

#endif
