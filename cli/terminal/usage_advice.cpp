#include "cli/terminal/usage_advice.h"

#include "interpret/language/suggest.h"
#include "kernel/base/printable.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// What people write who know other programs, and what oriel calls it. Of several that fit, the
/// first that there is.
struct UsageSynonym {
  std::string_view theirs;
  std::string_view ours;
};

constexpr UsageSynonym kCommandSynonyms[] = {
    {"classify", "label"},
    {"annotate", "label"},
    {"tag", "label"},
    {"simplify", "generalise"},
    {"generalize", "generalise"},
    {"lod", "generalise"},
    {"convert", "cat"},
    {"print", "cat"},
    {"read", "cat"},
    {"info", "cat"},
    {"fix", "repair"},
    {"heal", "repair"},
    {"check", "validate"},
    {"lint", "rules check"},
    {"test", "rules test"},
    {"why", "explain"},
    {"show", "view"},
    {"render", "view"},
    {"compare", "diff"},
    {"evaluate", "score"},
    {"join", "merge"},
    {"concat", "merge"},
    {"tile", "split"},
    {"help", "--help"},
    {"version", "--version"},
    {"validate", "check"},
    {"lint", "check"},
    {"print", "show"},
    {"cat", "show"},
    {"format", "fmt"},
    {"document", "doc"},
    {"docs", "doc"},
    {"list", "attributes"},
};

constexpr UsageSynonym kOptionSynonyms[] = {
    {"--pack", "--rules"},         {"--rule", "--rules"},        {"--rulepack", "--rules"},
    {"--out", "--output"},         {"--outfile", "--output"},    {"--output-file", "--output"},
    {"--format", "--to"},          {"--output-format", "--to"},  {"--input-format", "--from"},
    {"--threads", "--jobs"},       {"--workers", "--jobs"},      {"--cores", "--jobs"},
    {"--lod", "--to-lod"},         {"--target-lod", "--to-lod"}, {"--target", "--scale"},
    {"--reason", "--explain"},     {"--reasons", "--explain"},   {"--why", "--explain"},
    {"--building", "--id"},        {"--only", "--id"},           {"--filter", "--id"},
    {"--extent", "--bbox"},        {"--debug", "--verbose"},     {"--reference", "--truth"},
    {"--ground-truth", "--truth"}, {"--csv", "--features"},      {"--write", "--output"},
};

/// The command that was reached: `rules check` of `oriel rules check --bogus`.
const CLI::App& reached(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

/// "rules check", or "oriel" itself.
std::string full_name(const CLI::App& command) {
  std::string name = command.get_name();
  for (const CLI::App* above = command.get_parent();
       above != nullptr && above->get_parent() != nullptr; above = above->get_parent())
    name = above->get_name() + " " + name;
  return command.get_parent() == nullptr ? name : "oriel " + name;
}

/// Of a group of options, which CLI11 makes a command without a name.
bool is_group(const CLI::App* command) { return command->get_name().empty(); }

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!is_group(command)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const CLI::App* group : app.get_subcommands(is_group)) {
    const auto more = option_names(*group);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

template <std::size_t count>
std::string meant(std::string_view word, const std::vector<std::string>& names,
                  const UsageSynonym (&synonyms)[count]) {
  for (const UsageSynonym& synonym : synonyms) {
    const std::string_view first = synonym.ours.substr(0, synonym.ours.find(' '));
    const bool is_option_of_all = first == "--help" || first == "--version";
    if (synonym.theirs == word && (is_option_of_all || rules::contains(names, first)))
      return std::string(synonym.ours);
  }
  return rules::nearest(word, names);
}

std::string did_you_mean(const std::string& meant) {
  return meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant);
}

std::string unknown_option(const CLI::App& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  return fmt::format("'{}' has no option '{}'{}", full_name(command), printable(name),
                     did_you_mean(meant(name, option_names(command), kOptionSynonyms)));
}

}  // namespace

std::string usage_advice(const CLI::App& app) {
  const CLI::App& command = reached(app);
  const std::vector<std::string> rest = app.remaining(true);
  const auto option = std::ranges::find_if(rest, [](const std::string& argument) {
    return argument.size() > 1 && argument.front() == '-' && argument != "--";
  });
  const auto commands = command_names(command);
  const bool needs_command = !commands.empty() && command.get_subcommands().empty();
  if (needs_command && !rest.empty() && rest.begin() != option)
    return fmt::format("'{}' is no command of {}{}", printable(rest[0]), full_name(command),
                       did_you_mean(meant(rest[0], commands, kCommandSynonyms)));
  return option == rest.end() ? "" : unknown_option(command, *option);
}

}  // namespace oriel::cli
