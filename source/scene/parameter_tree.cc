#include <nmm/base/exceptions.h>
#include <nmm/base/input_file.h>
#include <nmm/scene/parameter_tree.h>

#include <algorithm>
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <regex>
#include <scene/parsing.h>
#include <sstream>

namespace NMM
{
  using internal::join;

  namespace
  {
    using Tree = boost::property_tree::ptree;

    /// Whether a node of the printed tree is an entry, as opposed to a section.
    bool
    is_entry(const Tree &tree)
    {
      return tree.find("pattern_description") != tree.not_found();
    }


    Tree
    declared_tree(const dealii::ParameterHandler &prm)
    {
      std::stringstream text;
      prm.print_parameters(text,
                           dealii::ParameterHandler::JSON |
                             dealii::ParameterHandler::KeepDeclarationOrder);
      Tree tree;
      boost::property_tree::read_json(text, tree);
      return tree;
    }


    const Tree *
    find_child(const Tree &tree, const std::string &key)
    {
      const auto child = tree.find(key);
      return child == tree.not_found() ? nullptr : &child->second;
    }


    std::vector<std::string>
    keys(const Tree &tree, const bool entries)
    {
      std::vector<std::string> result;
      for (const auto &[key, child] : tree)
        if (is_entry(child) == entries)
          result.push_back(key);
      return result;
    }


    std::string
    trimmed(const std::string &text)
    {
      const auto first = text.find_first_not_of(" \t\r\n");
      if (first == std::string::npos)
        return "";
      return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
    }


    std::string
    on_one_line(const std::string &text)
    {
      return trimmed(std::regex_replace(text, std::regex("\\s+"), " "));
    }


    std::string
    pattern_in_words(const std::string &description)
    {
      std::string text = dealii::Patterns::pattern_factory(description)
                           ->description(dealii::Patterns::PatternBase::Text);
      text =
        std::regex_replace(text,
                           std::regex("A floating point number v such that "),
                           "number ");
      text = std::regex_replace(text,
                                std::regex("-MAX_DOUBLE <= v <= MAX_DOUBLE"),
                                "v");
      text = std::regex_replace(text,
                                std::regex("An integer n such that "),
                                "integer ");
      text = std::regex_replace(text, std::regex(" <= MAX_DOUBLE"), "");
      text = std::regex_replace(text, std::regex(" <= 2147483647"), "");
      text = std::regex_replace(text, std::regex("number v\\b"), "number");
      text =
        std::regex_replace(text,
                           std::regex("A list of (\\d+) to \\1 elements where "
                                      "each element is "),
                           "$1 of ");
      return on_one_line(text);
    }


    /// Edit distance of two words, without regard to case.
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      const auto lower = [](const char c) {
        return std::tolower(static_cast<unsigned char>(c));
      };
      std::vector<unsigned int> row(b.size() + 1);
      for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
      for (std::size_t i = 1; i <= a.size(); ++i)
      {
        unsigned int diagonal = row[0];
        row[0]                = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
          const unsigned int above = row[j];
          const unsigned int replaced =
            diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
          row[j]   = std::min({above + 1, row[j - 1] + 1, replaced});
          diagonal = above;
        }
      }
      return row[b.size()];
    }


    /// Advice for an unknown word: "did you mean ...?" or "there are: ...".
    std::string
    suggestion(const std::string              &word,
               const std::vector<std::string> &candidates,
               const std::string              &kind)
    {
      if (candidates.empty())
        return "there are no " + kind + " here";
      const std::vector<std::string> near = near_matches(word, candidates);
      if (near.size() < candidates.size() || near.size() == 1)
        return "did you mean '" + join(near, "' or '") + "'?";
      return "the " + kind + " here are: '" + join(near, "', '") + "'";
    }


    std::string
    section_name(const std::vector<std::string> &path)
    {
      return path.empty() ? "the top level of the scene"
                          : "section '" + join(path, "/") + "'";
    }


    /// The tree below @p path; @throws InputError at the first unknown section.
    const Tree &
    find_section(const Tree                     &root,
                 const std::vector<std::string> &path,
                 const std::string              &where)
    {
      const Tree              *section = &root;
      std::vector<std::string> known;
      for (const std::string &name : path)
      {
        const Tree *child    = find_child(*section, name);
        const bool  is_known = child != nullptr && !is_entry(*child);
        const auto  others   = keys(*section, false);
        AssertThrow(
          is_known || find_child(*section, "Names") == nullptr,
          InputError("the section '" + name + "' is not listed in '" +
                       join(known, "/") + "/Names'",
                     where,
                     "add '" + name + "' to '" + join(known, "/") + "/Names'" +
                       (others.empty()
                          ? ""
                          : ", or take a name that is listed there: '" +
                              join(near_matches(name, others), "' or '") +
                              "'")));
        AssertThrow(is_known,
                    InputError("there is no section '" + name + "' in " +
                                 section_name(known),
                               where,
                               suggestion(name, others, "sections")));
        section = child;
        known.push_back(name);
      }
      return *section;
    }


    /// Checks the size of the numbers in a value. @throws InputError if computations with them
    /// would overflow or underflow.
    void
    check_size_of_numbers(const std::string &value, const std::string &where)
    {
      // Computations contain at most squares of products of two numbers.
      constexpr double   smallest = 1e-75, largest = 1e75;
      std::istringstream words(value);
      for (std::string word; std::getline(words, word, ',');)
      {
        const double size = std::abs(std::strtod(word.c_str(), nullptr));
        const bool   is_zero =
          size == 0. &&
          word.substr(0, word.find_first_of("eE")).find_first_of("123456789") ==
            std::string::npos;
        AssertThrow(is_zero || (size >= smallest && size <= largest),
                    InputError("the number " + trimmed(word) +
                                 " is too large or too small to compute with",
                               where,
                               "give 0 or one from 1e-75 to 1e75 in size, if "
                               "need be in other units"));
      }
    }


    /// Checks all values of a section. @throws InputError for values that ParameterHandler accepts
    /// from a file although they do not match their patterns (it does not check those with braces),
    /// and for numbers of extreme size.
    void
    check_values(const Tree                     &section,
                 const std::vector<std::string> &path,
                 const std::string              &file_name)
    {
      for (const auto &[key, child] : section)
      {
        std::vector<std::string> child_path = path;
        child_path.push_back(key);
        if (!is_entry(child))
        {
          check_values(child, child_path, file_name);
          continue;
        }
        const auto value = child.get<std::string>("value");
        if (value == child.get<std::string>("default_value"))
          continue;
        const std::string where =
          "parameter '" + join(child_path, "/") + "' of " + file_name;
        const auto pattern = child.get<std::string>("pattern_description");
        AssertThrow(value.find('{') == std::string::npos ||
                      dealii::Patterns::pattern_factory(pattern)->match(value),
                    InputError("'" + value + "' is no valid value",
                               where,
                               "give: " + pattern_in_words(pattern)));
        if (pattern.find("[Double") != std::string::npos)
          check_size_of_numbers(value, where);
      }
    }


    /// Sets a value that does not come from a .prm file.
    void
    assign(const ParameterAssignment &assignment,
           const Tree                &tree,
           const bool                 skip_undefined,
           dealii::ParameterHandler  &prm)
    {
      const std::vector<std::string> sections(assignment.path.begin(),
                                              assignment.path.end() - 1);
      const std::string             &key = assignment.path.back();

      if (skip_undefined)
      {
        const Tree *node = &tree;
        for (const std::string &name : assignment.path)
        {
          node = find_child(*node, name);
          if (node == nullptr)
            return;
        }
      }

      const Tree &section = find_section(tree, sections, assignment.source);
      const Tree *entry   = find_child(section, key);
      // An empty object and an empty string of JSON look the same in the tree.
      if (entry != nullptr && !is_entry(*entry) && assignment.value.empty())
        return;
      AssertThrow(
        entry != nullptr && is_entry(*entry),
        InputError("there is no parameter '" + key + "' in " +
                     section_name(sections),
                   assignment.source,
                   suggestion(key, keys(section, true), "parameters")));
      const std::string pattern =
        entry->get<std::string>("pattern_description");
      AssertThrow(
        dealii::Patterns::pattern_factory(pattern)->match(assignment.value),
        InputError("'" + assignment.value + "' is no valid value of '" +
                     join(assignment.path, "/") + "'",
                   assignment.source,
                   "give: " + pattern_in_words(pattern)));

      for (const std::string &name : sections)
        prm.enter_subsection(name);
      prm.set(key, assignment.value);
      for (std::size_t i = 0; i < sections.size(); ++i)
        prm.leave_subsection();
    }


    /// What separates the elements of a value: commas in a list, and semicolons in a text, which
    /// may be geometry records or expressions.
    std::string
    separator(const Tree &declared, const std::vector<std::string> &path)
    {
      const Tree *node = &declared;
      for (const std::string &name : path)
      {
        node = find_child(*node, name);
        if (node == nullptr)
          return ", ";
      }
      const auto pattern =
        node->get_optional<std::string>("pattern_description");
      return pattern && *pattern == "[Anything]" ? "; " : ", ";
    }


    /// A JSON tree as assignments; arrays become lists.
    void
    flatten(const Tree                       &tree,
            const Tree                       &declared,
            const std::vector<std::string>   &path,
            const std::string                &source,
            std::vector<ParameterAssignment> &assignments)
    {
      const bool is_array =
        !tree.empty() &&
        std::all_of(tree.begin(), tree.end(), [](const auto &child) {
          return child.first.empty();
        });
      if (!path.empty() && (tree.empty() || is_array))
      {
        std::vector<std::string> elements;
        for (const auto &child : tree)
          elements.push_back(child.second.data());
        assignments.push_back(
          {path,
           is_array ? join(elements, separator(declared, path)) : tree.data(),
           source});
        return;
      }
      for (const auto &[key, child] : tree)
      {
        std::vector<std::string> child_path = path;
        child_path.push_back(key);
        flatten(child, declared, child_path, source, assignments);
      }
    }


    /// Checks the number of nested levels. The parser is recursive, so a text with very many levels
    /// would overflow the stack. @throws InputError if there are too many.
    void
    check_depth(const std::string &text, const std::string &file_name)
    {
      constexpr unsigned int max_depth = 32;
      unsigned int           depth = 0, line = 1;
      bool                   is_quoted = false;
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        const char c = text[i];
        line += c == '\n';
        if (is_quoted && c == '\\')
          ++i;
        else if (c == '"')
          is_quoted = !is_quoted;
        else if (!is_quoted && (c == '{' || c == '['))
          ++depth;
        else if (!is_quoted && (c == '}' || c == ']') && depth > 0)
          --depth;
        AssertThrow(
          depth <= max_depth,
          InputError("the file is nested more than " +
                       std::to_string(max_depth) + " deep",
                     file_name + ":" + std::to_string(line),
                     "close braces and brackets: scenes have sections "
                     "in sections, and no more"));
      }
    }


    std::vector<ParameterAssignment>
    read_json_assignments(const std::string &text,
                          const std::string &file_name,
                          const Tree        &declared)
    {
      check_depth(text, file_name);
      std::istringstream input(text);
      Tree               tree;
      try
      {
        boost::property_tree::read_json(input, tree);
      }
      catch (const boost::property_tree::json_parser_error &error)
      {
        AssertThrow(false,
                    InputError("the file is no valid JSON (" + error.message() +
                                 ")",
                               file_name + ":" + std::to_string(error.line()),
                               "correct it"));
      }
      std::vector<ParameterAssignment> assignments;
      flatten(tree, declared, {}, file_name, assignments);
      return assignments;
    }


    /// The number in a message "Line <n>" of ParameterHandler; 0 if there is none.
    unsigned int
    line_number(const std::string &message)
    {
      std::smatch match;
      return std::regex_search(message, match, std::regex("Line <(\\d+)>"))
               ? std::stoul(match[1])
               : 0;
    }


    /// A line of a .prm text with those that continue it, without comment.
    struct Statement
    {
      unsigned int line;
      std::string  text;

      /// Whether the first word is that one, in lower or upper case.
      bool
      begins_with(std::string word) const
      {
        const std::string first = text.substr(0, text.find_first_of(" \t"));
        return first.size() == word.size() && edit_distance(first, word) == 0;
      }
    };


    /// The statements of a .prm text, joined as ParameterHandler joins them.
    std::vector<Statement>
    statements_of(const std::string &text)
    {
      std::vector<Statement> result;
      std::istringstream     input(text);
      std::string            content, joined;
      unsigned int           number = 0, first = 1;
      while (std::getline(input, content))
      {
        ++number;
        content = trimmed(content);
        if (joined.empty())
          first = number;
        const bool goes_on = !content.empty() && content.back() == '\\';
        joined += goes_on ? content.substr(0, content.size() - 1) : content;
        if (goes_on && input.peek() != EOF)
          continue;
        joined = trimmed(joined.substr(0, joined.find('#')));
        if (!joined.empty())
          result.push_back({first, joined});
        joined.clear();
      }
      return result;
    }


    /// The sections that are open at @p line of a .prm text, with the lines where they begin.
    std::vector<Statement>
    open_sections(const std::string &text, const unsigned int line)
    {
      std::vector<Statement> path;
      for (const Statement &statement : statements_of(text))
        if (statement.line >= line)
          break;
        else if (statement.begins_with("subsection"))
          path.push_back(
            {statement.line, on_one_line(statement.text.substr(10))});
        else if (statement.begins_with("end") && !path.empty())
          path.pop_back();
      return path;
    }


    /// Refuses the statement "include" of ParameterHandler, which reads any file and follows itself
    /// without end. @throws InputError if there is one.
    void
    check_statements(const std::string &text, const std::string &file_name)
    {
      for (const Statement &statement : statements_of(text))
        AssertThrow(!statement.begins_with("include"),
                    InputError("'include' is no statement of a scene",
                               file_name + ":" + std::to_string(statement.line),
                               "write what it should read into the scene"));
    }


    /// Checks that all sections are closed. @throws InputError if one is not.
    void
    check_ends(const std::string &text, const std::string &file_name)
    {
      const auto open =
        open_sections(text, std::numeric_limits<unsigned int>::max());
      AssertThrow(open.empty(),
                  InputError("the section '" + open.back().text +
                               "' is never closed",
                             file_name + ":" + std::to_string(open.back().line),
                             "add the missing 'end', and look whether the "
                             "file is cut off"));
    }


    /// Throws an InputError that explains a message of ParameterHandler.
    [[noreturn]] void
    explain(const std::string &message,
            const std::string &file_name,
            const std::string &text,
            const Tree        &tree)
    {
      const unsigned int line = line_number(message);
      const std::string  where =
        file_name + (line > 0 ? ":" + std::to_string(line) : "");
      std::vector<std::string> path;
      for (const Statement &section : open_sections(text, line))
        path.push_back(section.text);
      std::smatch match;

      if (std::regex_search(message,
                            match,
                            std::regex("No entry with name <(.*)> was "
                                       "declared")))
      {
        const Tree &section = find_section(tree, path, where);
        AssertThrow(false,
                    InputError("there is no parameter '" + match.str(1) +
                                 "' in " + section_name(path),
                               where,
                               suggestion(match.str(1),
                                          keys(section, true),
                                          "parameters")));
      }
      if (std::regex_search(message,
                            match,
                            // messages of deal.II 9.4, and of 9.6
                            std::regex("(?:no such subsection to be entered: |"
                                       "enter a subsection ')(.*?)(?:', but "
                                       "the ParameterHandler.*)?$")))
      {
        std::vector<std::string> child_path = path;
        // Below the top level the message contains the name with its path.
        const std::string prefix = path.empty() ? "" : join(path, ".") + ".";
        const std::string name   = trimmed(match.str(1));
        child_path.push_back(
          name.rfind(prefix, 0) == 0 ? name.substr(prefix.size()) : name);
        find_section(tree, child_path, where);
      }
      if (std::regex_search(message,
                            match,
                            std::regex("The entry value (.*) for the entry "
                                       "named (.*) does not match the given "
                                       "pattern: (.*)")))
      {
        std::vector<std::string> full = path;
        full.push_back(match.str(2));
        AssertThrow(false,
                    InputError("'" + match.str(1) + "' is no valid value of '" +
                                 join(full, "/") + "'",
                               where,
                               "give: " + pattern_in_words(match.str(3))));
      }
      const std::string rest =
        std::regex_replace(message,
                           std::regex("^Line <\\d+> of file <[^>:]*>?: "),
                           "");
      AssertThrow(false,
                  InputError("the scene cannot be read (" + rest + ")",
                             where,
                             "lines are 'subsection NAME', 'set KEY = VALUE' "
                             "and 'end', comments start with '#'"));
      throw; // not reached: the assertion above always throws
    }
  } // namespace


  ParameterAssignment
  parse_assignment(const std::string &text)
  {
    const std::string where  = "--set " + text;
    const std::string remedy = "write --set \"Section/Key=value\"";
    const auto        equals = text.find('=');
    AssertThrow(equals != std::string::npos,
                InputError("an override without '='", where, remedy));
    ParameterAssignment assignment;
    assignment.value  = trimmed(text.substr(equals + 1));
    assignment.source = where;
    std::istringstream path(text.substr(0, equals));
    for (std::string name; std::getline(path, name, '/');)
      assignment.path.push_back(trimmed(name));
    AssertThrow(assignment.path.size() > 1 &&
                  std::none_of(assignment.path.begin(),
                               assignment.path.end(),
                               [](const auto &s) { return s.empty(); }),
                InputError("an override without section or key",
                           where,
                           remedy));
    return assignment;
  }


  std::vector<std::string>
  near_matches(const std::string              &word,
               const std::vector<std::string> &candidates)
  {
    std::vector<std::pair<unsigned int, std::string>> ranked;
    for (const std::string &candidate : candidates)
    {
      const unsigned int distance = edit_distance(word, candidate);
      if (3 * distance <= std::max(word.size(), candidate.size()) + 1)
        ranked.emplace_back(distance, candidate);
    }
    if (ranked.empty())
      return candidates;
    std::stable_sort(ranked.begin(), ranked.end(), [](auto &a, auto &b) {
      return a.first < b.first;
    });
    std::vector<std::string> result;
    for (std::size_t i = 0; i < ranked.size() && i < 3; ++i)
      result.push_back(ranked[i].second);
    return result;
  }


  namespace
  {
    /// Checks that the text without comments is UTF-8, since values are written as JSON and XML.
    /// @throws InputError if it is not.
    void
    check_encoding(const std::string &text, const std::string &file_name)
    {
      std::istringstream lines(text);
      unsigned int       number = 0;
      for (std::string line; std::getline(lines, line);)
      {
        ++number;
        AssertThrow(is_utf8(line.substr(0, line.find('#'))),
                    InputError("the line has characters that are not UTF-8",
                               file_name + ":" + std::to_string(number),
                               "save the file with the encoding UTF-8"));
      }
    }
  } // namespace


  void
  read_parameters(const std::string                      &file_name,
                  const std::vector<ParameterAssignment> &assignments,
                  const bool                              skip_undefined,
                  dealii::ParameterHandler               &prm)
  {
    const std::string text = read_input_file(file_name, "the scene file");
    check_encoding(text, file_name);
    const Tree                       tree = declared_tree(prm);
    std::vector<ParameterAssignment> all;
    const bool                       is_json =
      file_name.size() > 5 &&
      file_name.compare(file_name.size() - 5, 5, ".json") == 0;
    if (is_json)
      all = read_json_assignments(text, file_name, tree);
    else
    {
      check_statements(text, file_name);
      check_ends(text, file_name);
      try
      {
        std::istringstream input(text);
        prm.parse_input(input, file_name, "", skip_undefined);
      }
      catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream message;
        error.print_info(message);
        explain(on_one_line(message.str()), file_name, text, tree);
      }
    }

    all.insert(all.end(), assignments.begin(), assignments.end());
    for (const ParameterAssignment &assignment : all)
    {
      AssertThrow(is_utf8(assignment.value),
                  InputError("the value has characters that are not UTF-8",
                             assignment.source,
                             "give it in the encoding UTF-8"));
      assign(assignment, tree, skip_undefined, prm);
    }
    if (!skip_undefined)
      check_values(declared_tree(prm), {}, file_name);
  }


  void
  set_default(const std::vector<std::string> &path,
              dealii::ParameterHandler       &prm)
  {
    const Tree                     tree = declared_tree(prm);
    const std::vector<std::string> sections(path.begin(), path.end() - 1);
    const Tree                    &section = find_section(tree, sections, "");
    const std::string              value =
      section.find(path.back())->second.get<std::string>("default_value");
    for (const std::string &name : sections)
      prm.enter_subsection(name);
    prm.set(path.back(), value);
    for (std::size_t i = 0; i < sections.size(); ++i)
      prm.leave_subsection();
  }


  std::string
  parameter_reference(const dealii::ParameterHandler &prm)
  {
    std::ostringstream out;
    out << "# Parameter reference\n\n"
           "Generated by `nmm --print-parameters=markdown`; do not edit. A "
           "name in angle\nbrackets stands for each of the names that the "
           "section's entry `Names` lists.\nWhat sections mean and how they "
           "work together is in scene-format.md.\n";

    const std::function<void(const Tree &, const std::vector<std::string> &)>
      print_section = [&](const Tree                     &section,
                          const std::vector<std::string> &path) {
        if (!path.empty())
          out << "\n## " << join(path, " / ") << "\n";
        if (!keys(section, true).empty())
          out << '\n';
        for (const std::string &key : keys(section, true))
        {
          const Tree       &entry = section.find(key)->second;
          const std::string value = entry.get<std::string>("default_value");
          out << "- **" << key
              << "** = " << (value.empty() ? "(empty)" : "`" + value + "`")
              << " ("
              << pattern_in_words(entry.get<std::string>("pattern_description"))
              << "): " << on_one_line(entry.get<std::string>("documentation"))
              << '\n';
        }
        for (const std::string &key : keys(section, false))
        {
          std::vector<std::string> child = path;
          child.push_back(key);
          print_section(section.find(key)->second, child);
        }
      };
    print_section(declared_tree(prm), {});
    return out.str();
  }
} // namespace NMM
