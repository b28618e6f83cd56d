#ifndef nmm_base_exceptions_h
#define nmm_base_exceptions_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>

#include <ostream>
#include <string>

namespace NMM
{
  /**
   * Base class of the errors that a user can cause or meet. They are thrown by
   * `AssertThrow(condition, InputError(...))`. `print_info()` prints the sentence for users;
   * `what()` adds the file, the line and the stack trace for developers.
   */
  class UserError : public dealii::ExceptionBase
  {
  public:
    /// Keeps the three parts of the message: what is wrong, the place (a curve, a parameter or
    /// coordinates), and what the user can do. @p where and @p remedy may be empty.
    UserError(std::string what_happened, std::string where, std::string remedy);

    /// Prints "<what>, at <where>: <remedy>" and ends the line; empty parts are left out.
    void
    print_info(std::ostream &out) const override;

    /// The sentence that print_info() prints, without the end of the line.
    std::string
    message() const;

    /// What is wrong, without the place and the remedy.
    const std::string &
    description() const
    {
      return what_happened;
    }

    /// The place of the error: the name of a curve or parameter, or coordinates; may be empty.
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
   * The scene, a file or the argument of a call is wrong. The message says what is wrong, where
   * (name of the curve or parameter, coordinates, value with unit) and what to
   * do about it. Programs end with exit code 2 and write nothing.
   */
  class InputError : public UserError
  {
  public:
    /// See UserError::UserError().
    using UserError::UserError;
  };

  /**
   * The input is well-formed, but the problem cannot be solved: an iteration does not converge,
   * or the system is singular (the message names the block that floats freely). Programs end
   * with exit code 3.
   */
  class NumericalFailure : public UserError
  {
  public:
    /// See UserError::UserError().
    using UserError::UserError;
  };

  /// A point as "(x, y)", with 12 significant digits.
  std::string
  to_string(const dealii::Point<2> &point);
} // namespace NMM

#endif
