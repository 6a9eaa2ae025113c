#include "cli/commands/commands.h"
#include "cli/commands/rules/rules_reference.h"
#include "cli/options/options.h"
#include "cli/output/named_files.h"
#include "cli/output/sarif.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"
#include "io/files/output_file.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/rules.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// "PATH: pack NAME VERSION, 23 rules for 10 labels".
std::string counts_of(const std::string& path, const RuleBase& pack) {
  return fmt::format("{}: pack {} {}, {} for {}\n", printable(path), printable(pack.name()),
                     printable(pack.version()), counted(pack.rule_count(), "rule"),
                     counted(pack.labels().size(), "label"));
}

struct RulesCheckArguments {
  std::vector<std::string> packs;
  bool is_json = false;
  std::string sarif;
};

/// A finding as editors read it.
nlohmann::ordered_json as_json(const Issue& issue) {
  return {{"file", issue.place.file},      {"line", issue.place.line},
          {"column", issue.place.column},  {"severity", to_string(issue.severity)},
          {"code", to_string(issue.code)}, {"sentence", issue.sentence}};
}

ExitCode check(const RulesCheckArguments& arguments) {
  NamedFiles names;
  for (const std::string& path : arguments.packs)
    if (!embedded_pack(path)) names.add_input("pack", path);
  names.add_output("--sarif", arguments.sarif);
  names.check();
  SarifLog log;
  Report report(true);
  ExitCode code = ExitCode::clean;
  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  for (const std::string& path : arguments.packs) {
    const auto pack = load_pack_file(path);
    log.add(pack.issues);
    if (arguments.is_json)
      for (const Issue& issue : pack.issues) findings.push_back(as_json(issue));
    else
      report.add(pack.issues);
    if (!pack.value)
      code = ExitCode::rules;
    else if (!arguments.is_json)
      print_out(counts_of(path, *pack.value));
  }
  if (arguments.is_json)
    print_out(
        findings.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n",
        true);
  if (!arguments.sarif.empty()) write_file(arguments.sarif, log.text());
  return code;
}

void add_check(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<RulesCheckArguments>();
  CLI::App* command = rules.add_subcommand(
      "check", "Check rule packs and report everything that is wrong; no building is read");
  command->add_option("pack", arguments->packs, "Rule packs: files, or names of built-in packs")
      ->required();
  command->add_flag("--json", arguments->is_json, "Print all findings as one JSON array");
  command->add_option(
      "--sarif", arguments->sarif,
      "Also write all findings to this file, as SARIF 2.1.0, which code hosts show");
  command->footer("Example:\n  oriel rules check my_rules.yaml");
  command->callback([arguments, &action] { action = [arguments] { return check(*arguments); }; });
}

struct RulesTestArguments {
  std::vector<std::string> files;
  std::string junit;
  std::string pictures;
  double min_coverage = 0;
  double min_conditions = 0;
  bool is_with_base = false;

  [[nodiscard]] CoverageOf coverage() const {
    return is_with_base ? CoverageOf::all_rules : CoverageOf::own_rules;
  }
};

/// The tests stand beside the pack: `town.test.yaml` beside `town.yaml`.
std::string tests_of(const std::string& file) {
  if (file.ends_with(".test.yaml")) return file;
  const std::string extension = ".yaml";
  const std::string name =
      file.ends_with(extension) ? file.substr(0, file.size() - extension.size()) : file;
  return name + ".test.yaml";
}

bool is_covered(const RuleTestReport& report, const RulesTestArguments& arguments) {
  const CoverageOf of = arguments.coverage();
  return report.rule_coverage(of) * 100 >= arguments.min_coverage &&
         report.condition_coverage(of) * 100 >= arguments.min_conditions;
}

/// Writes a picture for each failed test whose buildings are in a file, and prints where it lies.
void write_pictures(const std::vector<RuleTestReport>& reports, const std::string& folder,
                    Report& report) {
  std::set<std::string> taken;
  for (const RuleTestReport& tested : reports)
    for (const RuleTestResult& test : tested.tests) {
      if (test.failures.empty()) continue;
      const auto say = [&](const std::string& what) {
        print_out(fmt::format("{}:{}:{}: {}\n", printable(test.place.file), test.place.line,
                              test.place.column, what));
      };
      if (test.building.empty()) {
        say("no picture: " + printable(test.name) + ": its features are made by hand");
        continue;
      }
      auto drawn = picture_of(tested, test);
      if (!drawn.value) {
        for (Issue& issue : drawn.issues)
          if (issue.place.file.empty()) issue.place = test.place;
        report.add(drawn.issues);
        continue;
      }
      const std::string name = picture_name_of(tested, test);
      std::string unique = name;
      for (int i = 2; !taken.insert(unique).second; ++i) unique = fmt::format("{}-{}", name, i);
      const auto path = std::filesystem::path(folder) / (unique + ".svg");
      std::error_code error;
      std::filesystem::create_directories(folder, error);  // shows when it is opened
      write_file(path.string(), *drawn.value);
      say("picture: " + printable(test.name) + ": " + printable(path.string()));
    }
}

ExitCode test(const RulesTestArguments& arguments) {
  NamedFiles names;
  for (const std::string& file : arguments.files) {
    names.add_input("file", file);
    if (tests_of(file) != file) names.add_input("file", tests_of(file));
  }
  names.add_output("--junit", arguments.junit);
  names.check();
  Report report(true);
  ExitCode code = ExitCode::clean;
  std::vector<RuleTestReport> reports;
  for (const std::string& file : arguments.files) {
    auto tested = run_rule_tests(tests_of(file));
    report.add(tested.issues);
    if (!tested.value) {
      code = ExitCode::rules;
      continue;
    }
    print_out(to_text(*tested.value, arguments.coverage()));
    if (!is_covered(*tested.value, arguments)) {
      code = ExitCode::rules;
      run_log().write(LogLevel::error, printable(file) + ": less is covered than was asked for");
    }
    if (tested.value->failed() > 0) code = ExitCode::rules;
    reports.push_back(std::move(*tested.value));
  }
  if (!arguments.junit.empty()) write_file(arguments.junit, to_junit(reports));
  if (!arguments.pictures.empty()) write_pictures(reports, arguments.pictures, report);
  return code;
}

void add_test(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<RulesTestArguments>();
  CLI::App* command = rules.add_subcommand("test", "Run the tests of rule packs");
  command
      ->add_option(
          "file", arguments->files,
          "Packs, with their tests in NAME.test.yaml next to NAME.yaml, or the files of tests")
      ->required();
  command->add_option("--junit", arguments->junit, "Write the results to this file, as JUnit XML");
  command->add_option("--pictures", arguments->pictures,
                      "Folder for a picture of the building of each failed test, with what is not "
                      "as expected marked; it is made if it is not there");
  command
      ->add_option("--min-coverage", arguments->min_coverage,
                   "Fail if fewer than this per cent of the rules hold in any test")
      ->check(number_in(0.0, 100.0));
  command
      ->add_option(
          "--min-conditions", arguments->min_conditions,
          "Fail if fewer than this per cent of the conditions both hold and fail in the tests")
      ->check(number_in(0.0, 100.0));
  command->add_flag("--with-base", arguments->is_with_base,
                    "Also count the rules of the packs that a pack extends");
  command->footer("Example:\n  oriel rules test my_rules.yaml --min-coverage 100");
  command->callback([arguments, &action] { action = [arguments] { return test(*arguments); }; });
}

struct RulesPrintArguments {
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

ExitCode format(const RulesPrintArguments& arguments) {
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
      run_log().write(LogLevel::error, printable(pack) + " is not in canonical form");
      code = graver(code, ExitCode::rules);
    } else if (!arguments.is_write) {
      print_out(*formatted.value, true);
    } else if (*formatted.value != text_of(pack)) {
      write_file(pack, *formatted.value);
    }
  }
  return code;
}

ExitCode show(const RulesPrintArguments& arguments) {
  Report report(false);
  const std::string& pack = arguments.packs.front();
  const auto merged = merge_pack_file(pack);
  report.add(merged.issues);
  if (!merged.value) return ExitCode::rules;
  print_out(arguments.is_merged ? *merged.value : text_of(pack), true);
  return ExitCode::clean;
}

void add_format(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<RulesPrintArguments>();
  CLI::App* command = rules.add_subcommand("fmt", "Print rule packs in canonical form");
  command->add_option("pack", arguments->packs, "Rule packs")->required();
  CLI::Option* check =
      command->add_flag("--check", arguments->is_check,
                        "Print nothing; exit with 4 if a pack is not in canonical form");
  command->add_flag("-w,--write", arguments->is_write, "Write the result into the files")
      ->excludes(check);
  command->footer("Example:\n  oriel rules fmt -w my_rules.yaml");
  command->callback([arguments, &action] { action = [arguments] { return format(*arguments); }; });
}

void add_show(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<RulesPrintArguments>();
  arguments->packs.resize(1);
  CLI::App* command = rules.add_subcommand("show", "Print a rule pack: a file, or a built-in pack");
  command->add_option("pack", arguments->packs[0], "A file, or the name of a built-in pack")
      ->required();
  command->add_flag("--merged", arguments->is_merged,
                    "Merge it with the packs that it extends, without comments");
  command->footer("Example:\n  oriel rules show --merged my_town.yaml > all_of_it.yaml");
  command->callback([arguments, &action] { action = [arguments] { return show(*arguments); }; });
}

void add_schema(CLI::App& rules, Action& action) {
  CLI::App* command = rules.add_subcommand(
      "schema", "Print the JSON Schema of rule packs, for completion in editors");
  const auto of = std::make_shared<std::string>("packs");
  command->add_option("of", *of, "What it is of: packs, profiles or tests (default: packs)")
      ->check(CLI::IsMember({"packs", "profiles", "tests"}));
  command->footer("Example:\n  oriel rules schema > oriel-1.schema.json");
  command->callback([of, &action] {
    action = [of] {
      const rules::Grammar& grammar = *of == "packs"      ? rules::pack_grammar()
                                      : *of == "profiles" ? rules::profile_grammar()
                                                          : rules::test_grammar();
      print_out(grammar.schema(), true);
      return ExitCode::clean;
    };
  });
}

/// Throws E604 if there is something at one of the paths.
void refuse_present(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, none)))
      refuse_usage("name", Code::E604, printable(path) + " exists already; nothing is written");
  }
}

/// All of the files, or none of them.
void write_all(const std::vector<std::string>& paths, const std::vector<StarterFile>& files) {
  std::vector<std::unique_ptr<OutputFile>> outputs;
  for (std::size_t i = 0; i < files.size(); ++i) {
    outputs.push_back(std::make_unique<OutputFile>(paths[i]));
    outputs.back()->append(files[i].text);
  }
  std::size_t done = 0;
  try {
    for (; done < outputs.size(); ++done) outputs[done]->commit();
  } catch (const OutputError&) {
    for (std::size_t i = 0; i < done; ++i) std::filesystem::remove(paths[i]);
    throw;
  }
}

ExitCode make_new(const std::string& argument) {
  const std::filesystem::path given(argument);
  const auto files = starter_pack(given.filename().string());
  for (const Issue& issue : files.issues) refuse_usage("name", issue.code, issue.sentence);
  std::vector<std::string> paths;
  for (const StarterFile& file : *files.value)
    paths.push_back((given.parent_path() / file.name).string());
  refuse_present(paths);
  write_all(paths, *files.value);
  print_out(
      fmt::format("{}: a class and a rule for it, on top of residential\n{}: its tests\n{}: a "
                  "house with two of "
                  "them\nnow:\n  oriel rules test {}\n  oriel label {} --rules {}\n",
                  printable(paths[0]), printable(paths[1]), printable(paths[2]),
                  printable(paths[0]), printable(paths[2]), printable(paths[0])));
  return ExitCode::clean;
}

void add_new(CLI::App& rules, Action& action) {
  auto name = std::make_shared<std::string>();
  CLI::App* command = rules.add_subcommand(
      "new", "Write a new rule pack to start from, with its tests and a sample building");
  command
      ->add_option(
          "name", *name,
          "Name of the class, the pack and its files, such as solar_panel or packs/solar_panel")
      ->required();
  command->footer("Example:\n  oriel rules new solar_panel");
  command->callback([name, &action] { action = [name] { return make_new(*name); }; });
}

}  // namespace

void add_rules(CLI::App& app, Action& action) {
  CLI::App* rules = app.add_subcommand("rules", "Check, test, print and document rule packs");
  rules->require_subcommand(1);
  add_check(*rules, action);
  add_test(*rules, action);
  add_new(*rules, action);
  add_schema(*rules, action);
  add_format(*rules, action);
  add_show(*rules, action);
  add_rules_doc(*rules, action);
  add_rules_words(*rules, action);
  add_rules_explain(*rules, action);
  add_rules_lsp(*rules, action);
}

}  // namespace oriel::cli
