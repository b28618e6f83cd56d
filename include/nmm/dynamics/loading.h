#ifndef nmm_dynamics_loading_h
#define nmm_dynamics_loading_h

#include <nmm/mechanics/finite_elasticity.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace NMM
{
  /// A displacement condition or fixed point that holds until a time.
  struct Release
  {
    enum class Kind
    {
      /// Index into ElasticityProblem::boundary_conditions.
      boundary_condition,
      /// Index into ElasticityProblem::fixed_points.
      fixed_point
    };
    Kind         kind  = Kind::boundary_condition;
    unsigned int index = 0;
    /// [s]
    double time = 0.;
  };


  /// How the loads and conditions of an ElasticityProblem change in time.
  struct Loading
  {
    /// Multiplies loads and prescribed displacements at a time [s]; empty: ones.
    /// What it says of releases is kept.
    std::function<LoadAmplitudes(double)> amplitudes;
    std::vector<Release>                  releases;
    /**
     * Acceleration a_g(t) of the ground [m/s^2]; empty: none. Displacements are then
     * those relative to the ground, and the inertia force -rho a_g acts on all of
     * the solid.
     */
    std::function<dealii::Tensor<1, 2>(double)> base_acceleration;
  };


  /**
   * A function of time given by points, linear in between, e.g. an earthquake's
   * acceleration. Before the first and after the last point it is 0.
   *
   * File: two numbers a line, time [s] (strictly ascending) and value, separated by
   * blanks or a comma; empty lines and lines that begin with # are skipped.
   */
  class TimeHistory
  {
  public:
    /// @throws InputError naming the file, the line and what is wrong.
    static TimeHistory
    read(const std::string &filename);

    /// @p name stands for the file in messages.
    static TimeHistory
    read(std::istream &in, const std::string &name);

    /// @throws InputError if times do not ascend or the numbers of both differ.
    TimeHistory(std::vector<double> times, std::vector<double> values);

    double
    operator()(double t) const;

    double
    last_time() const;

  private:
    std::vector<double> times, values;
  };
} // namespace NMM

#endif
