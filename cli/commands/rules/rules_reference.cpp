#include "cli/commands/rules/rules_reference.h"

#include "cli/terminal/logging.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/table.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"
#include "oriel/rules.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// A list of names that packs can say.
struct WordList {
  std::string title;  ///< "of features"
  std::string key;    ///< in JSON: "features"
  std::string kind;   ///< "attribute"
  std::vector<VocabularyWord> words;
};

struct RulesWordsArguments {
  std::vector<std::string> names;
  bool is_json = false;
};

nlohmann::ordered_json word_as_json(const VocabularyWord& word, const std::string& kind) {
  nlohmann::ordered_json json{{"name", word.name}};
  if (!word.unit.empty()) json["unit"] = word.unit;
  json["meaning"] = word.meaning;
  json["example"] = word.example;
  if (!word.values.empty()) json[kind == "operator" ? "arguments" : "values"] = word.values;
  json["synonyms"] = word.synonyms;
  return json;
}

void print_json(const std::vector<WordList>& lists) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const WordList& list : lists) {
    nlohmann::ordered_json words = nlohmann::ordered_json::array();
    for (const VocabularyWord& word : list.words) words.push_back(word_as_json(word, list.kind));
    json[list.key] = std::move(words);
  }
  print_out(json.dump(2) + "\n", true);
}

/// One line for each name.
void print_list(const WordList& list) {
  const bool has_unit = !list.words.empty() && !list.words.front().unit.empty();
  std::vector<std::vector<std::string>> rows;
  rows.push_back(has_unit ? std::vector<std::string>{list.kind, "unit", "example", "meaning"}
                          : std::vector<std::string>{list.kind, "example", "meaning"});
  for (const VocabularyWord& word : list.words)
    rows.push_back(has_unit
                       ? std::vector<std::string>{word.name, word.unit, word.example, word.meaning}
                       : std::vector<std::string>{word.name, word.example, word.meaning});
  print_out(table(std::move(rows)));
}

/// All that is known of one name.
void print_word(const VocabularyWord& word, const WordList& list) {
  std::string text = fmt::format("{} ({} {})\n", word.name, list.kind, list.title);
  const auto add = [&](std::string_view what, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<12} {}\n", what, value);
  };
  add("meaning", word.meaning);
  add("unit", word.unit);
  add("example", word.example);
  if (list.kind == "operator") {
    add("in a pack",
        fmt::format("generalise: [{{id: mine, for: window, scale: \"1:1000 ..\", do: {}}}]",
                    word.example));
    for (const std::string& argument : word.values) add("argument", argument);
  } else {
    add("values", join(word.values));
  }
  add("also called", join(word.synonyms));
  print_out(text);
}

/// False if none of the lists has the name; what is near is said.
bool print_named(const std::string& name, const std::vector<WordList>& lists) {
  bool is_found = false;
  std::vector<std::string> all;
  for (const WordList& list : lists) {
    for (const VocabularyWord& word : list.words) all.push_back(word.name);
    const auto word = find_word(list.words, name);
    if (word) print_word(*word, list);
    is_found = is_found || word.has_value();
  }
  if (!is_found)
    run_log().write(LogLevel::error, fmt::format("there is no {} '{}'{}", lists.front().kind,
                                                 printable(name), did_you_mean(name, all)));
  return is_found;
}

ExitCode list_words(const RulesWordsArguments& arguments, std::vector<WordList> lists) {
  if (!arguments.is_json && arguments.names.empty()) {
    for (const WordList& list : lists) {
      if (lists.size() > 1)
        print_out(fmt::format("{}{}:\n\n", &list == lists.data() ? "" : "\n", list.title));
      print_list(list);
    }
    return ExitCode::clean;
  }
  if (arguments.is_json) {
    print_json(lists);
    return ExitCode::clean;
  }
  ExitCode code = ExitCode::clean;
  for (const std::string& name : arguments.names)
    if (!print_named(name, lists)) code = ExitCode::usage;
  return code;
}

void add_words(CLI::App& rules, Action& action, const std::string& name, const std::string& help,
               const std::string& example, std::vector<WordList> (*lists)()) {
  auto arguments = std::make_shared<RulesWordsArguments>();
  CLI::App* command = rules.add_subcommand(name, help);
  CLI::Option* names = command->add_option("name", arguments->names,
                                           "Show only these, with their names in other systems");
  command->add_flag("--json", arguments->is_json, "Print all as JSON")->excludes(names);
  command->footer("Example:\n  oriel rules " + example);
  command->callback([arguments, lists, &action] {
    action = [arguments, lists] { return list_words(*arguments, lists()); };
  });
}

std::vector<WordList> attribute_lists() {
  return {{"of features", "features", "attribute", attribute_words()},
          {"of surfaces", "surfaces", "attribute", surface_attribute_words()}};
}

std::vector<WordList> relation_lists() {
  return {{"between features", "relations", "relation", relation_words()}};
}

std::vector<WordList> operator_lists() {
  return {{"of generalisation", "operators", "operator", operator_words()}};
}

struct RulesExplainArguments {
  std::vector<std::string> codes;
  bool is_json = false;
};

std::string in_capitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

void report_unknown_code(const std::string& text) {
  std::vector<std::string> all;
  for (const Code code : all_codes()) all.push_back(to_string(code));
  const std::string near = did_you_mean(text, all);
  run_log().write(LogLevel::error,
                  fmt::format("there is no code '{}'{}", printable(text),
                              near.empty() ? "; codes are such as E101, G404 and R204" : near));
}

ExitCode explain_codes(const RulesExplainArguments& arguments) {
  ExitCode exit = ExitCode::clean;
  nlohmann::ordered_json pages = nlohmann::ordered_json::array();
  bool is_first = true;
  for (const std::string& given : arguments.codes) {
    const auto code = code_of(in_capitals(given));
    if (!code) {
      report_unknown_code(in_capitals(given));
      exit = ExitCode::usage;
    } else if (arguments.is_json) {
      pages.push_back({{"code", to_string(*code)},
                       {"title", meaning_of(*code)},
                       {"page", page_of(*code)},
                       {"document", document_of(*code)}});
    } else {
      print_out(fmt::format("{}{} {}\n\n{}\n", std::exchange(is_first, false) ? "" : "\n",
                            to_string(*code), meaning_of(*code), page_of(*code)));
    }
  }
  if (arguments.is_json) print_out(pages.dump(2) + "\n", true);
  return exit;
}

ExitCode document(const std::string& pack) {
  Report report(false);
  const auto page = describe_pack_file(pack);
  report.add(page.issues);
  if (!page.value) return ExitCode::rules;
  print_out(*page.value, true);
  return ExitCode::clean;
}

}  // namespace

void add_rules_doc(CLI::App& rules, Action& action) {
  auto pack = std::make_shared<std::string>();
  CLI::App* command = rules.add_subcommand(
      "doc",
      "Print a Markdown page about a rule pack: its classes, params and rules in plain words");
  command->add_option("pack", *pack, "A file, or the name of a built-in pack")->required();
  command->footer("Example:\n  oriel rules doc my_town.yaml > my_town.md");
  command->callback([pack, &action] { action = [pack] { return document(*pack); }; });
}

void add_rules_words(CLI::App& rules, Action& action) {
  add_words(rules, action, "attributes",
            "List the attributes of features and surfaces for conditions", "attributes slope",
            attribute_lists);
  add_words(rules, action, "relations", "List the relations between features", "relations beside",
            relation_lists);
  add_words(rules, action, "operators", "List the operators of `generalise:`", "operators enlarge",
            operator_lists);
}

void add_rules_explain(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<RulesExplainArguments>();
  CLI::App* command = rules.add_subcommand(
      "explain", "Print what the documentation says about a code, such as R204");
  command->add_option("code", arguments->codes, "Codes of findings")->required();
  command->add_flag("--json", arguments->is_json, "Print a JSON array");
  command->footer("Example:\n  oriel rules explain R204");
  command->callback(
      [arguments, &action] { action = [arguments] { return explain_codes(*arguments); }; });
}

}  // namespace oriel::cli
