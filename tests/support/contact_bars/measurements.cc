#include <algorithm>
#include <cmath>
#include <sstream>
#include <support/contact_bars/measurements.h>

namespace NMM
{
  namespace ContactBars
  {
    namespace
    {
      void
      write(std::ostream &out, const Measurement &m, const char *separator)
      {
        out << m.bar << separator << m.scenario << separator << m.quantity
            << separator << m.value << separator << m.expected << separator
            << m.error << separator;
        if (m.bound > 0.)
          out << m.bound;
        out << separator << m.seconds << separator << m.n_steps << '\n';
      }
    } // namespace


    bool
    Measurement::holds() const
    {
      // a run that failed has no error
      return !std::isnan(error) && (bound == 0. || std::abs(error) <= bound);
    }


    Measurements::Measurements(std::ostream *out)
      : out(out)
    {
    }


    void
    Measurements::add(const unsigned int bar,
                      const std::string &scenario,
                      const std::string &quantity,
                      const double       value,
                      const double       expected,
                      const double       scale,
                      const double       bound,
                      const Run         &run)
    {
      Measurement m;
      m.bar      = bar;
      m.scenario = scenario;
      m.quantity = quantity;
      m.value    = value;
      m.expected = expected;
      m.error    = (value - expected) / (scale == 0. ? expected : scale);
      m.bound    = bound;
      m.seconds  = run.seconds;
      m.n_steps  = run.n_steps;
      if (!run.failure.empty())
        m.error = std::nan("");
      list.push_back(m);
      if (out != nullptr)
      {
        write(*out, m, "  ");
        if (!run.failure.empty())
          *out << "    " << run.failure << '\n';
        if (!m.holds())
          *out << "    MISSED\n";
        out->flush();
      }
    }


    const std::vector<Measurement> &
    Measurements::all() const
    {
      return list;
    }


    std::string
    Measurements::failures() const
    {
      std::ostringstream text;
      for (const Measurement &m : list)
        if (!m.holds())
          write(text, m, "  ");
      return text.str();
    }


    void
    Measurements::write_csv(std::ostream &csv) const
    {
      csv << "bar,case,quantity,value,expected,error,bound,seconds,steps\n";
      for (Measurement m : list)
      {
        std::replace(m.scenario.begin(), m.scenario.end(), ',', ';');
        write(csv, m, ",");
      }
    }
  } // namespace ContactBars
} // namespace NMM
