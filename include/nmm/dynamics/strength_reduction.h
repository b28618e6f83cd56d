#ifndef nmm_dynamics_strength_reduction_h
#define nmm_dynamics_strength_reduction_h

#include <nmm/contact/contact.h>
#include <nmm/dynamics/step_control.h>
#include <nmm/materials/material.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * Laws of contact whose strength is divided by a factor F: tan phi / F, c / F and
   * tensile strength / F (Zienkiewicz, Humpheson & Lewis, Geotechnique 25
   * (1975) 671). Stiffness and dilation are left alone, but for a dilation that would
   * exceed the friction.
   * @throws InputError for a factor that is not positive.
   */
  ContactParameters
  reduce_strength(const ContactParameters &parameters, double factor);


  /// Materials whose strength is divided by a factor, see MaterialLaw::reduce_strength().
  /// @throws InputError for a factor that is not positive.
  std::vector<Material>
  reduce_strength(const std::vector<Material> &materials, double factor);


  /// What became of blocks whose strength was reduced.
  struct StrengthTrial
  {
    enum class Outcome
    {
      /// Came to rest before anything moved too far.
      stands,
      /// Something moved too far, or there was no rest within the steps allowed.
      moves,
      /// A step did not converge: this tells neither.
      fails
    };

    double  factor  = 1.;
    Outcome outcome = Outcome::moves;
    /// Largest displacement of a cover since the begin of the trial [m].
    double       displacement = 0.;
    unsigned int n_steps      = 0;
    /// Why it does not stand, for people.
    std::string reason;

    bool
    stands() const
    {
      return outcome == Outcome::stands;
    }

    bool
    fails() const
    {
      return outcome == Outcome::fails;
    }
  };


  /**
   * Relax, see relax(), until rest or until something has moved by more than
   * RelaxationParameters::max_displacement. No rest within the steps allowed counts as
   * motion, too. A step that fails ends the trial, which then fails.
   */
  StrengthTrial
  try_to_stand(TimeIntegrator                                &integrator,
               const RelaxationParameters                    &parameters,
               double                                         factor,
               const std::function<void(const StepRecord &)> &after_step = {});


  struct SafetyFactorParameters
  {
    /// Tried first [-].
    double first = 1.;
    /// Factor between trials until both outcomes are known [-].
    double ratio = 1.5;
    /// Nothing is tried beyond these [-].
    double lowest = 0.05, highest = 50.;
    /// Ratio of both ends of the bracket, less 1 [-].
    double tolerance = 0.01;

    /// @throws InputError naming the parameter and its value.
    void
    check() const;
  };


  /// The number by which strength can be divided before blocks move.
  struct SafetyFactor
  {
    /// Largest factor known to stand, 0 if there is none; smallest known to move,
    /// infinity if there is none.
    double stands_at = 0., moves_at = std::numeric_limits<double>::infinity();
    std::vector<StrengthTrial> trials;

    /// Their geometric mean; where one of them is missing the other one, and where both
    /// are not a number.
    double
    value() const;

    /// The last trial failed, which ended the search.
    bool
    has_failed() const
    {
      return !trials.empty() && trials.back().fails();
    }
  };


  /**
   * Bracket and bisect, in the mean geometric. @p try_factor begins each trial anew. A
   * trial that fails ends the search at once: it is no bound of the factor.
   * Friction makes limits that depend on the way they are reached: blocks that
   * settle under full strength first may stand at a factor at which the same
   * blocks, put together under reduced strength, move.
   */
  SafetyFactor
  find_safety_factor(
    const std::function<StrengthTrial(double factor)> &try_factor,
    const SafetyFactorParameters                      &parameters = {});
} // namespace NMM

#endif
