#include <nmm/base/exceptions.h>

#include <algorithm>
#include <base/archive.h>
#include <cmath>
#include <scene/crack_growth.h>
#include <scene/parsing.h>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    CrackTips::CrackTips(const Scene &scene, const PhysicalMesh &physical_mesh)
      : scene(scene)
      , tips(find_crack_tips(physical_mesh))
    {
    }


    const std::vector<CrackTip> &
    CrackTips::all_tips() const
    {
      return tips;
    }


    const std::vector<IntensityFactors> &
    CrackTips::all_factors() const
    {
      return factors;
    }


    void
    CrackTips::restore(std::vector<IntensityFactors> earlier)
    {
      require_in_checkpoint(earlier.empty() || earlier.size() == tips.size(),
                            "it has factors of another number of crack tips");
      factors = std::move(earlier);
    }


    void
    CrackTips::check() const
    {
      AssertThrow(
        !tips.empty() || can_start_cracks(scene.parameters().fracture,
                                          scene.parameters().materials),
        InputError("there is no crack tip that could have intensity "
                   "factors",
                   "parameter 'Fracture/Intensity factors'",
                   "let an open joint end inside a block, let cracks "
                   "grow in a material with a 'Fracture strength', or "
                   "remove it"));
      const double radius = scene.parameters().fracture.radius;
      for (const CrackTip &tip : tips)
        AssertThrow(radius <= tip.free_radius,
                    InputError("the disk of radius " + to_text(radius) +
                                 " m about the crack tip at " +
                                 to_string(tip.point) +
                                 " would hold more than its crack",
                               "parameter 'Fracture/Radius'",
                               "choose at most " + to_text(tip.free_radius) +
                                 " m, or 0 for a radius of its own for each "
                                 "tip"));
    }


    void
    CrackTips::compute(const DisplacementField &field,
                       const ElasticityProblem &problem,
                       const TipLoading        &loading)
    {
      compute_each(
        [&](const CrackTip &tip, const double radius, DiskRules &disk_rules) {
          return compute_intensity_factors(
            field, problem, tip, radius, loading, &disk_rules);
        });
    }


    void
    CrackTips::compute_each(const FactorsOfTip &factors_of)
    {
      factors.clear();
      for (const CrackTip &tip : tips)
      {
        // The free radius of a tip that has grown may be smaller than that at the start.
        factors.push_back(factors_of(
          tip,
          std::min(scene.parameters().fracture.radius, tip.free_radius),
          rules));
        AssertThrow(std::isfinite(factors.back().K_I) &&
                      std::isfinite(factors.back().K_II),
                    NumericalFailure("The intensity factors are not finite",
                                     "the crack tip at " + to_string(tip.point),
                                     "choose another 'Mathematical mesh/Cell "
                                     "size' or 'Fracture/Radius'"));
      }
    }


    std::vector<std::string>
    CrackTips::columns() const
    {
      std::vector<std::string> names;
      for (unsigned int i = 0; i < tips.size(); ++i)
        for (const std::string name : {"K_I_", "K_II_"})
          names.push_back(name + std::to_string(i));
      return names;
    }


    std::vector<double>
    CrackTips::numbers() const
    {
      std::vector<double> values;
      for (const IntensityFactors &k : factors)
        values.insert(values.end(), {k.K_I, k.K_II});
      return values;
    }


    std::string
    CrackTips::intensity_unit() const
    {
      const OutputParameters &output = scene.parameters().output;
      return output.stress_unit + "*" + output.length_unit + "^0.5";
    }


    std::vector<std::string>
    CrackTips::description() const
    {
      constexpr unsigned int   n_shown = 8;
      std::vector<std::string> lines;
      for (unsigned int i = 0;
           i < std::min<std::size_t>(n_shown, factors.size());
           ++i)
      {
        std::ostringstream text;
        text << "crack tip at " << to_string(tips[i].point) << ": K_I "
             << factors[i].K_I << ", K_II " << factors[i].K_II << " (+- "
             << factors[i].spread << ") " << intensity_unit();
        lines.push_back(text.str());
      }
      if (factors.size() > n_shown)
        lines.push_back("and " + std::to_string(factors.size() - n_shown) +
                        " more crack tip(s), see tips.csv");
      return lines;
    }


    void
    CrackTips::add_to(Summary &summary) const
    {
      const OutputParameters &output = scene.parameters().output;
      const auto              rate   = [](const IntensityFactors &k) {
        return k.energy_release_rate;
      };
      if (factors.empty())
        return;
      const auto most = std::max_element(factors.begin(),
                                         factors.end(),
                                         [&](const auto &a, const auto &b) {
                                           return rate(a) < rate(b);
                                         });
      summary.add("tip_of_largest_release", most - factors.begin());
      summary.add("largest_energy_release_rate",
                  rate(*most),
                  output.stress_unit + "*" + output.length_unit);
      summary.add("largest_intensity_spread",
                  std::max_element(factors.begin(),
                                   factors.end(),
                                   [](const auto &a, const auto &b) {
                                     return a.spread < b.spread;
                                   })
                    ->spread,
                  intensity_unit());
    }


    void
    CrackTips::write(const OutputDirectory &directory) const
    {
      if (factors.empty())
        return;
      directory.write_text("tips.csv", [&](std::ostream &out) {
        out << "tip,x,y,direction_x,direction_y,K_I,K_II,T,energy_release_rate,"
               "spread,radius\n";
        out.precision(12);
        for (unsigned int i = 0; i < factors.size(); ++i)
        {
          const CrackTip         &tip = tips[i];
          const IntensityFactors &k   = factors[i];
          out << i;
          for (const double value : {tip.point[0],
                                     tip.point[1],
                                     tip.direction[0],
                                     tip.direction[1],
                                     k.K_I,
                                     k.K_II,
                                     k.T,
                                     k.energy_release_rate,
                                     k.spread,
                                     k.radius})
            out << ',' << value;
          out << '\n';
        }
      });
    }


    double
    smallest_at_tips(const FractureParameters &parameters, const bool in_motion)
    {
      return in_motion && parameters.n_increments > 0 ? 1e-3 : 1e-6;
    }
  } // namespace internal
} // namespace NMM
