#include "cli/commands/commands.h"
#include "cli/commands/rules_commands.h"
#include "cli/terminal/report.h"
#include "interpret/pack/rule_base.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// "PATH: pack NAME VERSION, 23 rules for 10 labels".
std::string counts_of(const std::string& path, const RuleBase& pack) {
  const auto counted = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  return fmt::format("{}: pack {} {}, {} for {}\n", path, pack.name(), pack.version(),
                     counted(pack.rule_count(), "rule"), counted(pack.labels().size(), "label"));
}

struct Arguments {
  std::vector<std::string> packs;
  bool is_json = false;
};

/// A finding as editors read it.
nlohmann::ordered_json as_json(const Issue& issue) {
  return {{"file", issue.place.file},      {"line", issue.place.line},
          {"column", issue.place.column},  {"severity", to_string(issue.severity)},
          {"code", to_string(issue.code)}, {"sentence", issue.sentence}};
}

ExitCode work(const Arguments& arguments) {
  Report report(true);
  ExitCode code = ExitCode::clean;
  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  for (const std::string& path : arguments.packs) {
    const auto pack = load_pack_file(path);
    if (arguments.is_json)
      for (const Issue& issue : pack.issues) findings.push_back(as_json(issue));
    else
      report.add(pack.issues);
    if (!pack.value)
      code = ExitCode::rules;
    else if (!arguments.is_json)
      std::fputs(counts_of(path, *pack.value).c_str(), stdout);
  }
  if (arguments.is_json) std::fputs((findings.dump() + "\n").c_str(), stdout);
  return code;
}

}  // namespace

void add_rules(CLI::App& app, Action& action) {
  CLI::App* rules = app.add_subcommand("rules", "Work on rule packs");
  rules->require_subcommand(1);
  auto arguments = std::make_shared<Arguments>();
  CLI::App* check = rules->add_subcommand(
      "check", "Find everything that is wrong with a rule pack before any building is read");
  check
      ->add_option("pack", arguments->packs,
                   "Rule packs: files, or names of packs that are built in")
      ->required();
  check->add_flag("--json", arguments->is_json, "All findings as one JSON array");
  check->footer("Example:\n  oriel rules check my_rules.yaml");
  check->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
  add_rules_test(*rules, action);
  add_rules_text(*rules, action);
}

}  // namespace oriel::cli
