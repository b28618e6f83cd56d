#include <nmm/base/exceptions.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

#include <iostream>
#include <regex>
#include <scene/expression.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Silences the standard error stream during its lifetime, since FunctionParser prints its
      /// exceptions there.
      class SilentErrorStream
      {
      public:
        SilentErrorStream()
          : buffer(std::cerr.rdbuf(text.rdbuf()))
        {
        }

        ~SilentErrorStream()
        {
          std::cerr.rdbuf(buffer);
        }

      private:
        std::ostringstream text;
        std::streambuf    *buffer;
      };
    } // namespace


    namespace
    {
      /// Refuses functions whose value is another one each time. @throws InputError.
      void
      refuse_random_numbers(const std::string &expression,
                            const std::string &parameter)
      {
        AssertThrow(!std::regex_search(expression,
                                       std::regex("\\brand(_seed)?\\b")),
                    InputError("rand() has another value each time, so that "
                               "nothing that is computed with it converges",
                               "parameter '" + parameter + "'",
                               "use functions of the variables only"));
      }


      /// What the parser of deal.II complains about, in a few words: the sentence of muParser.
      std::string
      reason_of(const dealii::ExceptionBase &error)
      {
        std::ostringstream message;
        error.print_info(message);
        const std::string text =
          std::regex_replace(message.str(), std::regex("\\s+"), " ");
        std::smatch match;
        return std::regex_search(text,
                                 match,
                                 std::regex("The parser said: (.*?)\\.? *$"))
                 ? " (" + match.str(1) + ")"
                 : "";
      }
    } // namespace


    template <int dim>
    std::shared_ptr<const dealii::Function<dim>>
    parse_expressions(const std::vector<std::string> &expressions,
                      const std::string              &variables,
                      const std::string              &parameter)
    {
      const unsigned int n = expressions.size();
      auto function        = std::make_shared<dealii::FunctionParser<dim>>(n);
      for (const std::string &expression : expressions)
        refuse_random_numbers(expression, parameter);
      try
      {
        const SilentErrorStream silence;
        function->initialize(variables,
                             expressions,
                             {{"pi", dealii::numbers::PI}});
        // Expressions are compiled when they are first evaluated.
        dealii::Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = 0.25;
        for (unsigned int c = 0; c < n; ++c)
          function->value(x, c);
      }
      catch (const dealii::ExceptionBase &error)
      {
        std::string text;
        for (const std::string &expression : expressions)
          text += (text.empty() ? "" : "; ") + expression;
        const std::string names =
          std::regex_replace(variables, std::regex(","), ", ");
        AssertThrow(false,
                    InputError("'" + text + "' is no valid expression" +
                                 reason_of(error),
                               "parameter '" + parameter + "'",
                               "use " + names +
                                 ", pi, numbers, + - * / ^ and the usual "
                                 "functions"));
      }
      return function;
    }


    template std::shared_ptr<const dealii::Function<1>>
    parse_expressions<1>(const std::vector<std::string> &,
                         const std::string &,
                         const std::string &);

    template std::shared_ptr<const dealii::Function<2>>
    parse_expressions<2>(const std::vector<std::string> &,
                         const std::string &,
                         const std::string &);
  } // namespace internal
} // namespace NMM
