#ifndef nmm_base_exceptions_h
#define nmm_base_exceptions_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>

#include <ostream>
#include <string>

namespace NMM
{
  /**
   * Base of the two kinds of errors a user can cause or meet. Thrown through
   * `AssertThrow(condition, InputError(...))`; `print_info()` prints the
   * sentence for people, without file, line or stack trace, which `what()`
   * adds for developers.
   */
  class UserError : public dealii::ExceptionBase
  {
  public:
    UserError(std::string what_happened, std::string where, std::string remedy);

    /// "<what>, at <where>: <remedy>".
    void
    print_info(std::ostream &out) const override;

    /// The same sentence as a string.
    std::string
    message() const;

    /// What is wrong, without where and without the remedy.
    const std::string &
    description() const
    {
      return what_happened;
    }

    /// Where: the name of a curve or parameter, or coordinates.
    const std::string &
    place() const
    {
      return where;
    }

  private:
    std::string what_happened;
    std::string where;
    std::string remedy;
  };

  /**
   * The scene, a file or a call's argument is wrong. Says what is wrong, where
   * (name of the curve or parameter, coordinates, value with unit) and what to
   * do about it. Programs end with exit code 2 and write nothing.
   */
  class InputError : public UserError
  {
  public:
    using UserError::UserError;
  };

  /**
   * The input is well-formed but the numbers do not come out: no convergence,
   * a singular system (and which block floats freely). Programs end with exit
   * code 3.
   */
  class NumericalFailure : public UserError
  {
  public:
    using UserError::UserError;
  };

  /// A point as "(x, y)", with enough digits to find it again.
  std::string
  to_string(const dealii::Point<2> &point);
} // namespace NMM

#endif
