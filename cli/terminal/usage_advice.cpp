#include "cli/terminal/usage_advice.h"

#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

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
    if (synonym.theirs == word && (is_option_of_all || contains(names, first)))
      return std::string(synonym.ours);
  }
  return nearest(word, names);
}

std::string did_you_mean(const std::string& meant) {
  return meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant);
}

std::string unknown_option(const CLI::App& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  return fmt::format("'{}' has no option '{}'{}", full_name(command), printable(name),
                     did_you_mean(meant(name, option_names(command), kOptionSynonyms)));
}

/// CLI11 has the last of them first.
std::string too_many_arguments(const CLI::App& command, std::vector<std::string> rest) {
  std::ranges::reverse(rest);
  return fmt::format("'{}' takes fewer arguments: '{}' {} too many", full_name(command),
                     printable(fmt::format("{}", fmt::join(rest, "', '"))),
                     rest.size() == 1 ? "is" : "are");
}

/// The option of that name, of the command or of its groups; or null.
const CLI::Option* find_option(const CLI::App& command, const std::string& name) {
  if (const CLI::Option* option = command.get_option_no_throw(name)) return option;
  for (const CLI::App* group : command.get_subcommands(is_group))
    if (const CLI::Option* option = find_option(*group, name)) return option;
  return nullptr;
}

/// ": Where to write (default: stdout)"; nothing for what is no option of the command.
std::string meaning_of(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = find_option(command, name);
  return option == nullptr ? "" : ": " + option->get_description();
}

/// "--scale, --to-lod" of "... [--scale,--to-lod] ..."; nothing without brackets.
std::string listed_options(std::string text) {
  const std::size_t open = text.find('['), close = text.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  text = text.substr(open + 1, close - open - 1);
  for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos; at += 2)
    text.replace(at, 1, ", ");
  return text;
}

/// The first call of the command in its help: "\nExample: oriel label house.city.json -o
/// out.city.json".
std::string example_of(const CLI::App& command) {
  const std::string footer = command.get_footer();
  const std::size_t begin = footer.find(full_name(command) + " ");
  if (begin == std::string::npos) return {};
  return "\nExample: " + footer.substr(begin, footer.find('\n', begin) - begin);
}

std::string what_is_missing(const CLI::App& command, const std::string& text) {
  const std::string options = listed_options(text);
  if (!options.empty()) return fmt::format("one of {} is required{}", options, example_of(command));
  if (const auto commands = command_names(command); text.starts_with("A subcommand"))
    return fmt::format("{}: {}", text, fmt::join(commands, ", "));
  constexpr std::string_view kRequired = " is required";
  const std::string name = text.substr(0, text.rfind(kRequired));
  return text + meaning_of(command, name) + example_of(command);
}

/// Of "--bbox: At least 4 required but received 3" and the like.
std::string wrong_number_of_values(const CLI::App& command, const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* option = find_option(command, name);
  if (option == nullptr) return text;
  const std::string type = option->get_type_name();
  return fmt::format(
      "{} needs {}{}", name,
      type.find(',') == std::string::npos || type.find('{') != std::string::npos ? "a value" : type,
      meaning_of(command, name));
}

/// Of "--resume requires --status" and "--repeat excludes --resume": the two options.
std::pair<std::string, std::string> two_options(const std::string& text, std::string_view verb) {
  const std::size_t at = text.find(verb);
  return {text.substr(0, at), text.substr(std::min(text.size(), at + verb.size()))};
}

/// Of "Could not convert: --seed = x": CLI11 names a flag with a value so, too.
std::string wrong_kind_of_value(const CLI::App& command, std::string text) {
  constexpr std::string_view kBegin = "Could not convert: ";
  if (!text.starts_with(kBegin)) return text;
  text.erase(0, kBegin.size());
  const auto [name, value] = two_options(text, " = ");
  const CLI::Option* option = find_option(command, name);
  const bool is_flag = option != nullptr && option->get_type_size_max() == 0;
  return is_flag
             ? fmt::format("{} takes no value; '{}' was given", name, value)
             : fmt::format("{}: '{}' is not a number{}", name, value, meaning_of(command, name));
}

}  // namespace

std::string usage_sentence(const CLI::App& app, const CLI::Error& error) {
  const CLI::App& command = reached(app);
  const std::string text = error.what();
  if (error.get_name() == "RequiredError") {
    const bool is_excess = text.starts_with("Requires at most 1 ");
    if (is_excess) return fmt::format("only one of {} may be given", listed_options(text));
    return what_is_missing(command, text);
  }
  if (error.get_name() == "ArgumentMismatch") return wrong_number_of_values(command, text);
  if (error.get_name() == "ConversionError") return wrong_kind_of_value(command, text);
  if (error.get_name() == "RequiresError") {
    const auto [option, other] = two_options(text, " requires ");
    return fmt::format("{} needs {} as well{}", option, other, meaning_of(command, other));
  }
  if (error.get_name() == "ExcludesError") {
    const auto [option, other] = two_options(text, " excludes ");
    return fmt::format("{} and {} do not work together: leave one of them out", option, other);
  }
  return text;
}

std::string pointer_to_help(const CLI::App& app) {
  return fmt::format("Run '{} --help' for more information.", full_name(reached(app)));
}

std::string usage_advice(const CLI::App& app) {
  const CLI::App& command = reached(app);
  const std::vector<std::string> rest = app.remaining(true);
  if (!rest.empty() && rest[0] == "help" && &command != &app)
    return fmt::format("'help' is no command of oriel; did you mean '{} --help'?",
                       full_name(command));
  const auto option = std::ranges::find_if(rest, [](const std::string& argument) {
    return argument.size() > 1 && argument.front() == '-' && argument != "--";
  });
  const auto commands = command_names(command);
  const bool needs_command = !commands.empty() && command.get_subcommands().empty();
  if (needs_command && !rest.empty() && rest.begin() != option)
    return fmt::format("'{}' is not a command of {}{}", printable(rest[0]), full_name(command),
                       did_you_mean(meant(rest[0], commands, kCommandSynonyms)));
  if (option != rest.end()) return unknown_option(command, *option);
  return rest.empty() ? "" : too_many_arguments(command, rest);
}

}  // namespace oriel::cli
