#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/contact/state/carried_history.h>
#include <nmm/dynamics/checkpoint.h>
#include <nmm/fracture/tip_grading.h>
#include <nmm/mechanics/carried_covers.h>

#include <algorithm>
#include <cmath>
#include <scene/growth_in_motion.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Speed of Rayleigh waves, (0.862 + 1.14 nu) / (1 + nu) times that of shear waves (within
      /// 0.5 %; K. Graff, Wave motion in elastic solids (1975), section 6.1) [m/s].
      double
      rayleigh_speed(const Material &material)
      {
        const double nu          = material.poissons_ratio;
        const double shear_speed = std::sqrt(
          material.youngs_modulus / (2. * (1. + nu)) / material.density);
        return (0.862 + 1.14 * nu) / (1. + nu) * shear_speed;
      }
    } // namespace


    GrowthInMotion::GrowthInMotion(const FractureParameters &parameters)
      : parameters(&parameters)
      , increments("time")
    {
    }


    double
    GrowthInMotion::speed(const Material &material) const
    {
      return parameters->speed > 0. ? parameters->speed
                                    : 0.5 * rayleigh_speed(material);
    }


    std::vector<GrowingTip>
    GrowthInMotion::find_growing_tips(std::vector<GrowingTip> judged,
                                      const double            t) const
    {
      const auto is_on_its_way = [&](const GrowingTip &tip) {
        return t < arrival && std::find(running_tips.begin(),
                                        running_tips.end(),
                                        tip.tip.point) != running_tips.end();
      };
      judged.erase(std::remove_if(judged.begin(),
                                  judged.end(),
                                  [&](const GrowingTip &tip) {
                                    return !(tip.drive >= 1.) ||
                                           is_on_its_way(tip);
                                  }),
                   judged.end());
      return judged;
    }


    bool
    GrowthInMotion::has_increments_left() const
    {
      return increments.n_increments() < parameters->n_increments;
    }


    double
    GrowthInMotion::travel_time(const std::vector<GrowingTip> &tips,
                                const ElasticityProblem       &problem,
                                const PhysicalMesh &physical_mesh) const
    {
      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(physical_mesh);
      double longest = 0.;
      for (const GrowingTip &tip : tips)
        longest =
          std::max(longest,
                   tip.tip.point.distance(tip.extension.end) /
                     speed(
                       problem.materials[region_to_material[tip.tip.region]]));
      return longest;
    }


    void
    GrowthInMotion::add(const unsigned int             step,
                        const double                   t,
                        const double                   duration,
                        const std::vector<GrowingTip> &tips)
    {
      // Closing forces that have not faded yet are a part of the new ones, and fade with them.
      if (t >= arrival)
        running_tips.clear();
      arrival = t + duration;
      for (const GrowingTip &tip : tips)
      {
        increments.add(step, t, tip);
        running_tips.push_back(tip.extension.end);
      }
    }


    const GrowthTable &
    GrowthInMotion::table() const
    {
      return increments;
    }


    bool
    GrowthInMotion::has_grown_in(const unsigned int step) const
    {
      return increments.n_increments() > 0 &&
             increments.increments().back().step == step;
    }


    void
    GrowthInMotion::save(SavedGrowth &saved) const
    {
      saved.increments   = increments.increments();
      saved.running_tips = running_tips;
      saved.arrival      = arrival;
    }


    void
    GrowthInMotion::restore(const SavedGrowth &saved)
    {
      Assert(increments.n_increments() == 0, dealii::ExcInternalError());
      check_increments(saved.increments);
      require_in_checkpoint(std::isfinite(saved.arrival),
                            "the arrival of a crack is not finite");
      for (const LocalSize &size : saved.sizes)
        require_in_checkpoint(are_finite(std::vector<double>{size.point[0],
                                                             size.point[1],
                                                             size.size,
                                                             size.length}) &&
                                size.size > 0. && size.growth > 0. &&
                                size.growth <= 1. && size.exponent > 0. &&
                                size.exponent <= 1. && size.length > 0.,
                              "the size of cells at a tip cannot be");
      for (const Increment &increment : saved.increments)
        increments.add(increment);
      running_tips = saved.running_tips;
      arrival      = saved.arrival;
    }
  } // namespace internal
} // namespace NMM
