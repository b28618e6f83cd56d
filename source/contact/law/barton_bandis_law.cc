#include <nmm/contact/law/barton_bandis_law.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace
  {
    constexpr double degree = dealii::numbers::PI / 180.;
    /// Largest total friction angle, which the formula exceeds at low pressures [degrees].
    constexpr double largest_angle = 70.;
  } // namespace


  std::vector<ContactLaw::Parameter>
  BartonBandisLaw::parameters()
  {
    constexpr auto         number = Parameter::Kind::number;
    std::vector<Parameter> list   = ContactLaw::parameters();
    list.push_back({"JRC",
                    &joint_roughness,
                    number,
                    "Barton-Bandis: joint roughness coefficient of samples, "
                    "from 0 to 20 [-].",
                    "give a number from 0 to 20"});
    list.push_back({"JCS",
                    &joint_compressive_strength,
                    number,
                    "Barton-Bandis: joint wall compressive strength of "
                    "samples [Pa].",
                    "give a positive stress"});
    list.push_back({"Residual angle",
                    &residual_angle,
                    number,
                    "Barton-Bandis: residual friction angle [degrees].",
                    "give an angle from 0 up to below 70 degrees"});
    list.push_back({"Sample length",
                    &sample_length,
                    number,
                    "Barton-Bandis: of the samples that JRC and JCS are those "
                    "of [m].",
                    "give a positive length"});
    list.push_back({"Joint length",
                    &joint_length,
                    number,
                    "Barton-Bandis: of the joint, for which JRC and JCS are "
                    "corrected [m].",
                    "give a positive length"});
    list.push_back({"Largest closure",
                    &largest_closure,
                    number,
                    "Barton-Bandis: closure that the hyperbola does not "
                    "exceed [m]; 0: a linear spring.",
                    "give a length, or 0 for a linear spring"});
    return list;
  }


  double
  BartonBandisLaw::roughness() const
  {
    return joint_roughness *
           std::pow(joint_length / sample_length, -0.02 * joint_roughness);
  }


  double
  BartonBandisLaw::compressive_strength() const
  {
    return joint_compressive_strength *
           std::pow(joint_length / sample_length, -0.03 * joint_roughness);
  }


  ContactLaw::Strength
  BartonBandisLaw::strength(const double pressure, double /*slip*/) const
  {
    const double ratio = compressive_strength() / pressure;
    double       angle = residual_angle, by_log = 0.;
    if (ratio > 1.)
    {
      by_log = roughness();
      angle += by_log * std::log10(ratio);
    }
    // This includes a pressure of 0, for which the ratio is infinite.
    if (!(angle < largest_angle))
    {
      angle  = largest_angle;
      by_log = 0.;
    }
    const double tangent = std::tan(angle * degree);
    // p d(tan)/dp = (1 + tan^2) p d(angle)/dp
    const double by_pressure = tangent - (1. + tangent * tangent) * by_log *
                                           degree / dealii::numbers::LN10;
    return {pressure * tangent / strength_divisor,
            by_pressure / strength_divisor,
            0.};
  }


  ContactLaw::Response
  BartonBandisLaw::pressure(const double d) const
  {
    if (largest_closure == 0. || d <= 0.)
      return ContactLaw::pressure(d);
    const double end  = end_of_hyperbola();
    const double at   = std::min(d, end);
    const double left = 1. - at / largest_closure;
    const double k    = normal_stiffness / (left * left);
    return {normal_stiffness * at / left + k * (d - at), k};
  }


  double
  BartonBandisLaw::energy(const double d) const
  {
    if (largest_closure == 0. || d <= 0.)
      return ContactLaw::energy(d);
    const double end   = end_of_hyperbola();
    const double at    = std::min(d, end);
    const double ratio = at / largest_closure;
    const double more  = d - at;
    // -(x + ln(1 - x)) = x^2 / 2 + x^3 / 3 + ... is used for small x to avoid cancellation.
    constexpr double small = 1e-3;
    const double     sum =
      ratio < small ? ratio * ratio *
                        (0.5 + ratio * (1. / 3. + ratio * (0.25 + 0.2 * ratio)))
                        : -(ratio + std::log1p(-ratio));
    const Response there = pressure(at);
    return normal_stiffness * largest_closure * largest_closure * sum +
           more * (there.value + 0.5 * there.derivative * more);
  }


  double
  BartonBandisLaw::penetration(const double p) const
  {
    if (largest_closure == 0. || p <= 0.)
      return ContactLaw::penetration(p);
    const Response end = pressure(end_of_hyperbola());
    if (p > end.value)
      return end_of_hyperbola() + (p - end.value) / end.derivative;
    return p / (normal_stiffness + p / largest_closure);
  }


  ContactLaw::Response
  BartonBandisLaw::mean_pressure(const double d_0, const double d_1) const
  {
    const double change = d_1 - d_0;
    const double larger = std::max(std::abs(d_0), std::abs(d_1));
    // The difference quotient loses digits if both ends are close. The mean value of the cubic
    // through both ends is used instead, whose error is of the fifth order.
    constexpr double close = 1e-3;
    const Response   p_0 = pressure(d_0), p_1 = pressure(d_1);
    if (std::abs(change) <= close * larger || change == 0.)
    {
      const Response middle = pressure(0.5 * (d_0 + d_1));
      return {(p_0.value + 4. * middle.value + p_1.value) / 6.,
              (2. * middle.derivative + p_1.derivative) / 6.};
    }
    const double mean = (energy(d_1) - energy(d_0)) / change;
    return {mean, (p_1.value - mean) / change};
  }


  void
  BartonBandisLaw::reduce_strength(const double factor)
  {
    strength_divisor *= factor;
    tensile_strength /= factor;
  }


  void
  BartonBandisLaw::check(const std::string &where) const
  {
    ContactLaw::check(where);
    check_law_value(joint_roughness >= 0. && joint_roughness <= 20.,
                    "the joint roughness coefficient",
                    joint_roughness,
                    where,
                    "give a number from 0 to 20");
    check_law_value(joint_compressive_strength > 0. &&
                      std::isfinite(joint_compressive_strength),
                    "the joint compressive strength",
                    joint_compressive_strength,
                    where,
                    "give a positive stress");
    check_law_value(residual_angle >= 0. && residual_angle < largest_angle,
                    "the residual friction angle",
                    residual_angle,
                    where,
                    "give an angle from 0 up to below 70 degrees");
    for (const double length : {sample_length, joint_length})
      check_law_value(length > 0. && std::isfinite(length),
                      "the length of a sample or joint",
                      length,
                      where,
                      "give a positive length");
    check_law_value(largest_closure >= 0. && std::isfinite(largest_closure),
                    "the largest closure",
                    largest_closure,
                    where,
                    "give a length, or 0 for a linear spring");
    check_law_value(
      dilation == 0.,
      "the tangent of the dilation angle",
      dilation,
      where,
      "leave it out: the law of Barton and Bandis has no angle of "
      "dilation here");
  }
} // namespace NMM
