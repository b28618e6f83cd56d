#include <nmm/base/exceptions.h>

#include <algorithm>
#include <analysis/mechanism.h>
#include <cmath>
#include <contact/diagnostics/collapse.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      /// A point as text with three digits; components that are rounding errors of @p size are 0.
      std::string
      rounded(const Tensor<1, 2> &x, const double size)
      {
        std::ostringstream out;
        out.precision(3);
        const auto number = [&](const double value) {
          return std::abs(value) < 1e-3 * size ? 0. : value;
        };
        out << '(' << number(x[0]) << ", " << number(x[1]) << ')';
        return out.str();
      }
    } // namespace


    std::string
    describe(std::vector<BlockMotion> motions, const double sign)
    {
      std::sort(motions.begin(),
                motions.end(),
                [](const BlockMotion &a, const BlockMotion &b) {
                  return a.size() > b.size();
                });
      const BlockMotion &first  = motions.front();
      const double       extent = first.center.norm() + first.radius;

      std::ostringstream text;
      text.precision(3);
      text << "Block " << first.block << " around "
           << rounded(first.center, extent);
      const double turn = sign * first.rotation;
      // The motion counts as a translation if its centre of rotation is more than ten times the
      // radius of the block away.
      constexpr double small_turn = 0.1;
      if (std::abs(turn) * first.radius < small_turn * first.translation.norm())
        text << " slides towards "
             << rounded(sign * first.translation / first.translation.norm(),
                        1.);
      else
      {
        const Point<2> pole =
          first.center + Point<2>(-first.translation[1], first.translation[0]) /
                           first.rotation;
        text << " turns " << (turn > 0. ? "counter-" : "") << "clockwise about "
             << rounded(pole, extent);
      }
      // Other blocks count if they move by this part of the largest motion.
      constexpr double also = 0.1;
      const auto       n_more =
        std::count_if(motions.begin() + 1,
                      motions.end(),
                      [&](const BlockMotion &motion) {
                        return motion.size() > also * first.size();
                      });
      if (n_more > 0)
        text << ", and " << n_more << " more block(s) move with it";
      return text.str();
    }


    std::string
    describe_motion(const CoverSystem              &covers,
                    const ElasticityProblem        &problem,
                    const QuadratureCollection     &quadrature,
                    const FiniteElasticity::Vector &begin,
                    const FiniteElasticity::Vector &end)
    {
      const auto field_of = [&](const FiniteElasticity::Vector &u) {
        FiniteElasticity::Vector relevant(covers.locally_owned_dofs(2),
                                          covers.locally_relevant_dofs(2),
                                          covers.communicator());
        relevant = u;
        return DisplacementField(covers, problem, relevant);
      };
      return describe(block_motions(field_of(begin), field_of(end), quadrature),
                      1.);
    }


    void
    refuse_motion(const CoverSystem              &covers,
                  const ElasticityProblem        &problem,
                  const QuadratureCollection     &quadrature,
                  const FiniteElasticity::Vector &begin,
                  const FiniteElasticity::Vector &end)
    {
      throw NumericalFailure(
        "The relaxation finds no rest: " +
          describe_motion(covers, problem, quadrature, begin, end),
        "parameter 'Relaxation/Largest displacement'",
        "hold the block; or raise this parameter, if it comes to rest further "
        "away");
    }


    Mechanism
    find_mechanism(const std::vector<BlockMotion> &motions,
                   const double                    power,
                   const double                    reach)
    {
      Mechanism  result;
      const auto is_finite = [](const BlockMotion &motion) {
        return std::isfinite(motion.size());
      };
      if (!std::all_of(motions.begin(), motions.end(), is_finite))
      {
        result.description =
          "The iteration produced displacements that are not finite";
        return result;
      }
      const BlockMotion &first =
        *std::max_element(motions.begin(),
                          motions.end(),
                          [](const BlockMotion &a, const BlockMotion &b) {
                            return a.size() < b.size();
                          });
      result.does_anything_move = first.size() > std::max(reach, first.radius);
      result.description =
        result.does_anything_move
          ? describe(motions, power < 0. ? -1. : 1.)
          : "No block gives way: contact points keep changing between sticking "
            "and slipping, or between open and closed";
      return result;
    }


    Mechanism
    find_mechanism(const ContactStatics       &statics,
                   SolidTerm                  &solid,
                   Contact                    &contact,
                   const double                last,
                   const QuadratureCollection &quadrature)
    {
      using Vector = ContactStatics::Vector;
      // The power is the work of the increment of loads from the last equilibrium to the end of the
      // search.
      Vector change = solid.residual_at(statics.solution(),
                                        statics.last_attempt().load_factor);
      change.sadd(-1., 1., solid.residual_at(statics.solution(), last));
      Vector motion(change), before(change);
      motion = statics.last_iterate();
      before = statics.solution();
      motion -= before;
      const auto field_of = [&](const Vector &u) {
        return DisplacementField(solid.elasticity().cover_system(),
                                 solid.elasticity().elasticity_problem(),
                                 u);
      };
      const std::vector<BlockMotion> motions =
        block_motions(field_of(statics.solution()),
                      field_of(statics.last_iterate()),
                      quadrature);
      const Mechanism of_search =
        find_mechanism(motions, change * motion, contact.parameters().reach);
      if (of_search.does_anything_move)
        return of_search;

      // Elastic blocks give way at their corners, and collapse a little before rigid ones.
      for (const double more : {1., 1.02, 1.05, 1.1})
      {
        const std::vector<BlockMotion> collapse =
          find_collapse(solid,
                        contact,
                        statics.solution(),
                        motions,
                        more * statics.last_attempt().load_factor);
        if (collapse.empty())
          continue;
        std::ostringstream text;
        text << describe(collapse, 1.)
             << ": rigid blocks have no equilibrium under these loads";
        if (more > 1.)
          text << ", multiplied by " << more;
        return {true, text.str()};
      }
      return of_search;
    }
  } // namespace internal
} // namespace NMM
