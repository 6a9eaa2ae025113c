#include "cli/completion/command_tree.h"

#include <CLI/CLI.hpp>

namespace oriel::cli {
namespace {

/// The words between the braces of a type such as "TEXT:{none,planar}".
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

bool is_number_type(const std::string& type) {
  return type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
}

CompletedOption completed(const CLI::Option& option) {
  CompletedOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.sentence = option.get_description();
  result.takes_value = option.get_type_size_max() != 0;
  if (!result.takes_value) return result;
  const std::string type = option.get_type_name();
  result.is_number = is_number_type(type);
  result.is_repeated = option.get_expected_max() > 1;
  result.choices = choices_in(type);
  return result;
}

/// Of the app and of its groups of options, which are nameless commands to CLI11.
void add_options(const CLI::App& app, std::vector<CompletedOption>& options) {
  for (const CLI::Option* option : app.get_options())
    if (option->nonpositional() && !option->get_group().empty())
      options.push_back(completed(*option));
  for (const CLI::App* group :
       app.get_subcommands([](const CLI::App* one) { return one->get_name().empty(); }))
    add_options(*group, options);
}

CompletedCommand command_below(const CLI::App& app, const std::string& words) {
  CompletedCommand result{words, app.get_name(), app.get_description(), {}, {}};
  add_options(app, result.options);
  const auto is_shown = [](const CLI::App* one) {
    return !one->get_name().empty() && !one->get_group().empty();
  };
  for (const CLI::App* below : app.get_subcommands(is_shown))
    result.commands.push_back(
        command_below(*below, words.empty() ? below->get_name() : words + " " + below->get_name()));
  return result;
}

void append_all(const CompletedCommand& command, std::vector<const CompletedCommand*>& row) {
  row.push_back(&command);
  for (const CompletedCommand& below : command.commands) append_all(below, row);
}

}  // namespace

CompletedCommand command_tree(const CLI::App& app) { return command_below(app, ""); }

std::vector<const CompletedCommand*> all_commands(const CompletedCommand& tree) {
  std::vector<const CompletedCommand*> row;
  append_all(tree, row);
  return row;
}

}  // namespace oriel::cli
