#include <nmm/output/csv_series.h>

#include <algorithm>
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


    bool
    can_start_cracks(const FractureParameters    &fracture,
                     const std::vector<Material> &materials)
    {
      return fracture.n_increments > 0 &&
             std::any_of(materials.begin(),
                         materials.end(),
                         [](const Material &material) {
                           return material.fracture_strength > 0.;
                         });
    }


    double
    distance_of_starts(const FractureParameters &parameters)
    {
      constexpr double increments = 5.;
      return increments * parameters.increment;
    }


    void
    drop_starts_beside_tips(std::vector<GrowingTip>  &growing,
                            const FractureParameters &parameters)
    {
      const double            distance = distance_of_starts(parameters);
      std::vector<GrowingTip> kept;
      for (const GrowingTip &tip : growing)
        if (!tip.is_new || std::none_of(growing.begin(),
                                        growing.end(),
                                        [&](const GrowingTip &other) {
                                          return !other.is_new &&
                                                 other.tip.point.distance(
                                                   tip.tip.point) < distance;
                                        }))
          kept.push_back(tip);
      growing = std::move(kept);
    }


    std::vector<GrowingTip>
    judge_tips(const CrackTips          &tips,
               const FractureParameters &parameters,
               const ElasticityProblem  &problem,
               const CoverSystem        &covers,
               const ElementStress      &stress)
    {
      const GrowthCriterion          &criterion = growth_criterion(parameters);
      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(covers.manifold_mesh().physical_mesh());
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
      if (can_start_cracks(parameters, problem.materials))
        for (const CrackStart &start : find_crack_starts(
               covers, problem, stress, distance_of_starts(parameters)))
        {
          GrowingTip candidate;
          candidate.is_new        = true;
          candidate.tip.point     = start.point;
          candidate.tip.direction = start.direction;
          candidate.tip.region    = start.region;
          candidate.mean_stress   = start.mean_stress;
          candidate.drive         = start.drive;
          result.push_back(std::move(candidate));
        }
      return result;
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


    void
    extend_by_increment(GrowingTip               &growing,
                        const FractureParameters &parameters,
                        Geometry                 &geometry)
    {
      const double c = std::cos(growing.angle), s = std::sin(growing.angle);
      const Tensor<1, 2>    &e = growing.tip.direction;
      const dealii::Point<2> direction(c * e[0] - s * e[1],
                                       s * e[0] + c * e[1]);
      if (growing.is_new)
      {
        growing.extension = start_crack(geometry,
                                        growing.tip.point,
                                        direction,
                                        parameters.increment,
                                        new_name(geometry));
        return;
      }
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


    std::vector<std::pair<dealii::Point<2>, dealii::Point<2>>>
    GrowthTable::increments() const
    {
      std::vector<std::pair<dealii::Point<2>, dealii::Point<2>>> result;
      for (const Row &row : rows)
        result.emplace_back(row.tip.tip.point, row.tip.extension.end);
      return result;
    }


    void
    GrowthTable::write(const OutputDirectory &directory) const
    {
      directory.write_text("growth.csv", [&](std::ostream &out) {
        out << "step," << value_name
            << ",x,y,K_I,K_II,T,spread,angle,end_x,end_y,met,start_stress\n";
        out.precision(12);
        for (const Row &row : rows)
        {
          const GrowingTip &tip = row.tip;
          out << row.step << ',' << row.value << ',' << tip.tip.point[0] << ','
              << tip.tip.point[1];
          // A new crack has no intensity factors before, and others no stress at which they start.
          if (tip.is_new)
            out << ",,,,";
          else
            for (const double value : {tip.factors.K_I,
                                       tip.factors.K_II,
                                       tip.factors.T,
                                       tip.factors.spread})
              out << ',' << value;
          for (const double value : {tip.angle * 180. / dealii::numbers::PI,
                                     tip.extension.end[0],
                                     tip.extension.end[1]})
            out << ',' << value;
          out << ',' << quoted(tip.extension.met) << ',';
          if (tip.is_new)
            out << tip.mean_stress;
          out << '\n';
        }
      });
    }
  } // namespace internal
} // namespace NMM
