#ifndef nmm_source_scene_law_entries_h
#define nmm_source_scene_law_entries_h

#include <nmm/base/exceptions.h>
#include <nmm/base/named_law.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <scene/parsing.h>
#include <string>
#include <typeinfo>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The entries of a law that a scene chooses by name: the entry `Law`, and the parameters of all
     * laws. Parameters that the chosen law does not have must keep their defaults. Angles are in
     * degrees in scenes; the law has their tangents.
     */
    template <class Law>
    class LawEntries
    {
    public:
      /// @p laws must outlive this object.
      explicit LawEntries(const std::vector<NamedLaw<Law>> &laws)
        : laws(&laws)
      {
        for (const NamedLaw<Law> &named : laws)
        {
          const std::unique_ptr<Law> law = named.law->clone();
          for (const LawParameter &parameter : law->parameters())
          {
            const auto   known = std::find_if(declared.begin(),
                                            declared.end(),
                                            [&](const Declared &other) {
                                              return other.key == parameter.key;
                                            });
            const double value = value_in_scene(parameter);
            if (known == declared.end())
              declared.push_back(
                {named.name, parameter.key, parameter.documentation, value});
            else
              Assert(known->default_value == value,
                     dealii::ExcMessage("Laws have different defaults of '" +
                                        parameter.key + "'."));
          }
        }
      }


      /// The names of the laws, as words of a choice.
      Words<std::string>
      names() const
      {
        Words<std::string> words;
        for (const NamedLaw<Law> &law : *laws)
          words.emplace_back(law.name, law.name);
        return words;
      }


      /// Declares or reads the entry `Law` into @p name, whose default is the first law if it is
      /// empty, and the parameters of all laws into @p values.
      void
      list(Entries                       &entries,
           std::string                   &name,
           std::map<std::string, double> &values) const
      {
        std::string text;
        for (const NamedLaw<Law> &law : *laws)
          text +=
            (text.empty() ? "" : "; ") + law.name + ": " + law.documentation;
        if (name.empty())
          name = laws->front().name;
        entries.add("Law", name, names(), text + ".");
        for (const Declared &parameter : declared)
          entries.add(parameter.key,
                      values.emplace(parameter.key, parameter.default_value)
                        .first->second,
                      dealii::Patterns::Double(),
                      parameter.documentation);
      }


      /// The law @p name with the @p values of a scene.
      std::unique_ptr<Law>
      make(const std::string                   &name,
           const std::map<std::string, double> &values) const
      {
        std::unique_ptr<Law> law = find(name).law->clone();
        for (const LawParameter &parameter : law->parameters())
          if (const auto given = values.find(parameter.key);
              given != values.end())
            *parameter.value =
              parameter.kind == LawParameter::Kind::tangent
                ? std::tan(given->second * dealii::numbers::PI / 180.)
                : given->second;
        return law;
      }


      /// Returns the name of @p law, and sets @p values to its parameters in the units of scenes.
      std::string
      read(const Law &law, std::map<std::string, double> &values) const
      {
        const std::unique_ptr<Law> copy = law.clone();
        for (const LawParameter &parameter : copy->parameters())
          values[parameter.key] = value_in_scene(parameter);
        for (const NamedLaw<Law> &named : *laws)
          if (typeid(*named.law) == typeid(*copy))
            return named.name;
        return "";
      }


      /// Checks the values for the law @p name. @p place gives the place of a key for the message.
      /// @throws InputError for a value that is out of range, or that this law does not use.
      void
      check(const std::string                                     &name,
            const std::map<std::string, double>                   &values,
            const std::function<std::string(const std::string &)> &place) const
      {
        const std::unique_ptr<Law>      law        = find(name).law->clone();
        const std::vector<LawParameter> parameters = law->parameters();
        for (const LawParameter &parameter : parameters)
        {
          const double value    = values.at(parameter.key);
          const bool   is_angle = parameter.kind == LawParameter::Kind::tangent;
          AssertThrow(value >= 0. && std::isfinite(value) &&
                        !(is_angle && value >= 90.),
                      InputError("'" + parameter.key + "' is " +
                                   to_text(value) +
                                   (is_angle ? " degrees" : ""),
                                 place(parameter.key),
                                 parameter.remedy));
        }
        for (const Declared &parameter : declared)
          AssertThrow(
            values.at(parameter.key) == parameter.default_value ||
              std::any_of(parameters.begin(),
                          parameters.end(),
                          [&](const LawParameter &own) {
                            return own.key == parameter.key;
                          }),
            InputError("'" + parameter.key +
                         "' would not be used by the law '" + name + "'",
                       place(parameter.key),
                       "remove it, or set 'Law = " + parameter.law_name + "'"));
      }

    private:
      /// A parameter in the unit of scenes, with the first law that has it.
      struct Declared
      {
        std::string law_name, key, documentation;
        double      default_value;
      };


      static double
      value_in_scene(const LawParameter &parameter)
      {
        return parameter.kind == LawParameter::Kind::tangent
                 ? std::atan(*parameter.value) * 180. / dealii::numbers::PI
                 : *parameter.value;
      }


      const NamedLaw<Law> &
      find(const std::string &name) const
      {
        for (const NamedLaw<Law> &law : *laws)
          if (law.name == name)
            return law;
        return laws->front();
      }

      const std::vector<NamedLaw<Law>> *laws;
      std::vector<Declared>             declared;
    };
  } // namespace internal
} // namespace NMM

#endif
