#include <nmm/base/exceptions.h>
#include <nmm/geometry/joint_network.h>

#include <deal.II/base/tensor.h>

#include "geometry/piece_geometry.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    constexpr double max_traces = 1e6;

    /// Purpose of a random number.
    enum class Draw : std::uint32_t
    {
      line,
      trace
    };


    /**
     * Random numbers that depend on nothing but the arguments. The standard specifies engines and
     * seed sequences exactly, but not distributions, which are therefore not used.
     */
    class RandomNumbers
    {
    public:
      RandomNumbers(const unsigned int seed,
                    const Draw         purpose,
                    const std::int64_t line,
                    const std::int64_t trace)
      {
        const auto low  = [](const std::int64_t i) { return std::uint32_t(i); };
        const auto high = [](const std::int64_t i) {
          return std::uint32_t(static_cast<std::uint64_t>(i) >> 32);
        };
        std::seed_seq sequence{std::uint32_t(seed),
                               static_cast<std::uint32_t>(purpose),
                               low(line),
                               high(line),
                               low(trace),
                               high(trace)};
        engine.seed(sequence);
      }

      /// A number from [0, 1), a multiple of 2^-53.
      double
      unit()
      {
        return std::ldexp(static_cast<double>(engine() >> 11), -53);
      }

      /// A number from [-1, 1).
      double
      symmetric()
      {
        return 2. * unit() - 1.;
      }

    private:
      std::mt19937_64 engine;
    };


    struct Box
    {
      Point<2> lower{std::numeric_limits<double>::max(),
                     std::numeric_limits<double>::max()};
      Point<2> upper{std::numeric_limits<double>::lowest(),
                     std::numeric_limits<double>::lowest()};

      void
      include(const Curve &curve)
      {
        for (const CurvePiece &piece : curve.pieces)
        {
          const auto corners = internal::corners_around(piece);
          for (unsigned int c = 0; c < 2; ++c)
          {
            lower[c] = std::min(lower[c], corners[0][c]);
            upper[c] = std::max(upper[c], corners[1][c]);
          }
        }
      }

      std::array<Point<2>, 4>
      corners() const
      {
        return {{lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}}};
      }
    };


    /// Curves that bound the place to which the set is confined. @throws InputError if there are
    /// none.
    std::vector<const Curve *>
    curves_around(const JointSet &set, const Geometry &geometry)
    {
      std::vector<const Curve *> result;
      for (const Curve &region : geometry.regions())
        if (!set.within.empty() && region.name == set.within)
          result.push_back(&region);
      if (result.empty())
        for (const Curve &curve : geometry.curves())
          if (curve.role == CurveRole::boundary)
            result.push_back(&curve);
      AssertThrow(!result.empty(),
                  InputError("the geometry has no outer boundary",
                             "the joint set '" + set.name + "'",
                             "add a closed curve of role 'boundary'"));
      return result;
    }


    /// Bounding box of the place to which the set is confined, slightly enlarged.
    Box
    find_box(const JointSet &set, const Geometry &geometry)
    {
      Box box;
      for (const Curve *curve : curves_around(set, geometry))
        box.include(*curve);
      const double margin = 0.01 * box.lower.distance(box.upper);
      for (unsigned int c = 0; c < 2; ++c)
      {
        box.lower[c] -= margin;
        box.upper[c] += margin;
      }
      return box;
    }


    /// Area of the place to which the set is confined [m^2], with an error of about a hundredth:
    /// the lengths of horizontal lines inside of it, by the even-odd rule.
    double
    estimate_area(const JointSet &set, const Geometry &geometry)
    {
      constexpr unsigned int n_lines = 256;
      const auto             curves  = curves_around(set, geometry);
      const Box              box     = find_box(set, geometry);
      const double           step    = (box.upper[1] - box.lower[1]) / n_lines;
      double                 sum     = 0.;
      for (unsigned int i = 0; i < n_lines; ++i)
      {
        const double     y = box.lower[1] + (i + 0.5) * step;
        const CurvePiece line =
          CurvePiece::segment({box.lower[0], y}, {box.upper[0], y});
        std::vector<double> places;
        for (const Curve *curve : curves)
          for (const CurvePiece &piece : curve->pieces)
            for (const Point<2> &point : internal::crossings(line, piece))
              places.push_back(point[0]);
        std::sort(places.begin(), places.end());
        for (std::size_t k = 1; k < places.size(); k += 2)
          sum += places[k] - places[k - 1];
      }
      return sum * step;
    }


    /// Makes the joints of one set.
    class Generator
    {
    public:
      Generator(const JointSet &set, const Box &box);

      std::vector<Curve>
      run();

    private:
      /// Check the numbers of lines and traces, which are counted from the origin. @throws
      /// InputError if the origin is so far away that rounding affects their positions.
      void
      check_numbers(double first, double last, const std::string &what) const;
      void
      add_line(std::int64_t line);
      void
      add_trace(double begin, double end);
      Point<2>
      rounded(const Point<2> &point) const;
      /// Least and largest projection of the box onto a direction.
      std::array<double, 2>
      range(const Tensor<1, 2> &direction) const;

      const JointSet &set;
      const Box       box;
      Tensor<1, 2>    direction, normal;
      /// Coordinates are multiples of this unit [m].
      double             unit;
      std::vector<Curve> joints;
      /// Point of the current line that is nearest to the middle of the box, about which the line
      /// is turned, and direction of the line.
      Point<2>     foot;
      Tensor<1, 2> along;
    };


    Tensor<1, 2>
    unit_vector(const double degrees)
    {
      const double angle = degrees * (dealii::numbers::PI / 180.);
      return Point<2>(std::cos(angle), std::sin(angle));
    }


    Generator::Generator(const JointSet &set, const Box &box)
      : set(set)
      , box(box)
      , direction(unit_vector(set.dip))
      , normal(Point<2>(-direction[1], direction[0]))
    {
      // The unit is relative to the size of the network, wherever it lies. Far from the origin it is
      // the rounding of the coordinates.
      const double size     = box.lower.distance(box.upper);
      const double furthest = std::max(box.lower.norm(), box.upper.norm());
      unit =
        std::ldexp(1.,
                   std::max(std::ilogb(size) - 40, std::ilogb(furthest) - 52));
    }


    std::array<double, 2>
    Generator::range(const Tensor<1, 2> &along_this) const
    {
      double least = std::numeric_limits<double>::max(), largest = -least;
      for (const Point<2> &corner : box.corners())
      {
        const double s = Tensor<1, 2>(corner) * along_this;
        least          = std::min(least, s);
        largest        = std::max(largest, s);
      }
      return {{least, largest}};
    }


    Point<2>
    Generator::rounded(const Point<2> &point) const
    {
      // The unit is a power of 2, so that this is exact. Adding 0 turns -0 into 0.
      return {std::round(point[0] / unit) * unit + 0.,
              std::round(point[1] / unit) * unit + 0.};
    }


    std::vector<Curve>
    Generator::run()
    {
      // A turned line may be outside of the box at one end and inside at the other, so that more
      // lines are examined.
      const double widening =
        box.lower.distance(box.upper) *
        std::sin(std::min(90., set.dip_scatter) * dealii::numbers::PI / 180.);
      const auto [least, largest] = range(normal);
      const double first =
        std::floor((least - widening - set.offset) / set.spacing - 1.);
      const double last =
        std::ceil((largest + widening - set.offset) / set.spacing + 1.);
      const double period = set.trace_length / set.persistence;
      const double per_line =
        set.persistence < 1. ? box.lower.distance(box.upper) / period + 2. : 1.;
      std::ostringstream count;
      count << (last - first + 1.) * per_line;
      AssertThrow((last - first + 1.) * per_line <= max_traces,
                  InputError("the joint set '" + set.name + "' would have " +
                               count.str() + " traces",
                             "its spacing and trace length",
                             "choose them larger"));
      check_numbers(first, last, "lines");
      for (double line = first; line <= last; ++line)
        add_line(static_cast<std::int64_t>(line));
      return std::move(joints);
    }


    void
    Generator::check_numbers(const double       first,
                             const double       last,
                             const std::string &what) const
    {
      // With this largest number, rounding moves positions by at most 2^-12 of a spacing.
      constexpr double   largest = 1.1e12;
      std::ostringstream number;
      number << std::max(std::abs(first), std::abs(last));
      AssertThrow(std::abs(first) <= largest && std::abs(last) <= largest,
                  InputError("between the origin of the joint set '" +
                               set.name + "' and the solid are " +
                               number.str() + ' ' + what +
                               ", whose places are lost to rounding",
                             "its offset and the coordinates of the solid",
                             "give an offset below the spacing, and "
                             "coordinates from an origin nearby"));
    }


    void
    Generator::add_line(const std::int64_t line)
    {
      RandomNumbers random(set.seed, Draw::line, line, 0);
      const double  shift = 0.5 * set.spacing_scatter * random.symmetric();
      const double  turn  = set.dip_scatter * random.symmetric();
      const double  phase = random.unit();

      const double distance =
        set.offset + (static_cast<double>(line) + shift) * set.spacing;
      const Point<2> middle = box.lower + 0.5 * (box.upper - box.lower);
      foot  = Point<2>(distance * normal + (middle * direction) * direction);
      along = turn == 0. ? direction : unit_vector(set.dip + turn);

      // Parameters, from the foot, between which the line is in the box.
      double begin = std::numeric_limits<double>::lowest(), end = -begin;
      for (unsigned int c = 0; c < 2; ++c)
      {
        if (std::abs(along[c]) < 1e-12)
        {
          if (foot[c] < box.lower[c] || foot[c] > box.upper[c])
            return;
          continue;
        }
        const double a = (box.lower[c] - foot[c]) / along[c];
        const double b = (box.upper[c] - foot[c]) / along[c];
        begin          = std::max(begin, std::min(a, b));
        end            = std::min(end, std::max(a, b));
      }
      if (begin >= end)
        return;
      if (set.persistence == 1.)
      {
        add_trace(begin, end);
        return;
      }

      // Traces are numbered from the projection of the origin onto the line.
      const double origin = middle * direction;
      const double period = set.trace_length / set.persistence;
      const double first  = std::floor((begin + origin) / period - phase - 1.);
      const double last   = std::ceil((end + origin) / period - phase + 1.);
      check_numbers(first, last, "traces on a line");
      for (double trace = first; trace <= last; ++trace)
      {
        double length = set.trace_length;
        double place  = 0.5;
        if (set.trace_length_scatter > 0.)
        {
          RandomNumbers numbers(set.seed,
                                Draw::trace,
                                line,
                                static_cast<std::int64_t>(trace));
          length *= 1. + set.trace_length_scatter * numbers.symmetric();
          place = numbers.unit();
        }
        const double from =
          (trace + phase) * period - origin + place * (period - length);
        if (from < end && from + length > begin)
          add_trace(std::max(begin, from), std::min(end, from + length));
      }
    }


    void
    Generator::add_trace(const double begin, const double end)
    {
      const Point<2> from = rounded(foot + begin * along);
      const Point<2> to   = rounded(foot + end * along);
      if (from.distance(to) <= 16. * unit)
        return;
      Curve curve;
      curve.name       = set.name;
      curve.role       = CurveRole::joint;
      curve.state      = set.state;
      curve.within     = set.within;
      curve.drops_ends = set.drops_ends;
      curve.is_clipped = true;
      curve.source     = "joint set '" + set.name + "'";
      curve.pieces     = {CurvePiece::segment(from, to)};
      joints.push_back(std::move(curve));
    }
  } // namespace


  void
  JointSet::check() const
  {
    const auto check = [this](const bool         is_good,
                              const std::string &what,
                              const double       value,
                              const std::string &unit,
                              const std::string &remedy) {
      std::ostringstream text;
      text << what << " of the joint set '" << name << "' is " << value << unit;
      AssertThrow(is_good,
                  InputError(text.str(), "joint set '" + name + "'", remedy));
    };
    check(std::isfinite(dip), "the dip", dip, " degrees", "give an angle");
    check(dip_scatter >= 0. && dip_scatter <= 90.,
          "the scatter of the dip",
          dip_scatter,
          " degrees",
          "give an angle from 0 to 90 degrees");
    check(spacing > 0. && std::isfinite(spacing),
          "the spacing",
          spacing,
          " m",
          "give a positive length");
    check(spacing_scatter >= 0. && spacing_scatter < 1.,
          "the scatter of the spacing",
          spacing_scatter,
          "",
          "give a share from 0 to below 1");
    check(persistence > 0. && persistence <= 1.,
          "the persistence",
          persistence,
          "",
          "give a share above 0 and up to 1, which is through-going");
    check(std::isfinite(offset), "the offset", offset, " m", "give a length");
    if (persistence == 1.)
    {
      check(trace_length == 0. && trace_length_scatter == 0.,
            "the persistence",
            persistence,
            "",
            "remove the trace length and its scatter, which through-going "
            "joints do not have, or give a persistence below 1");
      return;
    }
    check(trace_length > 0. && std::isfinite(trace_length),
          "the trace length",
          trace_length,
          " m",
          "give the mean length of a trace, or let the persistence be 1");
    // There must be a bridge behind the longest trace.
    std::ostringstream limit;
    limit << 1. / persistence - 1.;
    check(trace_length_scatter >= 0. &&
            trace_length_scatter <= std::min(1., 1. / persistence - 1.),
          "the scatter of the trace length",
          trace_length_scatter,
          "",
          "give a share from 0 to at most 1 and at most " + limit.str() +
            ", so that traces do not meet");
  }


  double
  estimate_crossings(const std::vector<JointSet> &sets,
                     const Geometry              &geometry)
  {
    double sum = 0.;
    for (std::size_t a = 0; a < sets.size(); ++a)
    {
      sets[a].check();
      for (std::size_t b = 0; b < a; ++b)
      {
        const bool is_apart = !sets[a].within.empty() &&
                              !sets[b].within.empty() &&
                              sets[a].within != sets[b].within;
        if (is_apart)
          continue;
        const double area = std::min(estimate_area(sets[a], geometry),
                                     estimate_area(sets[b], geometry));
        const double sine = std::abs(
          std::sin((sets[a].dip - sets[b].dip) * (dealii::numbers::PI / 180.)));
        sum += area * sine * (sets[a].persistence / sets[a].spacing) *
               (sets[b].persistence / sets[b].spacing);
      }
    }
    return sum;
  }


  double
  estimate_length(const std::vector<JointSet> &sets, const Geometry &geometry)
  {
    double sum = 0.;
    for (const JointSet &set : sets)
    {
      set.check();
      sum += estimate_area(set, geometry) * set.persistence / set.spacing;
    }
    return sum;
  }


  std::vector<Curve>
  make_joints(const JointSet &set, const Geometry &geometry)
  {
    set.check();
    return Generator(set, find_box(set, geometry)).run();
  }
} // namespace NMM
