// A block that slides down an incline, as in nmm-contact-bars.

#include "measure.h"
#include <support/contact_bars/contact_bars.h>

namespace NMM
{
  namespace Bench
  {
    void
    measure_incline(Recorder &recorder)
    {
      std::vector<double> steps = {0.04};
      if (recorder.size() != Size::smallest)
        steps.insert(steps.end(), {0.02, 0.01});
      if (recorder.size() == Size::full)
        steps.push_back(0.005);
      for (const double step : steps)
        recorder.record([&]() {
          ContactBars::Incline incline = ContactBars::damped_incline();
          incline.friction_angle       = 25.;
          incline.step                 = step;
          incline.distance = recorder.size() == Size::smallest ? 0.1 : 2.;
          ContactBars::Measurements measurements;
          Stopwatch                 watch;
          slide_down_incline(incline, measurements);
          watch.lap();
          const ContactBars::Measurement &way = measurements.all().front();
          Row                             row;
          row.name              = "incline";
          row.method            = "manifold uniform";
          row.kinematics        = "small";
          row.enforcement       = "penalty";
          row.stabilization     = "aggregation";
          row.solver            = "MUMPS";
          row.degree            = 2;
          row.steps             = way.n_steps;
          row.total             = watch.total();
          row.error             = std::abs(way.error);
          row.error_kind        = "distance";
          row.second_error      = std::abs(measurements.all().back().error);
          row.second_error_kind = "energy balance";
          return row;
        });
    }
  } // namespace Bench
} // namespace NMM
