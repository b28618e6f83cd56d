#ifndef nmm_mechanics_loading_h
#define nmm_mechanics_loading_h

#include <nmm/mechanics/finite_elasticity.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace NMM
{
  /// The removal of a displacement condition or fixed point at a time.
  struct Release
  {
    /// The kind of support that is removed.
    enum class Kind
    {
      /// Index into ElasticityProblem::boundary_conditions.
      boundary_condition,
      /// Index into ElasticityProblem::fixed_points.
      fixed_point
    };
    /// Which list `index` refers to.
    Kind kind = Kind::boundary_condition;
    /// Index into that list; the condition must not be a load.
    unsigned int index = 0;
    /// Time of the removal [s].
    double time = 0.;
  };


  /// The loads and supports of an ElasticityProblem as functions of time.
  struct Loading
  {
    /// Amplitudes of loads and prescribed displacements as a function of time [s]; empty: all are
    /// 1. Releases in the amplitudes hold in addition to `releases`.
    std::function<LoadAmplitudes(double)> amplitudes;
    /// Supports that are removed, in any order.
    std::vector<Release> releases;
    /**
     * Acceleration a_g(t) of the ground [m/s^2]; empty: none. If given, displacements are
     * relative to the ground, and the inertia force -rho a_g acts on the whole solid.
     */
    std::function<dealii::Tensor<1, 2>(double)> base_acceleration;
  };


  /// Coefficients of Rayleigh damping, C = mass M + stiffness K(u = 0), see SolidTerm::damp().
  struct RayleighDamping
  {
    /// Coefficient of the mass matrix, not negative [1/s].
    double mass = 0.;
    /// Coefficient of the stiffness matrix, not negative [s].
    double stiffness = 0.;
  };


  /// Loads and prescribed displacements that are those of @p problem, multiplied by the amplitudes
  /// @p full and by the time. This is the loading of a solid at rest, whose time is the load factor.
  Loading
  proportional_loading(const ElasticityProblem &problem,
                       const LoadAmplitudes    &full = {});


  /// The loads @p a multiplied by those of @p b. Empty lists stand for 1, and a support is released if it
  /// is in one of both.
  LoadAmplitudes
  product(const LoadAmplitudes &a, const LoadAmplitudes &b);


  /// @p loading with all loads multiplied by @p stage, the loads and supports that a stage has left.
  Loading
  loading_after_stage(const Loading &loading, const LoadAmplitudes &stage);


  /// @p problem with gravity, body force and the values of its conditions and points multiplied by
  /// @p amplitudes. Empty lists stand for 1.
  ElasticityProblem
  problem_at(const ElasticityProblem &problem,
             const LoadAmplitudes    &amplitudes);


  /**
   * A piecewise linear function of time given by points, e.g. the acceleration of an
   * earthquake. It is 0 before the first and after the last point.
   *
   * File: two numbers per line, time [s] (strictly ascending) and value, separated by
   * blanks or a comma; empty lines and lines that begin with # are skipped.
   */
  class TimeHistory
  {
  public:
    /// Read a history from a file.
    /// @throws InputError naming the file, the line and what is wrong.
    static TimeHistory
    read(const std::string &filename);

    /// Read a history from a stream; @p name stands for the file in messages.
    static TimeHistory
    read(std::istream &in, const std::string &name);

    /// Make a history from as many @p times [s] as @p values.
    /// @throws InputError if times do not ascend strictly, a number is not finite, or the numbers
    /// of times and values differ or are 0.
    TimeHistory(std::vector<double> times, std::vector<double> values);

    /// Value at the time @p t [s], in the unit of the given values.
    double
    operator()(double t) const;

  private:
    std::vector<double> times, values;
  };
} // namespace NMM

#endif
