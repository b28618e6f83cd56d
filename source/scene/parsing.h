#ifndef nmm_source_scene_parsing_h
#define nmm_source_scene_parsing_h

#include <nmm/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The words of a choice, each with the value it stands for.
    template <typename Value>
    using Words = std::vector<std::pair<std::string, Value>>;


    /// The word for @p value.
    template <typename Value>
    const std::string &
    word_of(const Value &value, const Words<Value> &words)
    {
      for (const auto &word : words)
        if (word.second == value)
          return word.first;
      AssertThrow(false, dealii::ExcInternalError());
      return words.front().first;
    }


    /**
     * The entries of a section. The struct that owns them lists them once, in
     * `list_entries()`. Depending on the stage, this declares the entries, with the values of the
     * struct as defaults, or parses them into the struct, or notes their values for
     * expect_defaults().
     *
     * @code
     *   void GeometryParameters::list_entries(Entries &entries)
     *   {
     *     entries.add("File", file, "Geometry file.");
     *     entries.add("Small block area", small_block, Patterns::Double(0), "...");
     *   }
     * @endcode
     */
    class Entries
    {
    public:
      enum class Stage
      {
        declare,
        parse,
        note
      };

      explicit Entries(Stage stage, dealii::ParameterHandler *prm = nullptr);

      /// Whether the struct gets its values from a scene, so that it can check them.
      bool
      are_parsed() const;

      /// A number. A value that is NaN must be set by the scene: its default is 0, which the checks
      /// of the struct refuse.
      void
      add(const std::string              &key,
          double                         &value,
          const dealii::Patterns::Double &pattern,
          const std::string              &help);

      void
      add(const std::string               &key,
          unsigned int                    &value,
          const dealii::Patterns::Integer &pattern,
          const std::string               &help);

      void
      add(const std::string &key, bool &value, const std::string &help);

      /// A text, without blanks around it.
      void
      add(const std::string &key, std::string &value, const std::string &help);

      /// Numbers separated by commas.
      void
      add(const std::string            &key,
          std::vector<double>          &values,
          const dealii::Patterns::List &pattern,
          const std::string            &help);

      /// A point or vector "x, y".
      void
      add(const std::string    &key,
          dealii::Tensor<1, 2> &value,
          const std::string    &help);

      /// A point "x, y", or no point if the text is @p word. @p section is for the message.
      void
      add(const std::string               &key,
          std::optional<dealii::Point<2>> &value,
          const std::string               &word,
          const std::string               &section,
          const std::string               &help);

      /// Names separated by commas.
      void
      add(const std::string        &key,
          std::vector<std::string> &names,
          const std::string        &help);

      template <typename Value>
      void
      add(const std::string  &key,
          Value              &value,
          const Words<Value> &words,
          const std::string  &help)
      {
        const std::string text =
          entry(key, word_of(value, words), selection(words), help);
        for (const auto &word : words)
          if (word.first == text)
            value = word.second;
      }

      /// A list of words, separated by commas.
      template <typename Value>
      void
      add(const std::string  &key,
          std::vector<Value> &values,
          const Words<Value> &words,
          const std::string  &help)
      {
        entry(key, "", dealii::Patterns::List(selection(words), 0), help);
        if (!are_parsed())
          return;
        values.clear();
        for (const std::string &name : names_of(key))
          for (const auto &word : words)
            if (word.first == name)
              values.push_back(word.second);
      }

      /// The section @p name, whose entries the function @p list lists.
      template <typename List>
      void
      section(const std::string &name, const List &list)
      {
        prm->enter_subsection(name);
        list();
        prm->leave_subsection();
      }

      template <typename Parameters>
      void
      section(const std::string &name, Parameters *parameters)
      {
        section(name, [&]() { parameters->list_entries(*this); });
      }

      /// An entry `Names`, and a subsection for each of @p names, whose entries
      /// list(one, name) lists.
      template <typename Parameters, typename List>
      void
      subsections(const std::vector<std::string> &names,
                  std::vector<Parameters>        &all,
                  const std::string              &help,
                  const List                     &list)
      {
        std::vector<std::string> names_in_file = names;
        add("Names", names_in_file, help);
        if (stage == Stage::note)
          return;
        all.clear();
        for (const std::string &name : names)
        {
          all.emplace_back();
          section(name, [&]() { list(all.back(), name); });
        }
      }

      /// A section @p name with an entry `Names`, and with a subsection for each of @p names, for
      /// structs that have a member `name`.
      template <typename Parameters>
      void
      section_of_subsections(const std::string              &name,
                             const std::vector<std::string> &names,
                             std::vector<Parameters>        &all,
                             const std::string              &help)
      {
        section(name, [&]() {
          subsections(names,
                      all,
                      help,
                      [&](Parameters &one, const std::string &name) {
                        one.name = name;
                        one.list_entries(*this);
                      });
        });
      }

      /// The keys and values that were noted.
      const std::vector<std::pair<std::string, std::string>> &
      noted() const;

    private:
      Stage                                            stage;
      dealii::ParameterHandler                        *prm;
      std::vector<std::pair<std::string, std::string>> notes;

      /// Declares, reads or notes an entry. Returns the value in the scene, or @p value if none is
      /// read.
      std::string
      entry(const std::string                   &key,
            const std::string                   &value,
            const dealii::Patterns::PatternBase &pattern,
            const std::string                   &help);

      std::vector<std::string>
      names_of(const std::string &key) const;

      template <typename Value>
      static dealii::Patterns::Selection
      selection(const Words<Value> &words)
      {
        std::string text;
        for (const auto &word : words)
          text += (text.empty() ? "" : "|") + word.first;
        return dealii::Patterns::Selection(text);
      }
    };


    /// A list of names without empty ones.
    std::vector<std::string>
    get_names(const dealii::ParameterHandler &prm, const std::string &key);

    std::string
    join(const std::vector<std::string> &words,
         const std::string              &separator = ", ");

    /// A number as text with 10 digits.
    std::string
    to_text(double value);

    /**
     * A value of a scene would have no effect. It is an error, unless the command line sets other
     * values: then Scene takes the default, and reports it. @p text is the value and @p by what
     * makes no use of it, for the message.
     */
    class UnusedValue : public InputError
    {
    public:
      UnusedValue(const std::string &section,
                  const std::string &key,
                  const std::string &text,
                  const std::string &by,
                  const std::string &remedy);

      /// Names of the sections and, last, the key.
      std::vector<std::string> path;
      /// What makes no use of it.
      std::string by;
    };


    /// Reads one elevation, or points "x y" of a line separated by commas. @throws InputError.
    std::vector<dealii::Point<2>>
    read_line(const std::string &text, const std::string &parameter);


    /// Checks that a value that is not used has its default. @throws UnusedValue otherwise, saying
    /// that @p by makes no use of it.
    void
    expect_default(const std::string &section,
                   const std::string &key,
                   double             value,
                   double             default_value,
                   const std::string &by,
                   const std::string &remedy);

    /// The same for all noted entries of a section.
    void
    expect_defaults(const std::string &section,
                    const Entries     &given,
                    const Entries     &defaults,
                    const std::string &by,
                    const std::string &remedy);

    template <typename Parameters>
    void
    expect_defaults(const std::string &section,
                    Parameters         given,
                    const std::string &by,
                    const std::string &remedy)
    {
      Parameters standard;
      Entries    values(Entries::Stage::note), defaults(Entries::Stage::note);
      given.list_entries(values);
      standard.list_entries(defaults);
      expect_defaults(section, values, defaults, by, remedy);
    }
  } // namespace internal

  enum class Analysis;

  /// The entry `Model/Analysis`.
  void
  list_entry(internal::Entries &entries, Analysis &analysis);
} // namespace NMM

#endif
