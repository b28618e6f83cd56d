#include <nmm/base/archive.h>
#include <nmm/output/csv_series.h>

#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <scene/crack_growth.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Tensor;

    const GrowthCriterion &
    growth_criterion(const FractureParameters &parameters)
    {
      for (const auto &named : growth_criteria())
        if (named.name == parameters.criterion)
          return *named.law;
      Assert(false, dealii::ExcInternalError());
      return *growth_criteria().front().law;
    }


    void
    check_increments(const std::vector<Increment> &increments)
    {
      for (const Increment &increment : increments)
      {
        const CrackAdvance &advance = increment.advance;
        require_in_checkpoint(are_finite(
                                std::vector<double>{advance.tip[0],
                                                    advance.tip[1],
                                                    advance.length,
                                                    increment.end[0],
                                                    increment.end[1],
                                                    increment.angle}) &&
                                advance.length > 0. &&
                                std::abs(advance.direction.norm() - 1.) < 1e-6,
                              "an increment of a crack has no length or "
                              "direction");
      }
    }


    std::vector<GrowingTip>
    judge_tips(const CrackTips          &tips,
               const FractureParameters &parameters,
               const ElasticityProblem  &problem,
               const PhysicalMesh       &physical_mesh)
    {
      const GrowthCriterion          &criterion = growth_criterion(parameters);
      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(physical_mesh);
      std::vector<GrowingTip> result;
      for (unsigned int i = 0; i < tips.all_tips().size(); ++i)
      {
        // A crack ends at the first curve that it meets.
        if (tips.all_tips()[i].tied_curve != invalid_index)
          continue;
        GrowingTip candidate;
        candidate.tip     = tips.all_tips()[i];
        candidate.factors = tips.all_factors()[i];
        candidate.verdict =
          criterion.judge(candidate.factors.K_I, candidate.factors.K_II);
        candidate.drive =
          candidate.verdict.equivalent_intensity /
          problem.materials[region_to_material[candidate.tip.region]].toughness;
        candidate.angle = candidate.verdict.angle;
        result.push_back(std::move(candidate));
      }
      return result;
    }


    void
    add_new_tips(std::vector<GrowingTip>  &judged,
                 const CrackTips          &tips,
                 const GrowthTable        &earlier,
                 const FractureParameters &parameters,
                 const ElasticityProblem  &problem,
                 const CoverSystem        &covers,
                 const ElementStress      &stress)
    {
      constexpr double              n_increments = 5.;
      std::vector<dealii::Point<2>> taken;
      for (const CrackTip &tip : tips.all_tips())
        taken.push_back(tip.point);
      for (const Increment &increment : earlier.increments())
        if (increment.advance.is_new)
          taken.push_back(increment.advance.tip);
      for (const CrackStart &start :
           find_crack_starts(covers,
                             problem,
                             stress,
                             n_increments * parameters.increment,
                             taken))
      {
        GrowingTip candidate;
        candidate.tip.point      = start.point;
        candidate.tip.direction  = start.direction;
        candidate.tip.region     = start.region;
        candidate.mean_stress    = start.mean_stress;
        candidate.drive          = start.drive;
        candidate.advance.is_new = true;
        judged.push_back(std::move(candidate));
      }
    }


    namespace
    {
      /// A name that no curve has yet: "crack 1" and so on.
      std::string
      new_name(const Geometry &geometry)
      {
        for (unsigned int i = 1;; ++i)
        {
          const std::string name = "crack " + std::to_string(i);
          if (std::none_of(geometry.curves().begin(),
                           geometry.curves().end(),
                           [&](const Curve &curve) {
                             return curve.name == name;
                           }))
            return name;
        }
      }
    } // namespace


    CrackExtension
    CrackAdvance::extend(Geometry &geometry) const
    {
      const auto advance = is_new ? start_crack : extend_crack;
      return advance(geometry, tip, direction, length, name);
    }


    void
    extend_by_increment(GrowingTip               &growing,
                        const FractureParameters &parameters,
                        Geometry                 &geometry)
    {
      CrackAdvance &advance = growing.advance;
      advance.tip           = growing.tip.point;
      advance.direction =
        dealii::Physics::Transformations::Rotations::rotation_matrix_2d(
          growing.angle) *
        growing.tip.direction;
      advance.length    = parameters.increment;
      advance.name      = advance.is_new ? new_name(geometry)
                                         : geometry.curves()[growing.tip.curve].name;
      growing.extension = advance.extend(geometry);
    }


    GrowthTable::GrowthTable(std::string value_name)
      : value_name(std::move(value_name))
    {
    }


    void
    GrowthTable::add(const unsigned int step,
                     const double       value,
                     const GrowingTip  &tip)
    {
      const Tensor<1, 2> &e = tip.tip.direction,
                         d  = tip.extension.end - tip.tip.point;
      // An implicit criterion may have turned the increment once more after its last trial.
      const double angle = std::atan2(cross(e, d), e * d);
      add({step,
           value,
           tip.advance,
           tip.factors,
           angle,
           tip.extension.end,
           tip.extension.met,
           tip.mean_stress});
    }


    void
    GrowthTable::add(const Increment &increment)
    {
      length += (increment.end - increment.advance.tip).norm();
      rows.push_back(increment);
    }


    const std::vector<Increment> &
    GrowthTable::increments() const
    {
      return rows;
    }


    unsigned int
    GrowthTable::n_increments() const
    {
      return rows.size();
    }


    double
    GrowthTable::grown_length() const
    {
      return length;
    }


    void
    GrowthTable::write(const OutputDirectory &directory) const
    {
      directory.write_text("growth.csv", [&](std::ostream &out) {
        out << "step," << value_name
            << ",x,y,K_I,K_II,T,spread,angle,end_x,end_y,met,start_stress\n";
        out.precision(12);
        for (const Increment &row : rows)
        {
          out << row.step << ',' << row.value << ',' << row.advance.tip[0]
              << ',' << row.advance.tip[1];
          // A new crack has no intensity factors before, and others no stress at which they start.
          if (row.advance.is_new)
            out << ",,,,";
          else
            for (const double value : {row.factors.K_I,
                                       row.factors.K_II,
                                       row.factors.T,
                                       row.factors.spread})
              out << ',' << value;
          for (const double value :
               {row.angle * 180. / dealii::numbers::PI, row.end[0], row.end[1]})
            out << ',' << value;
          out << ',' << quoted(row.met) << ',';
          if (row.advance.is_new)
            out << row.start_stress;
          out << '\n';
        }
      });
    }
  } // namespace internal
} // namespace NMM
