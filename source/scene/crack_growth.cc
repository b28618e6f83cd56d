#include <nmm/output/csv_series.h>

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
    extend_by_increment(GrowingTip               &growing,
                        const FractureParameters &parameters,
                        Geometry                 &geometry)
    {
      const double c = std::cos(growing.angle), s = std::sin(growing.angle);
      const Tensor<1, 2>    &e = growing.tip.direction;
      const dealii::Point<2> direction(c * e[0] - s * e[1],
                                       s * e[0] + c * e[1]);
      growing.extension =
        extend_crack(geometry,
                     growing.tip.point,
                     direction,
                     parameters.increment,
                     geometry.curves()[growing.tip.curve].name);
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
      length += d.norm();
      rows.push_back({step, value, tip});
      // An implicit criterion may have turned the increment once more after its last trial.
      rows.back().tip.angle = std::atan2(e[0] * d[1] - e[1] * d[0], e * d);
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
            << ",x,y,K_I,K_II,T,spread,angle,end_x,end_y,met\n";
        out.precision(12);
        for (const Row &row : rows)
        {
          const GrowingTip &tip = row.tip;
          out << row.step << ',' << row.value;
          for (const double value : {tip.tip.point[0],
                                     tip.tip.point[1],
                                     tip.factors.K_I,
                                     tip.factors.K_II,
                                     tip.factors.T,
                                     tip.factors.spread,
                                     tip.angle * 180. / dealii::numbers::PI,
                                     tip.extension.end[0],
                                     tip.extension.end[1]})
            out << ',' << value;
          out << ',' << quoted(tip.extension.met) << '\n';
        }
      });
    }
  } // namespace internal
} // namespace NMM
