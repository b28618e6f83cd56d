#ifndef nmm_dynamics_strength_reduction_h
#define nmm_dynamics_strength_reduction_h

#include <nmm/contact/contact.h>
#include <nmm/dynamics/relaxation.h>
#include <nmm/materials/material.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * Contact laws whose strength is divided by a factor F: tan phi / F, c / F and
   * tensile strength / F (Zienkiewicz, Humpheson & Lewis, Geotechnique 25
   * (1975) 671). Stiffness and dilation angle remain as they are, except for a dilation angle
   * that would exceed the reduced friction angle.
   * @throws InputError for a factor that is not positive.
   */
  ContactParameters
  reduce_strength(const ContactParameters &parameters, double factor);


  /// Materials whose strength is divided by a factor, see MaterialLaw::reduce_strength().
  /// @throws InputError for a factor that is not positive.
  std::vector<Material>
  reduce_strength(const std::vector<Material> &materials, double factor);


  /// Materials with associated flow, see MaterialLaw::associate_flow().
  std::vector<Material>
  associate_flow(const std::vector<Material> &materials);


  /// Result of a relaxation with reduced strength; see try_to_stand().
  struct StrengthTrial
  {
    /// The possible results of a trial.
    enum class Outcome
    {
      /// The solid came to rest before any displacement became too large.
      stands,
      /// A displacement became too large, or there was no rest within the steps allowed.
      moves,
      /// A step did not converge, so that neither is known.
      fails
    };

    /// Factor that strength was divided by [-].
    double factor = 1.;
    /// Result of the trial.
    Outcome outcome = Outcome::moves;
    /// Largest change of an unknown since the beginning of the trial [m].
    double displacement = 0.;
    /// Number of accepted steps, and of iterations, those of steps given up included.
    unsigned int n_steps = 0, n_iterations = 0;
    /// Account::imbalance at the end [-].
    double imbalance = 0.;
    /// Why the solid does not stand, as part of a message; empty if it stands.
    std::string reason;

    /// Whether the solid came to rest.
    bool
    stands() const
    {
      return outcome == Outcome::stands;
    }

    /// Whether the trial has no result, because a step did not converge.
    bool
    fails() const
    {
      return outcome == Outcome::fails;
    }
  };


  /**
   * Call relax() until rest or until a displacement exceeds
   * RelaxationParameters::max_displacement. No rest within the steps allowed counts as
   * motion, too. A step that fails ends the trial, which then fails. @p factor is only copied to
   * the result: the caller has to build the model with the reduced strength.
   */
  StrengthTrial
  try_to_stand(TimeIntegrator                                &integrator,
               const RelaxationParameters                    &parameters,
               double                                         factor,
               const std::function<void(const StepRecord &)> &after_step = {});


  /// Range and accuracy of find_safety_factor().
  struct SafetyFactorParameters
  {
    /// Factor of the first trial [-].
    double first = 1.;
    /// Ratio of the factors of successive trials until one stands and one moves [-].
    double ratio = 1.5;
    /// @{
    /// Smallest and largest factor that is tried [-].
    double lowest = 0.05, highest = 50.;
    /// @}
    /// The search ends when moves_at / stands_at - 1 of SafetyFactor is at most this [-].
    double tolerance = 0.01;

    /// @throws InputError naming the parameter and its value.
    void
    check() const;
  };


  /// The factor of safety, by which strength can be divided before blocks move, as a bracket.
  struct SafetyFactor
  {
    /// @{
    /// Largest factor that stands (0: none does) and smallest factor that moves (infinity: none
    /// does) [-].
    double stands_at = 0., moves_at = std::numeric_limits<double>::infinity();
    /// @}
    /// All trials in the order of the search.
    std::vector<StrengthTrial> trials;

    /// Geometric mean of stands_at and moves_at [-]. If only one of them is known, that one; if
    /// none is, NaN.
    double
    value() const;

    /// Whether the search ended because its last trial failed.
    bool
    has_failed() const
    {
      return !trials.empty() && trials.back().fails();
    }
  };


  /**
   * Find the factor of safety: bracket it, then bisect the bracket at its geometric mean.
   * @p try_factor makes a new trial, from the initial state, for each factor. A trial that fails
   * ends the search at once, because it bounds the factor on neither side.
   * With friction the result depends on the loading path: blocks that
   * settle under full strength first may stand at a factor at which the same
   * blocks move if they are loaded under reduced strength from the beginning.
   */
  SafetyFactor
  find_safety_factor(
    const std::function<StrengthTrial(double factor)> &try_factor,
    const SafetyFactorParameters                      &parameters = {});
} // namespace NMM

#endif
