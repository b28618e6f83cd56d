#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/fracture/tip_cover.h>
#include <nmm/fracture/turned_tip.h>

#include <algorithm>
#include <cmath>
#include <scene/crack_tips.h>
#include <scene/parsing.h>
#include <sstream>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// "the crack tip at (1, 2)", or "the 3 crack tips at (1, 2), (3, 4) and elsewhere".
      std::string
      describe_tips(const std::vector<CrackTip> &tips)
      {
        constexpr unsigned int n_shown = 5;
        std::string            text =
          tips.size() == 1
                       ? "the crack tip at "
                       : "the " + std::to_string(tips.size()) + " crack tips at ";
        for (unsigned int i = 0; i < tips.size() && i < n_shown; ++i)
          text += (i > 0 ? ", " : "") + to_string(tips[i].point);
        return text + (tips.size() > n_shown ? " and elsewhere" : "");
      }


      /// What leaves the first of the tips without room, "joint 'a' is only 1e-12 m from it".
      std::string
      describe_room(const std::vector<CrackTip> &tips,
                    const PhysicalMesh          &mesh,
                    const std::string           &length_unit)
      {
        const CrackTip   &tip  = tips.front();
        const std::string room = to_text(tip.free_radius) + " " + length_unit;
        const Curve      &near = mesh.curves()[tip.nearest_curve];
        const std::string what = to_string(near.role) + " '" + near.name + "'";
        return (tip.nearest_curve == tip.curve
                  ? "the crack, " + what + ", is only " + room + " long"
                  : what + " is only " + room + " away") +
               (tips.size() > 1 ? " from the first of them" : "");
      }
    } // namespace


    CrackTips::CrackTips(const Scene             &scene,
                         const PhysicalMesh      &physical_mesh,
                         const ElasticityProblem &problem)
      : scene(scene)
      , tips(find_crack_tips(physical_mesh))
    {
      std::vector<CrackTip> undefined, at_rest;
      for (const CrackTip &tip : tips)
      {
        tip_has_factors.push_back(
          has_intensity_factors(tip, physical_mesh, problem));
        if (!tip_has_factors.back())
          undefined.push_back(tip);
        if (tip.tied_curve != invalid_index)
          at_rest.push_back(tip);
      }
      const auto on_curve = [&](const std::vector<CrackTip> &some) {
        const Curve &curve = physical_mesh.curves()[some.front().tied_curve];
        return describe_tips(some) +
               (some.size() == 1 ? " lies on "
                                 : " lie on interfaces such as ") +
               to_string(curve.role) + " '" + curve.name + "'";
      };
      if (!undefined.empty())
        tip_notices.push_back(
          on_curve(undefined) +
          ", between materials of different elasticity: "
          "intensity factors are not defined there, since stress does not grow "
          "like the inverse root of the distance; cells are small there as at "
          "other tips");
      const FractureParameters &fracture = scene.parameters().fracture;
      if (!at_rest.empty())
        reason_at_rest = on_curve(at_rest) + ", where cracks end";
      if (!at_rest.empty() && fracture.n_increments > 0)
        tip_notices.push_back(reason_at_rest + ": it does not grow");
      std::vector<CrackTip> coarse;
      for (const CrackTip &tip : tips)
        if (!has_tip_cover(physical_mesh, tip) &&
            least_cell_size(physical_mesh) > 1e-3 * tip.free_radius)
          coarse.push_back(tip);
      if (!coarse.empty())
        tip_notices.push_back(
          "coordinates cannot tell cells apart that are much smaller than the "
          "distance to what is nearest, " +
          to_text(coarse.front().free_radius) + " " +
          scene.parameters().output.length_unit + " at " +
          describe_tips(coarse) +
          ": intensity factors there may be too small by half a percent");
      const std::vector<CrackTip> without_room =
        find_tips_without_room(physical_mesh);
      if (without_room.empty())
        return;
      const std::string crowded =
        describe_tips(without_room) +
        (without_room.size() == 1 ? " has" : " have") +
        " no room for cells that resolve the stress there: " +
        describe_room(without_room,
                      physical_mesh,
                      scene.parameters().output.length_unit);
      if (reason_at_rest.empty())
        reason_at_rest = crowded;
      tip_notices.push_back(
        crowded +
        "; it has no intensity factors and cells are not small there, so that "
        "the factors of tips nearby can be wrong by a third; let the joint go "
        "on to the next curve, or leave at least " +
        to_text(1e4 * least_cell_size(physical_mesh)) + " " +
        scene.parameters().output.length_unit);
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


    bool
    CrackTips::has_factors(const unsigned int i) const
    {
      return tip_has_factors[i];
    }


    std::vector<std::string>
    CrackTips::notices() const
    {
      return tip_notices;
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
      const FractureParameters &fracture = scene.parameters().fracture;
      const bool                is_any_of_use =
        std::any_of(tips.begin(), tips.end(), [&](const CrackTip &tip) {
          return fracture.n_increments == 0 || tip.tied_curve == invalid_index;
        });
      AssertThrow(
        is_any_of_use ||
          fracture.can_start_cracks(scene.parameters().materials),
        InputError(reason_at_rest.empty()
                     ? "there is no crack tip that could have intensity "
                       "factors"
                   : fracture.n_increments > 0
                     ? "there is no crack tip that could grow, since " +
                         reason_at_rest
                     : "there is no crack tip that could have intensity "
                       "factors, since " +
                         reason_at_rest,
                   fracture.n_increments > 0 && !reason_at_rest.empty()
                     ? "parameter 'Fracture/Increments'"
                     : "parameter 'Fracture/Intensity factors'",
                   "let an open joint end inside a block, away from other "
                   "curves, let cracks grow in a material with a 'Fracture "
                   "strength', or remove it"));
      const double radius = fracture.radius;
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
      factors.clear();
      for (unsigned int i = 0; i < tips.size(); ++i)
      {
        const CrackTip &tip = tips[i];
        if (!has_factors(i))
        {
          factors.emplace_back();
          continue;
        }
        // The free radius of a tip that has grown may be smaller than that at the start.
        const SceneParameters &parameters = scene.parameters();
        const auto compute = parameters.model.kinematics == Kinematics::finite
                               ? compute_turned_factors
                               : compute_intensity_factors;
        factors.push_back(
          compute(field,
                  problem,
                  tip,
                  std::min(parameters.fracture.radius, tip.free_radius),
                  loading,
                  &rules));
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
        if (has_factors(i))
          for (const std::string name : {"K_I_", "K_II_"})
            names.push_back(name + std::to_string(i));
      return names;
    }


    std::vector<double>
    CrackTips::numbers() const
    {
      std::vector<double> values;
      for (unsigned int i = 0; i < factors.size(); ++i)
        if (has_factors(i))
          values.insert(values.end(), {factors[i].K_I, factors[i].K_II});
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
        text << "crack tip at " << to_string(tips[i].point) << ": ";
        if (has_factors(i))
          text << "K_I " << factors[i].K_I << ", K_II " << factors[i].K_II
               << " (+- " << factors[i].spread << ") " << intensity_unit();
        else
          text << "between unlike materials, intensity factors are not defined";
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
      if (std::none_of(tip_has_factors.begin(),
                       tip_has_factors.end(),
                       [](const bool has) { return has; }) ||
          factors.empty())
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
          for (const double value :
               {tip.point[0], tip.point[1], tip.direction[0], tip.direction[1]})
            out << ',' << value;
          for (const double value :
               {k.K_I, k.K_II, k.T, k.energy_release_rate, k.spread, k.radius})
          {
            out << ',';
            if (has_factors(i) && !std::isnan(value))
              out << value;
          }
          out << '\n';
        }
      });
    }
  } // namespace internal
} // namespace NMM
