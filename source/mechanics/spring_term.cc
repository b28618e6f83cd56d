#include <nmm/base/exceptions.h>
#include <nmm/mechanics/spring_term.h>

#include <algorithm>
#include <base/hash.h>
#include <cmath>

namespace NMM
{
  using dealii::Tensor;

  namespace
  {
    /// A force on a vector d [N/m] and its derivative with respect to d [Pa].
    struct Response
    {
      Tensor<1, 2> force;
      Tensor<2, 2> stiffness;
    };


    double
    energy(const Spring &spring, const Tensor<1, 2> &d)
    {
      const double elongation = d.norm() - *spring.natural_length;
      return 0.5 * spring.stiffness * elongation * elongation;
    }


    /// The conserving force from @p d_0 to @p d_1 and its derivative with respect to their mean; with
    /// equal arguments, those at one time.
    Response
    respond(const Spring       &spring,
            const Tensor<1, 2> &d_0,
            const Tensor<1, 2> &d_1)
    {
      const double       k = spring.stiffness, L = *spring.natural_length;
      const double       lengths = d_0.norm() + d_1.norm();
      const double       ratio   = L > 0. ? 2. * L / lengths : 0.;
      const Tensor<1, 2> mean    = 0.5 * (d_0 + d_1);
      Response           result;
      result.force = k * (1. - ratio) * mean;
      for (unsigned int c = 0; c < 2; ++c)
        result.stiffness[c][c] = k * (1. - ratio);
      // |d_1| changes by 2 d_1 / |d_1| with the mean
      if (L > 0.)
        result.stiffness +=
          k * ratio * (2. / (lengths * d_1.norm())) * outer_product(mean, d_1);
      return result;
    }


    void
    check(const Spring &spring)
    {
      const std::string where = "spring from " + to_string(spring.start) +
                                " to " + to_string(spring.end);
      const double length = *spring.natural_length;
      AssertThrow(spring.stiffness >= 0. && std::isfinite(spring.stiffness),
                  InputError("The stiffness is " +
                               std::to_string(spring.stiffness) + " N/m^2",
                             where,
                             "choose it at least 0"));
      AssertThrow(length >= 0. && std::isfinite(length),
                  InputError("The natural length is " + std::to_string(length) +
                               " m",
                             where,
                             "choose it at least 0"));
      AssertThrow(length == 0. || spring.start.distance(spring.end) > 0.,
                  InputError("A spring between equal points has no direction",
                             where,
                             "choose other points or the natural length 0"));
    }
  } // namespace


  SpringTerm::SpringTerm(const CoverSystem  &covers,
                         const ModelLayout  &layout,
                         std::vector<Spring> springs_in,
                         const Kinematics    kinematics)
    : springs(std::move(springs_in))
    , kinematics(kinematics)
  {
    internal::Hash hash_of_springs;
    for (Spring &spring : springs)
    {
      const Tensor<1, 2> d = spring.end - spring.start;
      if (!spring.natural_length)
        spring.natural_length = d.norm();
      check(spring);
      const auto point = [&](const dealii::Point<2> &x) {
        return material_point(covers,
                              *layout.constraints,
                              x,
                              "An end of a spring");
      };
      vectors.push_back(point(spring.end) - point(spring.start));
      at_rest.push_back(d);
      for (const double value : {spring.start[0],
                                 spring.start[1],
                                 d[0],
                                 d[1],
                                 spring.stiffness,
                                 *spring.natural_length})
        hash_of_springs.add(value);
    }
    is_absent.assign(springs.size(), false);
    hash_of_springs.add(kinematics);
    hash = hash_of_springs.value();
  }


  std::vector<SpringTerm::Unknowns>
  SpringTerm::couplings() const
  {
    std::vector<Unknowns> result;
    for (const MaterialVector &vector : vectors)
      result.push_back(vector.unknowns);
    return result;
  }


  ForceProperties
  SpringTerm::properties() const
  {
    const bool is_linear = kinematics == Kinematics::small;
    return {is_linear,
            /* is_symmetric = */ true,
            /* is_symmetric_between = */ is_linear};
  }


  Deformation
  SpringTerm::assemble(const Trial &trial, AssembledForces &sum)
  {
    const std::vector<Tensor<1, 2>> end   = evaluate(vectors, *trial.end),
                                    begin = trial.is_conserving
                                              ? evaluate(vectors, *trial.begin)
                                              : end;
    for (unsigned int s = 0; s < springs.size(); ++s)
    {
      const Spring &spring = springs[s];
      if (is_absent[s])
        continue;
      if (kinematics == Kinematics::small)
      {
        const Response     linear = respond(spring, at_rest[s], at_rest[s]);
        const Tensor<1, 2> change = 0.5 * (begin[s] + end[s]) - at_rest[s],
                           more   = linear.stiffness * change;
        sum.sink->add(vectors[s], linear.force + more, linear.stiffness);
        sum.energy_of_conditions +=
          energy(spring, at_rest[s]) + (linear.force + 0.5 * more) * change;
        continue;
      }
      if (*spring.natural_length > 0. && end[s].norm() == 0.)
        return Deformation::inverted;
      const Response response = respond(spring, begin[s], end[s]);
      sum.sink->add(vectors[s], response.force, response.stiffness);
      sum.energy_of_conditions += energy(spring, end[s]);
    }
    return Deformation::admissible;
  }


  void
  SpringTerm::set_presence(const Presence &presence)
  {
    const std::vector<bool> &absent = presence.absent_blocks;
    for (unsigned int s = 0; s < springs.size(); ++s)
      is_absent[s] = std::any_of(vectors[s].blocks.begin(),
                                 vectors[s].blocks.end(),
                                 [&](const unsigned int block) {
                                   return !absent.empty() && absent[block];
                                 });
  }


  std::vector<double>
  SpringTerm::forces(const Vector &u) const
  {
    const std::vector<Tensor<1, 2>> d = evaluate(vectors, u);
    std::vector<double>             result;
    for (unsigned int s = 0; s < springs.size(); ++s)
    {
      const double length =
        kinematics == Kinematics::finite
          ? d[s].norm()
          : at_rest[s].norm() +
              (at_rest[s].norm() > 0.
                 ? at_rest[s] * (d[s] - at_rest[s]) / at_rest[s].norm()
                 : (d[s] - at_rest[s]).norm());
      result.push_back(is_absent[s] ? 0.
                                    : springs[s].stiffness *
                                        (length - *springs[s].natural_length));
    }
    return result;
  }
} // namespace NMM
