#ifndef nmm_source_scene_parsing_h
#define nmm_source_scene_parsing_h

#include <nmm/scene/scene_parameters_dynamics.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Pattern of a point or vector "x, y".
    inline dealii::Patterns::List
    vector_pattern()
    {
      return dealii::Patterns::List(dealii::Patterns::Double(), 2, 2, ",");
    }


    inline dealii::Point<2>
    get_point(const dealii::ParameterHandler &prm, const std::string &key)
    {
      const std::vector<double> numbers = dealii::Utilities::string_to_double(
        dealii::Utilities::split_string_list(prm.get(key), ','));
      return {numbers[0], numbers[1]};
    }


    /// A point, or nothing where the text is @p word.
    inline std::optional<dealii::Point<2>>
    get_optional_point(const dealii::ParameterHandler &prm,
                       const std::string              &key,
                       const std::string              &word,
                       const std::string              &section)
    {
      const std::string text = prm.get(key);
      if (text == word)
        return std::nullopt;
      try
      {
        const std::vector<double> numbers = dealii::Utilities::string_to_double(
          dealii::Utilities::split_string_list(text, ','));
        if (numbers.size() == 2 && std::isfinite(numbers[0]) &&
            std::isfinite(numbers[1]))
          return dealii::Point<2>(numbers[0], numbers[1]);
      }
      catch (const dealii::ExceptionBase &)
      {
      }
      AssertThrow(false,
                  InputError("'" + text + "' is no point",
                             "parameter '" + section + "/" + key + "'",
                             "give two numbers 'x, y', or " +
                               (word.empty() ? "nothing" : "'" + word + "'")));
      return std::nullopt;
    }


    /// A list of names without empty ones.
    inline std::vector<std::string>
    get_names(const dealii::ParameterHandler &prm, const std::string &key)
    {
      std::vector<std::string> names;
      for (const std::string &name :
           dealii::Utilities::split_string_list(prm.get(key), ','))
        if (!name.empty())
          names.push_back(name);
      return names;
    }


    /// Pattern of a selection from the words of @p map.
    template <typename Enum>
    dealii::Patterns::Selection
    selection(const std::vector<std::pair<std::string, Enum>> &words)
    {
      std::string text;
      for (const auto &word : words)
        text += (text.empty() ? "" : "|") + word.first;
      return dealii::Patterns::Selection(text);
    }


    template <typename Enum>
    Enum
    get_selection(const dealii::ParameterHandler                  &prm,
                  const std::string                               &key,
                  const std::vector<std::pair<std::string, Enum>> &words)
    {
      const std::string text = prm.get(key);
      for (const auto &word : words)
        if (word.first == text)
          return word.second;
      AssertThrow(false, dealii::ExcInternalError());
      return words.front().second;
    }


    /// With 12 digits.
    std::string
    to_text(double value);

    /// @throws InputError if a value that differs from its default would be
    /// ignored, @p by what.
    void
    expect_default(const std::string &section,
                   const std::string &key,
                   double             value,
                   double             default_value,
                   const std::string &by,
                   const std::string &remedy);

    /// Entry `Analysis` of the model.
    void
    declare_analysis(dealii::ParameterHandler &prm);

    Analysis
    get_analysis(const dealii::ParameterHandler &prm);

    /// Entry `Components` of conditions and fixed points.
    void
    declare_components(dealii::ParameterHandler &prm);

    std::array<bool, 2>
    get_components(const dealii::ParameterHandler &prm);
  } // namespace internal
} // namespace NMM

#endif
