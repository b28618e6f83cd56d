#include <nmm/base/exceptions.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <scene/parsing.h>
#include <sstream>

namespace NMM
{
  namespace internal
  {
    namespace Patterns = dealii::Patterns;
    using dealii::Point;

    namespace
    {
      /// Two finite numbers, separated by a comma or, as in arrays of JSON, by a semicolon; nothing
      /// if @p text is something else.
      std::optional<Point<2>>
      to_point(std::string text)
      {
        std::replace(text.begin(), text.end(), ';', ',');
        try
        {
          const auto numbers = dealii::Utilities::string_to_double(
            dealii::Utilities::split_string_list(text, ','));
          if (numbers.size() == 2 && std::isfinite(numbers[0]) &&
              std::isfinite(numbers[1]))
            return Point<2>(numbers[0], numbers[1]);
        }
        catch (const dealii::ExceptionBase &)
        {
        }
        return std::nullopt;
      }
    } // namespace


    std::string
    join(const std::vector<std::string> &words, const std::string &separator)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : separator) + word;
      return text;
    }


    Entries::Entries(const Stage stage, dealii::ParameterHandler *prm)
      : stage(stage)
      , prm(prm)
    {
    }


    bool
    Entries::are_parsed() const
    {
      return stage == Stage::parse;
    }


    const std::vector<std::pair<std::string, std::string>> &
    Entries::noted() const
    {
      return notes;
    }


    std::string
    Entries::entry(const std::string           &key,
                   const std::string           &value,
                   const Patterns::PatternBase &pattern,
                   const std::string           &help)
    {
      if (stage == Stage::parse)
        return prm->get(key);
      if (stage == Stage::declare)
        prm->declare_entry(key, value, pattern, help);
      else
        notes.emplace_back(key, value);
      return value;
    }


    std::vector<std::string>
    Entries::names_of(const std::string &key) const
    {
      return get_names(*prm, key);
    }


    void
    Entries::add(const std::string      &key,
                 double                 &value,
                 const Patterns::Double &pattern,
                 const std::string      &help)
    {
      entry(key, std::isnan(value) ? "0" : to_text(value), pattern, help);
      if (are_parsed())
        value = prm->get_double(key);
    }


    void
    Entries::add(const std::string       &key,
                 unsigned int            &value,
                 const Patterns::Integer &pattern,
                 const std::string       &help)
    {
      entry(key, std::to_string(value), pattern, help);
      if (are_parsed())
        value = prm->get_integer(key);
    }


    void
    Entries::add(const std::string &key, bool &value, const std::string &help)
    {
      entry(key, value ? "true" : "false", Patterns::Bool(), help);
      if (are_parsed())
        value = prm->get_bool(key);
    }


    void
    Entries::add(const std::string &key,
                 std::string       &value,
                 const std::string &help)
    {
      value =
        dealii::Utilities::trim(entry(key, value, Patterns::Anything(), help));
    }


    void
    Entries::add(const std::string    &key,
                 std::vector<double>  &values,
                 const Patterns::List &pattern,
                 const std::string    &help)
    {
      std::vector<std::string> texts;
      for (const double value : values)
        texts.push_back(to_text(value));
      entry(key, join(texts), pattern, help);
      if (are_parsed())
        values = dealii::Utilities::string_to_double(names_of(key));
    }


    void
    Entries::add(const std::string    &key,
                 dealii::Tensor<1, 2> &value,
                 const std::string    &help)
    {
      std::vector<double> numbers = {value[0], value[1]};
      add(key, numbers, Patterns::List(Patterns::Double(), 2, 2, ","), help);
      value = Point<2>(numbers[0], numbers[1]);
    }


    void
    Entries::add(const std::string       &key,
                 std::optional<Point<2>> &value,
                 const std::string       &word,
                 const std::string       &section,
                 const std::string       &help)
    {
      const std::string text = entry(key, word, Patterns::Anything(), help);
      value                  = to_point(text);
      AssertThrow(value || text == word,
                  InputError("'" + text + "' is no point",
                             "parameter '" + section + "/" + key + "'",
                             "give two numbers 'x, y', or " +
                               (word.empty() ? "nothing" : "'" + word + "'")));
    }


    void
    Entries::add(const std::string        &key,
                 std::vector<std::string> &names,
                 const std::string        &help)
    {
      entry(key,
            stage == Stage::note ? join(names) : "",
            Patterns::List(Patterns::Anything(), 0),
            help);
      if (are_parsed())
        names = names_of(key);
    }


    std::vector<std::string>
    get_names(const dealii::ParameterHandler &prm, const std::string &key)
    {
      std::vector<std::string> names;
      for (const std::string &name :
           dealii::Utilities::split_string_list(prm.get(key), ','))
        if (!name.empty())
          names.push_back(name);
      return names;
    }


    std::string
    to_text(const double value)
    {
      std::ostringstream out;
      out.precision(10);
      out << value;
      return out.str();
    }


    UnusedValue::UnusedValue(const std::string &section,
                             const std::string &key,
                             const std::string &text,
                             const std::string &by,
                             const std::string &remedy)
      : InputError("'" + key + " = " + text + "' would not be used by " + by,
                   "parameter '" + section + "/" + key + "'",
                   remedy)
      , path(dealii::Utilities::split_string_list(section, '/'))
      , by(by)
    {
      path.push_back(key);
    }


    std::vector<dealii::Point<2>>
    read_line(const std::string &text, const std::string &parameter)
    {
      std::vector<dealii::Point<2>> result;
      for (const std::string &part :
           dealii::Utilities::split_string_list(text, ','))
      {
        std::istringstream  words(part);
        std::vector<double> numbers;
        for (double number; words >> number;)
          numbers.push_back(number);
        const bool is_level = numbers.size() == 1 && part == text;
        AssertThrow(words.eof() && (numbers.size() == 2 || is_level),
                    InputError("'" + part + "' is no point of a line",
                               "parameter '" + parameter + "'",
                               "give one elevation, or points 'x y, x y' from "
                               "left to right"));
        result.push_back(is_level ? dealii::Point<2>(0., numbers[0])
                                  : dealii::Point<2>(numbers[0], numbers[1]));
      }
      return result;
    }


    void
    expect_default(const std::string &section,
                   const std::string &key,
                   const double       value,
                   const double       default_value,
                   const std::string &by,
                   const std::string &remedy)
    {
      AssertThrow(value == default_value,
                  UnusedValue(section, key, to_text(value), by, remedy));
    }


    void
    expect_defaults(const std::string &section,
                    const Entries     &given,
                    const Entries     &defaults,
                    const std::string &by,
                    const std::string &remedy)
    {
      for (unsigned int i = 0; i < given.noted().size(); ++i)
      {
        const auto &[key, value] = given.noted()[i];
        AssertThrow(value == defaults.noted()[i].second,
                    UnusedValue(section, key, value, by, remedy));
      }
    }
  } // namespace internal
} // namespace NMM
