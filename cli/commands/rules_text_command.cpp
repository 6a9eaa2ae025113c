#include "cli/commands/rules_commands.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/report.h"
#include "interpret/pack/pack_schema.h"
#include "interpret/pack/rule_base.h"
#include "kernel/io/files/output_file.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments {
  std::vector<std::string> packs;
  bool is_check = false;
  bool is_write = false;
  bool is_merged = false;
};

std::string text_of(const std::string& pack) {
  if (const auto text = embedded_pack(pack)) return std::string(*text);
  std::ifstream file(pack, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ExitCode format(const Arguments& arguments) {
  Report report(true);
  ExitCode code = ExitCode::clean;
  for (const std::string& pack : arguments.packs) {
    if (arguments.is_write && embedded_pack(pack))
      throw CLI::ValidationError("--write", "'" + pack + "' is built in and has no file");
    const auto formatted = format_pack_file(pack);
    if (!formatted.value) {
      report.add(formatted.issues);
      code = graver(code, ExitCode::rules);
    } else if (arguments.is_check) {
      if (*formatted.value == text_of(pack)) continue;
      run_log().write(LogLevel::error, pack + " is not in canonical form");
      code = graver(code, ExitCode::rules);
    } else if (!arguments.is_write) {
      std::fputs(formatted.value->c_str(), stdout);
    } else if (*formatted.value != text_of(pack)) {
      write_file(pack, *formatted.value);
    }
  }
  return code;
}

ExitCode show(const Arguments& arguments) {
  Report report(true);
  const std::string& pack = arguments.packs.front();
  const auto merged = merge_pack_file(pack);
  report.add(merged.issues);
  if (!merged.value) return ExitCode::rules;
  std::fputs((arguments.is_merged ? *merged.value : text_of(pack)).c_str(), stdout);
  return ExitCode::clean;
}

void add_format(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = rules.add_subcommand("fmt", "Print rule packs in canonical form");
  command->add_option("pack", arguments->packs, "Rule packs")->required();
  CLI::Option* check = command->add_flag("--check", arguments->is_check,
                                         "Print nothing; exit code 4 if a pack is in another form");
  command->add_flag("-w,--write", arguments->is_write, "Write them to their files")
      ->excludes(check);
  command->footer("Example:\n  oriel rules fmt -w my_rules.yaml");
  command->callback([arguments, &action] { action = [arguments] { return format(*arguments); }; });
}

void add_show(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  arguments->packs.resize(1);
  CLI::App* command = rules.add_subcommand("show", "Print a rule pack, also one that is built in");
  command->add_option("pack", arguments->packs[0], "A file, or the name of a pack")->required();
  command->add_flag("--merged", arguments->is_merged,
                    "With the packs that it extends put into one, without comments");
  command->footer("Example:\n  oriel rules show --merged my_town.yaml > all_of_it.yaml");
  command->callback([arguments, &action] { action = [arguments] { return show(*arguments); }; });
}

void add_schema(CLI::App& rules, Action& action) {
  CLI::App* command = rules.add_subcommand(
      "schema", "Print the JSON Schema of rule packs, from which editors complete");
  command->footer("Example:\n  oriel rules schema > oriel-1.schema.json");
  command->callback([&action] {
    action = [] {
      std::fputs(pack_schema().c_str(), stdout);
      return ExitCode::clean;
    };
  });
}

}  // namespace

void add_rules_text(CLI::App& rules, Action& action) {
  add_schema(rules, action);
  add_format(rules, action);
  add_show(rules, action);
}

}  // namespace oriel::cli
